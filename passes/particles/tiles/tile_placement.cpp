// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tile_placement.hpp"

#include <cmath>

namespace mote::passes {
namespace {

// Decides whether tiles serve a box in view space, and which of them it may cover.
class TileRects {
public:
  TileRects(const View& view, const TilePlacement& how)
      : view_(view), margin_(how.margin / view.focal), splats_(how.splats), whole_(how.whole), perspective_(view.projection == Projection::Perspective),
        offset_(view.sample_offset - view.center()),
        last_(view.size.width - 1.0, view.size.height - 1.0), least_z_(std::max(view.near_cut, view.depth_near) * (1.0 + 1e-5)) {}

  // False: not for tiles. Chunks that cover no pixel center have an empty rectangle: `any` is false.
  bool place(const PlacedBox& box, double radius, TileChunk& out, bool& any) const {
    const double widened = margin_ * (perspective_ ? box.center.z + box.extent.z : 1.0), slack = 1e-6 * glm::length(box.center) + widened;
    radius += widened;
    const double z_min = box.center.z - box.extent.z - slack, z_max = box.center.z + box.extent.z + slack;
    if (z_min < least_z_ || (!whole_ && view_.far_cut > 0 && z_max > view_.far_cut)) return false;
    const glm::dvec2 lo = glm::dvec2(box.center - box.extent) - slack, hi = glm::dvec2(box.center + box.extent) + slack;
    glm::dvec2 first, last; // pixels
    for (int k = 0; k < 2; ++k) {
      const double a = perspective_ ? lo[k] / (lo[k] < 0 ? z_min : z_max) : lo[k];
      const double b = perspective_ ? hi[k] / (hi[k] > 0 ? z_min : z_max) : hi[k];
      first[k] = std::max(0.0, std::ceil(a * view_.focal - offset_[k] - 0.05));
      last[k] = std::min(last_[k], std::floor(b * view_.focal - offset_[k] + 0.05));
    }
    any = first.x <= last.x && first.y <= last.y;
    if (!any) return true;
    const glm::uvec2 tile_lo = glm::uvec2(first) / tile_size, tile_hi = glm::uvec2(last) / tile_size;
    const glm::dvec2 reach = glm::max(glm::abs(lo), glm::abs(hi));
    const glm::uvec2 most = most_tiles(radius, z_min, z_max, reach);
    out.rect_lo = pack_corner(tile_lo, most.x);
    out.rect_hi = pack_corner(tile_hi, most.y);
    out.side = splats_ ? splat_side(radius, z_min, z_max, reach) & 3u : 0u;
    out.origin = glm::vec3(box.origin);
    out.z_min = static_cast<float>(z_min);
    return true;
  }

private:
  // Pixels that a sphere extends at most if its nearest point is not before z_min and its center within `reach` of the axis.
  // Its extent in tangents is 2 r sqrt(x^2 + z^2 - r^2) / (z^2 - r^2) (method book, 4.1).
  [[nodiscard]] double extent(double radius, double z_min, double z_max, double reach) const {
    return view_.focal * (perspective_ ? 2 * radius * std::sqrt(reach * reach + z_max * z_max) / (z_min * (z_min + 2 * radius)) : 2 * radius);
  }
  // Tiles in x and y that it covers at most.
  [[nodiscard]] glm::uvec2 most_tiles(double radius, double z_min, double z_max, glm::dvec2 reach) const {
    glm::uvec2 most;
    for (int k = 0; k < 2; ++k) most[k] = static_cast<std::uint32_t>(std::min(extent(radius, z_min, z_max, reach[k]) + 0.1, 1e6)) / tile_size + 2;
    return most;
  }
  // Pixel centers in x or y that it covers at most, with what splat.comp allows for rounding; 0: more than splats are for.
  [[nodiscard]] std::uint32_t splat_side(double radius, double z_min, double z_max, glm::dvec2 reach) const {
    const double most = extent(radius, z_min, z_max, std::max(reach.x, reach.y)) + 0.05;
    return most < splat_sides ? static_cast<std::uint32_t>(most) + 1 : 0;
  }

  const View& view_;
  double margin_; // tangents
  bool splats_, whole_;
  bool perspective_;
  glm::dvec2 offset_, last_;
  double least_z_;
};

void add_near(const ChunkSet& set, std::uint64_t chunk, const ChunkPlacer& placer, const PlacedBox& box, TileChunk tiled, PlacedForTiles& out) {
  tiled.origin = glm::vec3(0);
  tiled.side = 0;
  tiled.chunk = static_cast<std::uint32_t>(out.near_records.size() / chunk_capacity);
  out.near.push_back(tiled);
  for (std::uint64_t record = chunk * chunk_capacity; record < (chunk + 1) * chunk_capacity; ++record) {
    out.near_records.push_back(placer.in_view(set, record, box));
    out.near_rows.push_back(set.rows[record]);
    out.near_colors.push_back(set.colors.empty() ? 0u : set.color_of(record));
  }
}

template <class T> void append(std::vector<T>& to, const std::vector<T>& from) { to.insert(to.end(), from.begin(), from.end()); }

} // namespace

void place_for_tiles(const ChunkSet& set, std::uint64_t first, std::uint64_t begin, std::uint64_t end, const Instance& instance, const View& view,
                     const ViewCuller& culler, const TilePlacement& how, PlacedForTiles& out) {
  const ChunkPlacer placer(instance, view, culler);
  const TileRects rects(view, how);
  PlacedBox box;
  TileChunk tiled;
  tiled.draw = how.draw & 0x3FFFFFFFu;
  for (std::uint64_t i = begin; i < end; ++i) {
    if (!placer.place(set.chunks[first + i], box)) continue;
    bool any = false;
    const double radius = placer.scale() * double{set.chunks[first + i].max_radius};
    if (!placer.similar() || !rects.place(box, radius, tiled, any) || (box.near && (how.exact || box.distance < 2 * radius || set.vec4s_per_record > 1))) {
      placer.add(set, first + i, i, box, out.rest);
    } else if (any && box.near) {
      add_near(set, first + i, placer, box, tiled, out);
    } else if (any) {
      tiled.chunk = static_cast<std::uint32_t>(i);
      out.tiled.push_back(tiled);
    }
  }
}

void PlacedForTiles::clear() {
  tiled.clear(), near.clear();
  rest.far.clear(), rest.near.clear(), rest.payloads.clear();
  near_records.clear(), near_rows.clear(), near_colors.clear();
}

void PlacedForTiles::add(const PlacedForTiles& later) {
  const auto before = static_cast<std::uint32_t>(near_records.size() / chunk_capacity);
  append(tiled, later.tiled);
  append(near, later.near);
  for (std::size_t i = near.size() - later.near.size(); i < near.size(); ++i) near[i].chunk += before;
  append(near_records, later.near_records);
  append(near_rows, later.near_rows);
  append(near_colors, later.near_colors);
}

} // namespace mote::passes
