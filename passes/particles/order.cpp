// SPDX-License-Identifier: MIT
#include "passes/particles/order.hpp"

#include "core/base/parallel.hpp"
#include "core/math/principal_axes.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/particles/radix_sort.hpp"

#include <algorithm>
#include <tuple>

namespace mote::passes {
namespace {

constexpr std::uint64_t chunks_per_thread = 512;

// One instance of one batch, from the eye.
struct Source {
  const Batch* batch{};
  std::size_t instance{};
  glm::dmat3 linear{1};      // world axes from data
  glm::dvec3 translation{0}; // of the data set's origin, relative to the eye
  double scale{1};           // at most this much longer than in the data
  bool affine{};             // placed by no similarity
};

Source source_of(const Batch& batch, std::size_t instance, const View& view) {
  const glm::dmat4& m = batch.instances[instance].world_from_data;
  Source s{&batch, instance, glm::dmat3(m), glm::dvec3(m[3]) - view.eye, 1.0, !similarity_scale(m)};
  s.scale = s.affine ? principal_axes(s.linear).longest() : *similarity_scale(m);
  return s;
}

struct Keys {
  const View& view;
  const Selection& selection;
  Order order;

  [[nodiscard]] std::uint64_t key(const glm::dvec3& center, double radius, std::uint64_t id) const {
    if (order == Order::File) return id;
    const std::uint64_t nearness = sortable(view.projection == Projection::Perspective
                                                ? glm::dot(center, center) - radius * radius
                                                : center.x * view.rotation[0].z + center.y * view.rotation[1].z + center.z * view.rotation[2].z);
    return order == Order::BackToFront ? ~nearness : nearness;
  }
  // Appends the particles of one placed chunk.
  void chunk(const Source& source, std::uint64_t chunk, std::uint32_t placement, std::vector<KeyValue>& out) const {
    const ChunkSet& set = *source.batch->chunks;
    const glm::dvec3 origin = source.linear * set.chunks[chunk].origin + source.translation;
    const std::uint64_t first_id = source.batch->id_base + source.instance * source.batch->row_count;
    for (std::uint32_t slot = 0; slot < set.chunks[chunk].count; ++slot) {
      const std::uint64_t record = chunk * chunk_capacity + slot;
      if (!in_selection(selection.opacity, alpha_of(*source.batch, record))) continue;
      const glm::vec4& stored = set.records[record * set.vec4s_per_record];
      const glm::dvec3 center = origin + source.linear * glm::dvec3(stored);
      out.push_back({key(center, double(stored.w) * source.scale, first_id + set.rows[record]), placement * chunk_capacity + slot});
    }
  }
};

// What is seen: placements with their sources and the chunk of the set.
struct Seen {
  std::vector<Source> sources{};
  std::vector<PlacedChunk> placements{};
  std::vector<std::uint32_t> owners{}; // index of a source
  std::vector<std::uint64_t> chunks{};
};

void append(Seen& seen, const std::vector<PlacedChunk>& placed, std::uint32_t owner, std::uint32_t first_chunk) {
  for (PlacedChunk p : placed) {
    seen.chunks.push_back(p.bits.w);
    p.bits.w += first_chunk;
    seen.placements.push_back(p);
    seen.owners.push_back(owner);
  }
}

std::vector<KeyValue> sorted_keys(const Seen& seen, const Keys& keys) {
  const std::uint32_t parts = thread_count(seen.placements.size(), chunks_per_thread);
  std::vector<std::vector<KeyValue>> found(parts);
  parallel_parts(seen.placements.size(), parts, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
    found[part].reserve((end - begin) * chunk_capacity);
    for (std::uint64_t i = begin; i < end; ++i)
      keys.chunk(seen.sources[seen.owners[i]], seen.chunks[i], static_cast<std::uint32_t>(i), found[part]);
  });
  std::vector<KeyValue> all = std::move(found.front());
  for (std::size_t i = 1; i < found.size(); ++i) all.insert(all.end(), found[i].begin(), found[i].end());
  radix_sort(all);
  return all;
}

// Cuts the order where another pipeline is needed.
void make_runs(OrderedParticles& out, const Seen& seen, const Scene& scene, const View& view, std::size_t near_count) {
  using Class = std::tuple<std::string, std::uint32_t, bool, bool>;
  std::vector<Class> known;
  std::vector<std::uint32_t> class_of(seen.sources.size());
  for (std::size_t s = 0; s < seen.sources.size(); ++s) {
    const ParticlePipelineKey key = key_for(scene, view, *seen.sources[s].batch);
    const Class c{key.type, key.specular_model, key.head_light_only, seen.sources[s].affine};
    const auto it = std::find(known.begin(), known.end(), c);
    class_of[s] = static_cast<std::uint32_t>(it - known.begin());
    if (it == known.end()) known.push_back(c);
  }
  std::uint32_t last = 0xFFFFFFFFu;
  for (std::uint32_t i = 0; i < out.order.size(); ++i) {
    const std::uint32_t placement = out.order[i] / chunk_capacity, owner = seen.owners[placement];
    const bool near_eye = placement < near_count;
    const std::uint32_t now = class_of[owner] * 2 + near_eye;
    if (now != last)
      out.runs.push_back({i, 0, static_cast<std::uint32_t>(seen.sources[owner].batch - scene.batches.data()), near_eye, seen.sources[owner].affine});
    ++out.runs.back().count;
    last = now;
  }
}

} // namespace

double alpha_of(const Batch& batch, std::uint64_t record) {
  return batch.alpha * batch.chunks->alpha_of(record);
}

bool in_selection(Opacity opacity, double alpha) {
  if (!(alpha > 0.0)) return false;
  return opacity == Opacity::All || (opacity == Opacity::Opaque) == (alpha >= 1.0);
}

OrderedParticles order_particles(const Scene& scene, const View& view, const Selection& selection, Order order,
                                 const std::vector<ChunkBase>& bases) {
  OrderedParticles out;
  Seen near, seen; // near chunks go first
  const ViewCuller culler(view);
  for (const Batch& batch : scene.batches) {
    const auto base = std::find_if(bases.begin(), bases.end(), [&](const ChunkBase& b) { return b.set == batch.chunks.get(); });
    if (base == bases.end() || !selection.draws(batch)) continue;
    for (std::size_t k = 0; k < batch.instances.size(); ++k) {
      PlacedChunks chunks;
      place_chunks(*batch.chunks, 0, batch.chunks->chunks.size(), batch.instances[k], view, culler, chunks);
      if (chunks.near.empty() && chunks.far.empty()) continue;
      const auto owner = static_cast<std::uint32_t>(out.blocks.size());
      out.blocks.push_back(batch_block(batch, k, view));
      if (!batch.chunks->colors.empty()) out.blocks.back().color = glm::vec4(1, 1, 1, out.blocks.back().color.a); // they have their own
      seen.sources.push_back(source_of(batch, k, view));
      append(near, chunks.near, owner, base->first_chunk);
      append(seen, chunks.far, owner, base->first_chunk);
      out.near.insert(out.near.end(), chunks.payloads.begin(), chunks.payloads.end());
    }
  }
  const std::size_t near_count = near.placements.size();
  seen.placements.insert(seen.placements.begin(), near.placements.begin(), near.placements.end());
  seen.owners.insert(seen.owners.begin(), near.owners.begin(), near.owners.end());
  seen.chunks.insert(seen.chunks.begin(), near.chunks.begin(), near.chunks.end());
  const std::vector<KeyValue> sorted = sorted_keys(seen, Keys{view, selection, order});
  out.order.reserve(sorted.size());
  for (const KeyValue& item : sorted) out.order.push_back(item.value);
  make_runs(out, seen, scene, view, near_count);
  out.placements = std::move(seen.placements);
  out.owners = std::move(seen.owners);
  return out;
}

} // namespace mote::passes
