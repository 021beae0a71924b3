// SPDX-License-Identifier: MIT
#include "render_graph/compile.hpp"

#include "render_graph/lifetimes.hpp"
#include "render_graph/order.hpp"
#include "render_graph/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::rg {
namespace {

// A pass without use is a note, or an error if one asks for strictness.
void note_culled(const GraphDesc& graph, const Order& order, bool strict, Diagnostics& diagnostics) {
  for (const Culled& culled : order.culled) {
    const auto pass = std::find_if(graph.passes.begin(), graph.passes.end(), [&](const PassDesc& p) { return p.name.text == culled.name; });
    if (!pass->enabled) continue; // the file says so itself
    const std::string text = fmt::format("pass '{}' is culled: {}.", culled.name, culled.reason);
    if (strict) diagnostics.error("G063", pass->name.loc, text);
    else diagnostics.note("G063", pass->name.loc, text);
  }
}

} // namespace

CompileResult compile(const GraphDesc& graph, const Registry& registry, const CompileOptions& options, const Diagnostics& found) {
  CompileResult result;
  Diagnostics& diagnostics = result.diagnostics;
  diagnostics.append(found);
  const Resolved resolved = resolve(graph, registry, options.roots, diagnostics);
  const Order order = find_order(resolved, diagnostics);
  if (!diagnostics.has_errors()) note_culled(graph, order, options.strict, diagnostics);
  diagnostics.sort_by_place();
  if (diagnostics.has_errors()) return result;
  Plan& plan = result.plan.emplace();
  plan.name = graph.name.text;
  plan.culled = order.culled;
  plan_resources(resolved, order, plan);
  for (int n : order.nodes) result.passes.push_back(resolved.nodes[static_cast<std::size_t>(n)].pass);
  return result;
}

CompileResult compile_file(const std::string& path, const Registry& registry, const CompileOptions& options, const std::vector<std::string>& settings) {
  Diagnostics found;
  GraphDesc graph = load_graph(path, found, {.settings = settings});
  if (graph.passes.empty() && found.has_errors()) return {std::nullopt, {}, found}; // nothing to go on with
  for (const std::string& setting : settings) apply_setting(graph, setting, found);
  return compile(graph, registry, options, found);
}

std::string check_text(const CompileResult& result) {
  std::string out = to_string(result.diagnostics);
  const auto errors = std::count_if(result.diagnostics.list().begin(), result.diagnostics.list().end(), [](const Diagnostic& d) { return d.severity == Severity::Error; });
  if (!result.plan) return out + fmt::format("{} error{}; nothing was run.\n", errors, errors == 1 ? "" : "s");
  return out + fmt::format("graph '{}' is correct: {} passes run, {} culled, {} textures, {} buffers; output {}.\n", result.plan->name, result.plan->passes.size(), result.plan->culled.size(),
                           result.plan->textures.size(), result.plan->buffers.size(), result.plan->roots.front().source);
}

} // namespace mote::rg
