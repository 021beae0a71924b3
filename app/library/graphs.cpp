// SPDX-License-Identifier: MIT
#include "app/library/graphs.hpp"

#include "app/codes.hpp"
#include "app/library/shipped_graphs.hpp"
#include "passes/builtin.hpp"
#include "render_graph/include.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::app {
namespace {

const std::vector<std::string> scene_keys{"schema", "graph", "color_space", "background", "tolerance", "style",
                                          "camera", "ambient", "light",     "data",  "frame",      "legend",    "particle_types"};

bool is_path(std::string_view graph) { return graph.find('/') != std::string_view::npos || graph.ends_with(".toml"); }

// The last pass of the file that can make this output.
std::string source_of_slot(const rg::GraphDesc& graph, const std::string& slot) {
  static const std::vector<rg::KindInfo> kinds = rg::describe(registry());
  std::string found;
  for (const rg::PassDesc& pass : graph.passes)
    for (const rg::KindInfo& kind : kinds)
      if (pass.enabled && kind.name == pass.kind.text)
        for (const rg::Slot& s : kind.slots)
          if (s.name == slot && rg::writes(s.access)) found = pass.name.text + "." + slot;
  return found;
}

rg::PassDesc* pass_of_output(rg::GraphDesc& graph) {
  const std::optional<rg::Source> source = rg::split_source(graph.output.text);
  if (!source) return nullptr;
  for (rg::PassDesc& pass : graph.passes)
    if (pass.name.text == source->pass) return &pass;
  return nullptr;
}

// What the display transform at the end of the graph reads, or the output itself when there is none.
std::string linear_source(rg::GraphDesc& graph) {
  if (const rg::PassDesc* last = pass_of_output(graph); last && last->kind.text == "ocio_tonemap")
    for (const rg::InputDesc& input : last->inputs)
      if (input.slot.text == "color") return input.source.text;
  return graph.output.text;
}

void deepen_output(rg::GraphDesc& graph) {
  const std::optional<rg::Source> source = rg::split_source(graph.output.text);
  rg::PassDesc* pass = pass_of_output(graph);
  if (!pass || !source) return;
  const rg::LocatedString format{"rgba32float", {"--bits"}};
  for (rg::OutputDesc& output : pass->outputs)
    if (output.slot.text == source->slot) {
      output.format = format;
      return;
    }
  rg::OutputDesc output;
  output.slot = {source->slot, {"--bits"}};
  output.format = format;
  pass->outputs.push_back(std::move(output));
}

// So that legends go through the same transform.
void read_display(rg::GraphDesc& graph, PassDisplay& ready) {
  const rg::PassDesc* pass = pass_of_output(graph);
  if (!pass || pass->kind.text != "ocio_tonemap") return;
  for (const rg::Entry& entry : pass->params) {
    const auto* text = std::get_if<std::string>(&entry.value.data);
    if (text && entry.key == "display") ready.display = *text;
    if (text && entry.key == "view") ready.view = *text;
    if (entry.key != "exposure") continue;
    if (const auto* real = std::get_if<double>(&entry.value.data)) ready.exposure = *real;
    if (const auto* whole = std::get_if<std::int64_t>(&entry.value.data)) ready.exposure = static_cast<double>(*whole);
  }
}

void check_settings(const GraphRequest& request, const rg::GraphDesc& graph, Diagnostics& diagnostics) {
  const std::vector<std::string> passes = pass_names(graph);
  if (passes.empty()) return; // the graph is broken, and that is reported
  for (const std::string& setting : request.settings) {
    const std::string word(first_word(setting));
    if (rg::sets_variable(setting)) continue; // the graph has been read with it
    if (std::find(passes.begin(), passes.end(), word) != passes.end()) continue;
    std::vector<std::string> all = scene_keys;
    all.insert(all.end(), passes.begin(), passes.end());
    diagnostics.error(code::set_target, {"--set"},
                      fmt::format("'{}': '{}' is neither a key of the scene nor a pass of the graph", setting, word),
                      {did_you_mean(word, all), fmt::format("Keys of a scene: {}", list_of(scene_keys)),
                       fmt::format("Passes of this graph: {}", list_of(passes))});
  }
}

void set_opaque_passes(rg::GraphDesc& graph, const GraphRequest& request, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < graph.passes.size(); ++i) {
    const rg::PassDesc& pass = graph.passes[i];
    if (pass.kind.text != "opaque_impostors") continue;
    const bool says = rg::find(pass.params, "samples") || rg::find(pass.params, "edges") || rg::find(pass.params, "blend") || rg::find(pass.params, "steps");
    if (says && request.opaque_settings_yield) continue;
    for (const std::string& setting : request.opaque_settings) rg::apply_setting(graph, graph.passes[i].name.text + "." + setting, diagnostics);
  }
}

} // namespace

const rg::Registry& registry() {
  static const rg::Registry kinds = [] {
    rg::Registry made;
    passes::register_builtin_passes(made);
    return made;
  }();
  return kinds;
}

std::vector<std::string> shipped_graphs() {
  std::vector<std::string> names;
  for (const ShippedGraph& graph : shipped_graph_texts()) names.emplace_back(graph.name);
  return names;
}

std::vector<std::string> pass_names(const rg::GraphDesc& graph) {
  std::vector<std::string> names;
  for (const rg::PassDesc& pass : graph.passes) names.push_back(pass.name.text);
  return names;
}

namespace {

// Nothing for a shipped name that does not exist. `files`: gets the paths that were looked at.
std::optional<rg::GraphDesc> find_graph(const GraphRequest& request, Diagnostics& diagnostics, std::vector<std::string>& files) {
  rg::ParseOptions options;
  options.settings = request.settings;
  options.read = [&files](const std::string& name, const std::string& from) -> std::optional<rg::GraphText> {
    if (is_path(name)) {
      const std::filesystem::path path(name);
      files.push_back((path.is_absolute() ? path : std::filesystem::path(from).parent_path() / path).string());
      return rg::read_beside(name, from);
    }
    for (const ShippedGraph& graph : shipped_graph_texts())
      if (graph.name == name) return rg::GraphText{"mote:" + name + ".toml", std::string(graph.text)};
    return std::nullopt;
  };
  if (is_path(request.graph)) {
    const std::filesystem::path path(request.graph);
    const std::string whole = (path.is_absolute() ? path : request.folder / path).string();
    files.push_back(whole);
    return rg::load_graph(whole, diagnostics, options);
  }
  for (const ShippedGraph& graph : shipped_graph_texts())
    if (graph.name == request.graph) return rg::parse_graph(graph.text, std::string(graph.name) + ".toml", diagnostics, options);
  return std::nullopt;
}

} // namespace

std::vector<std::string> graph_files(const GraphRequest& request) {
  std::vector<std::string> files;
  Diagnostics ignored; // whoever compiles the graph reports
  const std::optional<rg::GraphDesc> graph = find_graph(request, ignored, files);
  for (const rg::PassDesc& pass : graph ? graph->passes : std::vector<rg::PassDesc>()) {
    const rg::Entry* shader = rg::find(pass.params, "shader");
    const auto* word = shader ? std::get_if<std::string>(&shader->value.data) : nullptr;
    if (!word || word->find_first_of("/.") == std::string::npos) continue; // a shipped pass
    const std::filesystem::path path(*word), glsl = path.is_absolute() ? path : std::filesystem::path(shader->value.loc.file).parent_path() / path;
    files.push_back(glsl.string());
    files.push_back((glsl.parent_path() / "pass.toml").string());
  }
  return files;
}

rg::GraphDesc load_graph(const GraphRequest& request, Diagnostics& diagnostics) {
  std::vector<std::string> files;
  if (std::optional<rg::GraphDesc> graph = find_graph(request, diagnostics, files)) return std::move(*graph);
  const std::vector<std::string> names = shipped_graphs();
  const bool by_option = request.loc.file.empty() || request.loc.file.starts_with("--");
  fail(by_option ? Exit::Usage : Exit::BadInput, code::shipped_graph, request.loc, fmt::format("there is no shipped graph '{}'", request.graph),
       {did_you_mean(request.graph, names), fmt::format("Shipped graphs: {}; a file is named with its ending .toml", list_of(names))});
}

std::optional<ReadyGraph> ready_graph(const GraphRequest& request, Diagnostics& diagnostics) {
  Diagnostics found;
  rg::GraphDesc graph = load_graph(request, found);
  check_settings(request, graph, found);
  if (!found.has_errors())
    for (const std::string& setting : request.settings) rg::apply_setting(graph, setting, found);
  set_opaque_passes(graph, request, found);
  if (request.deep) deepen_output(graph);

  ReadyGraph ready;
  for (const rg::PassDesc& pass : graph.passes)
    if (pass.kind.text == "opaque_impostors" && rg::find(pass.params, "blend")) ready.blending.insert(pass.name.text);
  ready.output = graph.output.text;
  read_display(graph, ready.shown);
  rg::CompileOptions options;
  options.roots = request.dumps;
  if (request.linear) {
    ready.linear = linear_source(graph);
    options.roots.push_back({ready.linear, {"--output"}});
  }
  for (Aov aov : {Aov::Depth, Aov::Id, Aov::Normal}) {
    const bool asked = std::find(request.aovs.begin(), request.aovs.end(), aov) != request.aovs.end();
    if (!asked && !request.every_aov && !(aov == Aov::Depth && request.depth_if_made)) continue;
    const std::string name(aov_names[static_cast<std::size_t>(aov)]);
    const std::string source = source_of_slot(graph, "aov_" + name);
    if (!source.empty()) {
      options.roots.push_back({source, {"--aov"}});
      ready.aovs[aov] = source;
    } else if (asked) {
      found.error(code::aov_not_made, {"--aov"}, fmt::format("no pass of the graph '{}' makes the AOV '{}'", graph.name.text, name));
    }
  }
  rg::CompileResult result = rg::compile(graph, registry(), options, found);
  for (const Diagnostic& d : result.diagnostics.list())
    if (d.severity != Severity::Note) diagnostics.add(d);
  if (!result.plan || diagnostics.has_errors()) return std::nullopt;
  ready.plan = std::move(*result.plan);
  ready.passes = std::move(result.passes);
  return ready;
}

bool has_front_surfaces_only(const GraphRequest& request) {
  Diagnostics ignored;
  try {
    rg::GraphDesc graph = load_graph(request, ignored);
    for (const std::string& setting : request.settings) rg::apply_setting(graph, setting, ignored);
    for (const rg::PassDesc& pass : graph.passes)
      if (const rg::Entry* surfaces = pass.kind.text == "sorted_glyphs" ? rg::find(pass.params, "surfaces") : nullptr)
        if (const auto* word = std::get_if<std::string>(&surfaces->value.data)) return *word == "front";
  } catch (const Failure&) {
    // the reference needs no graph
  }
  return false;
}

std::string_view first_word(std::string_view setting) { return setting.substr(0, setting.find_first_of(".[=")); }

Settings split_settings(std::span<const std::string> settings) {
  Settings out;
  for (const std::string& setting : settings) {
    const bool scene = std::find(scene_keys.begin(), scene_keys.end(), first_word(setting)) != scene_keys.end();
    (scene ? out.scene : out.graph).push_back(setting);
  }
  return out;
}

} // namespace mote::app
