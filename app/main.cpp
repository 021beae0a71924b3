// SPDX-License-Identifier: MIT
// The command line: words to a command, problems to messages and exit statuses. What a command does is
// in commands/; what it does it with is in library/.
#include "app/codes.hpp"
#include "app/commands/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace mote::app {
namespace {

const std::vector<std::string> later_commands{"convert", "probe"};

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

// `mote FILE...` is `mote view FILE...`.
std::vector<std::string> with_command(std::vector<std::string> words, const CLI::App& app) {
  if (words.empty() || words[0].starts_with('-')) return words;
  const std::vector<std::string> names = command_names(app);
  if (std::find(names.begin(), names.end(), words[0]) != names.end()) return words;
  if (std::find(later_commands.begin(), later_commands.end(), words[0]) != later_commands.end())
    fail(Exit::Usage, code::not_there_yet, {}, fmt::format("this version has no command '{}'", words[0]), {fmt::format("Commands: {}", list_of(names))});
  const bool like_a_file = words[0].find_first_of("./:*") != std::string::npos || std::filesystem::exists(words[0]);
  if (!like_a_file)
    fail(Exit::Usage, code::command_line, {}, fmt::format("'{}' is neither a command nor a file", words[0]),
         {did_you_mean(words[0], names), fmt::format("Commands: {}", list_of(names))});
  words.insert(words.begin(), "view");
  return words;
}

const CLI::App& chosen(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

// CLI11's message, and for an unknown option the one that was perhaps meant.
[[noreturn]] void usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const CLI::App& command = chosen(app);
  std::vector<std::string> options, hints;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  std::string text = error.what();
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name.size() < 3 || std::find(options.begin(), options.end(), name) != options.end()) continue;
    text = fmt::format("there is no option '{}'", name);
    hints = {did_you_mean(name, options)};
    break;
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  hints.push_back(fmt::format("mote {}--help lists the options", &command == &app ? "" : command.get_name() + " "));
  fail(Exit::Usage, code::command_line, {}, text, hints);
}

Exit run(int argc, char** argv) {
  CLI::App app{"mote draws particles, fast and provably right.", "mote"};
  Exit exit = Exit::Done;
  add_render(app, exit);
  add_view(app, exit);
  add_info(app, exit);
  add_bench(app, exit);
  add_compare(app, exit);
  add_chart(app, exit);
  add_explain(app, exit);
  add_trace_pixel(app, exit);
  add_calibrate(app, exit);
  add_graph(app, exit);
  add_check(app, exit);
  add_lists(app, exit);
  app.set_version_flag("--version", long_version_text());
  app.require_subcommand(0, 1);
  app.footer("mote FILE... is mote view FILE... . Exit status: 0 done, 1 failed, 2 wrong usage, 3 bad input,\n"
             "4 no suitable Vulkan device, 130 interrupted, 143 terminated.");

  std::vector<std::string> words(argv + 1, argv + argc);
  words = with_command(std::move(words), app);
  if (words.empty()) {
    fmt::print(stderr, "{}", app.help());
    return Exit::Usage;
  }
  std::vector<std::string> reversed(words.rbegin(), words.rend()); // CLI11 takes them from the end
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) { // --help, --version
      app.exit(error);
      return Exit::Done;
    }
    usage_error(app, error, words);
  }
  return exit;
}

} // namespace
} // namespace mote::app

int main(int argc, char** argv) {
  using namespace mote;
  using namespace mote::app;
  install_signal_handlers();
  Exit exit = Exit::Failed;
  try {
    exit = run(argc, argv);
  } catch (const Stop& stop) {
    exit = stop.exit;
  } catch (const Failure& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    exit = failure.exit();
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "mote: error {}: there is not enough memory\n", mote::app::code::device_failed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "mote: error {}: {}\n", mote::app::code::device_failed, error.what());
  }
  // Everything written to standard output is there, or the caller learns that it is not.
  if (std::fflush(stdout) != 0 && exit == Exit::Done) {
    fmt::print(stderr, "mote: error I002: standard output cannot be written completely\n");
    exit = Exit::Failed;
  }
  return static_cast<int>(exit);
}
