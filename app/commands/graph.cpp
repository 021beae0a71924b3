// SPDX-License-Identifier: MIT
// mote graph: looks at a render graph without a device: problems, plan, Graphviz, kinds of passes.
#include "app/commands/command.hpp"
#include "app/library/user_types.hpp"
#include "passes/particles/particle_type.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

struct GraphArguments {
  std::string graph{"default"};
  std::vector<std::string> settings{}, types{};
  bool check{}, plan{}, dot{}, kinds{}, schema{}, json{}, strict{};
};

// A graph file or a shipped graph.
GraphRequest request_of(const GraphArguments& a) {
  GraphRequest request;
  request.graph = a.graph;
  request.loc = {"command line"};
  request.settings = a.settings;
  return request;
}

// Types from folders become known: a graph's draw lists may name them, the matrix has them.
void take_types(const GraphArguments& a) {
  SceneDesc named;
  Diagnostics found;
  for (const std::string& folder : a.types)
    if (auto type = read_user_type(folder, {"--type"}, found)) named.types.push_back(std::move(type));
  app::take_types(named, {}, found);
  print_and_stop_on_errors(found);
}

Exit run(const GraphArguments& a) {
  take_types(a);
  if (a.kinds) {
    fmt::print("{}", a.json ? rg::kinds_json(registry()) : rg::kinds_text(registry()));
    if (!a.json) fmt::print("\n{}", passes::support_matrix());
    return Exit::Done;
  }
  if (a.schema) {
    fmt::print("{}", rg::graph_schema(registry()));
    return Exit::Done;
  }
  Diagnostics found;
  rg::GraphDesc graph = load_graph(request_of(a), found);
  for (const std::string& setting : a.settings) rg::apply_setting(graph, setting, found);
  rg::CompileOptions options;
  options.strict = a.strict;
  const rg::CompileResult result = rg::compile(graph, registry(), options, found);
  if (a.check) {
    fmt::print(stderr, "{}", to_string(result.diagnostics));
    if (result.plan) fmt::print("{}: no errors, {} passes\n", graph.file, result.plan->passes.size());
  } else {
    print(result.diagnostics);
    if (result.plan) fmt::print("{}", a.dot ? rg::to_dot(*result.plan) : rg::to_text(*result.plan));
  }
  return result.plan ? Exit::Done : exit_of(result.diagnostics);
}

} // namespace

void add_graph(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("graph", "look at a render graph, without a device");
  auto a = std::make_shared<GraphArguments>();
  command->add_option("GRAPH", a->graph, "shipped graph or graph file");
  command->add_option("--set", a->settings, "change a parameter of a pass")->allow_extra_args(false)->type_name("PASS.PARAMETER=VALUE");
  add_type_option(*command, a->types);
  CLI::Option* check = command->add_flag("--check", a->check, "say what is wrong, or that nothing is");
  CLI::Option* plan = command->add_flag("--plan", a->plan, "the passes in order, with what they load, store and share (the default)");
  CLI::Option* dot = command->add_flag("--dot", a->dot, "the same for Graphviz");
  CLI::Option* kinds = command->add_flag("--kinds", a->kinds, "the kinds of passes with their slots and parameters");
  CLI::Option* schema = command->add_flag("--schema", a->schema, "a JSON schema of graph files, for editors");
  check->excludes(plan, dot, kinds, schema);
  plan->excludes(dot, kinds, schema);
  dot->excludes(kinds, schema);
  kinds->excludes(schema);
  command->add_flag("--json", a->json, "with --kinds: as JSON")->needs(kinds);
  command->add_flag("--strict", a->strict, "passes that nothing needs are errors");
  command->callback([a, &exit] { exit = run(*a); });
}

} // namespace mote::app
