// SPDX-License-Identifier: MIT
#include "app/window/painter.hpp"

#include "app/library/annotated.hpp"
#include "app/library/panels.hpp"
#include "app/library/smoothing.hpp"
#include "app/library/texels.hpp"
#include "render_graph/params.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace mote::window {
namespace {

constexpr double frames_of_a_session = 1000; // what a window expects to draw: costs of one time hardly count

// The graph's passes with its settings; problems are told by whoever compiles it.
rg::GraphDesc passes_of(const app::GraphRequest& request) {
  Diagnostics ignored;
  rg::GraphDesc graph = app::load_graph(request, ignored);
  for (const std::string& setting : request.settings) rg::apply_setting(graph, setting, ignored);
  return graph;
}

// The same graph with one sample a pixel, and outlines as that sample sees them.
app::GraphRequest draft_request(app::GraphRequest request) {
  for (const rg::PassDesc& pass : passes_of(request).passes)
    for (const auto& [parameter, value] : {std::pair("samples", "1"), std::pair("edges", "sampled")})
      if (rg::find(pass.params, parameter)) request.settings.push_back(fmt::format("{}.{}={}", pass.name.text, parameter, value));
  request.opaque_settings.clear();
  return request;
}

// Does each pixel of the picture depend on the view alone, not on its neighbors or on frames before? So for these kinds.
bool is_local(const app::GraphRequest& request) {
  constexpr std::array kinds{"opaque_impostors", "sorted_glyphs", "shadow_map", "ocio_tonemap"};
  const rg::GraphDesc graph = passes_of(request);
  return std::all_of(graph.passes.begin(), graph.passes.end(), [&](const rg::PassDesc& pass) { return !pass.enabled || std::find(kinds.begin(), kinds.end(), pass.kind.text) != kinds.end(); });
}

bool same_view(const View& a, const View& b) {
  return a.projection == b.projection && a.eye == b.eye && a.rotation == b.rotation && a.size == b.size && a.focal == b.focal && a.near_cut == b.near_cut && a.far_cut == b.far_cut &&
         a.depth_near == b.depth_near;
}

constexpr std::uint32_t margin_rows = 8, least_rows = 32; // of strips; a margin, so that outlines know what is beyond

// The window reads the output in a shader, which no pass of the graph does.
void make_readable(app::ReadyGraph& graph) {
  for (const rg::Root& root : graph.plan.roots)
    if (root.source == graph.output && !root.buffer) graph.plan.textures[root.resource].usage |= gpu::TextureUsage::Sampled | gpu::TextureUsage::CopySrc;
}

} // namespace

Painter::Painter(app::DrawingDevice& device, const app::DisplayOptions& display, passes::Expansion expansion)
    : device_(device), options_(display), expansion_(expansion) {}

std::unique_ptr<app::FrameRenderer> Painter::make(const app::GraphRequest& request, const ColorConfig& config, Diagnostics& diagnostics) {
  std::optional<app::ReadyGraph> graph = app::ready_graph(request, diagnostics);
  if (!graph) return nullptr;
  make_readable(*graph);
  auto made = std::make_unique<app::FrameRenderer>(device_, std::move(*graph), config, options_, expansion_, frames_of_a_session, store_);
  store_ = made->store();
  return made;
}

bool Painter::set(const app::Job& job, std::shared_ptr<const ColorConfig> config, Diagnostics& diagnostics) {
  try {
    // Outlines as `mote render` draws them.
    app::GraphRequest request = job.graph;
    app::request_smoothing(request, {}, app::takes_edges(request, job.scene));
    std::unique_ptr<app::FrameRenderer> made = make(request, *config, diagnostics);
    if (!made || diagnostics.has_errors()) return false;
    app::warn_of_graph(job, made->graph(), diagnostics);
    made->set_scene(job.scene);
    made->wait(made->draw(job.view_of(job.scene.camera))); // finds what only drawing finds
    const bool differs = draft_request(request).settings.size() != request.settings.size() || !request.opaque_settings.empty(), local = is_local(request);
    final_ = std::move(made);
    draft_.reset();
    pick_.reset();
    slot_.reset();
    config_ = std::move(config); // nobody points to the one before any more
    picks_ = true;
    draft_differs_ = differs;
    local_ = local;
    refining_.reset();
    row_ms_ = 0.0;
    request_ = std::move(request);
    scene_ = &job.scene;
    display_.emplace(app::display_of(*config_, options_, final_->graph().shown));
    return true;
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
    if (scene_) set_scene(*scene_); // the store may have let its particles go
    return false;
  }
}

void Painter::set_scene(const Scene& scene) {
  scene_ = &scene;
  refining_.reset();
  for (app::FrameRenderer* renderer : {final_.get(), draft_.get(), pick_.get(), slot_.get()})
    if (renderer) renderer->set_scene(scene);
}

gpu::Texture Painter::draft(const View& view) {
  refining_.reset();
  if (!draft_) { // one of its own in any case: what changes its size every frame begins anew each time
    app::GraphRequest request = draft_request(request_);
    request.depth_if_made = false;
    Diagnostics known; // the graph has been compiled before
    draft_ = make(request, *config_, known);
    if (draft_) draft_->set_scene(*scene_);
  }
  app::FrameRenderer& renderer = draft_ ? *draft_ : *final_;
  renderer.wait(renderer.draw(view));
  return renderer.output();
}

// Halves of the height until a strip fits; strips of one refinement never grow, so textures of one size serve it.
std::uint32_t Painter::strip_rows(std::uint32_t height, double goal_ms) const {
  if (!local_) return height;
  const double row = row_ms_ > 0.0 ? row_ms_ : goal_ms * 4.0 / std::max(1u, height); // nothing is known: a quarter
  std::uint32_t rows = height;
  while (rows > least_rows && row * rows > goal_ms) rows = (rows / 2 + 7) / 8 * 8;
  return std::min(rows, height);
}

bool Painter::refine(const View& view, double goal_ms) {
  if (!refining_ || !same_view(*refining_, view)) {
    refining_ = view;
    next_row_ = drawn_pieces_ = 0;
    slowest_row_ms_ = 0.0;
    strip_ = strip_rows(view.size.height, goal_ms);
    under_way_ = {};
    depth_under_way_.clear();
  }
  const auto start = std::chrono::steady_clock::now();
  const std::uint32_t rows = std::min(strip_, view.size.height - next_row_);
  draw_strip(view, next_row_, rows);
  next_row_ += rows;
  ++drawn_pieces_;
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  slowest_row_ms_ = std::max(slowest_row_ms_, ms / rows);
  row_ms_ = slowest_row_ms_;
  if (next_row_ < view.size.height) {
    strip_ = std::min(strip_, strip_rows(view.size.height, goal_ms));
    return false;
  }
  refining_.reset();
  pieces_ = drawn_pieces_;
  shown_ = std::exchange(under_way_, {});
  depth_ = std::exchange(depth_under_way_, {});
  return true;
}

void Painter::draw_strip(const View& view, std::uint32_t first, std::uint32_t rows) {
  const auto& aovs = final_->graph().aovs;
  const auto depth = aovs.find(app::Aov::Depth);
  const auto read_depth = [&] { return app::texels_as<float>(device_.device().read_texture(final_->texture(depth->second))); };
  if (rows == view.size.height) {
    final_->wait(final_->draw(view));
    under_way_ = final_->output();
    if (depth != aovs.end()) depth_under_way_ = read_depth();
    return;
  }
  View part = view; // with its margin; all strips of a height have one size
  const std::uint32_t high = std::min(rows + 2 * margin_rows, view.size.height);
  const std::uint32_t top = std::min(first > margin_rows ? first - margin_rows : 0, view.size.height - high), skipped = first - top;
  part.picture = view.whole();
  part.panel_origin = view.panel_origin + glm::uvec2(0, top);
  part.size.height = high;
  final_->wait(final_->draw(part));
  const gpu::Texture output = final_->output();
  if (!under_way_)
    under_way_ = device_.device().create_texture({.label = "refined", .size = {view.size.width, view.size.height, 1}, .format = output.format(),
                                                  .usage = gpu::TextureUsage::CopyDst | gpu::TextureUsage::Sampled});
  gpu::CommandEncoder encoder = device_.device().create_command_encoder("refined");
  encoder.copy_texture_to_texture({.texture = &output, .origin = {0, skipped, 0}}, {.texture = &under_way_, .origin = {0, first, 0}}, {view.size.width, rows, 1});
  device_.device().queue().wait(device_.device().queue().submit(encoder.finish()));
  device_.check();
  if (depth == aovs.end()) return;
  const std::vector<float> strip = read_depth();
  depth_under_way_.insert(depth_under_way_.end(), strip.begin() + std::ptrdiff_t{skipped} * view.size.width, strip.begin() + static_cast<std::ptrdiff_t>(std::size_t{skipped + rows} * view.size.width));
}

app::DrawnPicture Painter::picture(const app::Job& job, const View& view) {
  refining_.reset();
  app::DrawnPicture drawn = app::draw_picture(*final_, view, 0);
  app::annotate(drawn, job, *display_);
  return drawn;
}

std::optional<PickArea> Painter::pick(const View& view, double x, double y, std::uint32_t radius) {
  if (!pick_ && picks_) {
    app::GraphRequest request = draft_request(request_);
    request.aovs = {app::Aov::Id, app::Aov::Depth};
    Diagnostics none; // a graph without ids cannot be picked
    pick_ = make(request, *config_, none);
    picks_ = pick_ != nullptr;
    if (pick_) pick_->set_scene(*scene_);
  }
  if (!pick_) return std::nullopt;
  const View part = pick_view(view, x, y, radius);
  pick_->wait(pick_->draw(part));
  app::DrawnPicture drawn = pick_->read();
  return PickArea{part.panel_origin - view.panel_origin, part.size, std::move(drawn.id), std::move(drawn.depth)};
}

std::optional<SlotPixels> Painter::slot(const std::string& source, const View& view, Diagnostics& diagnostics) {
  if (!slot_ || slot_source_ != source) {
    app::GraphRequest request = request_;
    request.dumps.push_back({source, {"slot"}});
    slot_ = make(request, *config_, diagnostics);
    if (!slot_) return std::nullopt;
    slot_source_ = source;
    slot_->set_scene(*scene_);
  }
  slot_->wait(slot_->draw(view));
  const gpu::Texture texture = slot_->texture(source);
  if (!texture || app::texel_kind(texture.format()).components == 0) return std::nullopt;
  return SlotPixels{{texture.size().width, texture.size().height}, texture.format(), device_.device().read_texture(texture)};
}

} // namespace mote::window
