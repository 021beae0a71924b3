// SPDX-License-Identifier: MIT
// GLSL to SPIR-V: includes, defines, messages; the SPIR-V cache.
#include "core/gpu/reflection.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace mote::gpu {
namespace {

using testing::HasSubstr;

const GlslSource with_include{"main.comp", R"(#version 450
#include "size.glsl"
layout(local_size_x = SIZE) in;
void main() {}
)"};

IncludeCallback include_of(const std::string& text) {
  return [text](const std::string& name, const std::string&) -> std::optional<GlslSource> {
    if (name != "size.glsl") return std::nullopt;
    return GlslSource{"common/size.glsl", text};
  };
}
std::uint32_t size_of(const CompiledShader& shader) { return reflect(shader.spirv).entry_points[0].local_size[0]; }

TEST(Compiler, includes_and_defines) {
  const ShaderDefine defines[] = {{"FACTOR", "4"}};
  const CompiledShader compiled = compile_glsl(ShaderStage::Compute, with_include, defines, include_of("#define SIZE (8 * FACTOR)\n"));
  ASSERT_TRUE(compiled);
  EXPECT_EQ(size_of(compiled), 32u);
}

TEST(Compiler, every_error_has_its_place) {
  const CompiledShader compiled = compile_glsl(ShaderStage::Fragment, {"shaders/bad.frag", "#version 450\nvoid main() {\n  a = 1;\n  b = 2;\n}\n"});
  EXPECT_FALSE(compiled);
  ASSERT_GE(compiled.messages.size(), 2u);
  EXPECT_EQ(compiled.messages[0].file, "shaders/bad.frag");
  EXPECT_EQ(compiled.messages[0].line, 3);
  EXPECT_THAT(compiled.messages[0].text, HasSubstr("'a'"));
  EXPECT_EQ(compiled.messages[1].line, 4);
  EXPECT_THAT(to_string(compiled.messages[0]), testing::StartsWith("shaders/bad.frag:3: error: "));
}

TEST(Compiler, an_error_in_an_include_names_the_include) {
  const CompiledShader compiled = compile_glsl(ShaderStage::Compute, with_include, {}, include_of("#define SIZE 4\nfloat f() { return oops; }\n"));
  EXPECT_FALSE(compiled);
  ASSERT_FALSE(compiled.messages.empty());
  EXPECT_EQ(compiled.messages[0].file, "common/size.glsl");
  EXPECT_EQ(compiled.messages[0].line, 2);
}

TEST(Compiler, a_missing_include_is_an_error) {
  const CompiledShader compiled = compile_glsl(ShaderStage::Compute, with_include);
  EXPECT_FALSE(compiled);
  ASSERT_FALSE(compiled.messages.empty());
  EXPECT_THAT(compiled.messages[0].text, HasSubstr("size.glsl"));
}

TEST(Compiler, precise_survives) {
  const CompiledShader compiled = compile_glsl(ShaderStage::Compute, {"p.comp", R"(#version 450
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer B { float a, b, c; };
void main() { precise float r = a * b + c; c = r; }
)"});
  ASSERT_TRUE(compiled);
  constexpr std::uint32_t decorate = 71, no_contraction = 42;
  int found = 0;
  for (std::size_t i = 5; i < compiled.spirv.size(); i += compiled.spirv[i] >> 16) {
    found += (compiled.spirv[i] & 0xFFFFu) == decorate && compiled.spirv[i + 2] == no_contraction;
  }
  EXPECT_GE(found, 2) << "the multiplication and the addition";
}

class SpirvCacheTest : public testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::path(MOTE_BINARY_DIR) / "test_output" / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder);
  }
  std::filesystem::path only_file() const {
    std::vector<std::filesystem::path> files;
    for (const auto& f : std::filesystem::directory_iterator(folder)) files.push_back(f.path());
    EXPECT_EQ(files.size(), 1u);
    return files.at(0);
  }
  CompiledShader compile(const std::string& include = "#define SIZE 16\n") {
    SpirvCache cache(folder.string());
    return cache.compile(ShaderStage::Compute, with_include, {}, include_of(include));
  }
  std::filesystem::path folder;
};

TEST_F(SpirvCacheTest, second_compilation_hits) {
  const CompiledShader first = compile(), second = compile();
  EXPECT_FALSE(first.from_cache);
  EXPECT_TRUE(second.from_cache);
  EXPECT_EQ(first.spirv, second.spirv);
}
TEST_F(SpirvCacheTest, a_changed_include_misses) {
  compile();
  const CompiledShader changed = compile("#define SIZE 32\n");
  EXPECT_FALSE(changed.from_cache);
  EXPECT_EQ(size_of(changed), 32u);
}
TEST_F(SpirvCacheTest, other_defines_and_stages_are_other_entries) {
  SpirvCache cache(folder.string());
  const GlslSource source{"a.comp", "#version 450\nlayout(local_size_x = N) in;\nvoid main() {}\n"};
  const ShaderDefine two[] = {{"N", "2"}}, three[] = {{"N", "3"}};
  EXPECT_EQ(size_of(cache.compile(ShaderStage::Compute, source, two)), 2u);
  EXPECT_EQ(size_of(cache.compile(ShaderStage::Compute, source, three)), 3u);
  EXPECT_EQ(cache.hits(), 0u);
  EXPECT_EQ(size_of(cache.compile(ShaderStage::Compute, source, two)), 2u);
  EXPECT_EQ(cache.hits(), 1u);
  EXPECT_EQ(cache.misses(), 2u);
}
TEST_F(SpirvCacheTest, damaged_entries_are_compiled_anew) {
  const CompiledShader good = compile();
  const auto path = only_file();
  const auto size = std::filesystem::file_size(path);
  for (const std::uintmax_t cut : {std::uintmax_t{0}, std::uintmax_t{7}, size / 2, size - 1}) {
    std::filesystem::resize_file(path, cut);
    const CompiledShader again = compile();
    EXPECT_FALSE(again.from_cache) << cut;
    EXPECT_EQ(again.spirv, good.spirv);
  }
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(size) - 5);
    file.put('\x55');
  }
  EXPECT_FALSE(compile().from_cache);
  EXPECT_TRUE(compile().from_cache);
}
TEST_F(SpirvCacheTest, a_folder_that_cannot_be_made_is_no_error) {
  SpirvCache cache("/proc/nowhere/cache");
  EXPECT_TRUE(cache.compile(ShaderStage::Compute, with_include, {}, include_of("#define SIZE 1\n")));
  EXPECT_EQ(cache.misses(), 1u);
}
TEST_F(SpirvCacheTest, failures_are_not_kept) {
  EXPECT_FALSE(compile("#error no\n"));
  EXPECT_FALSE(std::filesystem::exists(folder) && !std::filesystem::is_empty(folder));
}

} // namespace
} // namespace mote::gpu
