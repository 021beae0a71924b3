// SPDX-License-Identifier: MIT
#include "app/library/job.hpp"

#include "app/codes.hpp"
#include "app/library/job_text.hpp"
#include "app/library/user_types.hpp"
#include "core/data/series.hpp"
#include "passes/particles/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::app {
namespace {

// Names of the lights that the graph's shadow_map passes are for; empty: the first one that casts shadows.
std::vector<std::string> mapped_lights(const GraphRequest& request) {
  Diagnostics ignored; // whoever compiles the graph reports
  rg::GraphDesc graph = load_graph(request, ignored);
  for (const std::string& setting : request.settings) rg::apply_setting(graph, setting, ignored);
  std::vector<std::string> names;
  for (const rg::PassDesc& pass : graph.passes) {
    if (pass.kind.text != "shadow_map" || !pass.enabled) continue;
    const rg::Entry* light = rg::find(pass.params, "light");
    const auto* name = light ? std::get_if<std::string>(&light->value.data) : nullptr;
    names.push_back(name ? *name : "");
  }
  return names;
}

void warn_of_shadows(const SceneDesc& desc, const GraphRequest& graph, Diagnostics& diagnostics) {
  if (std::none_of(desc.lights.begin(), desc.lights.end(), [](const Light& l) { return l.shadows; })) return;
  const std::vector<std::string> mapped = mapped_lights(graph);
  bool first = true;
  for (const Light& light : desc.lights) {
    if (!light.shadows) continue;
    const bool drawn = std::any_of(mapped.begin(), mapped.end(), [&](const std::string& name) { return name == light.name || (name.empty() && first); });
    first = false;
    if (!drawn)
      diagnostics.warning(code::shadows_ignored, {desc.name},
                          fmt::format("the light '{}' asks for shadows, but no shadow_map pass of the graph is for it", light.name),
                          {"The shipped graph 'shadowed' draws those of one light."});
  }
}

// What the scene asks for and no pass draws yet. The list shrinks with every pass kind that is added.
void warn_of_limits(const SceneDesc& desc, Diagnostics& diagnostics) {
  if (desc.tolerance)
    diagnostics.warning(code::tolerance_ignored, desc.tolerance->loc,
                        "the tolerance is not used: this version has one method, which is exact at the pixel centers");
}

// By the description as well, because the scene of a batch of pictures is not there yet.
bool is_transparent(const Job& job) {
  const auto asks = [](const DataDesc& data) { return data.alpha < 1.0 || data.opacity.rule != AlphaRule::Constant; };
  return std::any_of(job.desc.data.begin(), job.desc.data.end(), asks) ||
         std::any_of(job.scene.batches.begin(), job.scene.batches.end(), passes::may_be_transparent);
}

void check_ids(const JobRequest& request, const Scene& scene, Diagnostics& diagnostics) {
  const bool wanted = request.every_aov || std::find(request.aovs.begin(), request.aovs.end(), Aov::Id) != request.aovs.end();
  if (wanted && scene.particle_count() > 0xFFFFFFFEu)
    diagnostics.error(code::too_many_ids, {"--aov"},
                      fmt::format("the scene has {} particles; the id AOV counts 4294967294", scene.particle_count()));
}

void realize_frame(Job& job, Diagnostics& diagnostics) {
  job.scene = realize(job.desc, job.size, *job.source, job.frame, diagnostics);
  if (job.transparent) job.scene.background.a = 0.0;
}

// One frame or many, by index; needs the number of frames as soon as one is named.
void choose_frames(Job& job, const JobRequest& request, Diagnostics& diagnostics) {
  if (!job.desc.frame && !request.frames) return;
  const std::uint64_t count = job.source->frame_count(diagnostics);
  if (count == 0) return;
  try {
    if (!request.frames) job.frame = data::frame_index(job.desc.frame->value, count, job.desc.frame->loc);
    else job.frames = data::frame_list(*request.frames, count, {"--frames"});
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
    return;
  }
  if (request.frames && job.frames.empty())
    diagnostics.error(code::no_frames, {"--frames"}, fmt::format("'{}' names none of {} frames", *request.frames, count));
}

} // namespace

namespace {

// Which graph a scene is drawn with, before its contents are known.
void choose_graph(const JobRequest& request, const SceneDesc& desc, GraphRequest& graph) {
  graph.settings = split_settings(request.settings).graph;
  if (request.graph) {
    graph.graph = *request.graph;
    graph.loc = {"--graph"};
  } else if (desc.graph) {
    graph.graph = desc.graph->value;
    graph.loc = desc.graph->loc;
    if (desc.graph->loc.file != "--set") graph.folder = desc.folder;
  }
}

} // namespace

std::vector<std::string> scene_settings(const JobRequest& request) {
  std::vector<std::string> out = split_settings(request.settings).scene;
  for (const std::string& folder : request.types) out.push_back("particle_types+=" + folder);
  return out;
}

SceneDesc describe_job(const JobRequest& request, Diagnostics& diagnostics, GraphRequest& graph) {
  SceneDesc desc = describe(request.words, scene_settings(request), diagnostics);
  choose_graph(request, desc, graph);
  return desc;
}

Job load_job(const JobRequest& request, Diagnostics& diagnostics) {
  return load_described(describe(request.words, scene_settings(request), diagnostics), request, diagnostics);
}

Job load_described(SceneDesc desc, const JobRequest& request, Diagnostics& diagnostics) {
  Job job;
  job.desc = std::move(desc);
  choose_graph(request, job.desc, job.graph);
  job.size = request.size;
  job.graph.aovs = request.aovs;
  job.graph.every_aov = request.every_aov;
  job.graph.dumps = request.dumps;
  job.graph.linear = request.linear;
  job.graph.deep = request.deep;
  job.transparent = request.transparent;
  if (request.frame) job.desc.frame = Located<std::int64_t>{*request.frame, {"--frame"}};
  for (const DataDesc& data : job.desc.data) job.graph.depth_if_made |= data.cell.drawn; // its edges hide behind particles
  if (diagnostics.has_errors()) return job;
  take_types(job.desc, request.device, job.left_out);
  job.source = std::make_shared<SceneSource>(job.desc);
  warn_of_limits(job.desc, diagnostics);
  choose_frames(job, request, diagnostics);
  if (job.frames.empty() && !diagnostics.has_errors()) realize_frame(job, diagnostics);
  if (!request.graph && !job.desc.graph && is_transparent(job)) job.graph.graph = "transparent";
  warn_of_shadows(job.desc, job.graph, diagnostics);
  check_ids(request, job.scene, diagnostics);
  return job;
}

void warn_of_graph(const Job& job, const ReadyGraph& graph, Diagnostics& diagnostics) {
  const auto draws_them = [&](const rg::PlannedPass& pass) { return pass.kind == "sorted_glyphs" || graph.blending.contains(pass.name); };
  if (std::any_of(graph.plan.passes.begin(), graph.plan.passes.end(), draws_them) || !is_transparent(job)) return;
  diagnostics.warning(code::alpha_ignored, job.graph.loc, fmt::format("the graph '{}' has no pass for transparent particles: they are left out", job.graph.graph),
                      {"a pass of kind sorted_glyphs draws them; the shipped graph 'transparent' has one"});
}

void load_frame(Job& job, std::uint64_t index, Diagnostics& diagnostics) {
  job.frame = index;
  realize_frame(job, diagnostics);
}

Exit exit_of(const Diagnostics& diagnostics) {
  if (!diagnostics.has_errors()) return Exit::Done;
  for (const Diagnostic& d : diagnostics.list())
    if (d.severity == Severity::Error && !d.loc.file.starts_with("--")) return Exit::BadInput;
  return Exit::Usage;
}

} // namespace mote::app
