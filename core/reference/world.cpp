// SPDX-License-Identifier: MIT
#include "core/reference/world.hpp"

#include "core/base/diagnostic.hpp"
#include "core/base/parallel.hpp"
#include "core/reference/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

namespace mote::reference {

namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool opaque(const ChunkSet& chunks, std::uint64_t record, double batch_alpha) {
  return batch_alpha >= 1.0 && chunks.alpha_of(record) >= 1.0;
}
bool invisible(const ChunkSet& chunks, std::uint64_t record, double batch_alpha) {
  return !(batch_alpha > 0.0) || !(chunks.alpha_of(record) > 0.0);
}

// Exact geometry of a record as numbers that compare: equal ones are duplicates.
struct SameGeometry {
  const ChunkSet& chunks;
  [[nodiscard]] int order(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 ca = chunks.center(a), cb = chunks.center(b);
    for (int k = 0; k < 3; ++k)
      if (ca[k] != cb[k]) return ca[k] < cb[k] ? -1 : 1;
    const std::size_t n = chunks.vec4s_per_record;
    for (std::size_t i = 0; i < n; ++i)
      for (int k = i ? 0 : 3; k < 4; ++k) {
        const float fa = chunks.records[a * n + i][k], fb = chunks.records[b * n + i][k];
        if (fa != fb) return fa < fb ? -1 : 1;
      }
    return 0;
  }
};

// Items of all opaque records in use, the others being counted; or of all transparent ones.
std::vector<BvhItem> make_items(Tree& tree, const glm::dvec3& center, double alpha, bool of_opaque, unsigned threads) {
  const ChunkSet& chunks = *tree.chunks;
  constexpr std::uint64_t block = 64 * 1024;
  const std::uint64_t records = chunks.record_count();
  std::vector<std::vector<BvhItem>> parts((records + block - 1) / block);
  std::atomic<std::uint64_t> transparent{0};
  for_each_block(parts.size(), [&](std::size_t part) {
    const std::uint64_t end = std::min(records, (part + 1) * block);
    parts[part].reserve(end - part * block);
    for (std::uint64_t i = part * block; i < end; ++i) {
      if (chunks.rows[i] == no_row) continue;
      const Particle p = particle(chunks, i);
      if (!(p.radius > 0.0) || !std::isfinite(p.radius) || !finite(p.center)) continue;
      const bool is_opaque = opaque(chunks, i, alpha);
      if (of_opaque && !is_opaque) ++transparent;
      if (is_opaque != of_opaque || (!of_opaque && invisible(chunks, i, alpha))) continue;
      parts[part].push_back(make_item(tree.shape->bounds(p), center, static_cast<std::uint32_t>(i)));
    }
  }, threads);
  tree.transparent = transparent;
  std::vector<BvhItem> items;
  std::size_t count = 0;
  for (const auto& part : parts) count += part.size();
  items.reserve(count);
  for (auto& part : parts) items.insert(items.end(), part.begin(), part.end());
  return items;
}

// The middle of all chunks: float32 boxes relative to it are fine enough anywhere.
glm::dvec3 middle(const ChunkSet& chunks) {
  Bounds b;
  for (const Chunk& chunk : chunks.chunks)
    if (finite(chunk.origin)) b.add(chunk.origin);
  return b.empty() ? glm::dvec3(0) : b.center();
}

std::unique_ptr<Tree> build_tree(const std::shared_ptr<const ChunkSet>& chunks, const Shape& shape,
                                 double alpha, bool of_opaque, unsigned threads) {
  auto tree = std::make_unique<Tree>();
  tree->chunks = chunks;
  tree->shape = &shape;
  const glm::dvec3 center = middle(*chunks);
  const SameGeometry same{*chunks};
  std::mutex mutex;
  const Collapse collapse = [&](std::span<BvhItem> run) {
    std::sort(run.begin(), run.end(), [&](const BvhItem& a, const BvhItem& b) {
      const int order = same.order(a.index, b.index);
      return order ? order < 0 : chunks->rows[a.index] < chunks->rows[b.index];
    });
    std::size_t kept = 0;
    std::vector<std::uint32_t> repeated;
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (kept && same.order(run[kept - 1].index, run[i].index) == 0) {
        if (repeated.empty() || repeated.back() != run[kept - 1].index)
          repeated.push_back(run[kept - 1].index);
        continue;
      }
      run[kept++] = run[i];
    }
    const std::lock_guard lock(mutex);
    tree->repeated.insert(tree->repeated.end(), repeated.begin(), repeated.end());
    return kept;
  };
  tree->bvh = build_bvh(make_items(*tree, center, alpha, of_opaque, threads), center, of_opaque ? collapse : Collapse{}, threads);
  std::sort(tree->repeated.begin(), tree->repeated.end());
  return tree;
}

Placed place(const Tree& tree, const Scene& scene, std::uint32_t batch, std::size_t instance) {
  const Batch& b = scene.batches[batch];
  const glm::dmat4& m = b.instances[instance].world_from_data;
  const glm::dmat3 linear(m);
  Placed p;
  p.tree = &tree;
  p.batch = batch;
  p.first_id = b.id_base + instance * b.row_count;
  p.linear = linear;
  p.data_from_world = glm::inverse(linear);
  p.normal_to_world = glm::transpose(p.data_from_world);
  p.translation = glm::dvec3(m[3]);
  double sum = 0.0, forward = 0.0;
  bool good = finite(p.translation);
  for (int k = 0; k < 3; ++k) {
    good = good && finite(p.data_from_world[k]) && finite(linear[k]);
    sum += glm::dot(p.data_from_world[k], p.data_from_world[k]);
    forward += glm::dot(linear[k], linear[k]);
  }
  p.stretch = std::sqrt(sum); // the Frobenius norm bounds the spectral one
  p.curvature = 3.0 * std::sqrt(3.0) / (sum * std::sqrt(forward)); // (shortest half axis)^2 / longest, estimated by those norms
  if (!good || sum == 0.0)
    fail(Exit::BadInput, reference_codes::not_affine, {b.name},
         fmt::format("the matrix of instance {} cannot be inverted, so the reference cannot draw it.",
                     instance));
  glm::dvec3 half(0);
  for (int k = 0; k < 3; ++k)
    half += glm::abs(linear[k]) * (tree.bvh.bounds.max[k] - tree.bvh.bounds.min[k]) * 0.5;
  const glm::dvec3 center = p.translation + linear * tree.bvh.bounds.center();
  p.bounds.add(center - half);
  p.bounds.add(center + half);
  return p;
}

Bvh build_top(const std::vector<Placed>& placed, unsigned threads) {
  Bounds all;
  for (const Placed& p : placed) all.add(p.bounds);
  const glm::dvec3 center = all.empty() ? glm::dvec3(0) : all.center();
  std::vector<BvhItem> items;
  items.reserve(placed.size());
  for (std::uint32_t i = 0; i < placed.size(); ++i) items.push_back(make_item(placed[i].bounds, center, i));
  return build_bvh(std::move(items), center, {}, threads);
}

} // namespace

bool Tree::is_repeated(std::uint32_t record) const {
  return !repeated.empty() && std::binary_search(repeated.begin(), repeated.end(), record);
}

World build_world(const Scene& scene, unsigned threads) {
  const auto start = std::chrono::steady_clock::now();
  World world;
  world.scene = scene;
  // Batches that share chunks, type and opacity share a tree.
  std::map<std::tuple<const ChunkSet*, const Shape*, bool>, const Tree*> known;
  for (std::uint32_t i = 0; i < scene.batches.size(); ++i) {
    const Batch& batch = scene.batches[i];
    const Shape* shape = find_shape(batch.type);
    if (!shape)
      fail(Exit::BadInput, reference_codes::unknown_type, {batch.name},
           fmt::format("particle type '{}' has no double-precision intersector.", batch.type),
           {did_you_mean(batch.type, shape_types()), "the reference knows: " + list_of(shape_types())});
    world.particles = std::max(world.particles, batch.id_base + batch.instances.size() * batch.row_count);
    if (!batch.chunks) continue;
    const Tree*& tree = known[{batch.chunks.get(), shape, batch.alpha >= 1.0}];
    if (!tree) {
      world.trees.push_back(build_tree(batch.chunks, *shape, batch.alpha, true, threads));
      tree = world.trees.back().get();
    }
    world.transparent += tree->transparent * batch.instances.size();
    for (std::size_t k = 0; k < batch.instances.size() && !tree->bvh.nodes.empty(); ++k)
      world.placed.push_back(place(*tree, scene, i, k));
    if (tree->transparent == 0) continue;
    world.trees.push_back(build_tree(batch.chunks, *shape, batch.alpha, false, threads));
    const Tree& transparent = *world.trees.back();
    for (std::size_t k = 0; k < batch.instances.size() && !transparent.bvh.nodes.empty(); ++k)
      world.transparent_placed.push_back(place(transparent, scene, i, k));
  }
  world.top = build_top(world.placed, threads);
  world.transparent_top = build_top(world.transparent_placed, threads);
  world.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return world;
}

} // namespace mote::reference
