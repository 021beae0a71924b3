// SPDX-License-Identifier: MIT
// GraphDesc + Registry -> Plan, or all the reasons why not. No device.
//
//   Diagnostics problems;
//   GraphDesc desc = load_graph("scene.toml", problems);
//   CompileResult result = compile(desc, registry, {.roots = {{"opaque.depth", {"--dump"}}}}, problems);
//   if (!result.plan) print(result.diagnostics); else print(to_text(*result.plan));
//
// Extra roots (AOVs, dumps) keep passes and optional outputs alive; they never change the graph: a
// source that is drawn over later is copied first.
#pragma once

#include "render_graph/graph_desc.hpp"
#include "render_graph/plan.hpp"
#include "render_graph/registry.hpp"

#include <memory>
#include <optional>

namespace mote::rg {

struct CompileOptions {
  std::vector<LocatedString> roots{}; // further sources that are wanted; loc names who asks ("--dump")
  bool strict{};                      // culled passes are errors (G063), not notes
};

struct CompileResult {
  std::optional<Plan> plan{};                 // nothing if diagnostics has an error
  std::vector<std::shared_ptr<Pass>> passes{}; // as in plan->passes, declared, not prepared
  Diagnostics diagnostics{};                  // sorted by place; notes (culled passes) also when all is well
};

// `found` are the diagnostics of parsing, which come out together with the compiler's.
CompileResult compile(const GraphDesc& graph, const Registry& registry, const CompileOptions& options = {}, const Diagnostics& found = {});

// Parse, set ("pass.param=value" each) and compile in one go.
CompileResult compile_file(const std::string& path, const Registry& registry, const CompileOptions& options = {}, const std::vector<std::string>& settings = {});

// What `mote graph FILE --check` prints: the diagnostics, then one line that sums up.
std::string check_text(const CompileResult& result);

} // namespace mote::rg
