// SPDX-License-Identifier: MIT
#include "app/library/mote.hpp"

#include "app/library/annotated.hpp"
#include "app/library/job.hpp"
#include "app/library/panels.hpp"
#include "app/library/user_types.hpp"
#include "core/image/png.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote {
namespace {

[[noreturn]] void throw_error(const Diagnostics& diagnostics) {
  std::string first;
  for (const Diagnostic& d : diagnostics.list())
    if (first.empty() && d.severity == Severity::Error) first = d.code;
  throw Error(to_string(diagnostics), first, static_cast<int>(app::exit_of(diagnostics)));
}

// Runs the body; what the inner layers throw leaves as Error.
template <class Body> auto translated(const Body& body) {
  try {
    return body();
  } catch (const Failure& failure) {
    throw Error(failure.what(), failure.diagnostic().code, static_cast<int>(failure.exit()));
  }
}

passes::Expansion expansion_of(const std::string& word) {
  passes::Expansion expansion{};
  if (passes::parse_expansion(word, expansion)) return expansion;
  fail(Exit::Usage, "A001", {}, fmt::format("there is no expansion '{}'", word));
}

} // namespace

const char* version() noexcept { return MOTE_VERSION; }

Error::Error(const std::string& what, std::string code, int exit_status)
    : std::runtime_error(what), code_(std::move(code)), exit_status_(exit_status) {}
Error::~Error() = default;

// The description stays beside the scene, because an automatic camera depends on the picture's shape.
struct LoadedScene::Data {
  app::Job job{};
  std::vector<std::string> warnings{};
};

std::uint64_t LoadedScene::particle_count() const { return data_->job.scene.particle_count(); }
const std::vector<std::string>& LoadedScene::warnings() const { return data_->warnings; }

LoadedScene load(const std::vector<std::string>& names, const std::vector<std::string>& settings) {
  return translated([&] {
    auto data = std::make_shared<LoadedScene::Data>();
    app::JobRequest request;
    request.words = names;
    request.settings = settings;
    Diagnostics diagnostics;
    data->job = app::load_job(request, diagnostics);
    if (diagnostics.has_errors()) throw_error(diagnostics);
    diagnostics.append(app::as_warnings(data->job.left_out));
    for (const Diagnostic& d : diagnostics.list()) data->warnings.push_back(to_string(d));
    return LoadedScene(std::move(data));
  });
}

struct Renderer::Impl {
  app::DrawingDevice device;
  ColorConfig config;
  explicit Impl(const RendererOptions& options)
      : device({.name = options.device, .validation = options.validation}), config(ColorConfig::load(options.color_config)) {}
  Image render(const app::Job& loaded, const RenderOptions& options);
};

Renderer::Renderer(const RendererOptions& options) : impl_(translated([&] { return std::make_unique<Impl>(options); })) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
std::string Renderer::device_name() const { return impl_->device.info().name; }

Image Renderer::Impl::render(const app::Job& loaded, const RenderOptions& options) {
  if (options.width == 0 || options.height == 0) fail(Exit::Usage, "A002", {}, fmt::format("a picture of {}x{} has no pixels", options.width, options.height));
  if (std::max(options.width, options.height) > app::largest_picture)
    fail(Exit::Usage, "A002", {}, fmt::format("a picture of {}x{} is too large: at most {} pixels a side", options.width, options.height, app::largest_picture));
  app::Job job = loaded;
  job.size = {options.width, options.height};
  job.scene.camera = complete_camera(job.desc.camera, job.scene.bounds, job.size);
  if (options.transparent) job.scene.background.a = 0.0;
  if (!options.graph.empty()) {
    job.graph.graph = options.graph;
    job.graph.folder.clear();
  }
  job.graph.settings.insert(job.graph.settings.end(), options.settings.begin(), options.settings.end());
  job.graph.linear = options.linear;
  if (options.depth) job.graph.aovs.push_back(app::Aov::Depth);
  if (options.id) job.graph.aovs.push_back(app::Aov::Id);
  if (options.normal) job.graph.aovs.push_back(app::Aov::Normal);
  Diagnostics diagnostics;
  std::optional<app::ReadyGraph> graph = app::ready_graph(job.graph, diagnostics);
  if (!graph) throw_error(diagnostics);
  app::DisplayOptions display;
  display.view = options.view;
  const app::PassDisplay shown = graph->shown;
  app::FrameRenderer renderer(device, std::move(*graph), config, display, expansion_of(options.expansion));
  renderer.set_scene(job.scene);
  app::DrawnPicture p = app::draw_picture(renderer, job.view());
  if (!options.legend) job.scene.annotations = {};
  if (!job.scene.annotations.empty()) app::annotate(p, job, app::display_of(config, display, shown));
  if (!options.depth) p.depth.clear(); // that of hidden lines
  return {p.size.width,       p.size.height,   std::move(p.rgba8), std::move(p.linear),
          std::move(p.depth), std::move(p.id), std::move(p.normal)};
}

Image Renderer::render(const LoadedScene& scene, const RenderOptions& options) {
  return translated([&] { return impl_->render(scene.data().job, options); });
}

void write_png(const std::string& path, const Image& image, bool keep_alpha) {
  translated([&] {
    mote::write_png(path, image.width, image.height, std::span<const std::uint8_t>(image.rgba), {.keep_alpha = keep_alpha});
    return 0;
  });
}

} // namespace mote
