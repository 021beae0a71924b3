// SPDX-License-Identifier: MIT
#include "app/window/view.hpp"

#include "app/codes.hpp"
#include "app/library/provenance.hpp"
#include "app/library/user_types.hpp"
#include "app/window/host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <iterator>

namespace mote::window {
namespace {

std::vector<Step> read_script(const std::string& path, Diagnostics& diagnostics) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    diagnostics.error(app::code::script, {path}, "the script cannot be read");
    return {};
  }
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return parse_script(text, path, diagnostics);
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_report(const HostReport& report) {
  const auto line = [](const char* name, const std::vector<double>& ms) {
    fmt::print("{} median {:.1f} p95 {:.1f} largest {:.1f} ms of {}\n", name, percentile(ms, 0.5), percentile(ms, 0.95), percentile(ms, 1.0), ms.size());
  };
  fmt::print("frames {}\n", report.frames);
  line("input", report.input_ms);
  line("picture", report.picture_ms);
  line("compose", report.compose_ms);
  line("panels", report.panels_ms);
  line("present", report.present_ms);
}

} // namespace

void run_view(const ViewRequest& request, const std::function<void(const Diagnostics&)>& told) {
  Diagnostics diagnostics;
  HostOptions options;
  options.size = request.job.size;
  options.instead = "mote render";
  for (const std::string& word : request.job.words) options.instead += " " + app::quoted(word);
  options.instead += " -o picture.png";
  if (!request.script.empty()) options.script = read_script(request.script, diagnostics);
  app::Job job = app::load_job(request.job, diagnostics);
  diagnostics.append(app::as_warnings(job.left_out));
  told(diagnostics);
  std::future<ColorConfig> loading = std::async(std::launch::async, [&request] { return ColorConfig::load(request.display.config); });
  Host host(options);
  app::DeviceOptions with = request.device;
  with.surface_extensions = host.surface_extensions();
  app::DrawingDevice device(with);
  host.open(device, job.desc.name);
  const auto config = std::make_shared<const ColorConfig>(loading.get());
  HostReport report;
  {
    Session session(device, config, request.job, std::move(job), {.display = request.display, .expansion = request.expansion, .version = request.version});
    report = host.run(session);
  }
  if (request.report) print_report(report);
}

} // namespace mote::window
