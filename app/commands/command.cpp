// SPDX-License-Identifier: MIT
#include "app/commands/command.hpp"

#include "app/codes.hpp"
#include "app/library/panels.hpp"
#include "core/data/series.hpp"
#include "core/scene/generated.hpp"
#include "core/scene/user_type.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

namespace mote::app {

void add_scene_arguments(CLI::App& command, SceneArguments& a) {
  command.add_option("SCENE", a.words, "a scene file, particle files, or a generated scene like spheres:1e5:fill")->required();
  command.add_option("--set", a.settings, "change a value: camera.fov_y=40, light.sun.intensity=2, display.exposure=1")
      ->allow_extra_args(false)
      ->type_name("PATH=VALUE");
  add_type_option(command, a.types);
  command.add_option("--style", a.style, "how molecules are shown: spacefill, ball_and_stick, licorice")->type_name("STYLE");
  command.add_option("--graph", a.graph, "shipped graph or graph file")->type_name("GRAPH");
  command.add_option("--size", a.size, "size of the picture in pixels, 1280x720 if not given")->type_name("WxH");
  command.add_option("--expansion", a.expansion, "how particles become fragments: auto, vertex, geometry, compute, point")->type_name("NAME");
}

void add_type_option(CLI::App& command, std::vector<std::string>& types) {
  command.add_option("--type", types, "a folder with a particle type (type.toml, type.glsl); particle files named alone are drawn by the last one")
      ->allow_extra_args(false)
      ->type_name("DIR");
}

void add_device_arguments(CLI::App& command, DeviceArguments& a) {
  command.add_option("--device", a.device.name, "part of a Vulkan device's name")->type_name("NAME");
  command.add_option("--memory", a.device.memory, "memory that particles and pictures may take, like 512M or 4G")->transform(CLI::AsSizeValue(false))->type_name("SIZE");
  command.add_flag("--validation", a.device.validation, "run with the Vulkan validation layer; its messages are failures");
  command.add_option("--ocio", a.display.config, "OpenColorIO config instead of $OCIO or the shipped one")->type_name("FILE");
  command.add_option("--display", a.display.display, "display of the color config")->type_name("NAME");
  command.add_option("--view", a.display.view, "view transform: Un-tone-mapped, ACES SDR, Raw, or the config's")->type_name("NAME");
  command.add_flag("--exact", a.display.exact, "OpenColorIO's arithmetic instead of baked curves");
}

Size2d parse_size(std::string_view text) {
  Size2d size;
  const char* const end = text.data() + text.size();
  const auto [x, first] = std::from_chars(text.data(), end, size.width);
  const bool middle = first == std::errc{} && x != end && (*x == 'x' || *x == 'X');
  const auto [last, second] = std::from_chars(middle ? x + 1 : end, end, size.height);
  constexpr std::uint32_t most = largest_picture;
  const bool sound = middle && second == std::errc{} && last == end && size.width >= 1 && size.height >= 1 &&
                     size.width <= most && size.height <= most;
  if (!sound)
    fail(Exit::Usage, code::size, {"--size"}, fmt::format("'{}' is not a size: WIDTHxHEIGHT, each from 1 to {}", text, most),
         {"For example --size 1280x720"});
  return size;
}

passes::Expansion parse_expansion(const std::string& word) {
  passes::Expansion expansion{};
  if (passes::parse_expansion(word, expansion)) return expansion;
  std::vector<std::string> names;
  for (std::string_view name : passes::expansion_names()) names.emplace_back(name);
  fail(Exit::Usage, code::command_line, {"--expansion"}, fmt::format("there is no expansion '{}'", word),
       {did_you_mean(word, names), fmt::format("Expansions: {}", list_of(names))});
}

std::pair<std::string, std::string> split_request(const std::string& option, const std::string& request) {
  const std::size_t equals = request.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == request.size())
    fail(Exit::Usage, code::aov_request, {option}, fmt::format("'{}' is not NAME=FILE", request),
         {fmt::format("For example {} {}", option, option == "--aov" ? "depth=depth.npy" : "opaque.color=color.npy")});
  return {request.substr(0, equals), request.substr(equals + 1)};
}

namespace {

// Particle files without a scene are drawn by the last type that is named.
void draw_by_type(const SceneArguments& a, JobRequest& request) {
  if (a.types.empty()) return;
  for (const std::string& folder : a.types) request.types.push_back(std::filesystem::absolute(folder).lexically_normal().string());
  const auto whole = [](const std::string& word) { return is_scene_path(word) || is_generated_name(word); };
  if (std::any_of(a.words.begin(), a.words.end(), whole)) return;
  Diagnostics told_later;
  const auto type = read_user_type(request.types.back(), {"--type"}, told_later);
  if (!type) return;
  std::size_t i = 0;
  for (const std::string& word : a.words)
    if (!data::is_trajectory_name(word)) request.settings.insert(request.settings.begin(), fmt::format("data[{}].type=\"{}\"", i++, type->name));
}

} // namespace

JobRequest job_request(const SceneArguments& a) {
  JobRequest request;
  request.words = a.words;
  request.settings = a.settings;
  draw_by_type(a, request);
  if (!a.style.empty()) request.settings.push_back(fmt::format("style=\"{}\"", a.style));
  if (!a.graph.empty()) request.graph = a.graph;
  request.size = parse_size(a.size);
  return request;
}

std::vector<std::pair<std::string_view, std::uint64_t>> named_counts(const rg::PassCounts& c) {
  return {{"vertices", c.vertices}, {"primitives", c.primitives}, {"vertex_invocations", c.vertex_invocations},
          {"geometry_invocations", c.geometry_invocations}, {"geometry_primitives", c.geometry_primitives},
          {"clipping_invocations", c.clipping_invocations}, {"clipping_primitives", c.clipping_primitives},
          {"fragment_invocations", c.fragment_invocations}, {"interpolated_components", c.interpolated_components()}, {"flat_components", c.flat_components()}};
}

std::string counts_text(const rg::PassCounts& c, std::string_view indent) {
  if (c.vertices == 0) return fmt::format("{}nothing rasterized: kernels are not counted\n", indent);
  std::string text = fmt::format("{}vertices {}, primitives {}, rasterized {}, fragments {}\n", indent, c.vertices, c.primitives, c.clipping_primitives, c.fragment_invocations);
  if (c.fragment_invocations > 0)
    text += fmt::format("{}components interpolated {} ({} a fragment), flat {} ({} a fragment)\n", indent, c.interpolated_components(), c.interpolated, c.flat_components(), c.flat);
  return text;
}

void print(const Diagnostics& diagnostics) { std::fputs(to_string(diagnostics).c_str(), stderr); }

void print_and_stop_on_errors(const Diagnostics& diagnostics) {
  print(diagnostics);
  if (diagnostics.has_errors()) throw Stop{exit_of(diagnostics)};
}

namespace {

volatile sig_atomic_t waiting_signal = 0;
volatile sig_atomic_t uninterrupted = 0;

int status_of(int signal) { return static_cast<int>(signal == SIGTERM ? Exit::Terminated : Exit::Interrupted); }

extern "C" void on_signal(int signal) {
  if (uninterrupted) waiting_signal = signal;
  else _exit(status_of(signal));
}

} // namespace

Uninterrupted::Uninterrupted() { uninterrupted = 1; }
Uninterrupted::~Uninterrupted() {
  uninterrupted = 0;
  if (waiting_signal) _exit(status_of(waiting_signal));
}

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = SIG_IGN; // a closed pipe is an error of the write, not the end of the program
  sigaction(SIGPIPE, &action, nullptr);
}

} // namespace mote::app
