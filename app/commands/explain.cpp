// SPDX-License-Identifier: MIT
// mote explain: draws a few frames of a scene and says, pass by pass, what was chosen and why, what was left out, and what
// it was expected to cost and did.
#include "app/commands/command.hpp"
#include "app/library/calibrate.hpp"
#include "core/scene/generated.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace mote::app {
namespace {

using nlohmann::ordered_json;
constexpr int measured_frames = 4; // after the first, which makes the pipelines

struct ExplainArguments {
  SceneArguments scene{};
  DeviceArguments device{};
  int frames{1};
  bool json{};
};

struct Explained {
  std::vector<passes::ExpansionReport> choices{}; // of the first frame
  std::vector<rg::PassTiming> timings{};          // of the last
  double first{}, median{};                       // ms
};

Explained draw(FrameRenderer& renderer, const Job& job) {
  using Clock = std::chrono::steady_clock;
  Explained out;
  std::vector<double> times;
  for (int k = 0; k <= measured_frames; ++k) {
    const View view = job.view_of(turned(job.scene.camera, degrees_per_frame * k));
    const Clock::time_point start = Clock::now();
    renderer.wait(renderer.draw(view));
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (k == 0) {
      out.first = ms;
      out.choices = renderer.choices();
    } else {
      times.push_back(ms);
    }
  }
  out.median = median(times);
  out.timings = renderer.timings();
  return out;
}

double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

const passes::ExpansionReport* report_of(const Explained& e, const std::string& pass) {
  const auto it = std::find_if(e.choices.begin(), e.choices.end(), [&](const auto& r) { return r.pass == pass; });
  return it == e.choices.end() ? nullptr : &*it;
}

ordered_json json_of(const passes::ExpansionReport& r) {
  const passes::ViewContents& c = r.choice.contents;
  ordered_json json;
  json["expansion"] = passes::to_string(r.choice.expansion);
  json["why"] = r.choice.why;
  json["chunks"] = {{"tiled", r.tiled}, {"drawn", r.rastered}};
  if (!r.automatic) return json;
  json["in_view"] = {{"particles", std::round(c.particles)}, {"chunks", c.chunks}, {"chunks_total", c.chunks_total}, {"radius_px", rounded(c.radius)}, {"depth", rounded(c.depth())}};
  for (const passes::ExpansionCandidate& candidate : r.choice.candidates) {
    ordered_json row{{"expansion", passes::to_string(candidate.expansion)}};
    if (candidate.refused.empty()) {
      row["frame_ms"] = rounded(candidate.frame_ms);
      row["with_once_ms"] = rounded(candidate.total_ms);
    } else {
      row["refused"] = candidate.refused;
    }
    json["candidates"].push_back(std::move(row));
  }
  return json;
}

void print_json(const Explained& e, const rg::Plan& plan, const passes::DeviceCosts& costs, const std::string& device) {
  ordered_json json;
  json["device"] = device;
  json["costs"] = costs.source;
  json["passes"] = ordered_json::array();
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    ordered_json row{{"name", plan.passes[i].name}, {"kind", plan.passes[i].kind}};
    if (!e.timings[i].skipped.empty()) row["skipped"] = e.timings[i].skipped;
    if (const auto* report = report_of(e, plan.passes[i].name)) row.update(json_of(*report));
    row["gpu_ms"] = e.timings[i].gpu_ms ? ordered_json(rounded(*e.timings[i].gpu_ms)) : ordered_json(nullptr);
    row["cpu_ms"] = rounded(e.timings[i].cpu_ms);
    json["passes"].push_back(std::move(row));
  }
  json["culled"] = ordered_json::array();
  for (const rg::Culled& culled : plan.culled) json["culled"].push_back({{"name", culled.name}, {"kind", culled.kind}, {"reason", culled.reason}});
  json["first_ms"] = rounded(e.first);
  json["median_ms"] = rounded(e.median);
  fmt::print("{}\n", json.dump(2));
}

void print_choice(const passes::ExpansionReport& r) {
  fmt::print("     expansion {}: {}\n", passes::to_string(r.choice.expansion), r.choice.why);
  const passes::ViewContents& c = r.choice.contents;
  if (r.automatic)
    fmt::print("     in view: about {:.0f} particles in {} of {} chunks, radius {:.2f} pixels in the mean, {:.1f} layers deep\n", c.particles, c.chunks, c.chunks_total,
               c.radius, c.depth());
  for (const passes::ExpansionCandidate& candidate : r.choice.candidates) {
    if (candidate.refused.empty())
      fmt::print("       {:<9} predicted {:>9.2f} ms a frame, {:>9.2f} ms with its share of what is done once\n", passes::to_string(candidate.expansion),
                 candidate.frame_ms, candidate.total_ms);
    else
      fmt::print("       {:<9} {}\n", passes::to_string(candidate.expansion), candidate.refused);
  }
  fmt::print("     {} chunks in tiles, {} drawn by the rasterizer\n", r.tiled, r.rastered);
}

void print_text(const Explained& e, const rg::Plan& plan, const passes::DeviceCosts& costs, const std::string& device) {
  fmt::print("device: {}\ncosts:  {}\n", device, costs.source);
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const rg::PassTiming& timing = e.timings[i];
    fmt::print("{:>3}. {} ({})\n", i + 1, plan.passes[i].name, plan.passes[i].kind);
    if (!timing.skipped.empty()) {
      fmt::print("     left out of this frame: {}\n", timing.skipped);
      continue;
    }
    if (const auto* report = report_of(e, plan.passes[i].name)) print_choice(*report);
    const std::string on_device = timing.gpu_ms ? fmt::format("{:.2f} ms on the device, ", *timing.gpu_ms) : std::string();
    fmt::print("     measured: {}{:.2f} ms recording\n", on_device, timing.cpu_ms);
  }
  for (const rg::Culled& culled : plan.culled) fmt::print("not in the plan: {} ({}): {}\n", culled.name, culled.kind, culled.reason);
  fmt::print("first frame {:.1f} ms, then {:.2f} ms (median of {})\n", e.first, e.median, measured_frames);
}

void run(const ExplainArguments& a) {
  const passes::Expansion expansion = parse_expansion(a.scene.expansion);
  Diagnostics diagnostics;
  JobRequest request = job_request(a.scene);
  request.device = a.device.device;
  const Job job = load_job(request, diagnostics);
  std::optional<ReadyGraph> graph;
  if (!diagnostics.has_errors()) graph = ready_graph(job.graph, diagnostics);
  if (graph) warn_of_graph(job, *graph, diagnostics);
  print(job.left_out);
  print_and_stop_on_errors(diagnostics);
  const ColorConfig config = ColorConfig::load(a.device.display.config);
  DrawingDevice device(a.device.device);
  FrameRenderer renderer(device, std::move(*graph), config, a.device.display, expansion, a.frames);
  renderer.set_scene(job.scene);
  const Explained explained = draw(renderer, job);
  print(renderer.report());
  (a.json ? print_json : print_text)(explained, renderer.plan(), renderer.costs(), device.info().name);
}

} // namespace

void add_explain(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("explain", "say pass by pass what was chosen for a scene, why, and what it costs");
  auto a = std::make_shared<ExplainArguments>();
  add_scene_arguments(*command, a->scene);
  add_device_arguments(*command, a->device);
  command->add_option("--frames", a->frames, "as if so many were to be drawn: 1 is what render does, a window draws thousands")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  command->add_flag("--json", a->json, "as JSON");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
