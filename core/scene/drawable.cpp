// SPDX-License-Identifier: MIT
#include "core/scene/drawable.hpp"

#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mote {
namespace {

struct Skipped {
  std::uint64_t position{}, radius{}, zero{}, negative{}, shape{};
  std::uint64_t negative_row{}; // the first one
};

bool placed(const glm::dvec3& p) { return std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate && std::abs(p.z) <= largest_coordinate; }

Verdict judge_sphere(const glm::dvec3& p, double r) {
  if (r < 0.0) return Verdict::NegativeRadius;
  if (!placed(p)) return Verdict::NoPosition;
  if (!(r <= largest_coordinate)) return Verdict::NoRadius;
  return static_cast<float>(r) == 0.0f ? Verdict::ZeroRadius : Verdict::Draw;
}

bool drawn(Verdict verdict, std::uint64_t row, Skipped& skipped) {
  switch (verdict) {
  case Verdict::Draw: return true;
  case Verdict::NoPosition: ++skipped.position; break;
  case Verdict::NoRadius: ++skipped.radius; break;
  case Verdict::ZeroRadius: ++skipped.zero; break;
  case Verdict::NoShape: ++skipped.shape; break;
  case Verdict::Told: break;
  case Verdict::NegativeRadius:
    if (skipped.negative++ == 0) skipped.negative_row = row;
    break;
  }
  return false;
}

void report(const Skipped& skipped, const FrameContext& origin, const std::vector<double>& radii, Diagnostics& diagnostics) {
  const std::uint64_t count = origin.frame.count;
  if (skipped.negative) {
    const std::string more = skipped.negative > 1 ? fmt::format(", and {} more are negative", skipped.negative - 1) : "";
    const std::string value = radii.empty() ? "below 0" : fmt::format("'{}'", radii[skipped.negative_row]);
    diagnostics.error(code::radius_negative, origin.contents, fmt::format("the radius of particle {} is {}{}", skipped.negative_row, value, more),
                      {"Particles are counted from 0 in the order of the file"});
  }
  auto warn = [&](std::uint64_t number, std::string_view warning, std::string_view text) {
    if (number) diagnostics.warning(warning, origin.contents, fmt::format("{} of {} particles have {}", number, count, text));
  };
  warn(skipped.position, code::position_not_finite, "no finite position and are left out");
  warn(skipped.radius, code::radius_not_finite, "no finite radius and are left out");
  warn(skipped.shape, code::no_shape, "no length, no direction or no measure that could be drawn and are left out");
  warn(skipped.zero, code::radius_zero, "radius 0 and draw as nothing");
}

// Moves what is kept of a list to its front.
template <class T> void keep(std::vector<T>& list, std::size_t to, std::size_t from, std::size_t each = 1) {
  for (std::size_t i = 0; i < each && !list.empty(); ++i) list[to * each + i] = list[from * each + i];
}
template <class T> void cut(std::vector<T>& list, std::size_t count) {
  if (!list.empty()) list.resize(count);
}

} // namespace

Drawable choose(const FrameContext& context, std::vector<double> radii, std::vector<std::uint32_t> colors, Diagnostics& diagnostics) {
  const data::Frame& frame = context.frame;
  const data::Column& position = *frame.find("position");
  Drawable out;
  Skipped skipped;
  out.centers.resize(frame.count);
  out.rows.resize(frame.count);
  out.radii = radii;
  out.colors = std::move(colors);
  std::uint64_t kept = 0;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    if (!context.rows.empty() && !context.rows[row]) continue;
    const glm::dvec3 p(position.number(row, 0), position.number(row, 1), position.number(row, 2));
    if (!drawn(judge_sphere(p, radii[row]), row, skipped)) continue;
    out.centers[kept] = p;
    out.rows[kept] = static_cast<std::uint32_t>(row);
    keep(out.radii, kept, row);
    keep(out.colors, kept, row);
    ++kept;
  }
  out.centers.resize(kept);
  out.rows.resize(kept);
  out.radii.resize(kept);
  cut(out.colors, kept);
  report(skipped, context, radii, diagnostics);
  return out;
}

Drawable choose(const FrameContext& context, Glyphs glyphs, const std::vector<double>& radii, std::vector<std::uint32_t> colors, Diagnostics& diagnostics) {
  Drawable out{.vec4s_per_record = glyphs.vec4s_per_record, .centers = std::move(glyphs.centers), .half = std::move(glyphs.half), .radii = std::move(glyphs.bounds),
               .finest = std::move(glyphs.finest), .rest = std::move(glyphs.rest), .rows = {}, .colors = std::move(colors)};
  Skipped skipped;
  std::uint64_t kept = 0;
  for (std::uint64_t row = 0; row < context.frame.count; ++row) {
    if (!context.rows.empty() && !context.rows[row]) continue;
    const bool negative = glyphs.verdicts[row] == Verdict::NegativeRadius;
    if (!drawn(negative || placed(out.centers[row]) ? glyphs.verdicts[row] : Verdict::NoPosition, row, skipped)) continue;
    keep(out.centers, kept, row);
    keep(out.half, kept, row);
    keep(out.radii, kept, row);
    keep(out.finest, kept, row);
    keep(out.rest, kept, row, out.vec4s_per_record - 1);
    keep(out.colors, kept, row);
    out.rows.push_back(static_cast<std::uint32_t>(row));
    ++kept;
  }
  out.centers.resize(kept);
  out.half.resize(kept);
  out.radii.resize(kept);
  out.finest.resize(kept);
  out.rest.resize(kept * (out.vec4s_per_record - 1));
  cut(out.colors, kept);
  report(skipped, context, radii, diagnostics);
  return out;
}

Drawable subset(const Drawable& all, const std::vector<bool>& rows) {
  Drawable out = all;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    if (!rows[all.rows[i]]) continue;
    keep(out.centers, kept, i);
    keep(out.half, kept, i);
    keep(out.radii, kept, i);
    keep(out.finest, kept, i);
    keep(out.rest, kept, i, out.vec4s_per_record - 1);
    keep(out.rows, kept, i);
    keep(out.colors, kept, i);
    ++kept;
  }
  out.centers.resize(kept);
  cut(out.half, kept);
  out.radii.resize(kept);
  cut(out.finest, kept);
  cut(out.rest, kept * (out.vec4s_per_record - 1));
  out.rows.resize(kept);
  cut(out.colors, kept);
  return out;
}

std::shared_ptr<const ChunkSet> chunks_of(const Drawable& d) {
  return std::make_shared<ChunkSet>(build_chunks({.vec4s_per_record = d.vec4s_per_record, .centers = d.centers, .radii = d.radii, .finest = d.finest,
                                                  .half = d.half, .rest = d.rest, .rows = d.rows, .colors = d.colors}));
}

} // namespace mote
