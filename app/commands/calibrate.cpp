// SPDX-License-Identifier: MIT
// mote calibrate: measures in some seconds what each expansion costs on this device, and keeps it beside the caches, where
// everything that draws reads it at the start.
#include "app/commands/command.hpp"
#include "app/library/calibrate.hpp"
#include "app/library/device_costs.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

struct CalibrateArguments {
  DeviceOptions device{};
  bool json{};
};

void run(const CalibrateArguments& a) {
  if (cache_directory().empty()) save_costs({}, {}, {}); // says so before anything is measured
  const ColorConfig config = ColorConfig::load("");
  DrawingDevice device(a.device);
  const passes::DeviceCosts costs = measure_costs(device, config, [&](const std::string& line) {
    if (!a.json) fmt::print("{}\n", line);
    std::fflush(stdout);
  });
  {
    const Uninterrupted guard;
    save_costs(costs, device.info(), cache_directory());
  }
  if (a.json) {
    fmt::print("{}", costs_json(costs, device.info()));
    return;
  }
  fmt::print("\n{:<10}{:>12}{:>16}{:>16}{:>14}{:>14}\n", "expansion", "frame, ms", "particle, ns", "unit, ns", "pixel, ns", "once, ms");
  for (std::size_t i = 0; i < costs.costs.size(); ++i) {
    const passes::ExpansionCosts& c = costs.costs[i];
    fmt::print("{:<10}{:>12.3f}{:>16.2f}{:>16.2f}{:>14.2f}{:>14.1f}\n", passes::to_string(passes::costed_expansions[i]), c.fixed_ms, c.particle_ns, c.unit_ns,
               c.pixel_ns, c.pipeline_ms);
  }
  fmt::print("each AOV {:.2f} ns a pixel; unit: a fragment, with compute a particle in a tile\nkept in {}\n", costs.aov_ns,
             costs_path(device.info(), cache_directory()));
}

} // namespace

void add_calibrate(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("calibrate", "measure what drawing costs on this device, for --expansion auto");
  auto a = std::make_shared<CalibrateArguments>();
  command->add_option("--device", a->device.name, "part of a Vulkan device's name")->type_name("NAME");
  command->add_flag("--json", a->json, "the costs as JSON, as they are kept");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
