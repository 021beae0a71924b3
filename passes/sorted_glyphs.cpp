// SPDX-License-Identifier: MIT
#include "passes/sorted_glyphs.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/layer_lists.hpp"
#include "passes/over.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/ordered_store.hpp"
#include "passes/particles/quad_indices.hpp"
#include "passes/particles/transparent_pipelines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {

using gpu::TextureFormat;

constexpr std::uint32_t particles_between_marks = 4096; // front to back: how often saturated pixels are looked for
constexpr std::uint32_t most_marks = 8;

enum class Oit : std::uint8_t { None, Weighted, Exact };

class SortedGlyphs final : public rg::Pass {
public:
  void declare(std::vector<rg::Slot>& slots, rg::Params& params) override {
    pass_name_ = params.pass();
    selection_ = read_selection(params, Opacity::Transparent);
    states_ = read_states(params, {.depth_write = false, .blend = pack(blend_over())});
    straight_ = params.has("blend");
    two_surfaces_ = params.word("surfaces", "both", {"both", "front"}, "both: entry and exit, which together block alpha; front: one layer of alpha") == "both";
    const std::string order = params.word("order", "back_to_front", {"back_to_front", "front_to_back", "file"}, "of all particles of all data sets");
    order_ = order == "file" ? Order::File : order == "front_to_back" ? Order::FrontToBack : Order::BackToFront;
    const std::string oit = params.word("oit", "none", {"none", "weighted", "exact"}, "order-independent: weighted sums, or every surface of a pixel sorted");
    oit_ = oit == "weighted" ? Oit::Weighted : oit == "exact" ? Oit::Exact : Oit::None;
    memory_ = static_cast<std::uint64_t>(params.integer("memory", 128, {.min = 1, .max = 65536}, "MiB that the lists of oit = \"exact\" may take")) << 20;
    check_together(params, order);
    declare_slots(slots);
  }

  void prepare(rg::PassContext& context) override {
    color_format_ = context.format("color");
    depth_format_ = states_.depth_write ? context.format("depth") : TextureFormat::Depth32Float;
    generation_ = 0;
  }

  gpu::Color clear_value(std::string_view slot, const rg::FrameInput& frame) override {
    if (slot == "depth") return {cleared_depth(states_), 0, 0, 0};
    if (slot == "revealed") return {1, 0, 0, 0};
    if (slot != "color") return {0, 0, 0, 0};
    const glm::dvec4 b = frame.get<Scene>().background;
    return {b.r, b.g, b.b, b.a};
  }

  [[nodiscard]] bool opens_attachments() const override { return true; }

  [[nodiscard]] std::string idle_reason(const rg::FrameInput& frame) const override {
    const Scene& scene = frame.get<Scene>();
    const bool any = std::any_of(scene.batches.begin(), scene.batches.end(), [&](const Batch& batch) { return selection_.draws(batch); });
    return any ? "" : "no particle is transparent";
  }

  void record(rg::PassContext& context) override {
    const Scene& scene = context.frame().get<Scene>();
    const View& view = context.frame().get<View>();
    gpu::Device device = context.device();
    if (!pipelines_) make(device);
    check_scene(scene, device, context.frame().get<FrameOptions>().expansion);
    const FrameBlock block = frame_block(scene, view);
    device.queue().write_buffer(frame_buffer_, 0, std::as_bytes(std::span(&block, 1)));
    const bool moved = store_->update(scene, view, selection_, oit_ == Oit::None ? order_ : Order::File);
    if (expansion_ == Expansion::Vertex) indices_.reserve(device, static_cast<std::uint32_t>(store_->particles().order.size()));
    if (moved && oit_ == Oit::Exact)
      lists_->reserve(entries_per_row(scene, view, selection_), view.size.width, memory_, pipelines_->lists_layout());
    if (!depth_group_ || generation_ != context.generation()) make_depth_group(context);
    generation_ = context.generation();

    ColorTarget color{context.texture("color"), color_format_, context.fresh("color"), clear_value("color", context.frame())};
    if (straight_ && oit_ == Oit::None) return draw_over_color(context, color);
    over_->begin(context.encoder(), color, scene.background.a >= 1.0, view.size.width, view.size.height);
    if (oit_ == Oit::None) composite_layer(context, color);
    if (oit_ == Oit::Weighted) composite_sums(context, color);
    if (oit_ == Oit::Exact) composite_lists(context, color);
  }

  void report(Diagnostics& out) override {
    if (lists_ && oit_ == Oit::Exact) lists_->report(pass_name_, out);
  }

private:
  // States that a mode cannot have: P006.
  void check_together(rg::Params& params, const std::string& order) {
    auto refuse = [&](std::string_view name, std::string_view with) {
      params.error("P006", name, fmt::format("does not go with {}.", with), {"order-independent modes take every surface once, in any order, and write no depth"});
    };
    if (oit_ != Oit::None && params.has("blend")) refuse("blend", "oit");
    if (oit_ != Oit::None && states_.depth_write) refuse("depth_write", "oit");
    if (oit_ != Oit::None && params.has("order") && order != "back_to_front") refuse("order", "oit");
    if (oit_ == Oit::None && order_ == Order::FrontToBack && straight_) refuse("blend", "order = \"front_to_back\", which accumulates alpha");
  }

  void declare_slots(std::vector<rg::Slot>& slots) const {
    slots.push_back({.name = "color", .access = rg::Access::ColorReadWrite, .summary = "scene-linear color, drawn over",
                     .makes = rg::TextureSpec{.format = TextureFormat::RGBA16Float}, .sampled_too = true});
    if (states_.depth_write)
      slots.push_back({.name = "depth", .access = rg::Access::DepthReadWrite, .summary = "n / z of what is there, tested and written",
                       .makes = rg::TextureSpec{.format = TextureFormat::Depth32Float}});
    else
      slots.push_back({.name = "depth", .access = rg::Access::Sampled, .summary = "n / z of an earlier pass: each surface is tested against it", .optional = true});
    auto scratch = [&](std::string name, TextureFormat format, std::string summary) {
      slots.push_back({.name = std::move(name), .access = rg::Access::ColorWrite, .summary = std::move(summary), .makes = rg::TextureSpec{.format = format}, .sampled_too = true});
    };
    if (oit_ == Oit::None && !straight_) scratch("layer", TextureFormat::RGBA32Float, "the particles alone, color times alpha");
    if (oit_ == Oit::Weighted) {
      scratch("sums", TextureFormat::RGBA32Float, "weighted sum of color times alpha, and of alpha");
      scratch("revealed", TextureFormat::R32Float, "what the particles let through");
    }
  }

  void make(gpu::Device& device) {
    store_ = std::make_unique<OrderedStore>(device);
    pipelines_ = std::make_unique<TransparentPipelines>(device, store_->layout());
    over_ = std::make_unique<Over>(device, &pipelines_->lists_layout());
    lists_ = std::make_unique<LayerLists>(device);
    frame_buffer_ = device.create_buffer({.label = "frame", .size = sizeof(FrameBlock), .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&frame_buffer_}}};
    frame_group_ = device.create_bind_group({.label = "frame", .layout = &pipelines_->frame_layout(), .entries = entries});
    no_depth_ = device.create_texture({.label = "transparent.no_depth", .format = TextureFormat::RGBA8Unorm, .usage = gpu::TextureUsage::Sampled}).create_view();
  }

  void make_depth_group(rg::PassContext& context) {
    has_depth_ = !states_.depth_write && context.connected("depth");
    const gpu::TextureView depth = has_depth_ ? context.texture("depth") : no_depth_;
    gpu::Device device = context.device();
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &depth}};
    depth_group_ = device.create_bind_group({.label = "transparent.depth", .layout = &pipelines_->depth_layout(), .entries = entries});
  }

  void check_scene(const Scene& scene, const gpu::Device& device, Expansion wanted) {
    expansion_ = wanted == Expansion::Auto ? Expansion::Vertex : wanted;
    if (expansion_ == Expansion::Geometry && !gpu::has(device.features(), gpu::Feature::GeometryShader))
      fail(Exit::Failed, "P001", {}, "the device has no geometry stage, so expansion 'geometry' cannot be used", {"expansions that work here: vertex"});
    for (const Batch& batch : scene.batches) {
      const ParticleType* type = find_particle_type(batch.type);
      if (selection_.draws(batch) && (!type || !supports(*type, expansion_, Phase::Transparent)))
        fail(Exit::Failed, "P001", {}, fmt::format("particle type '{}' cannot be drawn transparent by expansion '{}'", batch.type, to_string(expansion_)),
             {"mote graph --kinds prints what works together"});
    }
    if (scene.lights.size() > max_lights)
      fail(Exit::Failed, "P003", {}, fmt::format("the scene has {} lights; a frame holds {}", scene.lights.size(), max_lights));
  }

  // Draws the particles [begin, end) of the order.
  void draw(gpu::RenderPass& pass, rg::PassContext& context, TransparentKey key, const TransparentBlock& block, std::uint32_t begin, std::uint32_t end) {
    const Scene& scene = context.frame().get<Scene>();
    const View& view = context.frame().get<View>();
    for (const OrderedRun& run : store_->particles().runs) {
      const std::uint32_t first = std::max(run.first, begin), last = std::min(run.first + run.count, end);
      if (first >= last) continue;
      const Batch& batch = scene.batches[run.batch];
      const ParticlePipelineKey asked = key.particle;
      key.particle = key_for(scene, view, batch);
      key.particle.phase = Phase::Transparent;
      key.particle.expansion = expansion_;
      key.particle.near_eye = run.near_eye;
      key.particle.affine = run.affine;
      key.particle.per_particle_color = store_->has_colors();
      key.particle.paletted = false; // in one order are particles of several sets
      key.particle.show_depth_violation = context.frame().get<FrameOptions>().show_depth_violation;
      key.particle.targets = asked.targets;
      key.particle.depth = depth_format_;
      key.particle.states = states_;
      key.two_surfaces = two_surfaces_;
      key.has_depth = has_depth_;
      pass.set_pipeline(pipelines_->get(key));
      pass.set_bind_group(0, frame_group_);
      pass.set_bind_group(1, store_->group(batch.type));
      pass.set_bind_group(2, depth_group_);
      if (key.layering == Layering::Exact) pass.set_bind_group(3, lists_->group());
      pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
      if (expansion_ == Expansion::Vertex) indices_.draw(pass, last - first, first);
      else pass.draw(last - first, 1, first);
    }
  }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(store_->particles().order.size()); }

  gpu::DepthAttachment depth_attachment(rg::PassContext& context, const gpu::TextureView& view) {
    const bool clear = context.fresh("depth");
    return {.view = &view, .load = clear ? gpu::LoadOp::Clear : gpu::LoadOp::Load, .clear = static_cast<float>(cleared_depth(states_))};
  }

  // A blend state of the user's: straight onto the color.
  void draw_over_color(rg::PassContext& context, ColorTarget& color) {
    const std::array colors{color.attachment()};
    gpu::RenderPassDescriptor descriptor{.label = "glyphs", .colors = colors};
    const gpu::TextureView depth = states_.depth_write ? context.texture("depth") : gpu::TextureView();
    if (depth) descriptor.depth = depth_attachment(context, depth);
    gpu::RenderPass pass = context.encoder().begin_render_pass(descriptor);
    TransparentKey key{.layering = depth ? Layering::SortedDepth : Layering::Sorted, .straight = true};
    key.particle.targets = {color_format_};
    draw(pass, context, key, {}, 0, count());
    pass.end();
  }

  // In order, into a layer of its own; then the layer goes over the color.
  void composite_layer(rg::PassContext& context, ColorTarget& color) {
    const gpu::TextureView layer = context.texture("layer");
    const gpu::TextureView depth = states_.depth_write ? context.texture("depth") : gpu::TextureView();
    const bool under = order_ == Order::FrontToBack && !depth;
    const std::uint32_t marks = under ? std::clamp(count() / particles_between_marks, 1u, most_marks) : 1;
    if (marks > 1) make_saturation(context);
    TransparentKey key{.layering = depth ? Layering::SortedDepth : Layering::Sorted, .under = under, .saturation = marks > 1};
    key.particle.targets = {context.format("layer")};
    for (std::uint32_t k = 0; k < marks; ++k) {
      const std::array colors{gpu::ColorAttachment{.view = &layer, .load = k == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load}};
      gpu::RenderPassDescriptor descriptor{.label = "glyphs", .colors = colors};
      if (depth) descriptor.depth = depth_attachment(context, depth);
      else if (marks > 1) descriptor.depth = gpu::DepthAttachment{.view = &saturation_, .load = k == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load, .clear = 0.0f};
      gpu::RenderPass pass = context.encoder().begin_render_pass(descriptor);
      const auto at = [&](std::uint32_t i) { return static_cast<std::uint32_t>(std::uint64_t{count()} * i / marks); };
      draw(pass, context, key, {}, at(k), at(k + 1));
      pass.end();
      if (k + 1 < marks) over_->mark_saturated(context.encoder(), layer, saturation_);
    }
    over_->apply(context.encoder(), color, "layer", std::span(&layer, 1), {0, context.view_size().height});
  }

  void make_saturation(rg::PassContext& context) {
    const rg::ViewSize size = context.view_size();
    if (saturation_ && saturation_.size().width == size.width && saturation_.size().height == size.height) return;
    gpu::Device device = context.device();
    saturation_ = device.create_texture({.label = "glyphs.saturation", .size = {size.width, size.height}, .format = TextureFormat::Depth32Float,
                                         .usage = gpu::TextureUsage::RenderAttachment}).create_view();
  }

  void composite_sums(rg::PassContext& context, ColorTarget& color) {
    const std::array views{context.texture("sums"), context.texture("revealed")};
    const std::array colors{gpu::ColorAttachment{.view = &views[0]}, gpu::ColorAttachment{.view = &views[1], .clear = {1, 0, 0, 0}}};
    gpu::RenderPass pass = context.encoder().begin_render_pass({.label = "glyphs", .colors = colors});
    TransparentKey key{.layering = Layering::Weighted};
    key.particle.targets = {context.format("sums"), context.format("revealed")};
    const Scene& scene = context.frame().get<Scene>();
    const View& view = context.frame().get<View>();
    const double farthest = scene.bounds.empty() ? 1.0 : glm::length(scene.bounds.center() - view.eye) + 0.5 * scene.bounds.diagonal();
    draw(pass, context, key, {.depth_scale = static_cast<float>(200.0 / farthest)}, 0, count());
    pass.end();
    over_->apply(context.encoder(), color, "weighted", views, {0, context.view_size().height});
  }

  void composite_lists(rg::PassContext& context, ColorTarget& color) {
    const rg::ViewSize size = context.view_size();
    lists_->clear(context.encoder());
    TransparentKey key{.layering = Layering::Exact};
    key.particle.targets = {color_format_};
    TransparentBlock block{.strip = 0, .capacity = lists_->capacity(), .width = size.width};
    for (const Rows& rows : lists_->strips()) {
      const std::array colors{color.attachment()};
      gpu::RenderPass pass = context.encoder().begin_render_pass({.label = "glyphs.lists", .colors = colors});
      pass.set_scissor(0, rows.begin, size.width, rows.end - rows.begin);
      draw(pass, context, key, block, 0, count());
      pass.end();
      over_->apply(context.encoder(), color, "exact", {}, rows, lists_->group(), std::as_bytes(std::span(&block.width, 1)));
      ++block.strip;
    }
    lists_->collect(context.encoder());
  }

  std::string pass_name_;
  Selection selection_;
  DrawStates states_;
  bool straight_{}, two_surfaces_{true};
  Order order_{};
  Oit oit_{};
  std::uint64_t memory_{};
  TextureFormat color_format_{}, depth_format_{};
  Expansion expansion_{Expansion::Vertex};
  std::unique_ptr<OrderedStore> store_;
  std::unique_ptr<TransparentPipelines> pipelines_;
  std::unique_ptr<Over> over_;
  std::unique_ptr<LayerLists> lists_;
  QuadIndices indices_;
  gpu::Buffer frame_buffer_;
  gpu::BindGroup frame_group_, depth_group_;
  gpu::TextureView no_depth_, saturation_;
  bool has_depth_{};
  std::uint64_t generation_{};
};

} // namespace

std::unique_ptr<rg::Pass> make_sorted_glyphs() { return std::make_unique<SortedGlyphs>(); }

} // namespace mote::passes
