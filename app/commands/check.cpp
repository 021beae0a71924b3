// SPDX-License-Identifier: MIT
// mote check: reads a scene with everything it names (data, graph) and says what is wrong, without a device.
#include "app/commands/command.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

Exit run(const SceneArguments& a) {
  Diagnostics diagnostics;
  const Job job = load_job(job_request(a), diagnostics);
  std::optional<ReadyGraph> graph;
  if (!diagnostics.has_errors()) graph = ready_graph(job.graph, diagnostics);
  if (graph) warn_of_graph(job, *graph, diagnostics);
  print(diagnostics);
  if (diagnostics.has_errors()) return exit_of(diagnostics);
  fmt::print("{}: no errors, {} particles, graph '{}'\n", job.desc.name, job.scene.particle_count(), job.graph.graph);
  return Exit::Done;
}

} // namespace

void add_check(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("check", "read a scene and all it names, and report what is wrong");
  auto a = std::make_shared<SceneArguments>();
  add_scene_arguments(*command, *a);
  command->callback([a, &exit] { exit = run(*a); });
}

} // namespace mote::app
