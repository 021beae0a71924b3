// SPDX-License-Identifier: MIT
// mote bench: how long frames take. A frame is recorded, submitted and waited for, with the display pass
// and without reading it back; the camera turns half a degree about the vertical each frame (--turn), or cuts to
// another side (--cut). The first frame (which makes pipelines) and two more are not in the statistics. Before that it
// notes what preparing the scene took, and how much memory the process held then and at the end.
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#include "app/library/calibrate.hpp"
#include "core/scene/generated.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>

namespace mote::app {
namespace {

constexpr int warm_up = 3;

struct BenchArguments {
  SceneArguments scene{};
  DeviceArguments device{};
  int frames{20};
  double turn{degrees_per_frame};
  bool json{}, stages{}, cut{}, stats{};
};

struct PassTimes {
  std::string name{};
  std::vector<double> gpu{}, cpu{};
  std::vector<std::pair<std::string, std::vector<double>>> stages{}; // by name, in order of first appearance
  std::optional<rg::PassCounts> counts{};                             // of the last frame
};

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// Bytes that the process holds in memory; by the kernel's account, where there is /proc.
struct Held {
  std::optional<std::uint64_t> now{}, most{};
};

Held held() {
  Held out;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "VmRSS:" && status >> kilobytes) out.now = kilobytes * 1024;
    if (word == "VmHWM:" && status >> kilobytes) out.most = kilobytes * 1024;
  }
  return out;
}

struct Prepared { // ms
  SceneSource::Preparing particles{};
  double upload{};
  Held memory{};
};

struct Measured {
  Prepared prepared{};
  Held memory{}; // at the end
  double first{};
  std::vector<double> frames{}; // ms
  std::vector<PassTimes> passes{};
};

// A cut looks from the other side: nothing that was seen in the frame before is.
constexpr double degrees_of_a_cut = 90.0;

Measured measure(FrameRenderer& renderer, const Job& job, const BenchArguments& a) {
  Measured out;
  for (int k = 0; k < warm_up + a.frames; ++k) {
    const View view = job.view_of(turned(job.scene.camera, (a.turn + (a.cut ? degrees_of_a_cut : 0.0)) * k));
    const Clock::time_point start = Clock::now();
    renderer.wait(renderer.draw(view));
    const double ms = ms_since(start);
    if (k == 0) out.first = ms;
    if (k < warm_up) continue;
    out.frames.push_back(ms);
    const std::vector<rg::PassTiming>& timings = renderer.timings();
    out.passes.resize(timings.size());
    for (std::size_t i = 0; i < timings.size(); ++i) {
      out.passes[i].name = timings[i].name;
      out.passes[i].cpu.push_back(timings[i].cpu_ms);
      out.passes[i].counts = timings[i].counts;
      if (timings[i].gpu_ms) out.passes[i].gpu.push_back(*timings[i].gpu_ms);
      for (const rg::StageTiming& stage : timings[i].stages) {
        auto& stages = out.passes[i].stages;
        auto it = std::find_if(stages.begin(), stages.end(), [&](const auto& s) { return s.first == stage.name; });
        if (it == stages.end()) it = stages.insert(it, {stage.name, {}});
        it->second.push_back(stage.gpu_ms);
      }
    }
  }
  out.memory = held();
  return out;
}

double rounded(double ms) { return std::round(ms * 1000.0) / 1000.0; }

void print_json(const Measured& m, const std::string& device, std::string_view expansion, std::uint64_t primitives) {
  nlohmann::ordered_json json;
  json["median_ms"] = rounded(median(m.frames));
  json["min_ms"] = rounded(*std::min_element(m.frames.begin(), m.frames.end()));
  json["max_ms"] = rounded(*std::max_element(m.frames.begin(), m.frames.end()));
  json["first_ms"] = rounded(m.first);
  json["device"] = device;
  json["expansion"] = expansion;
  json["primitives"] = primitives;
  json["prepare"] = {{"values_ms", rounded(m.prepared.particles.values)}, {"chunks_ms", rounded(m.prepared.particles.chunks)}, {"upload_ms", rounded(m.prepared.upload)}};
  const auto bytes = [](const std::optional<std::uint64_t>& n) { return n ? nlohmann::ordered_json(*n) : nlohmann::ordered_json(nullptr); };
  json["memory"] = {{"prepared_bytes", bytes(m.prepared.memory.now)}, {"resident_bytes", bytes(m.memory.now)}, {"peak_bytes", bytes(m.memory.most)}};
  json["passes"] = nlohmann::ordered_json::array();
  for (const PassTimes& pass : m.passes) {
    nlohmann::ordered_json row;
    row["name"] = pass.name;
    row["gpu_ms"] = pass.gpu.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(rounded(median(pass.gpu)));
    row["cpu_ms"] = rounded(median(pass.cpu));
    for (const auto& [name, times] : pass.stages) row["stages"][name] = rounded(median(times));
    if (pass.counts)
      for (const auto& [name, value] : named_counts(*pass.counts)) row["counts"][std::string(name)] = value;
    json["passes"].push_back(std::move(row));
  }
  fmt::print("{}\n", json.dump(2));
}

void print_text(const Measured& m, const std::string& device, std::string_view expansion, std::uint64_t primitives) {
  fmt::print("{} particles on {}, expansion {}\n", primitives, device, expansion);
  fmt::print("median {:.2f} ms, from {:.2f} to {:.2f} ms over {} frames; first frame {:.1f} ms\n", median(m.frames),
             *std::min_element(m.frames.begin(), m.frames.end()), *std::max_element(m.frames.begin(), m.frames.end()),
             m.frames.size(), m.first);
  fmt::print("prepared in {:.1f} ms: values {:.1f}, sort and boxes {:.1f}, upload {:.1f}\n", m.prepared.particles.values + m.prepared.particles.chunks + m.prepared.upload,
             m.prepared.particles.values, m.prepared.particles.chunks, m.prepared.upload);
  if (m.memory.now && m.memory.most)
    fmt::print("in memory {:.1f} MB, at most {:.1f} MB\n", static_cast<double>(*m.memory.now) / 1e6, static_cast<double>(*m.memory.most) / 1e6);
  for (const PassTimes& pass : m.passes) {
    fmt::print("  {:<16} device {:>8.2f} ms   recording {:>7.2f} ms\n", pass.name, median(pass.gpu), median(pass.cpu));
    for (const auto& [name, times] : pass.stages) fmt::print("    {:<14} device {:>8.2f} ms\n", name, median(times));
    if (pass.counts) fmt::print("{}", counts_text(*pass.counts, "    "));
  }
}

Exit run(const BenchArguments& a) {
  JobRequest request = job_request(a.scene);
  request.device = a.device.device;
  const passes::Expansion expansion = parse_expansion(a.scene.expansion);
  Diagnostics diagnostics;
  const Job job = load_job(request, diagnostics);
  std::optional<ReadyGraph> graph;
  if (!diagnostics.has_errors()) graph = ready_graph(job.graph, diagnostics);
  if (graph) warn_of_graph(job, *graph, diagnostics);
  print(job.left_out);
  print_and_stop_on_errors(diagnostics);
  const ColorConfig config = ColorConfig::load(a.device.display.config);
  DrawingDevice device(a.device.device);
  FrameRenderer renderer(device, std::move(*graph), config, a.device.display, expansion, warm_up + a.frames);
  renderer.set_stage_times(a.stages);
  if (a.stats) renderer.count_work();
  const Clock::time_point start = Clock::now();
  renderer.set_scene(job.scene);
  const Prepared prepared{job.source->preparing, ms_since(start), held()};
  Measured measured = measure(renderer, job, a);
  measured.prepared = prepared;
  print(renderer.report());
  const std::string_view used = passes::to_string(renderer.expansion());
  (a.json ? print_json : print_text)(measured, device.info().name, used, job.scene.particle_count());
  return exit_of(job.left_out);
}

} // namespace

void add_bench(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("bench", "measure how long frames take");
  auto a = std::make_shared<BenchArguments>();
  add_scene_arguments(*command, a->scene);
  add_device_arguments(*command, a->device);
  command->add_option("--frames", a->frames, "frames in the statistics; three more warm up")->check(CLI::Range(1, 100000))->type_name("N");
  command->add_option("--turn", a->turn, "degrees that the camera turns about the vertical a frame; 0.5 if not given")->type_name("DEGREES");
  command->add_flag("--cut", a->cut, "every frame is a camera cut: a quarter turn more");
  command->add_flag("--stages", a->stages, "the parts of passes, too");
  command->add_flag("--stats", a->stats, "vertices, primitives, fragments and the components they get, of each pass in the last frame");
  command->add_flag("--json", a->json, "as JSON");
  command->callback([a, &exit] { exit = run(*a); });
}

} // namespace mote::app
