// SPDX-License-Identifier: MIT
// mote view: the window (app/window). In a build without it, the command checks its words and says what works instead.
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#ifdef MOTE_WINDOW
#include "app/window/view.hpp"
#endif

#include <fmt/format.h>

namespace mote::app {
namespace {

struct ViewArguments {
  SceneArguments scene{};
  DeviceArguments device{};
  std::optional<std::int64_t> frame{};
  std::string script{};
  bool report{};
};

void run(const ViewArguments& a) {
  JobRequest request = job_request(a.scene);
  request.device = a.device.device;
  request.frame = a.frame;
  const passes::Expansion expansion = parse_expansion(a.scene.expansion);
#ifdef MOTE_WINDOW
  window::run_view({request, a.device.device, a.device.display, expansion, a.script, version_text(), a.report}, print_and_stop_on_errors);
#else
  (void)expansion;
  Diagnostics diagnostics;
  (void)load_job(request, diagnostics);
  print_and_stop_on_errors(diagnostics);
  std::string words;
  for (const std::string& word : a.scene.words) words += " " + word;
  fail(Exit::Failed, code::no_window, {}, "this build of mote has no window", {fmt::format("A picture without a window: mote render{} -o picture.png", words)});
#endif
}

} // namespace

void add_view(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("view", "show in a window; the key H lists what keys and mouse do there");
  auto a = std::make_shared<ViewArguments>();
  add_scene_arguments(*command, a->scene);
  add_device_arguments(*command, a->device);
  command->add_option("--frame", a->frame, "frame of a series, from 0; -1 is the last")->type_name("N");
  command->add_option("--script", a->script, "keys, mouse and screenshots from a file instead of a hand")->type_name("FILE");
  command->add_flag("--report", a->report, "how long inputs waited for their pictures, at the end");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
