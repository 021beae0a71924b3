// SPDX-License-Identifier: MIT
#include "app/window/painter.hpp"

#include "app/library/annotated.hpp"
#include "app/library/panels.hpp"
#include "app/library/texels.hpp"
#include "render_graph/params.hpp"

#include <algorithm>

namespace mote::window {
namespace {

constexpr double frames_of_a_session = 1000; // what a window expects to draw: costs of one time hardly count

// Settings that make passes of one sample a pixel of those that have several.
std::vector<std::string> draft_settings(const app::GraphRequest& request) {
  std::vector<std::string> out;
  Diagnostics ignored; // whoever compiles the graph reports
  rg::GraphDesc graph = app::load_graph(request, ignored);
  for (const std::string& setting : request.settings) rg::apply_setting(graph, setting, ignored);
  for (const rg::PassDesc& pass : graph.passes)
    if (rg::find(pass.params, "samples")) out.push_back(pass.name.text + ".samples=1");
  return out;
}

// The window reads the output in a shader, which no pass of the graph does.
void make_readable(app::ReadyGraph& graph) {
  for (const rg::Root& root : graph.plan.roots)
    if (root.source == graph.output && !root.buffer) graph.plan.textures[root.resource].usage |= gpu::TextureUsage::Sampled;
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
    std::unique_ptr<app::FrameRenderer> made = make(job.graph, *config, diagnostics);
    if (!made || diagnostics.has_errors()) return false;
    app::warn_of_graph(job, made->graph(), diagnostics);
    made->set_scene(job.scene);
    made->wait(made->draw(job.view_of(job.scene.camera))); // finds what only drawing finds
    const std::vector<std::string> fewer = draft_settings(job.graph);
    final_ = std::move(made);
    draft_.reset();
    pick_.reset();
    slot_.reset();
    config_ = std::move(config); // nobody points to the one before any more
    picks_ = true;
    draft_differs_ = !fewer.empty();
    request_ = job.graph;
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
  for (app::FrameRenderer* renderer : {final_.get(), draft_.get(), pick_.get(), slot_.get()})
    if (renderer) renderer->set_scene(scene);
}

gpu::Texture Painter::draw(const View& view, bool draft) {
  if (draft && !draft_) {
    app::GraphRequest request = request_;
    for (std::string& setting : draft_settings(request_)) request.settings.push_back(std::move(setting));
    request.depth_if_made = false;
    Diagnostics known; // the graph has been compiled before
    draft_ = make(request, *config_, known);
    if (draft_) draft_->set_scene(*scene_);
  }
  app::FrameRenderer& renderer = draft && draft_ ? *draft_ : *final_;
  renderer.wait(renderer.draw(view));
  return renderer.output();
}

std::vector<float> Painter::read_depth() {
  const auto& aovs = final_->graph().aovs;
  const auto depth = aovs.find(app::Aov::Depth);
  if (depth == aovs.end()) return {};
  return app::texels_as<float>(device_.device().read_texture(final_->texture(depth->second)));
}

app::DrawnPicture Painter::picture(const app::Job& job, const View& view) {
  app::DrawnPicture drawn = app::draw_picture(*final_, view, 0);
  app::annotate(drawn, job, *display_);
  return drawn;
}

std::optional<PickArea> Painter::pick(const View& view, double x, double y, std::uint32_t radius) {
  if (!pick_ && picks_) {
    app::GraphRequest request = request_;
    for (std::string& setting : draft_settings(request_)) request.settings.push_back(std::move(setting));
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
