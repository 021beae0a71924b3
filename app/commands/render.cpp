// SPDX-License-Identifier: MIT
// mote render: one picture, its AOVs and whatever else of the graph is asked for, into files.
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#include "app/library/panels.hpp"
#include "app/library/reference_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>

namespace mote::app {
namespace {

struct RenderArguments {
  SceneArguments scene{};
  DeviceArguments device{};
  std::string output{};
  std::vector<std::string> aovs{}, dumps{};
  bool reference{}, transparent{};
  int bits{8};
  std::uint32_t panel{};
};

// What goes where.
struct Outputs {
  std::string picture{};
  std::vector<std::pair<Aov, std::string>> aovs{};
  std::vector<std::pair<std::string, std::string>> dumps{};
};

void check_ending(const std::string& option, const std::string& path, std::initializer_list<FileKind> kinds, std::string_view endings) {
  if (std::find(kinds.begin(), kinds.end(), file_kind(path)) == kinds.end())
    fail(Exit::Usage, code::output_ending, {option}, fmt::format("'{}' ends in nothing that can be written here", path),
         {fmt::format("Endings: {}", endings)});
}

Aov parse_aov(const std::string& name) {
  const auto found = std::find(aov_names.begin(), aov_names.end(), name);
  if (found != aov_names.end()) return static_cast<Aov>(found - aov_names.begin());
  const std::vector<std::string> names(aov_names.begin(), aov_names.end());
  fail(Exit::Usage, code::aov_request, {"--aov"}, fmt::format("there is no AOV '{}'", name),
       {did_you_mean(name, names), fmt::format("AOVs: {}", list_of(names))});
}

Outputs parse_outputs(const RenderArguments& a) {
  Outputs out;
  out.picture = a.output;
  if (a.output.empty() && a.aovs.empty() && a.dumps.empty()) out.picture = "mote.png";
  if (!out.picture.empty()) check_ending("-o", out.picture, {FileKind::Png, FileKind::Exr}, ".png, .exr, or - for a PNG on standard output");
  for (const std::string& request : a.aovs) {
    const auto [name, file] = split_request("--aov", request);
    if (file != "-") check_ending("--aov", file, {FileKind::Npy}, ".npy");
    out.aovs.emplace_back(parse_aov(name), file);
  }
  for (const std::string& request : a.dumps) {
    const auto [source, file] = split_request("--dump", request);
    check_ending("--dump", file, {FileKind::Npy, FileKind::Exr}, ".npy, .exr");
    out.dumps.emplace_back(source, file);
  }
  std::size_t to_stdout = out.picture == "-" ? 1 : 0;
  for (const auto& [aov, file] : out.aovs) to_stdout += file == "-";
  if (to_stdout > 1) fail(Exit::Usage, code::twice_to_stdout, {}, "only one output can go to standard output");
  return out;
}

JobRequest request_of(const RenderArguments& a, const Outputs& outputs) {
  JobRequest request = job_request(a.scene);
  request.transparent = a.transparent;
  request.linear = request.every_aov = file_kind(outputs.picture) == FileKind::Exr;
  request.deep = a.bits == 16 && file_kind(outputs.picture) == FileKind::Png;
  for (const auto& [aov, file] : outputs.aovs)
    if (std::find(request.aovs.begin(), request.aovs.end(), aov) == request.aovs.end()) request.aovs.push_back(aov);
  for (const auto& [source, file] : outputs.dumps) request.dumps.push_back({source, {"--dump"}});
  return request;
}

std::string vec_text(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

// Everything that another run needs to make the same picture; no time and no host, so that equal input gives
// equal files.
Provenance provenance_of(const RenderArguments& a, const Job& job, const std::string& drawn_by, const std::string& display) {
  const Camera& c = job.scene.camera;
  std::string camera = fmt::format("eye = {}, target = {}, up = {}, ", vec_text(c.eye), vec_text(c.target), vec_text(c.up));
  camera += c.projection == Projection::Perspective ? fmt::format("fov_y = {}", c.fov_y)
                                                    : fmt::format("projection = \"orthographic\", height = {}", c.height);
  if (c.near) camera += fmt::format(", near = {}", *c.near);
  if (c.far) camera += fmt::format(", far = {}", *c.far);
  Provenance p{{"Software", version_text()},
               {"Source", job.desc.name},
               {"Camera", camera},
               {"Graph", a.reference ? "reference" : job.graph.graph},
               {"Device", drawn_by},
               {"View transform", display}};
  std::string settings;
  for (const std::string& setting : a.scene.settings) settings += (settings.empty() ? "" : " ") + setting;
  if (!settings.empty()) p.emplace_back("Settings", settings);
  return p;
}

void save(const RenderArguments& a, const Outputs& outputs, const DrawnPicture& picture, Provenance provenance) {
  const Uninterrupted guard;
  SaveOptions options{.bits = static_cast<unsigned>(a.bits), .keep_alpha = a.transparent, .provenance = std::move(provenance)};
  if (!outputs.picture.empty()) save_picture(outputs.picture, picture, options);
  for (const auto& [aov, file] : outputs.aovs) {
    if (aov == Aov::Depth) save_depth(file, picture);
    if (aov == Aov::Id) save_id(file, picture);
    if (aov == Aov::Normal) save_normal(file, picture);
  }
  if (a.output.empty() && !outputs.picture.empty()) fmt::print(stderr, "mote: the picture is in {}\n", outputs.picture);
}

void render_reference_picture(const RenderArguments& a, const Outputs& outputs, const Job& job) {
  if (!outputs.dumps.empty())
    fail(Exit::Usage, code::command_line, {"--dump"}, "the reference has no passes: --dump does not go with --reference");
  const ColorConfig config = ColorConfig::load(a.device.display.config);
  const DrawnPicture picture = draw_reference(job, config, a.device.display);
  save(a, outputs, picture, provenance_of(a, job, "double-precision reference", a.device.display.view));
}

void run(const RenderArguments& a) {
  const Outputs outputs = parse_outputs(a);
  if (a.panel != 0 && a.panel < 16)
    fail(Exit::Usage, code::panel, {"--panel"}, fmt::format("'{}' is too small for a panel: at least 16 pixels a side", a.panel));
  const JobRequest request = request_of(a, outputs);
  const passes::Expansion expansion = parse_expansion(a.scene.expansion);

  // The device and the color config are opened while the files are read: they do not depend on each other.
  std::future<std::unique_ptr<DrawingDevice>> opening;
  std::future<ColorConfig> loading;
  if (!a.reference) {
    opening = std::async(std::launch::async, [&a] { return std::make_unique<DrawingDevice>(a.device.device); });
    loading = std::async(std::launch::async, [&a] { return ColorConfig::load(a.device.display.config); });
  }
  Diagnostics diagnostics;
  const Job job = load_job(request, diagnostics);
  std::optional<ReadyGraph> graph;
  if (!a.reference && !diagnostics.has_errors()) graph = ready_graph(job.graph, diagnostics);
  if (graph) warn_of_graph(job, *graph, diagnostics);
  print_and_stop_on_errors(diagnostics);
  if (a.reference) return render_reference_picture(a, outputs, job);

  const ColorConfig config = loading.get();
  const std::unique_ptr<DrawingDevice> device = opening.get();
  FrameRenderer renderer(*device, std::move(*graph), config, a.device.display, expansion);
  renderer.set_scene(job.scene);
  const std::size_t panels = panel_count(renderer, job.view(), a.panel);
  if (panels > 1 && !outputs.dumps.empty())
    fail(Exit::Usage, code::panel, {"--dump"}, fmt::format("the picture is drawn in {} panels, and a dump holds one frame", panels),
         {fmt::format("draw at most {} pixels a side, or leave --panel out", default_panel)});
  const DrawnPicture picture = draw_picture(renderer, job.view(), a.panel);
  print(renderer.report());
  // How far a baked view transform is from the exact one is measured when it is made; say so.
  if (renderer.display_text().find("baked") != std::string::npos) fmt::print(stderr, "mote: {}\n", renderer.display_text());
  save(a, outputs, picture, provenance_of(a, job, device->info().name, renderer.display_text()));
  const Uninterrupted guard;
  for (const auto& [source, file] : outputs.dumps) renderer.dump(source, file);
}

} // namespace

void add_render(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("render", "draw a picture into a file");
  auto a = std::make_shared<RenderArguments>();
  add_scene_arguments(*command, a->scene);
  add_device_arguments(*command, a->device);
  command->add_option("-o,--output", a->output, "picture: .png, .exr (scene-linear, with depth, id and normal), or - for a PNG on standard output")
      ->type_name("FILE");
  command->add_option("--aov", a->aovs, "depth, id or normal at the pixel centers, into a .npy")->allow_extra_args(false)->type_name("NAME=FILE");
  command->add_option("--dump", a->dumps, "any source of the graph, into a .npy or .exr")->allow_extra_args(false)->type_name("PASS.SLOT=FILE");
  command->add_flag("--reference", a->reference, "draw with the double-precision reference instead of a device");
  command->add_flag("--transparent", a->transparent, "a background of alpha 0");
  command->add_option("--panel", a->panel, "draw in panels of at most N pixels a side (4096 where nothing is said), without seams")->type_name("N");
  command->add_option("--bits", a->bits, "bits per channel of a PNG: 8 or 16")->check(CLI::IsMember({8, 16}))->type_name("N");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
