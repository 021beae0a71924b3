// SPDX-License-Identifier: MIT
#include "passes/runtime_shaders.hpp"

#include "core/base/diagnostic.hpp"
#include "core/gpu/shader_compiler.hpp"
#include "shaders/embedded.hpp"

#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

namespace mote::passes {
namespace {

// From the folder that MOTE_SHADERS names if the file is there, else from the program.
std::optional<std::string> shader_text(const std::string& path) {
  if (const char* folder = std::getenv("MOTE_SHADERS"); folder && *folder) {
    std::ifstream file(std::string(folder) + "/" + path, std::ios::binary);
    if (file) return (std::ostringstream() << file.rdbuf()).str();
  }
  const std::string_view text = shaders::text(path);
  if (text.empty()) return std::nullopt;
  return std::string(text);
}

gpu::ShaderStage stage_of(const std::string& path) {
  const std::string ending = path.substr(path.rfind('.') + 1);
  if (ending == "vert") return gpu::ShaderStage::Vertex;
  if (ending == "geom") return gpu::ShaderStage::Geometry;
  if (ending == "frag") return gpu::ShaderStage::Fragment;
  return gpu::ShaderStage::Compute;
}

} // namespace

std::vector<std::uint32_t> compile_shader(const std::string& path, const std::vector<MadeText>& made,
                                          const std::string& cache_directory, std::span<const gpu::ShaderDefine> defines) {
  const auto include = [&](const std::string& name, const std::string&) -> std::optional<gpu::GlslSource> {
    for (const MadeText& m : made)
      if (m.name == name) return gpu::GlslSource{m.shown.empty() ? m.name : m.shown, m.text};
    if (auto text = shader_text(name)) return gpu::GlslSource{name, *text};
    return std::nullopt;
  };
  const auto text = shader_text(path);
  if (!text) throw std::logic_error("no shipped shader '" + path + "'");
  gpu::CompiledShader compiled = gpu::SpirvCache(cache_directory).compile(stage_of(path), {path, *text}, defines, include);
  if (compiled) return std::move(compiled.spirv);

  std::vector<std::string> lines;
  SourceLoc loc{.file = path};
  for (const gpu::ShaderMessage& message : compiled.messages) {
    if (message.error && loc.line == 0) loc = {.file = message.file, .line = static_cast<std::uint64_t>(message.line)};
    lines.push_back(to_string(message));
  }
  fail(Exit::Failed, "P002", loc, "shader '" + path + "' does not compile", std::move(lines));
}

} // namespace mote::passes
