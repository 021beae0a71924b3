// SPDX-License-Identifier: MIT
// mote chart: error against time of the methods of one topic, measured on this device now, as a picture or as numbers.
#include "app/charts/topic.hpp"
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#include "app/library/provenance.hpp"
#include "core/base/atomic_file.hpp"
#include "core/base/parallel.hpp"
#include "core/chart/write.hpp"
#include "core/image/png.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace mote::app {
namespace {

struct ChartArguments {
  std::vector<std::string> words{}, settings{};
  std::string topic{}, output{}, size{};
  DeviceOptions device{};
  bool list{}, quiet{};
};

std::string ending_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string ending = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

const Topic& find_topic(const std::string& name) {
  std::vector<std::string> names;
  for (const Topic& topic : topics()) {
    if (topic.name == name) return topic;
    names.emplace_back(topic.name);
  }
  fail(Exit::Usage, code::chart_topic, {"--topic"}, name.empty() ? "no topic is named" : fmt::format("there is no topic '{}'", name),
       {did_you_mean(name, names), fmt::format("Topics: {}", list_of(names)), "mote chart --list says what each shows"});
}

void check_output(const std::string& path) {
  const std::vector<std::string> endings{".svg", ".png", ".html", ".csv"};
  const std::string ending = ending_of(path);
  if (path.empty() || std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  fail(Exit::Usage, code::output_ending, {"-o"}, fmt::format("'{}' is no chart", path), {did_you_mean(ending, endings), fmt::format("Endings: {}", list_of(endings))});
}

// The processor's name and how many of its threads this process may use.
std::string machine_text() {
  std::ifstream file("/proc/cpuinfo");
  std::string line, name = "processor";
  while (std::getline(file, line))
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      name = line.substr(line.find(": ") + 2);
      break;
    }
  return fmt::format("{}, {} threads", name, worker_count());
}

std::string date_text() {
  std::time_t now = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch && *epoch) now = static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10));
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(now));
}

std::string command_text(const ChartArguments& a) {
  std::string out = "mote chart";
  for (const std::string& word : a.words) out += " " + quoted(word);
  out += " --topic " + a.topic;
  if (!a.size.empty()) out += " --size " + a.size;
  for (const std::string& setting : a.settings) out += " --set " + quoted(setting);
  return out;
}

void save(const chart::Chart& c, const std::string& path) {
  const std::string ending = ending_of(path);
  const Uninterrupted guard;
  if (ending == ".png") {
    const chart::Pixels pixels = chart::to_pixels(c);
    write_png(path, pixels.width, pixels.height, std::span<const std::uint8_t>(pixels.rgba));
  } else {
    write_file(path, std::string_view(ending == ".svg" ? chart::to_svg(c) : ending == ".html" ? chart::to_html(c) : chart::to_csv(c)));
  }
}

void list_topics() {
  for (const Topic& topic : topics())
    fmt::print("{:<14}{}{}\n", topic.name, topic.summary, topic.scene.empty() ? "" : fmt::format("  ({} at {})", topic.scene, topic.size));
}

void run(const ChartArguments& a) {
  if (a.list) return list_topics();
  const Topic& topic = find_topic(a.topic);
  check_output(a.output);
  if (topic.scene.empty() && (!a.words.empty() || !a.settings.empty() || !a.size.empty()))
    fail(Exit::Usage, code::command_line, {}, fmt::format("topic '{}' draws no scene", topic.name), {fmt::format("mote chart --topic {}", topic.name)});
  const ColorConfig config = ColorConfig::load("");
  DrawingDevice device(a.device);
  TopicContext context{.device = device, .config = config};
  context.request.words = a.words.empty() ? std::vector<std::string>{std::string(topic.scene)} : a.words;
  context.request.settings = a.settings;
  if (!topic.size.empty()) context.request.size = parse_size(a.size.empty() ? topic.size : a.size);
  context.say = [&](const std::string& line) {
    if (!a.quiet) fmt::print(stderr, "{}: {}\n", topic.name, line);
  };
  chart::Chart c = topic.measure(context);
  device.check();
  chart::mark_front(c);
  c.origin = {machine_text(), device.info().name, fmt::format("{} {}", device.info().driver, device.info().driver_info), date_text(), command_text(a)};
  if (a.output.empty()) fmt::print("{}", chart::to_text(c));
  else save(c, a.output);
}

} // namespace

void add_chart(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("chart", "measure methods on this device: error against time, as a picture or as numbers");
  auto a = std::make_shared<ChartArguments>();
  command->add_option("SCENE", a->words, "a scene file, particle files or a generated scene; the topic's own if not given");
  command->add_option("--topic", a->topic, "what to compare; --list names them")->type_name("NAME");
  command->add_option("-o,--output", a->output, "the chart: .svg, .png, .html, or .csv for its numbers; a table on standard output if not given")->type_name("FILE");
  command->add_option("--size", a->size, "size of the pictures in pixels")->type_name("WxH");
  command->add_option("--set", a->settings, "change a value of the scene")->allow_extra_args(false)->type_name("PATH=VALUE");
  command->add_option("--device", a->device.name, "part of a Vulkan device's name")->type_name("NAME");
  command->add_flag("--validation", a->device.validation, "run with the Vulkan validation layer; its messages are failures");
  command->add_flag("--quiet", a->quiet, "no progress on standard error");
  command->add_flag("--list", a->list, "list the topics");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
