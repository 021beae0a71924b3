// SPDX-License-Identifier: MIT
// mote view: the window. It is not built yet; the command checks its words and says what works instead.
#include "app/codes.hpp"
#include "app/commands/command.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace mote::app {
namespace {

bool has_display() {
  auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && value[0];
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

void run(const SceneArguments& a) {
  Diagnostics diagnostics;
  const Job job = load_job(job_request(a), diagnostics);
  print_and_stop_on_errors(diagnostics);
  std::string words;
  for (const std::string& word : a.words) words += " " + word;
  fail(Exit::Failed, code::no_window, {},
       has_display() ? "this version has no window" : "this version has no window, and there is no display (DISPLAY and WAYLAND_DISPLAY are not set)",
       {fmt::format("A picture without a window: mote render{} -o picture.png", words)});
}

} // namespace

void add_view(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("view", "show in a window (comes with a later version)");
  auto a = std::make_shared<SceneArguments>();
  add_scene_arguments(*command, *a);
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
