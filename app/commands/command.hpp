// SPDX-License-Identifier: MIT
// What the commands share: options that several of them take, words to values, messages, interruption.
// Each command is one file with one add_NAME(); main.cpp lists them.
#pragma once

#include "app/library/device.hpp"
#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mote::app {

// What to draw and how: words and options of render, bench, view, check.
struct SceneArguments {
  std::vector<std::string> words{}, settings{}, types{};
  std::string graph{}, size{"1280x720"}, expansion{"auto"}, style{};
};
struct DeviceArguments {
  DeviceOptions device{};
  DisplayOptions display{};
};
void add_scene_arguments(CLI::App& command, SceneArguments& arguments);
// --type, into absolute folders.
void add_type_option(CLI::App& command, std::vector<std::string>& types);
void add_device_arguments(CLI::App& command, DeviceArguments& arguments);

JobRequest job_request(const SceneArguments& arguments);       // throws Failure A002
Size2d parse_size(std::string_view text);                      // "1280x720"; throws Failure A002
passes::Expansion parse_expansion(const std::string& word);    // throws Failure A001
std::pair<std::string, std::string> split_request(const std::string& option, const std::string& request); // NAME=FILE; A004

// What a pass made the device do (--stats): names and numbers, and the same in three lines of text.
std::vector<std::pair<std::string_view, std::uint64_t>> named_counts(const rg::PassCounts& counts);
std::string counts_text(const rg::PassCounts& counts, std::string_view indent);

// To stderr, all of them.
void print(const Diagnostics& diagnostics);
// Prints; throws Stop when there are errors.
void print_and_stop_on_errors(const Diagnostics& diagnostics);
struct Stop {
  Exit exit{};
};

// While one of these lives, SIGINT and SIGTERM wait: around the writing of files, so that no half of one stays.
class Uninterrupted {
public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};
void install_signal_handlers(); // exits with 130 or 143

std::string version_text();      // "mote 0.1.0"
std::string long_version_text(); // and the libraries

// Every add_ makes a subcommand whose callback sets `exit`.
void add_render(CLI::App& app, Exit& exit);
void add_view(CLI::App& app, Exit& exit);
void add_info(CLI::App& app, Exit& exit);
void add_bench(CLI::App& app, Exit& exit);
void add_compare(CLI::App& app, Exit& exit);
void add_chart(CLI::App& app, Exit& exit);
void add_trace_pixel(CLI::App& app, Exit& exit);
void add_explain(CLI::App& app, Exit& exit);
void add_calibrate(CLI::App& app, Exit& exit);
void add_graph(CLI::App& app, Exit& exit);
void add_check(CLI::App& app, Exit& exit);
void add_lists(CLI::App& app, Exit& exit); // formats, colormaps, views

} // namespace mote::app
