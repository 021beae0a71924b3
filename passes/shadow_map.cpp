// SPDX-License-Identifier: MIT
#include "passes/shadow_map.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/particles/expansion_choice.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/particle_store.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/particles/quad_indices.hpp"
#include "passes/particles/selection.hpp"
#include "passes/particles/tiles/tiled_drawing.hpp"
#include "passes/scratch.hpp"
#include "passes/shadows/light_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {

using gpu::TextureFormat;

// The type as which a map of casters holds particles. A placement that is no similarity makes spheres and ellipsoids ellipsoids
// (shaders/particles/affine_caster.glsl); of other types it makes shapes that have no payload: empty.
std::string caster_type(const std::string& type, bool affine) {
  if (!affine) return type;
  return type == "sphere" || type == "ellipsoid" ? "ellipsoid" : "";
}

// Of all that a map may hold.
std::vector<std::string> caster_types(const Scene& scene, const Selection& selection) {
  std::vector<std::string> types;
  for (const Batch& batch : scene.batches)
    for (const Instance& instance : batch.instances) {
      const std::string type = selection.draws(batch) ? caster_type(batch.type, !similarity_scale(instance.world_from_data)) : "";
      if (!type.empty() && std::find(types.begin(), types.end(), type) == types.end()) types.push_back(type);
    }
  return types;
}

class ShadowMap final : public rg::Pass, public MapInBuffers {
public:
  void declare(std::vector<rg::Slot>& slots, rg::Params& params) override {
    light_ = params.string("light", "", "name of the light; empty: the first one that casts shadows");
    light_loc_ = params.loc("light");
    ids_ = params.word("method", "ids", {"ids", "depth"}, "ids: shadow rays against the casters of 2x2 texels; depth: compared depths") == "ids";
    const auto size = static_cast<std::uint32_t>(params.integer("size", 1024, {.min = 16, .max = 65536}, "texels on each side"));
    thin_ = static_cast<float>(params.number("thin", 0.71, {.min = 0, .max = 4}, "method ids: least radius of a caster, texels; thinner ones are widened on the map"));
    info_.ids = ids_;
    info_.normal_offset = params.number("normal_offset", 1.0, {.min = 0, .max = 100}, "method depth: times the least offset without acne");
    info_.pcf = static_cast<std::uint32_t>(params.integer("pcf", 1, {.min = 0, .max = 8}, "method depth: averages (2 pcf + 1)^2 texels"));
    transparent_ = params.boolean("transparent", false, "transparent particles cast shadows, too");
    selection_ = read_selection(params, transparent_ ? Opacity::All : Opacity::Opaque);
    const rg::SizeSpec square{.kind = rg::SizeSpec::Kind::Fixed, .width = size, .height = size};
    const rg::TextureSpec depth{.format = TextureFormat::Depth32Float, .size = square};
    if (!ids_) {
      slots.push_back({.name = "map", .access = rg::Access::DepthWrite, .summary = "n / z in the light's view", .makes = depth, .copied_into = true});
      return;
    }
    slots.push_back({.name = "map", .access = rg::Access::ColorWrite, .summary = "casters: payload and id, a layer each vec4",
                     .makes = rg::TextureSpec{.format = TextureFormat::RGBA32Uint, .size = square, .layers = 1 + most_payload_vec4s}, .copied_into = true});
    slots.push_back({.name = "depth", .access = rg::Access::DepthWrite, .summary = "n / z in the light's view", .makes = depth, .copied_into = true});
  }

  void prepare(rg::PassContext&) override {}
  [[nodiscard]] bool opens_attachments() const override { return true; } // two layers of one texture

  [[nodiscard]] std::string idle_reason(const rg::FrameInput& frame) const override {
    const Scene& scene = frame.get<Scene>();
    const std::size_t light = find_light(scene);
    if (light < scene.lights.size()) return scene.lights[light].shadows ? "" : fmt::format("the light '{}' casts no shadows", light_);
    return light_.empty() ? "no light casts shadows" : "";
  }

  void record(rg::PassContext& context) override {
    const Scene& scene = context.frame().get<Scene>();
    const ParticleStore& store = context.frame().get<ParticleStore>();
    const gpu::Texture map = context.whole_texture("map");
    const std::size_t light = checked_light(scene);
    placed_ = {};
    tiled_ = stays_ = false;
    const std::optional<View> view = light < scene.lights.size()
        ? light_view(scene.bounds, context.frame().get<View>(), scene.lights[light], {map.size().width, map.size().height})
        : std::nullopt;
    if (view) {
      info_.light = light;
      info_.view = *view;
      info_.types = caster_types(scene, selection_);
      place(context, scene, store, map);
      stays_ = stays_in_buffers(context);
      store.shadow_maps().publish(map, info_, stays_ ? this : nullptr);
    } else {
      store.shadow_maps().withdraw(map);
    }
    draw(context, map);
  }

  [[nodiscard]] Buffers buffers() const override { return tiles_.casters(); }

  gpu::Texture draw_texture(gpu::CommandEncoder& encoder, const Mark& mark) override {
    const Size2d size = info_.view.size;
    make_scratch(device_, whole_, "shadow.map", {size.width, size.height, 1 + most_payload_vec4s}, TextureFormat::RGBA32Uint);
    tiles_.record(encoder, frame_group_, {.casters = whole_}, mark);
    return whole_;
  }

private:
  // Whether the map may stay in the tiles' buffers: they hold all of it, and nobody reads it who does not ask for them.
  [[nodiscard]] bool stays_in_buffers(const rg::PassContext& context) const {
    const bool spheres = std::all_of(info_.types.begin(), info_.types.end(), [](const std::string& type) { return type == "sphere"; });
    return ids_ && tiled_ && spheres && placed_.draws.empty() && !context.kept("depth") && context.only_sampled_by("map", "opaque_impostors");
  }

  // scene.lights.size(): there is none.
  [[nodiscard]] std::size_t find_light(const Scene& scene) const {
    const auto found = std::find_if(scene.lights.begin(), scene.lights.end(),
                                    [&](const Light& l) { return light_.empty() ? l.shadows : l.name == light_; });
    return static_cast<std::size_t>(found - scene.lights.begin());
  }

  [[nodiscard]] std::size_t checked_light(const Scene& scene) const {
    const std::size_t light = find_light(scene);
    if (light == scene.lights.size()) {
      std::vector<std::string> names;
      for (const Light& l : scene.lights) names.push_back(l.name);
      if (!light_.empty())
        fail(Exit::BadInput, "P015", light_loc_, fmt::format("the scene has no light named '{}'", light_),
             {names.empty() ? "The scene has no lights." : "Lights: " + list_of(names) + ".", did_you_mean(light_, names)});
      return light;
    }
    const Light& l = scene.lights[light];
    if (l.kind == LightKind::Point)
      fail(Exit::BadInput, "P017", light_loc_, fmt::format("the light '{}' is a point light, which one map cannot hold", l.name),
           {"Shadow maps are for directional, spot and head lights."});
    if (l.kind == LightKind::Spot && l.outer_angle > widest_spot)
      fail(Exit::BadInput, "P017", light_loc_,
           fmt::format("the spot light '{}' opens {:.4g} degrees from its axis; a shadow map holds up to 80", l.name, glm::degrees(l.outer_angle)));
    return light;
  }

  void place(rg::PassContext& context, const Scene& scene, const ParticleStore& store, const gpu::Texture& map) {
    gpu::Device device = context.device();
    device_ = device;
    if (!pipelines_) {
      pipelines_ = std::make_unique<ParticlePipelines>(device, store.layout());
      frame_buffer_ = device.create_buffer({.label = "shadow.frame", .size = sizeof(FrameBlock),
                                            .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
      const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&frame_buffer_}}};
      frame_group_ = device.create_bind_group({.label = "shadow.frame", .layout = &pipelines_->frame_layout(), .entries = entries});
    }
    const FrameBlock block = frame_block(scene, info_.view);
    device.queue().write_buffer(frame_buffer_, 0, std::as_bytes(std::span(&block, 1)));
    const std::uint32_t slot = 1 + store.shadow_maps().number_of(map); // 0 is the camera's
    tiled_ = by_tiles(context, scene) && place_tiles(context, scene, store, slot);
    placed_ = tiled_ ? tiles_.rest() : store.place(scene, info_.view, slot);
    std::uint32_t most = 0;
    for (const ParticleDraw& d : placed_.draws) most = std::max(most, d.particles);
    indices_.reserve(device, most);
  }

  // Whether tiles are the cheapest expansion that can. A map shows only as shadows: what was asked for elsewhere and cannot
  // draw it is not refused here.
  bool by_tiles(rg::PassContext& context, const Scene& scene) {
    const FrameOptions& options = context.frame().get<FrameOptions>();
    const gpu::Device device = context.device();
    const ExpansionNeeds needs{device, scene, info_.view, selection_, DrawStates{}, TextureFormat::RGBA32Float, ids_ ? 2u : 0u, "", Phase::Shadow};
    if (options.expansion != Expansion::Auto) return options.expansion == Expansion::Compute && why_not(Expansion::Compute, needs).empty();
    return choose_expansion(needs, options, chooser_).expansion == Expansion::Compute;
  }

  bool place_tiles(rg::PassContext& context, const Scene& scene, const ParticleStore& store, std::uint32_t slot) {
    TileWish wish{scene, info_.view, selection_, Phase::Shadow};
    if (ids_) wish.type = "sphere"; // tiles leave one payload vec4
    wish.slot = slot;
    wish.slack = ids_ ? thin_ : 0.0f;
    wish.placing.margin = wish.slack;
    wish.placing.whole = true;
    return tiles_.place(context.device(), store, pipelines_->frame_layout(), wish);
  }

  void record_tiles(rg::PassContext& context, const gpu::Texture& map) {
    TileTargets targets{.casters = ids_ && !stays_ ? map : gpu::Texture(), .casters_stay = stays_};
    if (!ids_) targets.encoded_depth = map;
    else if (!placed_.draws.empty() || context.kept("depth")) targets.encoded_depth = context.whole_texture("depth");
    tiles_.record(context.encoder(), frame_group_, targets, [&](std::string_view stage) { context.mark(stage); });
  }

  void draw(rg::PassContext& context, const gpu::Texture& map) {
    if (tiled_) record_tiles(context, map);
    if (tiled_ && placed_.draws.empty()) return;
    const gpu::LoadOp load = tiled_ ? gpu::LoadOp::Load : gpu::LoadOp::Clear;
    constexpr double none = 4294967295.0;
    std::vector<gpu::TextureView> layers;
    std::vector<gpu::ColorAttachment> colors;
    std::vector<TextureFormat> targets;
    std::uint32_t used = 2; // layers
    for (const std::string& type : info_.types) used = std::max(used, 1 + find_particle_type(type)->vec4s_per_payload);
    for (std::uint32_t i = 0; ids_ && i < used; ++i)
      layers.push_back(map.create_view({.dimension = gpu::TextureViewDimension::D2, .base_array_layer = i, .array_layer_count = 1}));
    for (const gpu::TextureView& layer : layers) {
      colors.push_back({.view = &layer, .load = load, .clear = {none, none, none, none}});
      targets.push_back(map.format());
    }
    const gpu::TextureView depth = context.texture(ids_ ? "depth" : "map");
    gpu::RenderPass pass = context.encoder().begin_render_pass({.label = "shadow_map", .colors = colors, .depth = gpu::DepthAttachment{.view = &depth, .load = load}});
    for (const ParticleDraw& particles : placed_.draws) {
      if (!selection_.draws(*particles.batch)) continue;
      const std::string held = caster_type(particles.batch->type, ids_ && particles.affine);
      if (held.empty())
        fail(Exit::BadInput, "P018", light_loc_, fmt::format("'{}' is scaled unevenly; a map of casters holds spheres and ellipsoids that are, but no particles of type '{}'", particles.batch->name, particles.batch->type),
             {"method = \"depth\" holds every shape."});
      ParticlePipelineKey key{.type = particles.batch->type, .phase = Phase::Shadow, .near_eye = particles.near_eye, .affine = particles.affine};
      key.orthographic = info_.view.projection == Projection::Orthographic;
      key.opaque_only = !transparent_ && has_own_alpha(*particles.batch);
      key.per_particle_color = key.opaque_only;
      key.paletted = key.opaque_only && particles.batch->chunks->paletted();
      key.proxy_slack = ids_ ? thin_ : 0.0f;
      key.targets = targets;
      key.written = 1 + find_particle_type(held)->vec4s_per_payload;
      key.type_number = number_of(*find_particle_type(held));
      key.depth = depth.format();
      pass.set_pipeline(pipelines_->get(key));
      pass.set_bind_group(0, frame_group_);
      pass.set_bind_group(1, particles.group);
      pass.set_push_constants(0, std::as_bytes(std::span(&particles.block, 1)));
      indices_.draw(pass, particles.particles);
    }
    pass.end();
  }

  std::string light_;
  SourceLoc light_loc_;
  bool ids_{true}, transparent_{};
  float thin_{0.71f};
  Selection selection_;
  ShadowMapInfo info_;
  std::unique_ptr<ParticlePipelines> pipelines_;
  gpu::Buffer frame_buffer_;
  gpu::BindGroup frame_group_;
  QuadIndices indices_;
  PlacedView placed_;
  TiledDrawing tiles_;
  bool tiled_{}, stays_{}; // in this frame
  gpu::Device device_;
  gpu::Texture whole_; // a map that stayed in buffers and was then asked for as a texture
  ExpansionChooser chooser_;
};

} // namespace

std::unique_ptr<rg::Pass> make_shadow_map() { return std::make_unique<ShadowMap>(); }

} // namespace mote::passes
