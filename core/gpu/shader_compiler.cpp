// SPDX-License-Identifier: MIT
#include "core/gpu/shader_compiler.hpp"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <charconv>
#include <memory>
#include <mutex>
#include <string_view>

namespace mote::gpu {
namespace {

void initialize_once() {
  static std::once_flag once;
  std::call_once(once, [] { glslang::InitializeProcess(); });
}

EShLanguage language(ShaderStage stage) {
  switch (stage) {
    case ShaderStage::Vertex: return EShLangVertex;
    case ShaderStage::Geometry: return EShLangGeometry;
    case ShaderStage::Compute: return EShLangCompute;
    default: return EShLangFragment;
  }
}

class Includer final : public glslang::TShader::Includer {
public:
  explicit Includer(const IncludeCallback& find) : find_(find) {}
  IncludeResult* includeLocal(const char* header, const char* from, std::size_t depth) override { return open(header, from, depth); }
  IncludeResult* includeSystem(const char* header, const char* from, std::size_t depth) override { return open(header, from, depth); }
  void releaseInclude(IncludeResult* result) override {
    if (result == nullptr) return;
    delete static_cast<std::string*>(result->userData);
    delete result;
  }

private:
  IncludeResult* open(const char* header, const char* from, std::size_t depth) {
    constexpr std::size_t deepest = 32;
    std::optional<GlslSource> found;
    if (find_ && depth <= deepest) found = find_(header, from);
    if (!found) return nullptr;
    auto text = std::make_unique<std::string>(std::move(found->text));
    auto result = std::make_unique<IncludeResult>(found->name, text->data(), text->size(), text.get());
    static_cast<void>(text.release());
    return result.release();
  }
  const IncludeCallback& find_;
};

// "ERROR: shaders/a.frag:3: 'x' : undeclared identifier" -> its parts. Lines of other shapes (summaries) give nothing.
std::optional<ShaderMessage> parse_line(std::string_view line) {
  ShaderMessage message;
  constexpr std::string_view error = "ERROR: ", warning = "WARNING: ";
  if (line.starts_with(error)) {
    line.remove_prefix(error.size());
  } else if (line.starts_with(warning)) {
    line.remove_prefix(warning.size());
    message.error = false;
  } else {
    return std::nullopt;
  }
  // the first ":<digits>:" ends the file name
  for (std::size_t at = line.find(':'); at != std::string_view::npos; at = line.find(':', at + 1)) {
    int number = 0;
    const auto [end, status] = std::from_chars(line.data() + at + 1, line.data() + line.size(), number);
    if (status != std::errc{} || end == line.data() + line.size() || *end != ':') continue;
    message.file = line.substr(0, at);
    message.line = number;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()) + 1);
    break;
  }
  if (line.starts_with(' ')) line.remove_prefix(1);
  if (message.file.empty() && line.find("compilation error") != std::string_view::npos) return std::nullopt;
  message.text = line;
  return message;
}

void add_messages(std::string_view log, std::vector<ShaderMessage>& messages) {
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    if (auto message = parse_line(log.substr(0, end))) messages.push_back(std::move(*message));
    log.remove_prefix(std::min(end + 1, log.size()));
  }
}

std::string preamble_of(std::span<const ShaderDefine> defines) {
  std::string text = "#extension GL_GOOGLE_include_directive : enable\n";
  for (const ShaderDefine& d : defines) text += fmt::format("#define {} {}\n", d.name, d.value);
  return text;
}

} // namespace

std::string to_string(const ShaderMessage& m) {
  return fmt::format("{}:{}: {}: {}", m.file, m.line, m.error ? "error" : "warning", m.text);
}

CompiledShader compile_glsl(ShaderStage stage, const GlslSource& source, std::span<const ShaderDefine> defines, const IncludeCallback& include) {
  initialize_once();
  CompiledShader result;
  glslang::TShader shader(language(stage));
  const char* text = source.text.c_str();
  const int length = static_cast<int>(source.text.size());
  const char* name = source.name.c_str();
  const std::string preamble = preamble_of(defines);
  shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
  shader.setPreamble(preamble.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, language(stage), glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
  constexpr auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgCascadingErrors);
  Includer includer(include);
  const bool parsed = shader.parse(GetDefaultResources(), 450, false, rules, includer);
  add_messages(shader.getInfoLog(), result.messages);
  glslang::TProgram program;
  bool linked = false;
  if (parsed) {
    program.addShader(&shader);
    linked = program.link(rules);
    add_messages(program.getInfoLog(), result.messages);
  }
  if (linked) {
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(language(stage)), result.spirv, &options);
  } else if (result.messages.empty()) {
    result.messages.push_back({source.name, 0, "glslang failed without saying why", true});
  }
  return result;
}

} // namespace mote::gpu
