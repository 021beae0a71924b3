// SPDX-License-Identifier: MIT
// Every file in bad/ ends in the errors it must give: "# expect CODE LINE:COLUMN text", then hints.
#include "fake_kinds.hpp"
#include "goldens.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace mote::rg::test {
namespace {

std::vector<std::filesystem::path> bad_files() {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(here() / "bad")) out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

std::string expected_of(const std::filesystem::path& file) {
  std::string out, line;
  std::istringstream in(read_text(file));
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.starts_with("# expect ")) out += line.substr(9) + "\n", inside = true;
    else if (inside && line.starts_with("#        ")) out += "    " + line.substr(9) + "\n";
  }
  return out;
}

std::string errors_of(const Diagnostics& diagnostics) {
  std::string out;
  for (const Diagnostic& d : diagnostics.list()) {
    if (d.severity != Severity::Error) continue;
    out += fmt::format("{} {}:{} {}\n", d.code, d.loc.line, d.loc.column, d.text);
    for (const std::string& hint : d.hints)
      if (!hint.empty()) out += "    " + hint + "\n";
  }
  return out;
}

class BadGraph : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(BadGraph, GivesExactlyItsErrors) {
  std::filesystem::current_path(here() / "bad"); // so that messages name the bare file
  const std::string expected = expected_of(GetParam());
  ASSERT_FALSE(expected.empty()) << GetParam() << " says not what to expect";
  const CompileResult result = compile_file(GetParam().filename().string(), fake_registry());
  EXPECT_FALSE(result.plan);
  EXPECT_TRUE(result.passes.empty());
  EXPECT_EQ(errors_of(result.diagnostics), expected);
  EXPECT_THAT(check_text(result), testing::HasSubstr("nothing was run."));
}

INSTANTIATE_TEST_SUITE_P(Files, BadGraph, testing::ValuesIn(bad_files()), [](const auto& file) { return file.param.stem().string(); });

TEST(GraphErrors, UnreadableFile) {
  const CompileResult result = compile_file("no/such.toml", fake_registry());
  ASSERT_EQ(result.diagnostics.list().size(), 1u);
  EXPECT_EQ(to_string(result.diagnostics.list()[0]), "no/such.toml: error G007: the graph file 'no/such.toml' cannot be read.");
  EXPECT_TRUE(compile_file(here().string(), fake_registry()).diagnostics.has("G007")) << "a folder is no graph file";
}

TEST(GraphErrors, ExtraRootThatDoesNotExist) {
  const CompileResult result = compile_file((here() / "good/full.toml").string(), fake_registry(), {.roots = {{"opaque.aov_normals", {"--aov"}}}});
  EXPECT_FALSE(result.plan);
  EXPECT_THAT(to_string(result.diagnostics), testing::AllOf(testing::HasSubstr("--aov: error G062: a request names 'opaque.aov_normals'"), testing::HasSubstr("Did you mean 'opaque.aov_normal'?")));
}

TEST(GraphErrors, StrictMakesCulledPassesErrors) {
  const std::string file = (here() / "good/full.toml").string();
  const CompileResult lax = compile_file(file, fake_registry());
  EXPECT_TRUE(lax.plan && lax.diagnostics.has("G063"));
  const CompileResult strict = compile_file(file, fake_registry(), {.strict = true});
  EXPECT_FALSE(strict.plan);
  EXPECT_THAT(to_string(strict.diagnostics), testing::HasSubstr("error G063: pass 'soft' is culled: only 'softer' reads its outputs, and nothing needs that."));
}

// docs/graph-file.md lists exactly the codes that exist, and every one of them is provoked by a test.
TEST(GraphErrors, TheDocumentListsAllCodes) {
  std::set<std::string> documented, tested{"G007", "G008", "G026", "G062", "G063", "G070", "G071", "G072", "G073"}; // no file can have these
  std::istringstream in(read_text(std::filesystem::path(MOTE_SOURCE_DIR) / "docs/graph-file.md"));
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("| G0")) documented.insert(line.substr(2, 4));
  for (const auto& file : bad_files()) {
    std::istringstream expected(expected_of(file));
    for (std::string line; std::getline(expected, line);)
      if (line.starts_with("G0")) tested.insert(line.substr(0, 4));
  }
  EXPECT_EQ(documented, tested);
  std::set<std::string> in_code;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(MOTE_SOURCE_DIR) / "render_graph")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_text(entry.path());
    for (std::size_t at = text.find("\"G0"); at != std::string::npos; at = text.find("\"G0", at + 1)) in_code.insert(text.substr(at + 1, 4));
  }
  EXPECT_EQ(documented, in_code);
}

TEST(GraphDocument, ItsSampleFileIsCorrect) {
  const std::string text = read_text(std::filesystem::path(MOTE_SOURCE_DIR) / "docs/graph-file.md");
  const auto begin = text.find("```toml\n"), end = text.find("```", begin + 3);
  ASSERT_NE(end, std::string::npos);
  const CompileResult result = compile_text(text.substr(begin + 8, end - begin - 8));
  EXPECT_TRUE(result.plan) << check_text(result);
  EXPECT_FALSE(result.diagnostics.has_errors());
}

} // namespace
} // namespace mote::rg::test
