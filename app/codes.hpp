// SPDX-License-Identifier: MIT
// Every code that the library and the command line report by themselves, one line each for
// docs/errors.md; what they pass on (scene, data, graph, color, device) has codes of its own. A code keeps
// its meaning for ever; new ones go to the end.
#pragma once

#include <array>
#include <string_view>

namespace mote::app {

namespace code {
inline constexpr std::string_view command_line = "A001";
inline constexpr std::string_view size = "A002";
inline constexpr std::string_view output_ending = "A003";
inline constexpr std::string_view aov_request = "A004";
inline constexpr std::string_view aov_not_made = "A005";
inline constexpr std::string_view shipped_graph = "A006";
inline constexpr std::string_view device_failed = "A007";
inline constexpr std::string_view too_many_ids = "A008";
inline constexpr std::string_view not_there_yet = "A009";
inline constexpr std::string_view no_window = "A010";
inline constexpr std::string_view set_target = "A011";
inline constexpr std::string_view output_texture = "A012";
inline constexpr std::string_view compare_input = "A013";
inline constexpr std::string_view validation = "A014";
inline constexpr std::string_view twice_to_stdout = "A015";
inline constexpr std::string_view panel = "A016";
inline constexpr std::string_view no_frames = "A017";
inline constexpr std::string_view numbered_output = "A018";
inline constexpr std::string_view shard = "A019";
inline constexpr std::string_view alpha_ignored = "A020";
inline constexpr std::string_view shadows_ignored = "A021";
inline constexpr std::string_view tolerance_ignored = "A022";
inline constexpr std::string_view movie = "A023";
inline constexpr std::string_view no_counts = "A024";
inline constexpr std::string_view over_memory = "A025";
inline constexpr std::string_view chart_topic = "A030";
inline constexpr std::string_view bad_costs = "A040";
inline constexpr std::string_view no_cache = "A041";
inline constexpr std::string_view cannot_present = "A050";
inline constexpr std::string_view script = "A051";
inline constexpr std::string_view trace_beyond = "A060";
} // namespace code

struct AppCode {
  std::string_view code{}, line{};
};
inline constexpr std::array<AppCode, 31> app_codes{{
    {code::command_line, "usage: an unknown option, a missing argument, words that do not fit together"},
    {code::size, "usage: --size is not WIDTHxHEIGHT, each from 1 to 32768"},
    {code::output_ending, "usage: an output file of an ending that cannot be written"},
    {code::aov_request, "usage: --aov or --dump is not NAME=FILE with a known name"},
    {code::aov_not_made, "usage: no pass of the graph makes the AOV"},
    {code::shipped_graph, "usage: there is no shipped graph of that name"},
    {code::device_failed, "failed: the device reported an error while drawing"},
    {code::too_many_ids, "usage: more particles than the id AOV can count"},
    {code::not_there_yet, "usage: a command that this version does not have"},
    {code::no_window, "failed: there is no window"},
    {code::set_target, "usage: --set names neither a key of the scene nor a pass of the graph"},
    {code::output_texture, "failed: the graph's output or a dump is of a format that the file cannot hold"},
    {code::compare_input, "input: a file that compare cannot take as a picture"},
    {code::validation, "failed: the validation layer had something to say"},
    {code::twice_to_stdout, "usage: two outputs to standard output"},
    {code::panel, "usage: --panel is no number of pixels from 16, or a dump of a picture that is drawn in panels"},
    {code::no_frames, "usage: a list of frames that leaves none"},
    {code::numbered_output, "usage: many pictures need %d or %04d in the output's name, one picture must not have it"},
    {code::shard, "usage: --shard is not K/N with K from 0 to N"},
    {code::alpha_ignored, "warning: the graph has no pass for transparent particles"},
    {code::shadows_ignored, "warning: a light asks for shadows, but the graph has no shadow_map pass for it"},
    {code::tolerance_ignored, "warning: the tolerance is not used"},
    {code::movie, "failed: a movie cannot be made (ffmpeg is missing or failed)"},
    {code::no_counts, "warning: the device does not count what pipelines do"},
    {code::over_memory, "failed: --memory cannot hold the scene"},
    {code::chart_topic, "usage: there is no topic of that name for a chart"},
    {code::bad_costs, "warning: the measured costs of the device cannot be read; shipped ones serve"},
    {code::no_cache, "failed: there is no folder for caches, where calibrate keeps what it measured"},
    {code::cannot_present, "failed: the display cannot show the pictures of a Vulkan device"},
    {code::script, "input: a line of a window's script that cannot be understood"},
    {code::trace_beyond, "failed: a pass draws in a way that trace-pixel does not follow"},
}};

} // namespace mote::app
