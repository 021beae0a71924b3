// SPDX-License-Identifier: MIT
// Passes from files: `fullscreen` and `compute` with a shader and a pass.toml. Known answers, what is
// refused and where, reloading while frames are drawn, and the shipped outline.
#include "harness.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/builtin.hpp"
#include "render_graph/compile.hpp"
#include "render_graph/executor.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace mote::test {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* gradient_toml = R"(schema = 1
[outputs]
color = { format = "rgba32float" }
[params]
gain = { type = "float", default = 1.0, min = 0.0 }
steps = { type = "int", default = 3 }
flip = { type = "bool", default = false }
ink = { type = "color", default = "#ffffff" }
offset = { type = "vec3", default = [0.0, 0.0, 0.0] }
)";
constexpr const char* gradient = "void main() { vec2 p = gl_FragCoord.xy / view_size; if (flip) p = 1.0 - p; o_color = vec4(p * gain, float(steps), 1.0) * ink + vec4(offset, 0.0); }\n";

class FilePasses : public GpuTest {
protected:
  void SetUp() override {
    GpuTest::SetUp();
    folder_ = fs::temp_directory_path() / ("mote_file_pass_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    executor_.reset();
    fs::remove_all(folder_);
    GpuTest::TearDown();
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name, std::ios::binary) << text; }
  // A second write within the clock's grain would be missed by any program that compares times.
  void change(const std::string& name, const std::string& text) {
    const auto before = fs::last_write_time(folder_ / name);
    write(name, text);
    fs::last_write_time(folder_ / name, before + std::chrono::seconds(1));
  }

  rg::CompileResult compile(const std::string& passes, const std::string& output) {
    rg::Registry registry;
    passes::register_builtin_passes(registry);
    Diagnostics found;
    const rg::GraphDesc graph = rg::parse_graph("schema = 1\noutput = '" + output + "'\n" + passes, (folder_ / "graph.toml").string(), found);
    return rg::compile(graph, registry, {}, found);
  }
  std::string problems(const std::string& passes, const std::string& output = "made.color") { return to_string(compile(passes, output).diagnostics); }

  std::vector<glm::vec4> run(const std::string& passes, const std::string& output = "made.color") {
    const auto graph = compile(passes, output);
    EXPECT_TRUE(graph.plan) << to_string(graph.diagnostics);
    if (!graph.plan) return {};
    executor_ = std::make_unique<rg::Executor>(device(), *graph.plan, graph.passes);
    return frame();
  }
  std::vector<glm::vec4> frame() {
    rg::FrameInput input;
    const passes::PassReports reports{[this](const Diagnostic& d) { reports_ += to_string(d); }};
    input.set(&reports);
    executor_->execute(input, {8, 4});
    const std::vector<std::byte> bytes = device().read_texture(executor_->output());
    std::vector<glm::vec4> out(bytes.size() / sizeof(glm::vec4));
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }

  const std::string made_ = "[[pass]]\nname = 'made'\nkind = 'fullscreen'\nparams = { shader = 'made.glsl' }\n";
  fs::path folder_;
  std::unique_ptr<rg::Executor> executor_;
  std::string reports_;
};

TEST_F(FilePasses, FullscreenKnownAnswer) {
  write("pass.toml", gradient_toml);
  write("made.glsl", gradient);
  const auto plain = run(made_);
  ASSERT_EQ(plain.size(), 32u);
  EXPECT_EQ(plain[0], glm::vec4(0.0625f, 0.125f, 3, 1));
  EXPECT_EQ(plain[31], glm::vec4(0.9375f, 0.875f, 3, 1));
  const auto set = run("[[pass]]\nname = 'made'\nkind = 'fullscreen'\nparams = { shader = 'made.glsl', gain = 2.0, steps = -7, flip = true, ink = '#ff00ff', offset = [0.0, 0.5, 1.0] }\n");
  EXPECT_EQ(set[0], glm::vec4(1.875f, 0.5f, -6, 1));
}

TEST_F(FilePasses, ComputeKnownAnswerAndInputsOfOtherPasses) {
  write("pass.toml", gradient_toml);
  write("made.glsl", gradient);
  fs::create_directory(folder_ / "sum");
  write("sum/pass.toml", "schema = 1\n[inputs]\nfrom = 'texture2d'\n[outputs]\nwhole = { format = 'rgba32float' }\n");
  write("sum/sum.glsl", "layout(local_size_x = 8, local_size_y = 8) in;\nvoid main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n"
                        "  if (p.x < int(view_size.x) && p.y < int(view_size.y)) imageStore(o_whole, p, texelFetch(from, p, 0) * 2.0);\n}\n");
  const auto out = run(made_ + "[[pass]]\nname = 'sum'\nkind = 'compute'\ninputs = { from = 'made.color' }\nparams = { shader = 'sum/sum.glsl' }\n", "sum.whole");
  ASSERT_EQ(out.size(), 32u);
  EXPECT_EQ(out[0], glm::vec4(0.125f, 0.25f, 6, 2));
  EXPECT_EQ(out[31], glm::vec4(1.875f, 1.75f, 6, 2));
}

// ---- what is refused ------------------------------------------------------------------------------------
TEST_F(FilePasses, UsesWhatIsNotDeclared) {
  write("pass.toml", gradient_toml);
  write("made.glsl", gradient);
  EXPECT_EQ(problems(made_), "");
  write("made.glsl", "// a comment\nvoid main() {\n  o_color = vec4(depth);\n}\n");
  EXPECT_THAT(problems(made_), AllOf(HasSubstr("made.glsl:3:1: error P002:"), HasSubstr("'depth'"), HasSubstr("undeclared"), HasSubstr("pass.toml declares: o_color, gain,")));
  write("made.glsl", "layout(set = 0, binding = 5) uniform texture2D other;\nvoid main() { o_color = texelFetch(other, ivec2(0), 0); }\n");
  EXPECT_THAT(problems(made_), AllOf(HasSubstr("made.glsl: error P013: the shader uses 'other' (set 0, binding 5), which is not declared."), HasSubstr("declares:")));
  write("made.glsl", "layout(set = 1, binding = 0) uniform Mine { vec4 a; };\nvoid main() { o_color = a; }\n");
  EXPECT_THAT(problems(made_), HasSubstr("error P013"));
  write("made.glsl", "layout(location = 3) in vec4 v;\nvoid main() { o_color = v; }\n");
  EXPECT_THAT(problems(made_), HasSubstr("error P013: the shader reads 'v' (location 3)"));
  write("made.glsl", "layout(location = 1) out vec4 more;\nvoid main() { o_color = more = vec4(1.0); }\n");
  EXPECT_THAT(problems(made_), HasSubstr("error P013: the shader writes 'more' (location 1)"));
  write("made.glsl", "void main() { o_color = vec4(1.0); gl_FragDepth = 0.5; }\n");
  EXPECT_THAT(problems(made_), HasSubstr("error P013: the shader writes gl_FragDepth"));
  write("made.glsl", "layout(push_constant) uniform P { vec4 c; };\nvoid main() { o_color = c; }\n");
  EXPECT_THAT(problems(made_), HasSubstr("push constants"));
  write("made.glsl", "layout(set = 0, binding = 0) uniform sampler2D both;\nvoid main() { o_color = texture(both, vec2(0.0)); }\n");
  EXPECT_THAT(problems(made_), AllOf(HasSubstr("error P013"), HasSubstr("combined image sampler")));
}

TEST_F(FilePasses, FilesThatAreNotThere) {
  EXPECT_THAT(problems("[[pass]]\nname = 'made'\nkind = 'fullscreen'\n"), HasSubstr("error G025"));
  EXPECT_THAT(problems(made_), AllOf(HasSubstr("graph.toml:6:21: error P010"), HasSubstr("made.glsl' cannot be read")));
  write("made.glsl", gradient);
  EXPECT_THAT(problems(made_), AllOf(HasSubstr("error P010"), HasSubstr("pass.toml' cannot be read")));
  EXPECT_THAT(problems("[[pass]]\nname = 'made'\nkind = 'fullscreen'\nparams = { shader = 'outlin' }\n"),
              AllOf(HasSubstr("error P010"), HasSubstr("shipped passes: outline."), HasSubstr("Did you mean 'outline'?")));
}

TEST_F(FilePasses, WhatAPassTomlCannotSay) {
  write("made.glsl", gradient);
  const auto said = [&](const std::string& toml) {
    write("pass.toml", toml);
    return problems(made_);
  };
  const std::string out = "[outputs]\ncolor = { format = 'rgba32float' }\n";
  EXPECT_THAT(said("schema = 2\n" + out), HasSubstr("pass.toml:1:10: error P011: 'schema' is 2"));
  EXPECT_THAT(said("schema = 1\ninput = 3\n" + out), AllOf(HasSubstr("pass.toml:2:1: error P011: 'input' is no key"), HasSubstr("Did you mean 'inputs'?")));
  EXPECT_THAT(said("schema = 1\n" + out + "[inputs]\na = 'texture4d'\n"), AllOf(HasSubstr("pass.toml:5:5: error P011"), HasSubstr("texture2d")));
  EXPECT_THAT(said("schema = 1\n[outputs]\ncolor = { format = 'rgba9' }\n"), HasSubstr("pass.toml:3:20: error P011: 'rgba9' is no format"));
  EXPECT_THAT(said("schema = 1\n[outputs]\ncolor = { }\n"), HasSubstr("lacks its format"));
  EXPECT_THAT(said("schema = 1\n"), HasSubstr("error P011: the pass has no outputs"));
  EXPECT_THAT(said("schema = 1\n" + out + "[params]\na = { type = 'flot' }\n"), AllOf(HasSubstr("pass.toml:5:14: error P011"), HasSubstr("Did you mean 'float'?")));
  EXPECT_THAT(said("schema = 1\n" + out + "[params]\na = { default = 1 }\n"), HasSubstr("the parameter 'a' lacks its type"));
  EXPECT_THAT(said("schema = 1\n" + out + "[params]\na = { type = 'vec2', default = [1] }\n"), HasSubstr("array of 2 numbers"));
  EXPECT_THAT(said("schema = 1\n" + out + "[params]\na = { type = 'color', default = 'blu' }\n"), HasSubstr("'blu' is no color"));
  EXPECT_THAT(said("schema ="), HasSubstr("error G001"));
}

TEST_F(FilePasses, ParametersAndInputsAreChecked) {
  write("pass.toml", gradient_toml);
  write("made.glsl", gradient);
  EXPECT_THAT(problems("[[pass]]\nname = 'made'\nkind = 'fullscreen'\nparams = { shader = 'made.glsl', gein = 2.0 }\n"),
              AllOf(HasSubstr("error G021"), HasSubstr("Did you mean 'gain'?")));
  EXPECT_THAT(problems("[[pass]]\nname = 'made'\nkind = 'fullscreen'\nparams = { shader = 'made.glsl', gain = -1.0 }\n"), HasSubstr("error G022"));
  fs::create_directory(folder_ / "ids");
  write("ids/pass.toml", "schema = 1\n[inputs]\nid = 'utexture2d'\n[outputs]\ncolor = { format = 'rgba32float' }\n");
  write("ids/ids.glsl", "void main() { o_color = vec4(texelFetch(id, ivec2(0), 0)); }\n");
  const std::string ids = "[[pass]]\nname = 'ids'\nkind = 'fullscreen'\nparams = { shader = 'ids/ids.glsl' }\n";
  EXPECT_THAT(problems(ids, "ids.color"), HasSubstr("error G015"));
  try {
    run(made_ + ids + "inputs = { id = 'made.color' }\n", "ids.color");
    FAIL() << "floats were read as ids";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), AllOf(HasSubstr("error P014"), HasSubstr("input 'id' is a rgba32float"), HasSubstr("declares a utexture2d")));
  }
}

// ---- reloading ----------------------------------------------------------------------------------------------
TEST_F(FilePasses, AChangedShaderIsInTheNextFrame) {
  write("pass.toml", "schema = 1\n[outputs]\ncolor = { format = 'rgba32float' }\n");
  write("made.glsl", "#include \"part.glsl\"\nvoid main() { o_color = vec4(value); }\n");
  write("part.glsl", "const float value = 1.0;\n");
  EXPECT_THAT(run(made_), Each(glm::vec4(1)));
  change("made.glsl", "#include \"part.glsl\"\nvoid main() { o_color = vec4(value + 1.0); }\n");
  EXPECT_THAT(frame(), Each(glm::vec4(2)));
  change("part.glsl", "const float value = 5.0;\n");
  EXPECT_THAT(frame(), Each(glm::vec4(6))) << "an included file counts, too";
  EXPECT_EQ(reports_, "");
}

TEST_F(FilePasses, AChangedDescriptionIsInTheNextFrame) {
  const std::string out = "schema = 1\n[outputs]\ncolor = { format = 'rgba32float' }\n[params]\n";
  write("pass.toml", out + "a = { type = 'float', default = 1.0 }\nb = { type = 'float', default = 1.0 }\n");
  write("made.glsl", "void main() { o_color = vec4(a + 10.0 * b); }\n");
  EXPECT_THAT(run("[[pass]]\nname = 'made'\nkind = 'fullscreen'\nparams = { shader = 'made.glsl', b = 2.0 }\n"), Each(glm::vec4(21)));
  change("pass.toml", out + "b = { type = 'float', default = 9.0 }\nc = { type = 'vec2', default = [0.5, 0.5] }\na = { type = 'float', default = 4.0 }\n");
  EXPECT_THAT(frame(), Each(glm::vec4(24))) << "a new default counts, what the graph says stays";
  change("made.glsl", "void main() { o_color = vec4(a + 10.0 * b + c.x); }\n");
  EXPECT_THAT(frame(), Each(glm::vec4(24.5)));
  EXPECT_EQ(reports_, "");
  const auto refused = [&](const std::string& toml, const std::string& words) {
    reports_.clear();
    change("pass.toml", toml);
    EXPECT_THAT(frame(), Each(glm::vec4(24.5)));
    EXPECT_THAT(reports_, HasSubstr(words));
  };
  refused("schema = 1\n[outputs]\ncolor = { format = 'rgba16float' }\n", "pass.toml: error P012: the inputs or outputs of the pass 'made' have changed");
  refused(out + "a = { type = 'float' }\nc = { type = 'vec2' }\n", "P012: the graph sets the parameter 'b'");
  refused(out + "a = { type = 'flot' }\n", "error P011");
  change("pass.toml", out + "b = { type = 'float', default = 9.0 }\nc = { type = 'vec2', default = [1.5, 0.5] }\na = { type = 'float', default = 4.0 }\n");
  EXPECT_THAT(frame(), Each(glm::vec4(25.5)));
}

TEST_F(FilePasses, ABrokenShaderKeepsTheLastGoodOne) {
  write("pass.toml", "schema = 1\n[outputs]\ncolor = { format = 'rgba32float' }\n");
  write("made.glsl", "void main() { o_color = vec4(1.0); }\n");
  EXPECT_THAT(run(made_), Each(glm::vec4(1)));
  change("made.glsl", "void main() {\n  o_color = vec4(1.0)\n}\n");
  EXPECT_THAT(frame(), Each(glm::vec4(1)));
  EXPECT_THAT(reports_, AllOf(HasSubstr("made.glsl:"), HasSubstr("error P002")));
  reports_.clear();
  EXPECT_THAT(frame(), Each(glm::vec4(1)));
  EXPECT_EQ(reports_, "") << "said once";
  change("made.glsl", "layout(set = 0, binding = 3) uniform texture2D t;\nvoid main() { o_color = texelFetch(t, ivec2(0), 0); }\n");
  fs::last_write_time(folder_ / "made.glsl", fs::last_write_time(folder_ / "made.glsl") + std::chrono::seconds(5));
  EXPECT_THAT(frame(), Each(glm::vec4(1)));
  EXPECT_THAT(reports_, HasSubstr("error P013"));
  write("made.glsl", "void main() { o_color = vec4(3.0); }\n");
  EXPECT_THAT(frame(), Each(glm::vec4(3)));
}

// ---- the shipped outline -------------------------------------------------------------------------------------
TEST_F(FilePasses, OutlineKnownAnswer) {
  graph_ = "outlined";
  Scene scene = scene_of({{0, 0, 0, 2}}, {0xFFFFFFFFu});
  scene.ambient = {1, 1, 1};
  scene.lights.clear();
  const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {101, 101}, 5.05); // a disc of 40 px radius
  const Picture p = draw(scene, view, {}, {"outline.strength=1.0", "outline.ink=\"#ff0000\""});
  EXPECT_EQ(p.display[p.at(50, 50)], glm::u8vec4(255, 255, 255, 255));
  EXPECT_EQ(p.display[p.at(10, 50)], glm::u8vec4(255, 0, 0, 255)) << "the outermost pixel of the disc, 40 from its center";
  EXPECT_EQ(p.display[p.at(9, 50)], glm::u8vec4(255, 255, 255, 255)) << "background";
  EXPECT_EQ(p.display[p.at(12, 50)], glm::u8vec4(255, 255, 255, 255));
  std::size_t lines = 0;
  for (const glm::u8vec4& c : p.display) lines += c == glm::u8vec4(255, 0, 0, 255);
  EXPECT_NEAR(static_cast<double>(lines), 4 * 40 * std::sqrt(2.0), 12) << "one pixel wide in the 4-neighborhood";
}

} // namespace
} // namespace mote::test
