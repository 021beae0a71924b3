// SPDX-License-Identifier: MIT
#include "render_graph/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::rg {
namespace {

constexpr int broken = -2; // its cause is reported already

std::size_t at(int i) { return static_cast<std::size_t>(i); }
bool takes_source(const Slot& slot) { return reads(slot.access) && !slot.state; }
template <class Test> std::vector<std::string> slot_names(const std::vector<Slot>& slots, Test test) {
  std::vector<std::string> out;
  for (const Slot& slot : slots)
    if (test(slot)) out.push_back(slot.name);
  return out;
}
template <class Test> int find_slot(const std::vector<Slot>& slots, std::string_view name, Test test) {
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (slots[i].name == name && test(slots[i])) return static_cast<int>(i);
  return none;
}
bool is_output(const Slot& slot) { return writes(slot.access); }

class Resolver {
public:
  Resolver(const GraphDesc& graph, const Registry& registry, Diagnostics& diagnostics)
      : graph_(graph), registry_(registry), diagnostics_(diagnostics) {}

  Resolved run(const std::vector<LocatedString>& extra_roots) {
    for (const PassDesc& pass : graph_.passes) add_node(pass);
    for (std::size_t n = 0; n < out_.nodes.size(); ++n) check_tables(out_.nodes[n]);
    for (std::size_t n = 0; n < out_.nodes.size(); ++n) connect(static_cast<int>(n));
    add_root(graph_.output, "G060", "'output'");
    for (const LocatedString& root : extra_roots) add_root(root, "G062", "a request");
    note_readers();
    return std::move(out_);
  }

private:
  struct Found { int node{none}, slot{none}; };

  void add_node(const PassDesc& desc) {
    Node node{.desc = &desc};
    const std::string& name = desc.name.text;
    for (const Node& other : out_.nodes)
      if (other.name() == name && !name.empty()) {
        diagnostics_.error("G010", desc.name.loc, fmt::format("the pass name '{}' is taken.", name), {fmt::format("first used at {}.", to_string(other.desc->name.loc))});
        return; // one pass of a name; the second is not looked at further
      }
    const PassKind* kind = registry_.find(desc.kind.text);
    if (!kind && desc.kind.loc.line != 0) {
      const auto kinds = registry_.names();
      diagnostics_.error("G011", desc.kind.loc, fmt::format("pass '{}' is of the unknown kind '{}'.", name, desc.kind.text),
                         {"kinds: " + list_of(kinds) + ".", did_you_mean(desc.kind.text, kinds)});
    }
    if (kind && !name.empty()) { // what has no name is complained of by the parser
      node.pass = kind->make();
      Params params(desc.params, desc.draw, name, kind->name, desc.loc, diagnostics_);
      node.pass->declare(node.slots, params);
      params.finish();
      check_slots(kind->name, node.slots);
    }
    node.in.assign(node.slots.size(), none);
    node.out.assign(node.slots.size(), none);
    out_.nodes.push_back(std::move(node));
    visited_.emplace_back(out_.nodes.back().slots.size(), Visit::No);
  }

  // Keys of `inputs` and `outputs` that are no slots.
  void check_tables(const Node& node) {
    if (!node.pass) return;
    const auto complain = [&](std::string_view code, const LocatedString& slot, std::string_view what, std::vector<std::string> names) {
      diagnostics_.error(code, slot.loc, fmt::format("pass '{}' gives the {} '{}', which kind '{}' does not have.", node.name(), what, slot.text, node.desc->kind.text),
                         {fmt::format("{}s: {}.", what, list_of(names)), did_you_mean(slot.text, names)});
    };
    for (const InputDesc& input : node.desc->inputs)
      if (find_slot(node.slots, input.slot.text, takes_source) == none) complain("G014", input.slot, "input", slot_names(node.slots, takes_source));
    for (const OutputDesc& output : node.desc->outputs)
      if (find_slot(node.slots, output.slot.text, is_output) == none) complain("G017", output.slot, "output", slot_names(node.slots, is_output));
  }

  // The pass and slot that a source names. Reports G012, G013, G016, or G060/G062 for roots.
  Found look_up(const LocatedString& source, const std::string& who, std::string_view root_code) {
    const auto parts = split_source(source.text);
    const auto code = [&](std::string_view normal) { return root_code.empty() ? normal : root_code; };
    if (!parts) {
      diagnostics_.error(code("G016"), source.loc, fmt::format("{} names '{}', which is not \"pass.slot\".", who, source.text));
      return {};
    }
    const auto it = std::find_if(out_.nodes.begin(), out_.nodes.end(), [&](const Node& n) { return n.name() == parts->pass; });
    if (it == out_.nodes.end()) {
      std::vector<std::string> names;
      for (const Node& n : out_.nodes) names.push_back(n.name());
      diagnostics_.error(code("G013"), source.loc, fmt::format("{} names '{}', but there is no pass '{}'.", who, source.text, parts->pass),
                         {"passes: " + list_of(names) + ".", did_you_mean(parts->pass, names)});
      return {};
    }
    if (!it->pass) return {};
    const int slot = find_slot(it->slots, parts->slot, is_output);
    if (slot == none) {
      const auto names = slot_names(it->slots, is_output);
      std::vector<std::string> sources;
      for (const std::string& name : names) sources.push_back(parts->pass + "." + name);
      diagnostics_.error(code("G012"), source.loc, fmt::format("{} names '{}', but pass '{}' has no output '{}'.", who, source.text, parts->pass, parts->slot),
                         {fmt::format("outputs of '{}' (kind '{}'): {}.", parts->pass, it->desc->kind.text, list_of(names)), did_you_mean(source.text, sources)});
      return {};
    }
    return {static_cast<int>(it - out_.nodes.begin()), slot};
  }

  // The version of an output: made on first asking. `none`: the pass is disabled, or draws over
  // something that is not there, and nothing passes through. `broken`: an error was reported.
  int version_of(Found f) {
    Node& node = out_.nodes[at(f.node)];
    const Slot& slot = node.slots[at(f.slot)];
    Visit& visit = visited_[at(f.node)][at(f.slot)];
    if (!node.desc->enabled) {
      if (visit == Visit::Now) return none; // a ring of disabled passes
      visit = Visit::Now;
      const int through = reads(slot.access) && !slot.state ? source_version(f.node, f.slot) : none;
      visit = Visit::Done;
      return through;
    }
    if (node.out[at(f.slot)] != none || visit == Visit::Done) return node.out[at(f.slot)];
    const int id = static_cast<int>(out_.versions.size());
    out_.versions.push_back({.node = f.node, .slot = f.slot, .loc = node.desc->loc});
    node.out[at(f.slot)] = id; // before the source is looked for: a cycle ends here and is reported by order
    visit = Visit::Done;
    const int parent = takes_source(slot) ? source_version(f.node, f.slot) : none;
    if (parent >= 0) out_.versions[at(id)].parent = parent;
    else if (parent == broken || !slot.makes) {
      out_.versions[at(id)].ok = false;
      return node.out[at(f.slot)] = parent == broken || !slot.optional ? broken : none;
    }
    if (slot.makes) out_.versions[at(id)].spec = *slot.makes;
    return id;
  }

  // The version that an input slot reads; reports G012..G016 once.
  int source_version(int n, int s) {
    int& known = out_.nodes[at(n)].in[at(s)];
    if (known != none) return known;
    const Node& node = out_.nodes[at(n)];
    const Slot& slot = node.slots[at(s)];
    const InputDesc* input = nullptr;
    for (const InputDesc& candidate : node.desc->inputs)
      if (candidate.slot.text == slot.name) input = &candidate;
    const bool needed = node.desc->enabled && !slot.optional && !slot.makes;
    if (!input) {
      if (!needed) return none;
      diagnostics_.error("G015", node.desc->loc, fmt::format("pass '{}' lacks its input '{}' ({}).", node.name(), slot.name, slot.summary),
                         {fmt::format("add inputs = {{ {} = \"pass.slot\" }}.", slot.name)});
      return known = broken;
    }
    const Found found = look_up(input->source, fmt::format("pass '{}' input '{}'", node.name(), slot.name), {});
    if (found.node == none) return known = broken;
    const int version = version_of(found);
    if (version == none && needed) {
      diagnostics_.error("G053", input->source.loc,
                         fmt::format("pass '{}' needs '{}', but pass '{}' is not enabled and has no source to pass through.", node.name(), input->source.text, out_.nodes[at(found.node)].name()),
                         {fmt::format("'enabled' is at {}.", to_string(out_.nodes[at(found.node)].desc->enabled_loc))});
      return out_.nodes[at(n)].in[at(s)] = broken;
    }
    return out_.nodes[at(n)].in[at(s)] = version;
  }

  void connect(int n) {
    const std::size_t count = out_.nodes[at(n)].slots.size();
    for (std::size_t s = 0; s < count; ++s) {
      const Slot& slot = out_.nodes[at(n)].slots[s];
      if (takes_source(slot)) (void)source_version(n, static_cast<int>(s));
      if (is_output(slot) && out_.nodes[at(n)].desc->enabled) (void)version_of({n, static_cast<int>(s)});
    }
  }

  void add_root(const LocatedString& root, std::string_view code, const std::string& who) {
    if (root.text.empty() && root.loc.line == 0) return; // missing: reported by the parser
    const Found found = look_up(root, who, code);
    if (found.node == none) return;
    const int version = version_of(found);
    if (version == none)
      diagnostics_.error("G061", root.loc, fmt::format("{} is '{}', but pass '{}' is not enabled and passes nothing through.", who, root.text, out_.nodes[at(found.node)].name()));
    if (version < 0) return;
    for (const auto& [text, known] : out_.roots)
      if (text.text == root.text) return;
    out_.roots.emplace_back(root, version);
  }

  SourceLoc loc_of_input(const Node& node, std::string_view slot) const {
    for (const InputDesc& input : node.desc->inputs)
      if (input.slot.text == slot) return input.source.loc;
    return node.desc->loc;
  }

  // Readers and overwriters of every version; two overwriters are G051, reading what one draws over G054.
  void note_readers() {
    for (std::size_t n = 0; n < out_.nodes.size(); ++n) {
      Node& node = out_.nodes[n];
      for (std::size_t s = 0; node.desc->enabled && s < node.slots.size(); ++s) {
        const int v = node.in[s];
        if (v < 0) continue;
        Version& version = out_.versions[at(v)];
        if (!writes(node.slots[s].access)) {
          version.readers.emplace_back(static_cast<int>(n), static_cast<int>(s));
        } else if (version.overwriter == none) {
          version.overwriter = static_cast<int>(n);
        } else {
          const Node& first = out_.nodes[at(version.overwriter)];
          diagnostics_.error("G051", loc_of_input(node, node.slots[s].name),
                             fmt::format("pass '{}' draws over '{}', but pass '{}' does so already.", node.name(), out_.name(v), first.name()),
                             {fmt::format("use what '{}' gives on instead, as in \"{}.{}\".", first.name(), first.name(), node.slots[s].name)});
        }
      }
    }
    for (const Version& version : out_.versions)
      for (const auto& [n, s] : version.readers)
        if (n == version.overwriter) {
          const Node& node = out_.nodes[at(n)];
          diagnostics_.error("G054", loc_of_input(node, node.slots[at(s)].name),
                             fmt::format("pass '{}' reads '{}' in its slot '{}' while drawing over it.", node.name(), out_.name(static_cast<int>(&version - out_.versions.data())), node.slots[at(s)].name));
        }
  }

  enum class Visit : std::uint8_t { No, Now, Done };
  const GraphDesc& graph_;
  const Registry& registry_;
  Diagnostics& diagnostics_;
  Resolved out_{};
  std::vector<std::vector<Visit>> visited_{};
};

} // namespace

Resolved resolve(const GraphDesc& graph, const Registry& registry, const std::vector<LocatedString>& extra_roots, Diagnostics& diagnostics) {
  Resolved out = Resolver(graph, registry, diagnostics).run(extra_roots);
  settle_specs(out, diagnostics);
  return out;
}

} // namespace mote::rg
