// SPDX-License-Identifier: MIT
// Random graphs with fixed seeds, checked against what a plan must be, by slow and obvious means.
#include "fake_kinds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace mote::rg::test {
namespace {

struct Made {
  std::string name{}, text{};
  std::vector<std::string> needs{}; // passes
};

// A DAG of paint and blur passes: pass i takes its sources from earlier ones; a version is drawn over at most once.
std::vector<Made> random_passes(std::mt19937& random, int count) {
  std::vector<Made> out;
  std::set<int> drawn_over;
  auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < count; ++i) {
    Made pass{.name = fmt::format("p{}", i)};
    const int a = i ? below(i) : 0, b = i ? below(i) : 0;
    auto source = [&](int n) { return fmt::format("'p{}.color'", n); };
    if (i > 0 && below(2) == 0) {
      pass.text = fmt::format("[[pass]]\nname = '{}'\nkind = 'blur'\ninputs = {{ source = {} }}\nparams = {{ radius = 1 }}\n", pass.name, source(a));
      pass.needs = {out[static_cast<std::size_t>(a)].name};
    } else {
      std::string inputs;
      if (i > 1 && a != b) inputs = "mask = " + source(b), pass.needs.push_back(out[static_cast<std::size_t>(b)].name);
      // drawing over the newest version only keeps readers of it before this pass in the file, so no ring can arise
      if (i > 0 && b != i - 1 && below(2) == 0 && drawn_over.insert(i - 1).second) {
        inputs += fmt::format("{}color = {}", inputs.empty() ? "" : ", ", source(i - 1));
        pass.needs.push_back(out[static_cast<std::size_t>(i - 1)].name);
      }
      pass.text = fmt::format("[[pass]]\nname = '{}'\nkind = 'paint'\ninputs = {{ {} }}\n", pass.name, inputs);
    }
    out.push_back(std::move(pass));
  }
  return out;
}

std::set<std::string> needed(const std::vector<Made>& passes, const std::string& name) {
  std::set<std::string> out{name};
  for (auto it = passes.rbegin(); it != passes.rend(); ++it)
    if (out.contains(it->name)) out.insert(it->needs.begin(), it->needs.end());
  return out;
}

// Plays the plan: every version a pass reads must be the last one written to that memory.
void check_contents(const Plan& plan) {
  std::map<std::uint32_t, std::string> holds; // physical -> version
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    for (const Use& use : plan.passes[i].uses) {
      if (use.source.empty()) continue;
      EXPECT_EQ(holds[plan.textures[use.resource].physical], use.source) << plan.passes[i].name << " reads\n" << to_text(plan);
    }
    for (const Use& use : plan.passes[i].uses)
      if (!use.gives.empty()) holds[plan.textures[use.resource].physical] = use.gives;
    for (const Copy& copy : plan.copies)
      if (copy.after == i) holds[plan.textures[copy.to].physical] = holds[plan.textures[copy.from].physical];
  }
  for (const Root& root : plan.roots) EXPECT_EQ(holds[plan.textures[root.resource].physical], root.source) << to_text(plan);
}

TEST(RandomGraphs, PlansKeepTheRules) {
  int compiled = 0, shared = 0, copied = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    std::mt19937 random(seed);
    std::vector<Made> passes = random_passes(random, 3 + static_cast<int>(random() % 12));
    const std::vector<Made> in_order = passes;
    const std::string output = passes.back().name, dumped = passes[random() % passes.size()].name;
    const CompileOptions options{.roots = {{dumped + ".color", {"--dump"}}}};
    const std::string head = fmt::format("schema = 1\noutput = '{}.color'\n", output);
    auto text = [&] {
      std::string out = head;
      for (const Made& pass : passes) out += pass.text;
      return out;
    };
    const CompileResult result = compile_text(text(), options);
    if (result.diagnostics.has("G050")) continue; // a late reader of what was drawn over
    ASSERT_TRUE(result.plan) << check_text(result) << text();
    ++compiled;
    const Plan& plan = *result.plan;
    check_contents(plan);
    std::set<std::string> ran, wanted = needed(in_order, output);
    wanted.merge(needed(in_order, dumped));
    for (const PlannedPass& pass : plan.passes) ran.insert(pass.name);
    EXPECT_EQ(ran, wanted);
    EXPECT_EQ(plan.culled.size() + plan.passes.size(), passes.size());
    for (const PlannedTexture& a : plan.textures)
      for (const PlannedTexture& b : plan.textures) shared += &a < &b && a.physical == b.physical;
    copied += static_cast<int>(plan.copies.size());
    std::shuffle(passes.begin(), passes.end(), random);
    const CompileResult again = compile_text(text(), options);
    ASSERT_TRUE(again.plan);
    check_contents(*again.plan);
    std::set<std::string> ran_again;
    for (const PlannedPass& pass : again.plan->passes) ran_again.insert(pass.name);
    EXPECT_EQ(ran_again, ran) << "what runs does not hang on the order of the file";
    EXPECT_EQ(*again.plan, *compile_text(text(), options).plan) << "the same file gives the same plan";
  }
  EXPECT_GT(compiled, 200); // the generator makes what the test is about
  EXPECT_GT(shared, 100);
  EXPECT_GT(copied, 20);
}

} // namespace
} // namespace mote::rg::test
