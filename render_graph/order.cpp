// SPDX-License-Identifier: MIT
#include "render_graph/order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace mote::rg {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Edge `from` runs before `to`. via: the version that joins them.
struct Edge {
  int from{}, to{}, version{};
  bool overwrite{}; // `from` reads what `to` draws over
};

std::vector<Edge> find_edges(const Resolved& r) {
  std::vector<Edge> edges;
  for (std::size_t n = 0; n < r.nodes.size(); ++n) {
    if (!r.nodes[n].desc->enabled) continue;
    for (int v : r.nodes[n].in)
      if (v >= 0) edges.push_back({r.versions[at(v)].node, static_cast<int>(n), v, false});
  }
  for (std::size_t v = 0; v < r.versions.size(); ++v)
    for (const auto& [reader, slot] : r.versions[v].readers)
      if (r.versions[v].overwriter != none && r.versions[v].overwriter != reader)
        edges.push_back({reader, r.versions[v].overwriter, static_cast<int>(v), true});
  return edges;
}

void mark_live(const Resolved& r, int node, std::vector<bool>& live) {
  std::vector<int> stack{node};
  while (!stack.empty()) {
    const int n = stack.back();
    stack.pop_back();
    if (live[at(n)]) continue;
    live[at(n)] = true;
    for (int v : r.nodes[at(n)].in)
      if (v >= 0) stack.push_back(r.versions[at(v)].node);
  }
}

// Smallest ready node first: topological, and the file's order where that leaves a choice.
std::vector<int> sort_nodes(std::size_t count, const std::vector<Edge>& edges, const std::vector<bool>& wanted) {
  std::vector<int> waiting(count, 0), out;
  std::vector<std::vector<int>> next(count);
  for (const Edge& e : edges)
    if (wanted[at(e.from)] && wanted[at(e.to)]) {
      ++waiting[at(e.to)];
      next[at(e.from)].push_back(e.to);
    }
  std::set<int> ready;
  for (std::size_t n = 0; n < count; ++n)
    if (wanted[n] && waiting[n] == 0) ready.insert(static_cast<int>(n));
  while (!ready.empty()) {
    const int n = *ready.begin();
    ready.erase(ready.begin());
    out.push_back(n);
    for (int to : next[at(n)])
      if (--waiting[at(to)] == 0) ready.insert(to);
  }
  return out;
}

// Follows edges among `stuck` nodes backwards until one comes twice: the ring, in running order.
std::vector<Edge> find_ring(const std::vector<Edge>& edges, const std::vector<bool>& stuck) {
  const auto into = [&](int n) {
    return std::find_if(edges.begin(), edges.end(), [&](const Edge& e) { return e.to == n && stuck[at(e.from)]; });
  };
  int n = static_cast<int>(std::find(stuck.begin(), stuck.end(), true) - stuck.begin());
  std::vector<Edge> path;
  std::vector<int> seen;
  while (std::find(seen.begin(), seen.end(), n) == seen.end()) {
    seen.push_back(n);
    path.push_back(*into(n));
    n = path.back().from;
  }
  path.erase(path.begin(), path.begin() + (std::find(seen.begin(), seen.end(), n) - seen.begin()));
  std::reverse(path.begin(), path.end());
  return path;
}

void report_cycle(const Resolved& r, const std::vector<Edge>& ring, Diagnostics& diagnostics) {
  std::string path;
  std::vector<std::string> hints;
  const Edge* last = nullptr; // the file's last input on the ring is taken for the one that closes it
  for (const Edge& e : ring) {
    path += r.nodes[at(e.from)].name() + " -> ";
    if (e.overwrite)
      hints.push_back(fmt::format("'{}' reads '{}', which '{}' draws over: it must run before.", r.nodes[at(e.from)].name(), r.name(e.version), r.nodes[at(e.to)].name()));
    else {
      hints.push_back(fmt::format("'{}' takes '{}'.", r.nodes[at(e.to)].name(), r.name(e.version)));
      last = &e;
    }
  }
  path += r.nodes[at(ring.front().from)].name();
  SourceLoc loc = r.nodes[at(ring.front().to)].desc->loc;
  if (last)
    for (std::size_t s = 0; s < r.nodes[at(last->to)].in.size(); ++s)
      for (const InputDesc& input : r.nodes[at(last->to)].desc->inputs)
        if (r.nodes[at(last->to)].in[s] == last->version && input.slot.text == r.nodes[at(last->to)].slots[s].name) loc = input.source.loc;
  diagnostics.error("G050", loc, fmt::format("the passes form a cycle: {}.", path), std::move(hints));
}

std::string cull_reason(const Resolved& r, std::size_t n) {
  if (!r.nodes[n].desc->enabled) return "enabled = false";
  std::vector<std::string> readers;
  for (int v : r.nodes[n].out) {
    if (v < 0) continue;
    const Version& version = r.versions[at(v)];
    auto add = [&](int reader) {
      const std::string quoted = fmt::format("'{}'", r.nodes[at(reader)].name());
      if (std::find(readers.begin(), readers.end(), quoted) == readers.end()) readers.push_back(quoted);
    };
    for (const auto& [reader, slot] : version.readers) add(reader);
    if (version.overwriter != none) add(version.overwriter);
  }
  return readers.empty() ? "nothing reads its outputs" : fmt::format("only {} read{} its outputs, and nothing needs {}", list_of(readers), readers.size() == 1 ? "s" : "", readers.size() == 1 ? "that" : "those");
}

} // namespace

Order find_order(const Resolved& r, Diagnostics& diagnostics) {
  Order order;
  const std::size_t count = r.nodes.size();
  const std::vector<Edge> edges = find_edges(r);
  std::vector<bool> stuck(count);
  for (std::size_t n = 0; n < count; ++n) stuck[n] = r.nodes[n].desc->enabled;
  for (int n : sort_nodes(count, edges, stuck)) stuck[at(n)] = false;
  if (std::find(stuck.begin(), stuck.end(), true) != stuck.end()) { // all passes, needed or not
    report_cycle(r, find_ring(edges, stuck), diagnostics);
    return order;
  }
  order.live.assign(count, false);
  for (const auto& [root, version] : r.roots) mark_live(r, r.versions[at(version)].node, order.live);
  order.nodes = sort_nodes(count, edges, order.live);
  for (std::size_t n = 0; n < count; ++n)
    if (!order.live[n]) order.culled.push_back({r.nodes[n].name(), r.nodes[n].desc->kind.text, cull_reason(r, n)});
  return order;
}

} // namespace mote::rg
