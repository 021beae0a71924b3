// SPDX-License-Identifier: MIT
// STL, ascii and binary. The format repeats each corner for each facet: corners of equal coordinates are
// one particle, in the order of their first appearance; its normal is the mean direction of its facets.
#include "core/data/codes_fields.hpp"
#include "core/data/registry.hpp"
#include "core/data/scan.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace mote::data {
namespace {

using Three = std::array<double, 3>;

struct Hash {
  std::size_t operator()(const Three& p) const {
    std::uint64_t h = 0x9e3779b97f4a7c15;
    for (const double v : p)
      h = (h ^ std::bit_cast<std::uint64_t>(v == 0 ? 0.0 : v)) * 0xff51afd7ed558ccd, h ^= h >> 32;
    return h;
  }
};

class Corners {
public:
  void add(const Three& corner, const Three& normal) {
    const auto [found, fresh] = index_.try_emplace(corner, points_.size() / 3);
    if (fresh) {
      points_.insert(points_.end(), corner.begin(), corner.end());
      normals_.resize(points_.size());
    }
    for (std::size_t k = 0; k < 3; ++k) normals_[3 * found->second + k] += normal[k];
  }
  Frame finish(const std::string& file) {
    for (std::size_t i = 0; i < normals_.size(); i += 3) {
      const double length = std::hypot(normals_[i], normals_[i + 1], normals_[i + 2]);
      for (std::size_t k = 0; k < 3 && length > 0; ++k) normals_[i + k] /= length;
    }
    std::vector<Column> arrays{position_column(std::move(points_)), {"normal", 3, std::move(normals_), {}}};
    Frame frame;
    assemble(frame, std::move(arrays), {}, {file});
    return frame;
  }

private:
  std::unordered_map<Three, std::uint64_t, Hash> index_{};
  std::vector<double> points_{}, normals_{};
};

constexpr std::uint64_t head_size = 84, facet_size = 50; // of the binary kind: 80 bytes of anything, a count

// An ascii file says "solid" and then "facet" or "endsolid"; "solid" alone may begin a binary one, too.
bool is_ascii(std::string_view all) {
  const std::string head = lower(all.substr(0, 1024));
  return head.starts_with("solid") &&
         (head.find("facet") != std::string::npos || head.find("endsolid") != std::string::npos);
}

Frame parse_binary(Bytes& bytes, Diagnostics& warnings) {
  ByteReader in(bytes, Order::Little);
  in.skip(80, "the heading");
  const auto facets = in.number<std::uint32_t>("the number of facets");
  const std::string_view all =
      in.take(std::uint64_t{facets} * facet_size, fmt::format("the {} facets", facets));
  if (in.left() > 0)
    warnings.warning(code::trailing, byte_place(bytes, in.at()),
                     fmt::format("{} bytes behind the last facet are ignored", in.left()));
  Corners corners;
  for (std::uint64_t f = 0; f < facets; ++f) {
    std::array<double, 12> v{};
    load_reals<float>(all.data() + f * facet_size, Order::Little, v);
    for (std::size_t c = 3; c < 12; c += 3) corners.add({v[c], v[c + 1], v[c + 2]}, {v[0], v[1], v[2]});
  }
  return corners.finish(bytes.name());
}

void expect(Scan& scan, std::string_view word) {
  if (const std::string_view found = scan.need_word(word); !same_word(found, word))
    scan.refuse(code::heading, fmt::format("'{}' is missing; here stands {}", word, shown(found)));
}
Three three(Scan& scan) {
  Three out{};
  for (double& value : out) value = scan.real("a coordinate");
  return out;
}

// solid NAME { facet normal x y z  outer loop  3 x vertex x y z  endloop  endfacet } endsolid NAME
Frame parse_ascii(Bytes& bytes) {
  Scan scan(bytes.name(), bytes.text());
  Corners corners;
  while (!scan.peek().empty()) {
    expect(scan, "solid");
    (void)scan.line();
    for (std::string_view word = scan.need_word("'endsolid'"); !same_word(word, "endsolid");
         word = scan.need_word("'endsolid'")) {
      if (!same_word(word, "facet"))
        scan.refuse(code::heading,
                    fmt::format("'facet' or 'endsolid' is missing; here stands {}", shown(word)));
      expect(scan, "normal");
      const Three normal = three(scan);
      expect(scan, "outer");
      expect(scan, "loop");
      for (int corner = 0; corner < 3; ++corner) {
        expect(scan, "vertex");
        corners.add(three(scan), normal);
      }
      expect(scan, "endloop");
      expect(scan, "endfacet");
    }
    (void)scan.line();
  }
  return corners.finish(bytes.name());
}

Frame parse_stl(Bytes& bytes, Diagnostics& warnings) {
  return is_ascii(bytes.view()) ? parse_ascii(bytes) : parse_binary(bytes, warnings);
}

Sureness probe_stl(const Probe& probe) {
  if (is_ascii(probe.head)) return Sureness::Likely;
  if (probe.head.size() < head_size) return Sureness::ByName;
  const std::uint64_t size =
      head_size + facet_size * load_number<std::uint32_t>(probe.head.data() + 80, Order::Little);
  return size == probe.head.size() ? Sureness::Likely
                                   : Sureness::ByName; // of a longer file only the name tells
}

} // namespace

Reader stl_reader();
Reader stl_reader() {
  return {{"stl", "STL, ascii and binary: the different corners, with normals", "stl stla stlb"},
          probe_stl,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("stl", std::move(bytes), parse_stl); }};
}

} // namespace mote::data
