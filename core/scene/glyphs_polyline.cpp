// SPDX-License-Identifier: MIT
// The maker of polylines: rows of one chain, in the order of the file, joined by capsules. A row is the segment from its point
// to the chain's next one (so the last row of a chain draws nothing; a chain of one row is a ball). Where two segments meet they end at
// the plane that halves their angle, if each holds what the other's ball leaves to it there: radii are equal, and each is longer
// than radius / cos(half the turn); then everything that one reaches beyond the plane is within the other. Else they overlap, and each
// record has the other's axis and radius in the plane's place, so that transparent ones can tell what is whose.
#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/glyphs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

namespace mote {
namespace {

constexpr std::uint64_t none = ~std::uint64_t{0};

// The next row of each row's chain.
std::vector<std::uint64_t> links(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics) {
  std::optional<Attribute> chain;
  if (desc.polyline.chain) chain = wanted_attribute(context, *desc.polyline.chain, false, diagnostics);
  else chain = find_attribute(context.frame, "chain");
  std::vector<std::uint64_t> next(context.frame.count, none);
  std::unordered_map<double, std::uint64_t> last;
  for (std::uint64_t row = 0; row < next.size(); ++row) {
    if (!context.rows.empty() && !context.rows[row]) continue;
    const auto [known, first] = last.try_emplace(chain ? chain->at(row) : 0.0, row);
    if (!first) next[std::exchange(known->second, row)] = row;
  }
  return next;
}

struct Segment {
  glm::dvec3 from{0}, way{0}; // way: to the next point
  double length{}, radius{};
  bool drawn{};
};

// The plane's normal where `a` goes on as `b`; zero where they overlap instead.
glm::dvec3 plane_between(const Segment& a, const Segment& b) {
  if (!a.drawn || !b.drawn || !(a.length > 0.0) || !(b.length > 0.0) || static_cast<float>(a.radius) != static_cast<float>(b.radius)) return glm::dvec3(0);
  const glm::dvec3 u = a.way / a.length, v = b.way / b.length;
  const double half_turn = std::sqrt(std::max(0.0, 0.5 * (1.0 + glm::dot(u, v)))); // its cosine
  if (!(std::min(a.length, b.length) * half_turn > 1.0001 * a.radius)) return glm::dvec3(0);
  return glm::normalize(u + v);
}

// A joint as records have it: (plane's normal, 0), else (h, radius) of the segment that overlaps with this one, else 0.
glm::vec4 joint(const Segment& a, const Segment& b, const Segment& other) {
  const glm::dvec3 plane = plane_between(a, b);
  if (plane != glm::dvec3(0)) return {glm::vec3(plane), 0.0f};
  return a.drawn && b.drawn ? glm::vec4(glm::vec3(0.5 * other.way), static_cast<float>(other.radius)) : glm::vec4(0);
}

double mean_length(const std::vector<Segment>& segments) {
  double sum = 0.0;
  std::uint64_t count = 0;
  for (const Segment& s : segments)
    if (s.length > 0.0 && std::isfinite(s.length)) sum += s.length, ++count;
  return count ? sum / double(count) : 0.0;
}

} // namespace

Glyphs make_polyline(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics) {
  const std::uint64_t count = context.frame.count;
  Glyphs out("polyline", 4, count);
  const std::vector<std::uint64_t> next = links(context, desc, diagnostics);
  if (diagnostics.has_errors()) return out;
  const data::Column& position = *context.frame.find("position");
  const auto at = [&](std::uint64_t row) { return glm::dvec3(position.number(row, 0), position.number(row, 1), position.number(row, 2)); };
  std::vector<Segment> segments(count);
  std::vector<std::uint64_t> before(count, none);
  for (std::uint64_t row = 0; row < count; ++row) {
    segments[row].from = at(row);
    if (next[row] == none) continue;
    before[next[row]] = row;
    segments[row].way = glm::dvec3(glm::vec3(0.5 * (at(next[row]) - at(row)))) * 2.0;
    segments[row].length = glm::length(segments[row].way);
  }
  const double usual = 0.1 * mean_length(segments);
  for (std::uint64_t row = 0; row < count; ++row) {
    Segment& s = segments[row];
    s.radius = radii.empty() ? usual : radii[row];
    out.centers[row] = s.from + 0.5 * s.way;
    Verdict& verdict = out.verdicts[row];
    if (next[row] == none && before[row] != none) verdict = Verdict::Told; // the chain's end
    else if (s.radius < 0.0) verdict = Verdict::NegativeRadius;
    else if (!(s.radius <= 1e30)) verdict = Verdict::NoRadius;
    else if (!(s.length <= 1e30)) verdict = Verdict::NoPosition;
    else if (static_cast<float>(s.radius) == 0.0f) verdict = Verdict::ZeroRadius;
    s.drawn = verdict == Verdict::Draw;
  }
  for (std::uint64_t row = 0; row < count; ++row) {
    const Segment& s = segments[row];
    if (!s.drawn) continue;
    glm::vec4* record = out.record(row);
    record[0] = glm::vec4(glm::vec3(0.5 * s.way), static_cast<float>(s.radius));
    if (before[row] != none) record[1] = joint(segments[before[row]], s, segments[before[row]]);
    if (next[row] != none) record[2] = joint(s, segments[next[row]], segments[next[row]]);
    out.finest[row] = s.radius;
    out.bounds[row] = (0.5 * s.length + s.radius) * glyph_padding;
    out.half[row] = (0.5 * glm::abs(s.way) + s.radius) * glyph_padding;
  }
  return out;
}

} // namespace mote
