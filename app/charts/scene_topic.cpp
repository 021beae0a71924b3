// SPDX-License-Identifier: MIT
#include "app/charts/scene_topic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mote::app {
namespace {

void stop_on_errors(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.list())
    if (d.severity == Severity::Error) throw Failure(exit_of(diagnostics), d);
}

} // namespace

SceneTopic::SceneTopic(TopicContext& context) : context_(context) {
  Diagnostics diagnostics;
  job = load_job(context.request, diagnostics);
  stop_on_errors(diagnostics);
}

FrameRenderer& SceneTopic::renderer(const Method& method, bool linear, bool aovs) {
  GraphRequest request;
  request.graph = method.graph;
  request.settings = method.settings;
  request.linear = linear;
  if (aovs) request.aovs = {Aov::Depth, Aov::Id, Aov::Normal};
  Diagnostics diagnostics;
  std::optional<ReadyGraph> graph = ready_graph(request, diagnostics);
  stop_on_errors(diagnostics);
  renderer_.reset(); // its memory first
  renderer_ = std::make_unique<FrameRenderer>(context_.device, std::move(*graph), context_.config, DisplayOptions{}, method.expansion);
  renderer_->set_scene(job.scene);
  return *renderer_;
}

DrawnPicture SceneTopic::picture(const Method& method, bool aovs) {
  FrameRenderer& r = renderer(method, true, aovs);
  r.wait(r.draw(view()));
  return r.read();
}

double SceneTopic::milliseconds(const Method& method) {
  FrameRenderer& r = renderer(method, false, false);
  double least = INFINITY;
  for (int k = 0; k < 7; ++k) {
    const auto start = std::chrono::steady_clock::now();
    r.wait(r.draw(view()));
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    if (k >= 2) least = std::min(least, ms);
  }
  return least;
}

std::uint64_t SceneTopic::fragments(const Method& method) {
  FrameRenderer& r = renderer(method, false, false);
  r.count_work();
  r.wait(r.draw(view()));
  for (const rg::PassTiming& pass : r.timings())
    if (pass.name == "opaque" && pass.counts) return pass.counts->fragment_invocations;
  return 0;
}

std::string SceneTopic::text() const {
  std::string words;
  for (const std::string& word : context_.request.words) words += (words.empty() ? "" : " ") + word;
  return fmt::format("{}, {}x{}", words, job.size.width, job.size.height);
}

compare::CompareInput input_of(const DrawnPicture& picture, bool aovs) {
  compare::CompareInput out;
  out.name = "the picture";
  out.width = picture.size.width;
  out.height = picture.size.height;
  out.encoding = compare::Encoding::Linear;
  for (std::size_t i = 0; i + 3 < picture.linear.size(); i += 4)
    out.color.emplace_back(picture.linear[i], picture.linear[i + 1], picture.linear[i + 2], picture.linear[i + 3]);
  if (!aovs) return out;
  out.id = picture.id;
  out.depth.assign(picture.depth.begin(), picture.depth.end());
  for (std::size_t i = 0; i + 2 < picture.normal.size(); i += 3) out.normal.emplace_back(picture.normal[i], picture.normal[i + 1], picture.normal[i + 2]);
  return out;
}

compare::CompareInput input_of(const ReferencePicture& picture) {
  compare::CompareInput out;
  out.name = "the reference";
  out.width = picture.size.width;
  out.height = picture.size.height;
  out.encoding = compare::Encoding::Linear;
  out.depth = picture.depth;
  out.id = picture.id;
  out.ambiguous = picture.layers_ambiguous.empty() ? picture.ambiguous : picture.layers_ambiguous;
  for (const glm::dvec3& n : picture.normal) out.normal.emplace_back(n);
  for (const glm::dvec4& c : picture.color) out.color.emplace_back(c);
  return out;
}

} // namespace mote::app
