// SPDX-License-Identifier: MIT
#include "passes/opaque_impostors.hpp"

#include "core/base/diagnostic.hpp"
#include "core/gpu/points.hpp"
#include "passes/opaque_slots.hpp"
#include "passes/particles/expansion_choice.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/particle_store.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/particles/quad_indices.hpp"
#include "passes/particles/selection.hpp"
#include "passes/particles/steps.hpp"
#include "passes/particles/tiles/tiled_drawing.hpp"
#include "passes/sampling/accumulator.hpp"
#include "passes/sampling/pattern.hpp"
#include "passes/scratch.hpp"
#include "passes/shadows/shadow_inputs.hpp"
#include "passes/shadows/surface_shading.hpp"
#include "passes/states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <tuple>
#include <utility>

namespace mote::passes {
namespace {

using gpu::TextureFormat;

class OpaqueImpostors final : public rg::Pass {
public:
  void declare(std::vector<rg::Slot>& slots, rg::Params& params) override {
    declare_opaque_slots(slots);
    selection_ = read_selection(params, params.has("blend") ? Opacity::All : Opacity::Opaque);
    states_ = read_states(params);
    shadow_inputs_.declare(slots, params);
    offsets_ = read_samples(params);
    boxes_ = params.word("proxy", "tight", {"tight", "box"}, "tight: a rectangle; box: cylinders and cones by the faces of the box around them that are seen, by a geometry stage") == "box";
    analytic_edges_ = params.word("edges", "sampled", {"sampled", "analytic"}, "analytic: outlines blended by what they cover of a pixel") == "analytic";
    steps_ = read_steps(params);
    if (analytic_edges_ && (offsets_.size() > 1 || params.has("blend") || !steps_.whole()))
      params.error("P006", "edges", fmt::format("is \"analytic\", which does not go with {}", offsets_.size() > 1 ? "several samples a pixel" : steps_.whole() ? "blend" : "steps"));
  }

  void prepare(rg::PassContext& context) override {
    targets_.clear();
    for (const std::string& slot : context.color_slots()) targets_.push_back(context.format(slot));
    aovs_ = connected_aovs(context);
    depth_ = context.format("depth");
    deferred_ = shadow_inputs_.connected(context);
    if (deferred_ && states_.blend != 0) fail(Exit::BadInput, "P006", {}, "a pass with a shadow map shades each pixel once; it does not go with blend");
    if (deferred_ && !steps_.whole()) fail(Exit::BadInput, "P006", {}, fmt::format("a pass with a shadow map draws the whole of its particles; it does not go with steps = \"{}\"", to_string(steps_.step)));
  }

  gpu::Color clear_value(std::string_view slot, const rg::FrameInput& frame) override {
    return opaque_clear_value(slot, states_, frame);
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
    lights_ = shadow_inputs_.lights(context);
    choose(context);
    const Expansion expansion = report_.choice.expansion;
    const double largest_point = expansion == Expansion::Point ? double{gpu::max_point_size(device)} : 0.0;
    surfaces_first_ = deferred_;
    edges_tiled_ = analytic_edges_ && expansion == Expansion::Compute && place_edges(context, store);
    const bool all_by_quads = analytic_edges_ && !edges_tiled_, nothing_else = edges_tiled_ && !wants_center(context);
    const bool tiled = expansion == Expansion::Compute && !all_by_quads && !nothing_else && place_tiles(context, store);
    if (surfaces_first_ && (expansion != Expansion::Compute || all_by_quads)) update_surfaces(context, surfaces_, false);
    placed_ = tiled ? tiled_.rest() : nothing_else ? PlacedView{} : store.place(scene, view, 0, largest_point);
    report_.tiled = tiled ? tiled_.chunks() : edges_tiled_ ? edges_.chunks() : 0;
    report_.rastered = placed_.chunks_placed;
    if (const auto& chosen = context.frame().get<FrameOptions>().chosen) chosen(report_);
    raster_ = expansion == Expansion::Geometry ? expansion : Expansion::Vertex;
    reserve_indices(device);
    if (offsets_.size() > 1) return record_samples(context, tiled);
    if (!steps_.whole()) return record_steps(context);
    if (analytic_edges_) return record_edges(context, tiled);
    if (tiled) record_tiles(context);
    if (tiled && !surfaces_first_ && placed_.draws.empty()) return;
    if (surfaces_first_) return draw_picture(context, frame_group_, own_targets(context), aovs_, context.texture("depth"), surfaces_.get(), tiled);
    gpu::RenderPass pass = context.begin_attachments(tiled);
    draw_particles(context, pass, placed_, {frame_group_, targets_, aovs_}, nullptr);
    pass.end();
  }

  void report(Diagnostics& out) override {
    if (!lacks_tiles_.empty())
      out.warning("P020", {}, fmt::format("the device has {}: particles are drawn by the {} expansion, not by tiles", lacks_tiles_, to_string(report_.choice.expansion)));
  }

private:
  // False: nothing in view is for tiles. Shadows are asked where tiles are cast, unless something is left for quads, which
  // do not know them, or the maps are beyond what a cast can hold: then tiles leave surfaces, as quads do.
  bool place_tiles(rg::PassContext& context, const ParticleStore& store) {
    TileWish wish{context.frame().get<Scene>(), context.frame().get<View>(), selection_};
    wish.alarm = context.frame().get<FrameOptions>().show_depth_violation;
    wish.placing.exact = aovs_ != 0 || context.kept("depth");
    const bool several = offsets_.size() > 1;
    if (several) wish.placing.margin = 0.5; // of any sample to its pixel's center
    const auto place = [&] {
      const bool tiled = tiled_.place(context.device(), store, pipelines_->frame_layout(), wish);
      return tiled && !(several && !tiled_.rest().draws.empty()); // all samples by tiles, or none
    };
    if (deferred_ && TileShadows::can_hold(lights_)) {
      const bool tiled = place();
      surfaces_first_ = !tiled_.rest().draws.empty();
      if (!surfaces_first_) {
        update_tile_shadows(context);
        return tiled;
      }
    }
    if (surfaces_first_) {
      update_surfaces(context, surfaces_, false);
      wish.phase = Phase::Surface;
      wish.placing.material = [this](const Batch& batch) { return surfaces_->material_of(batch); };
    }
    return place();
  }

  void update_tile_shadows(rg::PassContext& context) {
    if (!tile_shadows_) tile_shadows_ = std::make_unique<TileShadows>(context.device());
    tile_shadows_->update(lights_, context.frame().get<View>());
  }

  // The picture with analytic edges, apart from the one of the centers. False: tiles cannot draw all of it, or not with these shadow maps.
  bool place_edges(rg::PassContext& context, const ParticleStore& store) {
    if (deferred_ && !TileShadows::can_hold(lights_)) return false;
    TileWish wish{context.frame().get<Scene>(), context.frame().get<View>(), selection_};
    wish.slot = 0x80000000u; // of no map and no camera
    wish.edges = true;
    if (!edges_.place(context.device(), store, pipelines_->frame_layout(), wish) || !edges_.rest().draws.empty()) return false;
    if (deferred_) update_tile_shadows(context);
    return true;
  }

  void record_tiles(rg::PassContext& context) {
    const bool draw_on = !tiled_.rest().draws.empty();
    TileTargets targets{.color = context.whole_texture("color"),
                        .encoded_depth = draw_on || context.kept("depth") ? context.whole_texture("depth") : gpu::Texture(),
                        .depth = context.whole_texture("aov_depth"),
                        .id = context.whole_texture("aov_id"),
                        .normal = context.whole_texture("aov_normal"),
                        .background = clear_value("color", context.frame())};
    targets.shadows = shadows_for_tiles();
    targets.cache_directory = cache_directory(context);
    if (surfaces_first_) targets = surface_targets(targets.encoded_depth);
    else if (!draw_on && offsets_.size() == 1 && !analytic_edges_) take_over_map(context, targets);
    tiled_.record(context.encoder(), frame_group_, targets, [&](std::string_view stage) { context.mark(stage); });
  }

  static void take_over_map(rg::PassContext& context, TileTargets& targets) {
    const auto next = context.successor("color");
    if (!next || !TileRenderer::works(context.device(), next->target.format())) return;
    targets.map = next->map;
    targets.color = next->target;
    context.take_over("color");
  }

  [[nodiscard]] TileTargets surface_targets(const gpu::Texture& encoded_depth) const {
    return {.color = surfaces_->color(), .encoded_depth = encoded_depth, .id = surfaces_->id(), .normal = surfaces_->normal_t()};
  }
  [[nodiscard]] const TileShadows* shadows_for_tiles() const { return deferred_ && !surfaces_first_ ? tile_shadows_.get() : nullptr; }
  static std::string cache_directory(const rg::PassContext& context) {
    const DisplaySettings* display = context.frame().find<DisplaySettings>();
    return display ? display->cache_directory : std::string();
  }

  void reserve_indices(gpu::Device& device) {
    for (const ParticleDraw& draw : placed_.draws)
      if (raster_ == Expansion::Vertex) indices_.reserve(device, draw.particles);
  }

  struct Into { gpu::BindGroup frame{}; std::vector<TextureFormat> formats{}; std::uint32_t aovs{}; };
  struct Targets { // views of attachments, color first, and what they are cleared to
    std::vector<gpu::TextureView> views{};
    std::vector<gpu::Color> clear{};
    [[nodiscard]] std::vector<gpu::ColorAttachment> attachments() const {
      std::vector<gpu::ColorAttachment> out;
      for (std::size_t i = 0; i < views.size(); ++i) out.push_back({.view = &views[i], .clear = clear[i]});
      return out;
    }
  };

  void draw_particles(const rg::PassContext& context, gpu::RenderPass& pass, const PlacedView& placed, const Into& into, const SurfaceShading* surfaces) {
    const Scene& scene = context.frame().get<Scene>();
    const View& view = context.frame().get<View>();
    for (const ParticleDraw& draw : placed.draws) {
      if (!selection_.draws(*draw.batch)) continue;
      BatchBlock block = draw.block;
      ParticlePipelineKey key = key_for(scene, view, *draw.batch);
      key.expansion = draw.sprites ? Expansion::Point : raster_;
      key.box = boxes_ && find_particle_type(draw.batch->type)->boxes && gpu::has(context.device().features(), gpu::Feature::GeometryShader);
      if (key.box) key.expansion = Expansion::Geometry;
      key.near_eye = draw.near_eye;
      key.affine = draw.affine;
      key.targets = into.formats;
      key.depth = depth_;
      key.aovs = into.aovs;
      key.opaque_only = key.per_particle_color && selection_.opacity == Opacity::Opaque;
      key.states = states_;
      if (into.aovs == 0) key.step = steps_.step;
      if (key.step == Step::Points) key.proxy_slack = static_cast<float>(0.5 * steps_.point_size) - 0.04f; // what every proxy has
      key.show_depth_violation = context.frame().get<FrameOptions>().show_depth_violation;
      if (surfaces) {
        unlit(key);
        key.phase = Phase::Surface;
        key.edges = surfaces->edges();
        key.proxy_slack = key.edges ? 0.75f : 0.0f;
        block.material.x = static_cast<float>(surfaces->material_of(*draw.batch));
      }
      pass.set_pipeline(pipelines_->get(key));
      pass.set_bind_group(0, into.frame);
      pass.set_bind_group(1, draw.group);
      pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
      if (key.expansion == Expansion::Vertex)
        indices_.draw(pass, draw.particles);
      else
        pass.draw(draw.particles);
    }
  }

  [[nodiscard]] Targets own_targets(const rg::PassContext& context) {
    Targets out;
    for (const std::string& slot : context.color_slots()) {
      out.views.push_back(context.texture(slot));
      out.clear.push_back(clear_value(slot, context.frame()));
    }
    return out;
  }

  // The picture of one sample offset. With `surfaces`: what all particles leave there, then each pixel's shading once;
  // `begun`: on top of the surfaces that tiles have left.
  void draw_picture(rg::PassContext& context, const gpu::BindGroup& frame, const Targets& targets, std::uint32_t aovs, const gpu::TextureView& depth,
                    SurfaceShading* surfaces, bool begun = false) {
    const std::vector<gpu::ColorAttachment> colors = targets.attachments();
    if (!begun || !placed_.draws.empty()) {
      std::vector<gpu::ColorAttachment> drawn = surfaces ? surfaces->attachments() : colors;
      const gpu::LoadOp load = begun ? gpu::LoadOp::Load : gpu::LoadOp::Clear;
      Into into{frame, {}, surfaces ? 0 : aovs};
      for (gpu::ColorAttachment& attachment : drawn) {
        attachment.load = load;
        into.formats.push_back(attachment.view->format());
      }
      gpu::RenderPass pass = context.encoder().begin_render_pass({.label = "particles", .colors = drawn,
           .depth = gpu::DepthAttachment{.view = &depth, .load = load, .clear = static_cast<float>(cleared_depth(states_))}});
      draw_particles(context, pass, placed_, into, surfaces);
      pass.end();
    }
    if (surfaces) surfaces->record(context.encoder(), frame, colors, aovs);
  }

  void update_surfaces(rg::PassContext& context, std::unique_ptr<SurfaceShading>& surfaces, bool edges) {
    draw_textures(lights_, context.encoder(), [&](std::string_view stage) { context.mark(stage); });
    if (!surfaces) surfaces = std::make_unique<SurfaceShading>(context.device(), pipelines_->frame_layout(), edges);
    surfaces->update(context.frame().get<Scene>(), context.frame().get<View>(), lights_);
  }

  // Depth and AOVs are those of the pixel's center, from a picture of their own, if anybody looks at them.
  [[nodiscard]] bool wants_center(const rg::PassContext& context) const { return aovs_ != 0 || context.kept("depth"); }
  void record_center(rg::PassContext& context, bool tiled) {
    if (!wants_center(context)) return;
    if (tiled) record_tiles(context);
    if (!tiled || surfaces_first_ || !placed_.draws.empty())
      draw_picture(context, frame_group_, own_targets(context), aovs_, context.texture("depth"), surfaces_first_ ? surfaces_.get() : nullptr, tiled);
  }

  // AOVs are those of the whole thing, from a picture of their own.
  void record_steps(rg::PassContext& context) {
    if (aovs_ != 0) draw_picture(context, frame_group_, own_targets(context), aovs_, context.texture("depth"), nullptr);
    draw_picture(context, frame_group_, {{context.texture("color")}, {clear_value("color", context.frame())}}, 0, context.texture("depth"), nullptr);
  }

  void record_edges(rg::PassContext& context, bool tiled) {
    if (!edges_tiled_) update_surfaces(context, edge_surfaces_, true);
    record_center(context, tiled);
    if (edges_tiled_) {
      TileTargets targets{.color = context.whole_texture("color"), .background = clear_value("color", context.frame()), .edges = true,
                          .shadows = deferred_ ? tile_shadows_.get() : nullptr, .cache_directory = cache_directory(context)};
      take_over_map(context, targets);
      return edges_.record(context.encoder(), frame_group_, targets, [&](std::string_view stage) { context.mark(stage); });
    }
    const Size2d size = context.frame().get<View>().size;
    gpu::Device device = context.device();
    if (make_scratch(device, edge_depth_, "edges.depth", {size.width, size.height, 1}, depth_)) edge_depth_view_ = edge_depth_.create_view();
    const Targets picture{{context.texture("color")}, {clear_value("color", context.frame())}};
    draw_picture(context, frame_group_, picture, 0, edge_depth_view_, edge_surfaces_.get());
  }

  // One picture a sample, averaged.
  void record_samples(rg::PassContext& context, bool tiled) {
    const Scene& scene = context.frame().get<Scene>();
    View view = context.frame().get<View>();
    gpu::Device device = context.device();
    if (!accumulator_) accumulator_ = std::make_unique<Accumulator>(device, static_cast<std::uint32_t>(offsets_.size()));
    accumulator_->update(view.size.width, view.size.height);
    const glm::dvec2 center = view.sample_offset;
    const gpu::TextureView color = context.texture("color");
    record_center(context, tiled);
    const Targets picture{{accumulator_->picture()}, {clear_value("color", context.frame())}};
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      view.sample_offset = center + offsets_[i] - 0.5;
      if (i == sample_frames_.size()) sample_frames_.push_back(make_frame(device));
      const FrameBlock block = frame_block(scene, view);
      device.queue().write_buffer(sample_frames_[i].first, 0, std::as_bytes(std::span(&block, 1)));
      if (tiled) {
        TileTargets targets{.color = accumulator_->texture(), .background = picture.clear.front(), .shadows = shadows_for_tiles(), .cache_directory = cache_directory(context)};
        if (surfaces_first_) targets = surface_targets({});
        tiled_.record(context.encoder(), sample_frames_[i].second, targets, [&](std::string_view stage) { context.mark(stage); });
      }
      if (!tiled || surfaces_first_)
        draw_picture(context, sample_frames_[i].second, picture, 0, accumulator_->depth(), surfaces_first_ ? surfaces_.get() : nullptr, tiled);
      accumulator_->add(context.encoder(), i == 0);
    }
    accumulator_->resolve(context.encoder(), color);
  }

  void choose(rg::PassContext& context) {
    const Scene& scene = context.frame().get<Scene>();
    for (const Batch& batch : scene.batches)
      if (const ParticleType* type = find_particle_type(batch.type); analytic_edges_ && selection_.draws(batch) && type && !type->analytic_edges)
        fail(Exit::Failed, "P021", {}, fmt::format("edges = \"analytic\" is not for particle type '{}'", batch.type), {"edges = \"sampled\" with samples draws every type with smooth outlines"});
    check_steps(steps_, scene, selection_);
    const FrameOptions& options = context.frame().get<FrameOptions>();
    if (scene.lights.size() > max_lights)
      fail(Exit::Failed, "P003", {}, fmt::format("the scene has {} lights; a frame holds {}", scene.lights.size(), max_lights));
    const gpu::Device device = context.device();
    const ExpansionNeeds needs{device, scene, context.frame().get<View>(), selection_, states_, context.format("color"),
                               static_cast<std::uint32_t>(std::popcount(aovs_)),
                               options.expansion == Expansion::Auto && analytic_edges_ && deferred_ && !TileShadows::can_hold(lights_) ? "analytic edges and these shadow maps" : "",
                               deferred_ ? Phase::Surface : Phase::Opaque, steps_.step, analytic_edges_};
    report_ = {.kind = "opaque_impostors", .choice = choose_expansion(needs, options, chooser_), .automatic = options.expansion == Expansion::Auto};
    lacks_tiles_ = report_.automatic ? device_lacks_tiles(device) : std::string();
  }

  void make_frame_group(gpu::Device& device, const ParticleStore& store) {
    pipelines_ = std::make_unique<ParticlePipelines>(device, store.layout());
    std::tie(frame_buffer_, frame_group_) = make_frame(device);
  }
  std::pair<gpu::Buffer, gpu::BindGroup> make_frame(gpu::Device& device) {
    const gpu::Buffer buffer = device.create_buffer({.label = "frame", .size = sizeof(FrameBlock),
                                                     .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&buffer}}};
    return {buffer, device.create_bind_group({.label = "frame", .layout = &pipelines_->frame_layout(), .entries = entries})};
  }

  Selection selection_;
  DrawStates states_;
  Steps steps_;
  ShadowInputs shadow_inputs_;
  bool deferred_{}; // a shadow map is connected
  bool surfaces_first_{}; // in this frame: particles leave surfaces, which are shaded once
  std::vector<MappedLight> lights_;
  std::unique_ptr<TileShadows> tile_shadows_;
  Expansion raster_{Expansion::Vertex}; // of what is not drawn in tiles
  std::vector<TextureFormat> targets_;
  TextureFormat depth_{};
  std::uint32_t aovs_{};
  std::unique_ptr<ParticlePipelines> pipelines_;
  gpu::Buffer frame_buffer_;
  gpu::BindGroup frame_group_;
  QuadIndices indices_;
  PlacedView placed_;
  TiledDrawing tiled_, edges_;
  bool edges_tiled_{}; // in this frame: edges_ draws the picture, the rest only what is read of the centers
  std::unique_ptr<SurfaceShading> surfaces_, edge_surfaces_;
  bool analytic_edges_{}, boxes_{};
  gpu::Texture edge_depth_;
  gpu::TextureView edge_depth_view_;
  std::vector<glm::dvec2> offsets_; // samples in a pixel; one: its center
  std::vector<std::pair<gpu::Buffer, gpu::BindGroup>> sample_frames_;
  std::unique_ptr<Accumulator> accumulator_;
  ExpansionChooser chooser_;
  ExpansionReport report_; // of the last frame
  std::string lacks_tiles_;
};

} // namespace

std::unique_ptr<rg::Pass> make_opaque_impostors() { return std::make_unique<OpaqueImpostors>(); }

} // namespace mote::passes
