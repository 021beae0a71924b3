// SPDX-License-Identifier: MIT
#include "app/library/calibrate.hpp"

#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"
#include "core/scene/generated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <span>

namespace mote::app {
namespace {

using passes::Expansion;

struct Shot {
  const char* scene;
  Size2d size;
  bool compute_only; // too slow otherwise
};
// Few and many particles, small and large ones, few and many pixels: what tells the terms of the model apart.
constexpr std::array<Shot, 6> shots{{{"spheres:1e3:fit", {1280, 720}, false},
                                     {"spheres:1e3:fill", {640, 360}, false},
                                     {"spheres:1e5:fit", {640, 360}, false},
                                     {"spheres:1e5:fill", {1280, 720}, false},
                                     {"spheres:1e4:fill", {640, 360}, false},
                                     {"spheres:1e6:fit", {1280, 720}, true}}};
constexpr int warm_up = 1, frames = 3;

Job job_of(const Shot& shot, bool aovs) {
  JobRequest request;
  request.words = {shot.scene};
  request.size = shot.size;
  if (aovs) request.aovs = {Aov::Depth, Aov::Id, Aov::Normal};
  Diagnostics diagnostics;
  return load_job(request, diagnostics);
}

struct Times {
  double first{}, least{}; // ms; the least, because other work on the machine only adds
};
Times measure(DrawingDevice& device, const ColorConfig& config, const Job& job, Expansion expansion) {
  using Clock = std::chrono::steady_clock;
  Diagnostics diagnostics;
  std::optional<ReadyGraph> graph = ready_graph(job.graph, diagnostics);
  FrameRenderer renderer(device, std::move(*graph), config, {}, expansion);
  renderer.set_scene(job.scene);
  std::vector<double> times;
  for (int k = 0; k < warm_up + frames; ++k) {
    const View view = job.view_of(turned(job.scene.camera, degrees_per_frame * k));
    const Clock::time_point start = Clock::now();
    renderer.wait(renderer.draw(view));
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  return {times[0], *std::min_element(times.begin() + warm_up, times.end())};
}

// The geometry stage makes the same rectangles: a few scenes tell how much more it costs.
constexpr std::size_t geometry_shots = 3;
double ratio_of(std::span<const passes::CostSample> some, std::span<const passes::CostSample> all) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < some.size(); ++i) ratios.push_back(some[i].ms / all[i].ms);
  return median(std::move(ratios));
}
passes::ExpansionCosts scaled(const passes::ExpansionCosts& c, double factor) {
  return {c.fixed_ms * factor, c.particle_ns * factor, c.unit_ns * factor, c.pixel_ns * factor, 0.0};
}

bool draws(const gpu::Device& device, Expansion expansion) {
  if (expansion == Expansion::Geometry) return gpu::has(device.features(), gpu::Feature::GeometryShader);
  return expansion != Expansion::Compute || passes::device_lacks_tiles(device).empty();
}

} // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

passes::DeviceCosts measure_costs(DrawingDevice& device, const ColorConfig& config, const std::function<void(const std::string&)>& say) {
  passes::DeviceCosts costs = passes::shipped_costs(device.info().type);
  costs.source = "measured by mote calibrate";
  std::array<std::vector<passes::CostSample>, passes::costed_expansions.size()> samples;
  for (const Shot& shot : shots) {
    const Job job = job_of(shot, false);
    const passes::ViewContents contents = passes::survey(job.scene, job.view(), {});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Expansion expansion = passes::costed_expansions[i];
      if (!draws(device.device(), expansion) || (shot.compute_only && expansion != Expansion::Compute)) continue;
      if (expansion == Expansion::Geometry && samples[i].size() == geometry_shots) continue;
      if (samples[i].empty()) (void)measure(device, config, job, expansion); // caches are warm from here on
      const Times times = measure(device, config, job, expansion);
      if (samples[i].empty()) costs.costs[i].pipeline_ms = std::max(0.0, times.first - times.least);
      samples[i].push_back({contents, times.least});
      say(fmt::format("{:<18} {:>4}x{:<4} {:<9} {:>8.1f} ms", shot.scene, shot.size.width, shot.size.height, passes::to_string(expansion), times.least));
    }
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].empty()) continue;
    const double pipeline_ms = costs.costs[i].pipeline_ms;
    if (passes::costed_expansions[i] == Expansion::Geometry) costs.costs[i] = scaled(costs.costs[0], ratio_of(samples[i], samples[0]));
    else costs.costs[i] = passes::fit_costs(passes::costed_expansions[i], samples[i]);
    costs.costs[i].pipeline_ms = pipeline_ms;
  }
  const Times with = measure(device, config, job_of(shots[0], true), Expansion::Vertex);
  const double pixels = double(shots[0].size.width) * shots[0].size.height;
  costs.aov_ns = std::max(0.0, (with.least - samples[0][0].ms) * 1e6 / (3.0 * pixels));
  return costs;
}

} // namespace mote::app
