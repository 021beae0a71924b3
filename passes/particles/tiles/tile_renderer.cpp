// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tile_renderer.hpp"

#include "passes/particles/particle_type.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <bit>

namespace mote::passes {
namespace {

using Usage = gpu::BufferUsage;
constexpr std::uint32_t most_capacity = 1u << 21;     // entries of a round: 24 MiB of them, 20 MiB of placed particles
static_assert((most_capacity / 256 + 1) * chunk_capacity <= 1u << 20); // place_bits of work.glsl
static_assert(2 * (most_capacity / 256) * chunk_capacity <= 1u << 20); // of a gathered frame: each chunk may be taken by both steps
constexpr float last_depth_step = 4095;               // as in work.glsl
constexpr float infinitely_far = 3e38f;               // as in cast.comp
constexpr std::uint32_t no_caster = 0xFFFFFFFFu;      // every word of a texel without one
constexpr std::uint64_t most_by_id = 1u << 23;        // casters kept by their ids: 128 MiB, of which what is seen is touched
constexpr std::uint32_t infinity_bits = 0x7F800000u;
constexpr std::uint32_t workgroup = 64;               // of all kernels but cast

std::uint32_t words_of(gpu::TextureFormat format) {
  switch (format) {
  case gpu::TextureFormat::RGBA8Unorm: return 1;
  case gpu::TextureFormat::RGBA16Float: return 2;
  case gpu::TextureFormat::RGBA32Float: return 4;
  default: return 0;
  }
}

// Uints of a step's arguments: a cursor; splat_words for each slice and side of splats; 4 for splat_far; then (x, y, z, total) for each slice, for
// allocate, cast and scatter, and for each slice's sift, each round. As in work.glsl.
constexpr std::uint32_t splat_words = 8;
std::uint32_t splat_far_start(std::size_t slices) { return 4u + splat_words * splat_sides * static_cast<std::uint32_t>(slices); }
std::uint32_t rounds_start(std::size_t slices) { return splat_far_start(slices) + 4u; }
std::uint32_t round_size(std::size_t slices) { return 4u * (2u * static_cast<std::uint32_t>(slices) + 3u); }
std::uint32_t region_size(std::uint32_t rounds, std::size_t slices) { return rounds_start(slices) + rounds * round_size(slices); }

std::vector<std::uint32_t> background_words(gpu::Color c, std::uint32_t words) {
  const glm::vec4 v(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), static_cast<float>(c.a));
  if (words == 1) return {glm::packUnorm4x8(v)};
  if (words == 2) return {glm::packHalf2x16(glm::vec2(v.x, v.y)), glm::packHalf2x16(glm::vec2(v.z, v.w))};
  return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y), std::bit_cast<std::uint32_t>(v.z), std::bit_cast<std::uint32_t>(v.w)};
}

ParticlePipelineKey drawing_of(ParticlePipelineKey key, const TileTargets& targets) {
  key.aovs = (targets.depth ? aov_depth_bit : 0u) | (targets.id ? aov_id_bit : 0u) | (targets.normal ? aov_normal_bit : 0u);
  if (targets.shadows) key.head_light_only = false;
  key.edges = targets.edges;
  return key;
}

bool has_casters(const TileTargets& targets) { return targets.casters || targets.casters_stay; }

} // namespace

bool TileRenderer::works(const gpu::Device& device, gpu::TextureFormat color) { return TileKernels::lanes(device) != 0 && words_of(color) != 0; }

TileRenderer::TileRenderer(gpu::Device device, const gpu::BindGroupLayout& frame) : device_(device), kernels_(std::move(device), frame) {}

bool TileRenderer::reserve(gpu::Buffer& buffer, std::string_view label, std::uint64_t bytes, Usage usage) {
  bytes = std::max<std::uint64_t>(bytes, 16);
  if (buffer && buffer.size() >= bytes) return false;
  buffer = {};
  buffer = device_.create_buffer({.label = label, .size = bytes, .usage = usage});
  return true;
}

void TileRenderer::update(TiledView& view, std::uint32_t width, std::uint32_t height, bool gather) {
  choose_splats(view.chunks);
  sort_by_depth(view.chunks, scratch_);
  plan_ = plan_tiles(view.chunks, width, height, most_capacity, gather);
  block_ = {.slices = static_cast<std::uint32_t>(view.slices.size()), .capacity = plan_.capacity, .list_capacity = plan_.list_capacity,
            .tiles_x = plan_.tiles_x, .tiles_y = plan_.tiles_y, .level1 = plan_.level1, .level2 = plan_.level2, .level3 = plan_.level3,
            .width = width, .height = height, .tile_room = plan_.tile_room, .spilled = plan_.level1 * plan_.tile_room + plan_.most_entries,
            .depth_origin = plan_.depth_first, .depth_scale = last_depth_step / std::max(plan_.depth_last - plan_.depth_first, 1e-6f * plan_.depth_last),
            .material = view.materials.empty() ? glm::vec4(0) : view.materials.front()};
  if (view.chunks.empty()) return;

  list_splats(view);
  regions_.clear();
  arguments_.clear();
  for (const TileStep& step : plan_.steps) {
    regions_.push_back(static_cast<std::uint32_t>(arguments_.size()));
    arguments_.resize(arguments_.size() + region_size(step.rounds, view.slices.size()), 1u);
    for (std::size_t i = regions_.back(); i < arguments_.size(); ++i)
      if (i < regions_.back() + 4u || i % 4 == 0 || i % 4 == 3) arguments_[i] = 0u; // (x, 1, 1, total)
    for (std::size_t k = 0, start = 0; k < splats_.size(); start += splats_[k++]) arguments_[regions_.back() + 4u + splat_words * k + 4u] = static_cast<std::uint32_t>(start);
    arguments_[regions_.back() + splat_far_start(view.slices.size()) + 1u] = plan_.tiles_y;
  }
  auto upload = [&](gpu::Buffer& buffer, std::string_view label, std::span<const std::byte> bytes) {
    reserve(buffer, label, bytes.size() + bytes.size() / 4, Usage::Storage | Usage::CopyDst | Usage::CopySrc);
    device_.queue().write_buffer(buffer, 0, bytes);
  };
  upload(buffers_.chunks, "tiles.chunks", std::as_bytes(std::span(view.chunks)));
  upload(buffers_.draws, "tiles.draws", std::as_bytes(std::span(view.draws)));
  upload(buffers_.materials, "tiles.materials", std::as_bytes(std::span(view.materials)));
  upload(buffers_.argument_template, "tiles.argument_template", std::as_bytes(std::span(arguments_)));
  ids_ = view.ids;
  flags_fresh_ = reserve(buffers_.flags, "tiles.flags", view.flags * 8ull, Usage::Storage | Usage::CopyDst);
}

// Chunks that are drawn by splats go to a list of their slice and side.
void TileRenderer::list_splats(const TiledView& view) {
  splats_.assign(view.slices.size() * splat_sides, 0);
  splats_alone_ = plan_.splats == view.chunks.size() && view.slices.size() == 1;
  if (plan_.splats == 0) return;
  for (const TileChunk& chunk : view.chunks)
    if (chunk.side != 0) ++splats_[view.draws[chunk.draw].slice * splat_sides + chunk.side - 1u];
}

void TileRenderer::reserve_frame(const ParticlePipelineKey& key, const TileTargets& targets) {
  Buffers& b = buffers_;
  const std::uint64_t pixels = std::uint64_t{block_.width} * block_.height, places = std::uint64_t{plan_.gathered ? 2 * plan_.steps.front().count : plan_.list_capacity} * chunk_capacity;
  const std::uint64_t texels = std::uint64_t{plan_.level1} * tile_size * tile_size; // of a map that stays: whole tiles
  const std::uint64_t payload = find_particle_type(key.type)->vec4s_per_payload * sizeof(glm::vec4);
  const Usage storage = Usage::Storage | Usage::CopyDst | Usage::CopySrc;
  reserve(b.lists, "tiles.lists", std::uint64_t{plan_.most_rounds()} * block_.slices * plan_.list_capacity * 16 + 16, storage);
  reserve(b.arguments, "tiles.arguments", arguments_.size() * 4, storage);
  reserve(b.indirect, "tiles.indirect", arguments_.size() * 4, Usage::Indirect | Usage::CopyDst);
  reserve(b.payloads, "tiles.payloads", places * payload, storage);
  reserve(b.colors, "tiles.colors", places * 8, storage);
  reserve(b.ids, "tiles.ids", targets.id || has_casters(targets) || targets.shadows ? places * 4 : 0, storage);
  // Counts are left at zero by the casts before, unless they are counted elsewhere now: in a picture of another size.
  tiles_fresh_ = reserve(b.tiles, "tiles.tiles", plan_.level1 * 12ull, storage) || tiles_of_ != plan_.level1 || tiles_fresh_ || plan_.gathered;
  tiles_of_ = plan_.level1;
  reserve(b.far, "tiles.far", (plan_.cells + 3ull * plan_.level1) * 4, storage);
  reserve(b.active, "tiles.active", plan_.level1 * 4ull, storage);
  reserve(b.entries, "tiles.entries", (std::uint64_t{plan_.level1} * plan_.tile_room + 3ull * plan_.most_entries) * 4, storage);
  const bool keep_layers = targets.edges && !plan_.gathered;
  reserve(b.nearest, "tiles.nearest", targets.edges && plan_.gathered ? 0 : pixels * 4, storage);
  reserve(b.back_colors, "tiles.back_colors", keep_layers ? pixels * 8 : 0, storage);
  reserve(b.splats, "tiles.splats", plan_.splats != 0 ? pixels * 8 : 0, storage);
  reserve(b.splat_lists, "tiles.splat_lists", plan_.splats * 4ull, storage);
  reserve(b.color, "tiles.color", targets.casters_stay ? 0 : pixels * color_words_ * 4, storage);
  reserve(b.unused_color, "tiles.unused_color", 0, storage);
  reserve(b.encoded, "tiles.encoded_depth", targets.encoded_depth ? pixels * 4 : 0, storage);
  reserve(b.depth, "tiles.depth", targets.depth ? pixels * 4 : 0, storage);
  reserve(b.id, "tiles.id", targets.casters_stay ? texels * 4 : targets.id ? pixels * 4 : 0, storage);
  reserve(b.normal, "tiles.normal", keep_layers ? pixels * 32 : targets.normal || targets.casters ? pixels * 16 : targets.casters_stay && !by_id_ ? texels * 16 : 0, storage);
  reserve(b.casters, "tiles.casters", by_id_ ? ids_ * 16 : 0, storage);
}

void TileRenderer::make_groups(const TiledView& view) {
  auto group = [&](std::string_view label, const gpu::BindGroupLayout& layout, std::initializer_list<const gpu::Buffer*> buffers) {
    std::vector<gpu::BindGroupEntry> entries;
    for (const gpu::Buffer* buffer : buffers) entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .buffer = {buffer}});
    return device_.create_bind_group({.label = label, .layout = &layout, .entries = entries});
  };
  slice_groups_.clear();
  for (const SliceBuffers& slice : view.slices)
    slice_groups_.push_back(group("tiles.slice", kernels_.slice_layout(), {&slice.records, &slice.rows, &slice.colors, &slice.color_indices}));
  const Buffers& b = buffers_;
  binning_group_ = group("tiles.binning", kernels_.binning_layout(),
                         {&b.chunks, &b.draws, &b.flags, &b.lists, &b.arguments, &b.payloads, &b.colors, &b.ids, &b.tiles, &b.far, &b.active, &b.entries, &b.splats, &b.splat_lists, &b.casters});
  const bool narrow = color_words_ == 1;
  cast_group_ = group("tiles.cast", kernels_.cast_layout(),
                      {&b.materials, &b.payloads, &b.colors, &b.ids, &b.tiles, &b.far, &b.active, &b.entries, &b.nearest,
                       narrow ? &b.color : &b.unused_color, &b.encoded, &b.depth, &b.id, &b.normal, narrow ? &b.unused_color : &b.color, &b.back_colors});
  resolve_groups_.clear();
  if (plan_.splats == 0) return;
  splat_far_group_ = group("tiles.splat_far", kernels_.splat_far_layout(), {&b.splats, &b.nearest, &b.far});
  for (const SliceBuffers& slice : view.slices)
    resolve_groups_.push_back(group("tiles.resolve", kernels_.resolve_layout(),
                                    {&b.materials, &slice.records, &slice.rows, &slice.colors, &b.chunks, &b.draws, &b.splats, &slice.color_indices, &b.nearest,
                                     narrow ? &b.color : &b.unused_color, &b.encoded, &b.depth, &b.id, &b.normal, narrow ? &b.unused_color : &b.color, &b.back_colors}));
}

void TileRenderer::clear(gpu::CommandEncoder& encoder, const TileTargets& targets) {
  Buffers& b = buffers_;
  const std::uint32_t pixels = block_.width * block_.height;
  encoder.copy_buffer_to_buffer(b.argument_template, 0, b.arguments, 0, arguments_.size() * 4);
  if (tiles_fresh_) encoder.clear_buffer(b.tiles);
  tiles_fresh_ = plan_.gathered; // which leaves counts
  encoder.clear_buffer(b.far, 0, 0, infinity_bits);
  if (!(targets.edges && plan_.gathered)) encoder.clear_buffer(b.nearest, 0, std::uint64_t{pixels} * 4, std::bit_cast<std::uint32_t>(infinitely_far));
  if (targets.edges && !plan_.gathered) encoder.clear_buffer(b.normal, 0, std::uint64_t{pixels} * 32, std::bit_cast<std::uint32_t>(infinitely_far));
  if (plan_.splats != 0) encoder.clear_buffer(b.splats, 0, std::uint64_t{block_.width} * block_.height * 8, std::bit_cast<std::uint32_t>(infinitely_far));
  if (flags_fresh_) encoder.clear_buffer(b.flags);
  if (targets.encoded_depth) encoder.clear_buffer(b.encoded);
  if (targets.depth) encoder.clear_buffer(b.depth, 0, 0, infinity_bits);
  if (targets.id) encoder.clear_buffer(b.id, 0, 0, 0xFFFFFFFFu);
  if (targets.normal) encoder.clear_buffer(b.normal);
  if (targets.casters_stay) encoder.clear_buffer(b.id, 0, 0, no_caster);
  if (targets.casters) {
    encoder.clear_buffer(b.normal, 0, 0, no_caster);
    encoder.clear_buffer(b.color, 0, 0, no_caster);
  }
  if (!targets.color) return;

  const gpu::Color background = targets.map ? targets.map->apply(targets.background) : targets.background;
  const std::vector<std::uint32_t> words = background_words(background, color_words_);
  if (std::all_of(words.begin(), words.end(), [&](std::uint32_t w) { return w == words.front(); })) {
    encoder.clear_buffer(b.color, 0, 0, words.front());
    return;
  }
  // A pattern that a fill cannot make is made once and copied.
  if (background_words_ != words || !b.background || b.background.size() < std::uint64_t{pixels} * color_words_ * 4) {
    std::vector<std::uint32_t> image(std::size_t{pixels} * color_words_);
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = words[i % words.size()];
    reserve(b.background, "tiles.background", image.size() * 4, Usage::CopyDst | Usage::CopySrc);
    device_.queue().write_buffer(b.background, 0, std::as_bytes(std::span(image)));
    background_words_ = words;
  }
  encoder.copy_buffer_to_buffer(b.background, 0, b.color, 0, std::uint64_t{pixels} * color_words_ * 4);
}

void TileRenderer::record_step(gpu::CommandEncoder& encoder, std::size_t index, const TiledView& view, const gpu::BindGroup& frame_group, const CastKey& key,
                               const TileTargets& targets, const Mark& mark) {
  const TileStep& step = plan_.steps[index];
  ParticlePipelineKey placed = key.drawing;
  if (targets.shadows || has_casters(targets)) placed.aovs |= aov_id_bit; // no particle shadows itself
  const auto slices = static_cast<std::uint32_t>(view.slices.size());
  StepBlock block = block_;
  block.first = step.first;
  block.count = step.count;
  block.region = regions_[index];
  const bool sifted = step.others && !flags_fresh_;
  const std::uint32_t others = (step.others ? 1u : 0u) | anew_ << 2 | (sifted ? 32u : 0u) | (plan_.gathered ? 64u : 0u);
  block.others = others;
  block.place_first = plan_.gathered && step.others ? step.count : 0u;
  auto groups = [](std::uint32_t invocations) { return (invocations + workgroup - 1) / workgroup; };
  auto begin = [&](gpu::ComputePass& pass, const gpu::ComputePipeline& pipeline) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, frame_group);
    pass.set_bind_group(1, slice_groups_[block.slice]);
    pass.set_bind_group(2, binning_group_);
    pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
  };
  auto offset = [&](std::uint32_t round, std::uint32_t slot) { return (block.region + rounds_start(slices) + round * round_size(slices) + slot * 4u) * 4ull; };

  gpu::ComputePass cull = encoder.begin_compute_pass({.label = "tiles.cull"});
  begin(cull, kernels_.kernel("cull"));
  cull.dispatch(groups(step.count));
  cull.end();
  mark("cull");
  encoder.copy_buffer_to_buffer(buffers_.arguments, block.region * 4ull, buffers_.indirect, block.region * 4ull, region_size(step.rounds, slices) * 4ull);
  record_splats(encoder, block, frame_group, placed, mark);
  const bool tiles = plan_.splats < view.chunks.size();
  if (tiles && sifted) {
    gpu::ComputePass sift = encoder.begin_compute_pass({.label = "tiles.sift"});
    for (block.round = 0; block.round < step.rounds; ++block.round)
      for (block.slice = 0; block.slice < slices; ++block.slice) {
        begin(sift, kernels_.sift(placed));
        sift.dispatch_indirect(buffers_.indirect, offset(block.round, slices + 3 + block.slice));
      }
    block.slice = 0;
    sift.end();
    mark("sift");
    encoder.copy_buffer_to_buffer(buffers_.arguments, offset(0, 0), buffers_.indirect, offset(0, 0), step.rounds * round_size(slices) * 4ull);
  }
  for (std::uint32_t round = 0; tiles && round < step.rounds; ++round) {
    block.round = round;
    block.others = others | (plan_.gathered || (first_ && round == 0) ? 0u : 2u);
    gpu::ComputePass place = encoder.begin_compute_pass({.label = "tiles.place"});
    for (block.slice = 0; block.slice < slices; ++block.slice) {
      placed.paletted = placed.per_particle_color && view.slices[block.slice].paletted;
      begin(place, kernels_.place({placed, !step.others || sifted || (first_ && round == 0), block.slice == 0, key.by_id}));
      place.dispatch_indirect(buffers_.indirect, offset(round, block.slice));
    }
    block.slice = 0;
    begin(place, kernels_.kernel("allocate"));
    place.dispatch_indirect(buffers_.indirect, offset(round, slices));
    place.end();
    mark(step.others ? "place others" : "place");
    encoder.copy_buffer_to_buffer(buffers_.arguments, offset(round, slices + 1), buffers_.indirect, offset(round, slices + 1), 32);
    gpu::ComputePass cast = encoder.begin_compute_pass({.label = "tiles.cast"});
    begin(cast, kernels_.kernel("scatter"));
    cast.dispatch_indirect(buffers_.indirect, offset(round, slices + 2));
    cast.end();
    mark("scatter");
    cast = encoder.begin_compute_pass({.label = "tiles.cast"});
    const TileKernels::Besides besides{targets.map, targets.shadows, targets.cache_directory};
    cast.set_pipeline(kernels_.cast(key, besides));
    cast.set_bind_group(0, frame_group);
    cast.set_bind_group(1, cast_group_);
    set_shading_groups(cast, targets, besides);
    cast.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
    cast.dispatch_indirect(buffers_.indirect, offset(round, slices + 1));
    cast.end();
    mark(step.others ? "cast others" : "cast");
  }
  if (index + 1 == plan_.steps.size()) return;
  record_splat_far(encoder, block, frame_group, placed.orthographic, mark);
  gpu::ComputePass far = encoder.begin_compute_pass({.label = "tiles.far"});
  begin(far, kernels_.kernel("far"));
  far.dispatch(groups(plan_.cells));
  far.end();
  mark("far");
}

void TileRenderer::set_shading_groups(gpu::ComputePass& pass, const TileTargets& targets, const TileKernels::Besides& besides) const {
  if (targets.map && targets.map->group) pass.set_bind_group(rg::PixelMap::set, targets.map->group);
  if (targets.shadows) pass.set_bind_group(besides.shadow_set(), targets.shadows->group());
}

void TileRenderer::record_splats(gpu::CommandEncoder& encoder, const StepBlock& block, const gpu::BindGroup& frame_group, const ParticlePipelineKey& placed, const Mark& mark) {
  if (plan_.splats == 0) return;
  gpu::ComputePass pass = encoder.begin_compute_pass({.label = "tiles.splat"});
  for (std::uint32_t k = 0; k < splats_.size(); ++k) {
    if (splats_[k] == 0) continue;
    StepBlock own = block;
    own.slice = k / splat_sides;
    pass.set_pipeline(kernels_.splat(placed, k % splat_sides + 1u));
    pass.set_bind_group(0, frame_group);
    pass.set_bind_group(1, slice_groups_[own.slice]);
    pass.set_bind_group(2, binning_group_);
    pass.set_push_constants(0, std::as_bytes(std::span(&own, 1)));
    pass.dispatch_indirect(buffers_.indirect, (block.region + 4u + splat_words * k) * 4ull);
  }
  pass.end();
  mark("splat");
}

void TileRenderer::record_splat_far(gpu::CommandEncoder& encoder, const StepBlock& block, const gpu::BindGroup& frame_group, bool orthographic, const Mark& mark) {
  if (plan_.splats == 0) return;
  gpu::ComputePass pass = encoder.begin_compute_pass({.label = "tiles.splat_far"});
  pass.set_pipeline(kernels_.splat_far(orthographic, splats_alone_));
  pass.set_bind_group(0, frame_group);
  pass.set_bind_group(1, splat_far_group_);
  pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
  pass.dispatch_indirect(buffers_.indirect, (block.region + splat_far_start(slice_groups_.size())) * 4ull);
  pass.end();
  mark("splat far");
}

void TileRenderer::resolve_splats(gpu::CommandEncoder& encoder, const TiledView& view, const gpu::BindGroup& frame_group, CastKey key, const TileTargets& targets, const Mark& mark) {
  const TileKernels::Besides besides{targets.map, targets.shadows, targets.cache_directory};
  for (std::uint32_t k = 0; k < resolve_groups_.size(); ++k) {
    const auto first = splats_.begin() + k * splat_sides;
    if (std::all_of(first, first + splat_sides, [](std::uint32_t count) { return count == 0; })) continue;
    StepBlock block = block_;
    block.slice = k;
    gpu::ComputePass pass = encoder.begin_compute_pass({.label = "tiles.resolve"});
    key.drawing.paletted = key.drawing.per_particle_color && view.slices[k].paletted;
    pass.set_pipeline(kernels_.resolve_splats(key, besides, splats_alone_));
    pass.set_bind_group(0, frame_group);
    pass.set_bind_group(1, resolve_groups_[k]);
    set_shading_groups(pass, targets, besides);
    pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
    pass.dispatch(block.tiles_x, block.tiles_y);
    pass.end();
    mark("resolve splats");
  }
}

void TileRenderer::copy_out(gpu::CommandEncoder& encoder, const TileTargets& targets) {
  const gpu::Extent3d size{block_.width, block_.height, 1};
  auto copy = [&](const gpu::Buffer& from, const gpu::Texture& to) {
    if (to) encoder.copy_buffer_to_texture({.buffer = &from}, {.texture = &to}, size);
  };
  copy(buffers_.color, targets.color);
  copy(buffers_.encoded, targets.encoded_depth);
  copy(buffers_.depth, targets.depth);
  copy(buffers_.id, targets.id);
  copy(buffers_.normal, targets.normal);
  if (!targets.casters) return;
  encoder.copy_buffer_to_texture({.buffer = &buffers_.normal}, {.texture = &targets.casters}, size);
  encoder.copy_buffer_to_texture({.buffer = &buffers_.color}, {.texture = &targets.casters, .origin = {0, 0, 1}}, size);
}

void TileRenderer::record(gpu::CommandEncoder& encoder, const TiledView& view, const gpu::BindGroup& frame_group, const ParticlePipelineKey& drawing,
                          const TileTargets& targets, const Mark& mark) {
  color_words_ = targets.color ? words_of(targets.color.format()) : targets.casters ? 4 : targets.casters_stay ? 1 : 0;
  block_.background = glm::vec4(glm::dvec4(targets.background.r, targets.background.g, targets.background.b, targets.background.a));
  by_id_ = targets.casters_stay && plan_.splats == 0 && ids_ <= most_by_id;
  const CastKey key{.drawing = drawing_of(drawing, targets), .one_material = view.materials.size() == 1, .want_depth = bool(targets.encoded_depth),
              .display_only = color_words_ == 1 && !targets.depth && !targets.id && !targets.normal && !targets.encoded_depth && drawing.phase == Phase::Opaque,
              .keep_layers = targets.edges && !plan_.gathered, .by_id = by_id_, .color_words = color_words_,
              .pixel_map = targets.map ? targets.map->id : std::string(), .shadows = targets.shadows ? targets.shadows->key() : TileShadows::Key{}};
  reserve_frame(key.drawing, targets);
  make_groups(view);
  clear(encoder, targets);
  mark("clear");
  first_ = true;
  anew_ = (anew_ + 1) % 8;
  for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
    if (flags_fresh_ && !plan_.steps[i].others) continue; // nothing was seen before
    record_step(encoder, i, view, frame_group, key, targets, mark);
    first_ = false;
  }
  flags_fresh_ = false;
  resolve_splats(encoder, view, frame_group, key, targets, mark);
  copy_out(encoder, targets);
  mark("copy");
}

} // namespace mote::passes
