// SPDX-License-Identifier: MIT
// From names to edges: makes the passes of a GraphDesc, asks each for its slots, finds the source of
// every input, settles formats and sizes. Reports everything that does not fit (G010..G063).
//
// Every output of every enabled pass is a *version*; a read-write output is a version with a parent.
// compile() goes on with the result (order, lifetimes). Internal to the render graph.
#pragma once

#include "render_graph/graph_desc.hpp"
#include "render_graph/registry.hpp"

#include <memory>

namespace mote::rg {

constexpr int none = -1;

struct Version {
  int node{}, slot{};
  int parent{none};        // version that it draws over
  ResourceSpec spec{};
  SourceLoc loc{};         // where the file speaks of it, else its pass
  std::vector<std::pair<int, int>> readers{}; // (node, slot) of plain readers, in file order
  int overwriter{none};    // node that draws over it
  bool ok{true};           // false: never made, an error was reported or nothing is there to draw over
};

struct Node {
  const PassDesc* desc{};
  std::shared_ptr<Pass> pass{}; // null: unknown kind
  std::vector<Slot> slots{};
  std::vector<int> in{};  // per slot: version read, or none
  std::vector<int> out{}; // per slot: version written, or none
  [[nodiscard]] const std::string& name() const { return desc->name.text; }
};

struct Resolved {
  std::vector<Node> nodes{}; // in file order
  std::vector<Version> versions{};
  std::vector<std::pair<LocatedString, int>> roots{}; // what is wanted, its version; the output first
  [[nodiscard]] std::string name(int version) const {
    const Version& v = versions[static_cast<std::size_t>(version)];
    const Node& node = nodes[static_cast<std::size_t>(v.node)];
    return node.name() + "." + node.slots[static_cast<std::size_t>(v.slot)].name;
  }
};

// `graph` must outlive the result.
Resolved resolve(const GraphDesc& graph, const Registry& registry, const std::vector<LocatedString>& extra_roots, Diagnostics& diagnostics);

// Formats and sizes of all versions, and whether they suit their users (G018, G041..G048). The last step
// of resolve(), in its own file.
void settle_specs(Resolved& resolved, Diagnostics& diagnostics);

} // namespace mote::rg
