// SPDX-License-Identifier: MIT
// mote trace-pixel: one pixel followed through spaces, depth tests and blending, as text or JSON.
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#include "app/library/pixel_trace.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>

namespace mote::app {
namespace {

using nlohmann::ordered_json;

struct TraceArguments {
  SceneArguments scene{};
  DeviceArguments device{};
  bool json{};
};

template <int N> std::string text(const glm::vec<N, double>& v) {
  std::string out = "(";
  for (int k = 0; k < N; ++k) out += fmt::format("{}{:.9g}", k ? ", " : "", v[k]);
  return out + ")";
}
ordered_json number(double v) { return std::isfinite(v) ? ordered_json(v) : ordered_json(nullptr); }
template <int N> ordered_json json_of(const glm::vec<N, double>& v) {
  ordered_json out = ordered_json::array();
  for (int k = 0; k < N; ++k) out.push_back(number(v[k]));
  return out;
}

std::uint32_t parse_place(const std::string& word, std::uint32_t end, std::string_view what) {
  std::uint32_t value{};
  const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || last != word.data() + word.size() || value >= end)
    fail(Exit::Usage, code::command_line, {}, fmt::format("'{}' is not a {} of the picture: 0 to {}", word, what, end - 1), {"mote trace-pixel SCENE X Y: column and row count from the top left"});
  return value;
}

ordered_json json_of(const TracedParticle& p) {
  ordered_json out{{"id", p.id}, {"row", p.row}, {"file", p.file}, {"type", p.type}, {"radius", p.radius}};
  out["object"] = json_of(p.object);
  out["world"] = json_of(p.world);
  out["eye"] = json_of(p.eye);
  out["clip"] = json_of(p.clip);
  out["ndc"] = json_of(p.ndc);
  out["window"] = json_of(p.window);
  out["rectangle"] = {{"min", json_of(p.lo)}, {"max", json_of(p.hi)}};
  out["hit"] = p.hit;
  if (p.hit) out["enters"] = p.enters;
  if (p.hit) out["leaves"] = p.leaves;
  return out;
}
ordered_json json_of(const TracedFragment& f) {
  return {{"particle", f.particle}, {"side", f.exit ? "exit" : "entry"}, {"z", f.z}, {"depth", f.depth}, {"depth_float32", f.depth32},
          {"normal", json_of(f.normal)}, {"color", json_of(f.color)}, {"alpha", f.alpha}, {"depth_there", number(f.there)}, {"passes", f.passes},
          {"before", json_of(f.before)}, {"after", json_of(f.after)}};
}
void print_json(const PixelTrace& t) {
  ordered_json out{{"pixel", {t.x, t.y}}, {"size", {t.size.width, t.size.height}}, {"ray", {{"origin", json_of(t.ray_origin)}, {"direction", json_of(t.ray_direction)}}}};
  out["passes"] = ordered_json::array();
  for (const TracedPass& pass : t.passes) {
    ordered_json row{{"name", pass.name}, {"kind", pass.kind}, {"states", pass.states}, {"blending", pass.blending}, {"particles", ordered_json::array()}, {"fragments", ordered_json::array()}};
    for (const TracedParticle& p : pass.particles) row["particles"].push_back(json_of(p));
    for (const TracedFragment& f : pass.fragments) row["fragments"].push_back(json_of(f));
    row["color"] = json_of(pass.color);
    out["passes"].push_back(std::move(row));
  }
  out["linear"] = json_of(t.linear);
  out["display"] = {{"name", t.display_name}, {"rgba8", t.display}};
  out["notes"] = t.notes;
  fmt::print("{}\n", out.dump(2));
}

void print_particle(const TracedParticle& p) {
  fmt::print("  particle {} ({} {}, row {}), radius {:.9g}\n", p.id, p.file, p.type, p.row, p.radius);
  fmt::print("    object  {}\n    world   {}\n    eye     {}\n    clip    {}\n    ndc     {}\n    window  {}\n", text(p.object), text(p.world), text(p.eye), text(p.clip), text(p.ndc), text(p.window));
  fmt::print("    rectangle x {:.3f} to {:.3f}, y {:.3f} to {:.3f}: covers the pixel\n", p.lo.x, p.hi.x, p.lo.y, p.hi.y);
  if (p.hit) fmt::print("    the ray is inside from z = {:.9g} to {:.9g}\n", p.enters, p.leaves);
  else fmt::print("    the ray misses: discarded\n");
}
void print_fragment(const TracedPass& pass, std::size_t i) {
  const TracedFragment& f = pass.fragments[i];
  fmt::print("  fragment {}: particle {}, {} at z = {:.9g}, depth n / z = {:.9g} (float32 {:.9g})\n", i + 1, pass.particles[f.particle].id, f.exit ? "exit" : "entry", f.z, f.depth, f.depth32);
  fmt::print("    normal {}, color {}, alpha {:.6g}\n", text(f.normal), text(f.color), f.alpha);
  const std::string there = std::isinf(f.there) ? "nothing there" : fmt::format("z = {:.9g} there", f.there);
  fmt::print("    depth test, {}: {}\n", there, f.passes ? "passes" : "fails");
  if (f.passes) fmt::print("    color {} -> {}\n", text(f.before), text(f.after));
}
void print_text(const PixelTrace& t) {
  fmt::print("pixel ({}, {}) of {}x{}, its center; double precision on the processor\n", t.x, t.y, t.size.width, t.size.height);
  fmt::print("ray in eye space (x right, y down, z forward): {} + z {}\n", text(t.ray_origin), text(t.ray_direction));
  for (const TracedPass& pass : t.passes) {
    fmt::print("pass {} ({}): {}\n  blending: {}\n", pass.name, pass.kind, pass.states, pass.blending);
    for (const TracedParticle& p : pass.particles) print_particle(p);
    for (std::size_t i = 0; i < pass.fragments.size(); ++i) print_fragment(pass, i);
    if (pass.fragments.empty()) fmt::print("  no fragment\n");
    fmt::print("  color after the pass {}\n", text(pass.color));
  }
  fmt::print("scene-linear {}, on the display ({}) {} {} {} {}\n", text(t.linear), t.display_name, t.display[0], t.display[1], t.display[2], t.display[3]);
  for (const std::string& note : t.notes) fmt::print("note: {}\n", note);
}

void run(TraceArguments a) {
  if (a.scene.words.size() < 3) fail(Exit::Usage, code::command_line, {}, "trace-pixel needs a scene, a column and a row", {"for example mote trace-pixel app/scenes/stack.toml 640 380"});
  const std::string y = a.scene.words.back(), x = a.scene.words[a.scene.words.size() - 2];
  a.scene.words.resize(a.scene.words.size() - 2);
  const JobRequest request = job_request(a.scene);
  const std::uint32_t column = parse_place(x, request.size.width, "column"), row = parse_place(y, request.size.height, "row");
  Diagnostics diagnostics;
  const Job job = load_job(request, diagnostics);
  std::optional<ReadyGraph> graph;
  if (!diagnostics.has_errors()) graph = ready_graph(job.graph, diagnostics);
  print_and_stop_on_errors(diagnostics);
  const PixelTrace trace = trace_pixel(job, *graph, column, row, ColorConfig::load(a.device.display.config), a.device.display);
  (a.json ? print_json : print_text)(trace);
}

} // namespace

void add_trace_pixel(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("trace-pixel", "follow one pixel: particles from object space to the window, fragments through depth test and blending");
  auto a = std::make_shared<TraceArguments>();
  add_scene_arguments(*command, a->scene);
  command->get_option("SCENE")->description("a scene as for render, then the pixel's column X and row Y, from the top left")->type_name("SCENE X Y");
  add_device_arguments(*command, a->device);
  command->add_flag("--json", a->json, "as JSON");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
