// SPDX-License-Identifier: MIT
#include "passes/opaque_impostors.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/particle_store.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/particles/quad_indices.hpp"
#include "passes/particles/selection.hpp"
#include "passes/particles/tiles/tile_renderer.hpp"
#include "passes/states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace mote::passes {
namespace {

using gpu::TextureFormat;

struct AovSlot {
  std::string_view name;
  TextureFormat format;
  AovBits bit;
  std::string_view summary;
};
constexpr std::array<AovSlot, 3> aov_slots{{
    {"aov_depth", TextureFormat::R32Float, aov_depth_bit, "distance along the view axis, +inf where nothing is"},
    {"aov_id", TextureFormat::R32Uint, aov_id_bit, "particle id, 4294967295 where nothing is"},
    {"aov_normal", TextureFormat::RGBA32Float, aov_normal_bit, "unit normal in world space, turned to the eye"},
}};

class OpaqueImpostors final : public rg::Pass {
public:
  void declare(std::vector<rg::Slot>& slots, rg::Params& params) override {
    slots.push_back({.name = "color", .access = rg::Access::ColorWrite, .summary = "scene-linear color over the background",
                     .makes = rg::TextureSpec{.format = TextureFormat::RGBA16Float}, .copied_into = true});
    slots.push_back({.name = "depth", .access = rg::Access::DepthWrite, .summary = "n / z, reverse-Z",
                     .makes = rg::TextureSpec{.format = TextureFormat::Depth32Float}, .copied_into = true});
    for (const AovSlot& aov : aov_slots)
      slots.push_back({.name = std::string(aov.name), .access = rg::Access::ColorWrite, .summary = std::string(aov.summary),
                       .makes = rg::TextureSpec{.format = aov.format}, .optional = true, .copied_into = true});
    selection_ = read_selection(params, params.has("blend") ? Opacity::All : Opacity::Opaque);
    states_ = read_states(params);
  }

  void prepare(rg::PassContext& context) override {
    aovs_ = 0;
    targets_.clear();
    for (const std::string& slot : context.color_slots()) targets_.push_back(context.format(slot));
    for (const AovSlot& aov : aov_slots)
      if (context.connected(aov.name)) aovs_ |= aov.bit;
    depth_ = context.format("depth");
  }

  gpu::Color clear_value(std::string_view slot, const rg::FrameInput& frame) override {
    if (slot == "aov_depth") return {std::numeric_limits<double>::infinity(), 0, 0, 0};
    if (slot == "depth") return {cleared_depth(states_), 0, 0, 0};
    if (slot == "aov_id") return {4294967295.0, 0, 0, 0};
    if (slot != "color") return {0, 0, 0, 0};
    const glm::dvec4 b = frame.get<Scene>().background;
    return {b.r, b.g, b.b, b.a};
  }

  [[nodiscard]] bool opens_attachments() const override { return true; }

  void record(rg::PassContext& context) override {
    const Scene& scene = context.frame().get<Scene>();
    const View& view = context.frame().get<View>();
    const ParticleStore& store = context.frame().get<ParticleStore>();
    gpu::Device device = context.device();
    if (!pipelines_) make_frame_group(device, store);
    const FrameBlock block = frame_block(scene, view);
    device.queue().write_buffer(frame_buffer_, 0, std::as_bytes(std::span(&block, 1)));
    const Expansion expansion = choose_expansion(context.frame().get<FrameOptions>().expansion, device, scene);
    if (expansion == Expansion::Compute) check_tiles(scene);
    const bool tiled = expansion == Expansion::Compute && record_tiles(context, store);
    if (!tiled) placed_ = store.place(scene, view);
    if (tiled && tiled_.rest.draws.empty()) return;
    record_draws(context, tiled ? tiled_.rest : placed_, expansion == Expansion::Geometry ? expansion : Expansion::Vertex, tiled);
  }

private:
  // False: nothing in view is for tiles.
  bool record_tiles(rg::PassContext& context, const ParticleStore& store) {
    const Scene& scene = selected(context.frame().get<Scene>());
    const View& view = context.frame().get<View>();
    store.place_tiles(scene, view, tiled_);
    if (!tiles_) tiles_ = std::make_unique<TileRenderer>(context.device(), pipelines_->frame_layout());
    if (tiled_.chunks.empty()) return false;
    tiles_->update(tiled_, view.size.width, view.size.height);
    bool mixed = false;
    ParticlePipelineKey key = key_for_all(scene, view, mixed);
    if (mixed)
      fail(Exit::Failed, "P001", {}, "expansion 'compute' draws with one specular model a pass; this scene has Phong and Blinn-Phong materials",
           {"--expansion vertex or geometry can"});
    key.aovs = aovs_;
    const bool draw_on = !tiled_.rest.draws.empty();
    TileTargets targets{.color = context.whole_texture("color"),
                              .encoded_depth = draw_on || context.kept("depth") ? context.whole_texture("depth") : gpu::Texture(),
                              .depth = context.whole_texture("aov_depth"),
                              .id = context.whole_texture("aov_id"),
                              .normal = context.whole_texture("aov_normal"),
                              .background = clear_value("color", context.frame())};
    const auto next = draw_on ? std::nullopt : context.successor("color");
    if (next && TileRenderer::works(context.device(), next->target.format())) {
      const DisplaySettings* display = context.frame().find<DisplaySettings>();
      targets.map = next->map;
      targets.color = next->target;
      targets.cache_directory = display ? display->cache_directory : std::string();
      context.take_over("color");
    }
    tiles_->record(context.encoder(), tiled_, frame_group_, key, targets, [&](std::string_view stage) { context.mark(stage); });
    return true;
  }

  // The scene without the batches that are not this pass's.
  const Scene& selected(const Scene& scene) {
    const auto mine = [&](const Batch& batch) { return selection_.draws(batch); };
    if (std::all_of(scene.batches.begin(), scene.batches.end(), mine)) return scene;
    selected_ = scene;
    std::erase_if(selected_.batches, [&](const Batch& batch) { return !mine(batch); });
    return selected_;
  }

  void record_draws(rg::PassContext& context, const PlacedView& placed, Expansion expansion, bool loaded) {
    const Scene& scene = context.frame().get<Scene>();
    const View& view = context.frame().get<View>();
    std::uint32_t most = 0;
    for (const ParticleDraw& draw : placed.draws) most = std::max(most, draw.particles);
    gpu::Device device = context.device();
    if (expansion == Expansion::Vertex) indices_.reserve(device, most);
    gpu::RenderPass pass = context.begin_attachments(loaded);
    for (const ParticleDraw& draw : placed.draws) {
      if (!selection_.draws(*draw.batch)) continue;
      ParticlePipelineKey key = key_for(scene, view, *draw.batch);
      key.expansion = expansion;
      key.near_eye = draw.near_eye;
      key.affine = draw.affine;
      key.aovs = aovs_;
      key.targets = targets_;
      key.depth = depth_;
      key.opaque_only = key.per_particle_color && selection_.opacity == Opacity::Opaque;
      key.states = states_;
      key.show_depth_violation = context.frame().get<FrameOptions>().show_depth_violation;
      pass.set_pipeline(pipelines_->get(key));
      pass.set_bind_group(0, frame_group_);
      pass.set_bind_group(1, draw.group);
      pass.set_push_constants(0, std::as_bytes(std::span(&draw.block, 1)));
      if (expansion == Expansion::Vertex)
        indices_.draw(pass, draw.particles);
      else
        pass.draw(draw.particles);
    }
    pass.end();
  }

  // Auto is the vertex expansion: it works everywhere and was never slower. What is asked for and cannot be is P001.
  Expansion choose_expansion(Expansion wanted, const gpu::Device& device, const Scene& scene) const {
    const Expansion expansion = wanted == Expansion::Auto ? Expansion::Vertex : wanted;
    if (expansion == Expansion::Geometry && !gpu::has(device.features(), gpu::Feature::GeometryShader))
      fail(Exit::Failed, "P001", {}, "the device has no geometry stage, so expansion 'geometry' cannot be used", {"expansions that work here: vertex"});
    for (const Batch& batch : scene.batches) {
      const ParticleType* type = find_particle_type(batch.type);
      if (selection_.draws(batch) && (!type || !supports(*type, expansion, Phase::Opaque)))
        fail(Exit::Failed, "P001", {}, fmt::format("particle type '{}' cannot be drawn by expansion '{}'", batch.type, to_string(expansion)),
             {"mote graph --kinds prints what works together"});
    }
    if (scene.lights.size() > max_lights)
      fail(Exit::Failed, "P003", {}, fmt::format("the scene has {} lights; a frame holds {}", scene.lights.size(), max_lights));
    return expansion;
  }

  // What tiles cannot do, and is not done otherwise unasked: P001.
  void check_tiles(const Scene& scene) const {
    const std::vector<std::string> hints{"--expansion vertex or geometry can"};
    if (states_ != DrawStates{}) fail(Exit::Failed, "P001", {}, "expansion 'compute' draws with the default depth_test, depth_write, blend and cull only", hints);
    for (const Batch& batch : scene.batches)
      if (selection_.opacity == Opacity::Opaque && selection_.draws(batch) && has_own_alpha(batch))
        fail(Exit::Failed, "P001", {}, fmt::format("expansion 'compute' cannot tell the opaque particles of '{}' from its transparent ones", batch.name), hints);
  }

  void make_frame_group(gpu::Device& device, const ParticleStore& store) {
    pipelines_ = std::make_unique<ParticlePipelines>(device, store.layout());
    frame_buffer_ = device.create_buffer({.label = "frame", .size = sizeof(FrameBlock),
                                          .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&frame_buffer_}}};
    frame_group_ = device.create_bind_group({.label = "frame", .layout = &pipelines_->frame_layout(), .entries = entries});
  }

  Selection selection_;
  DrawStates states_;
  std::vector<TextureFormat> targets_;
  TextureFormat depth_{};
  std::uint32_t aovs_{};
  std::unique_ptr<ParticlePipelines> pipelines_;
  gpu::Buffer frame_buffer_;
  gpu::BindGroup frame_group_;
  QuadIndices indices_;
  PlacedView placed_;
  TiledView tiled_;
  Scene selected_; // alive while its draws are recorded
  std::unique_ptr<TileRenderer> tiles_;
};

} // namespace

std::unique_ptr<rg::Pass> make_opaque_impostors() { return std::make_unique<OpaqueImpostors>(); }

} // namespace mote::passes
