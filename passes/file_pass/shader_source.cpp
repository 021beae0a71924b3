// SPDX-License-Identifier: MIT
#include "passes/file_pass/shader_source.hpp"

#include "core/gpu/reflection.hpp"
#include "core/gpu/shader_compiler.hpp"
#include "shaders/embedded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace mote::passes {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view shipped_folder = "passes/";

fs::file_time_type time_of(const std::string& path) {
  std::error_code ignored;
  return fs::last_write_time(path, ignored); // the least time for a file that is not there
}

std::string declared(const PassFile& file) {
  std::vector<std::string> names;
  for (const FileInput& input : file.inputs) names.push_back(input.name);
  for (const FileOutput& output : file.outputs) names.push_back("o_" + output.name);
  for (const FileParam& param : file.params) names.push_back(param.name);
  return fmt::format("{} declares: {}, view_size.", file.file, list_of(names));
}

// What the module uses against what its pass.toml declares.
void check(const gpu::ReflectedEntryPoint& entry, const PassFile& file, bool compute, const std::string& path, Diagnostics& problems) {
  const SourceLoc place{path};
  const auto bindings = static_cast<std::uint32_t>(file.inputs.size() + (compute ? file.outputs.size() : 0) + 1);
  for (const gpu::ReflectedBinding& b : entry.bindings)
    if (b.group != 0 || b.binding >= bindings)
      problems.error("P013", place, fmt::format("the shader uses '{}' (set {}, binding {}), which is not declared.", b.name, b.group, b.binding), {declared(file)});
  if (entry.push_constant_size > 0) problems.error("P013", place, "the shader uses push constants, which a pass from a file does not have.", {declared(file)});
  for (const gpu::ReflectedVariable& v : entry.inputs)
    problems.error("P013", place, fmt::format("the shader reads '{}' (location {}) from an earlier stage, but a full-screen pass has none.", v.name, v.location));
  for (const gpu::ReflectedVariable& v : entry.outputs)
    if (v.location >= file.outputs.size())
      problems.error("P013", place, fmt::format("the shader writes '{}' (location {}), which is not declared.", v.name, v.location), {declared(file)});
  if (entry.writes_depth) problems.error("P013", place, "the shader writes gl_FragDepth, but a pass from a file has no depth attachment.");
}

} // namespace

ShaderSource ShaderSource::locate(const std::string& word, const std::string& resolved_path) {
  ShaderSource out;
  out.shipped_ = word.find('/') == std::string::npos && word.find('.') == std::string::npos;
  out.path_ = out.shipped_ ? fmt::format("{}{}/{}.glsl", shipped_folder, word, word) : resolved_path;
  return out;
}

std::vector<std::string> ShaderSource::shipped() {
  std::set<std::string> names;
  for (const std::string_view path : shaders::text_paths())
    if (path.starts_with(shipped_folder)) names.emplace(path.substr(shipped_folder.size(), path.find('/', shipped_folder.size()) - shipped_folder.size()));
  return {names.begin(), names.end()};
}

std::string ShaderSource::description_path() const { return (fs::path(path_).parent_path() / "pass.toml").string(); }
std::optional<std::string> ShaderSource::description() const { return text_of(description_path()); }

std::string ShaderSource::on_disk(const std::string& path) const {
  if (!shipped_) return path;
  const char* folder = std::getenv("MOTE_SHADERS"); // for work on shaders
  return folder && *folder ? std::string(folder) + "/" + path : std::string();
}

std::optional<std::string> ShaderSource::text_of(const std::string& path) const {
  const std::string disk = on_disk(path);
  std::error_code ignored;
  if (std::ifstream file(disk, std::ios::binary); !disk.empty() && file && !fs::is_directory(disk, ignored))
    return (std::ostringstream() << file.rdbuf()).str();
  const std::string_view embedded = shipped_ ? shaders::text(path) : std::string_view();
  return embedded.empty() ? std::nullopt : std::optional<std::string>(embedded);
}

void ShaderSource::watch(const std::string& path) {
  if (const std::string disk = on_disk(path); !disk.empty()) watched_.emplace_back(disk, time_of(disk));
}

bool ShaderSource::changed() const {
  return std::any_of(watched_.begin(), watched_.end(), [](const auto& entry) { return time_of(entry.first) != entry.second; });
}

CheckedShader ShaderSource::compile(const PassFile& file, bool compute) {
  watched_.clear();
  watch(path_); // before it is read: a change while it is compiled is seen
  watch(description_path());
  CheckedShader out;
  const auto text = text_of(path_);
  if (!text) {
    out.problems.error("P010", {path_}, fmt::format("the shader '{}' cannot be read.", path_));
    return out;
  }
  // #include "x": beside the file that says it, else among the shipped shaders.
  const auto include = [&](const std::string& name, const std::string& from) -> std::optional<gpu::GlslSource> {
    const std::string beside = (fs::path(from).parent_path() / name).string();
    watch(beside);
    if (auto found = text_of(beside)) return gpu::GlslSource{beside, std::move(*found)};
    const std::string_view shipped = shaders::text(name);
    return shipped.empty() ? std::nullopt : std::optional<gpu::GlslSource>({name, std::string(shipped)});
  };
  const gpu::ShaderStage stage = compute ? gpu::ShaderStage::Compute : gpu::ShaderStage::Fragment;
  gpu::CompiledShader compiled = gpu::compile_glsl(stage, {path_, pass_preamble(file, compute) + *text}, {}, include);
  for (const gpu::ShaderMessage& message : compiled.messages)
    if (message.error && !message.text.empty())
      out.problems.error("P002", {.file = message.file, .line = static_cast<std::uint64_t>(std::max(message.line, 0)), .column = message.line > 0 ? 1u : 0u},
                         message.text, message.text.find("undeclared") != std::string::npos ? std::vector{declared(file)} : std::vector<std::string>{});
  if (!compiled && !out.problems.has_errors()) out.problems.error("P002", {path_}, "the shader does not compile.");
  if (out.problems.has_errors()) return out;
  try {
    const gpu::Reflection reflection = gpu::reflect(compiled.spirv);
    if (const auto* entry = gpu::find_entry_point(reflection, "main", stage)) {
      check(*entry, file, compute, path_, out.problems);
      out.local_size = entry->local_size;
    } else {
      out.problems.error("P013", {path_}, "the shader has no main().");
    }
  } catch (const std::exception& fault) { // a kind of binding that core/gpu does not have
    out.problems.error("P013", {path_}, fault.what(), {declared(file)});
  }
  if (!out.problems.has_errors()) out.spirv = std::move(compiled.spirv);
  return out;
}

} // namespace mote::passes
