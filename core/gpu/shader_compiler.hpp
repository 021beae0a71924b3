// SPDX-License-Identifier: MIT
// GLSL -> SPIR-V in this process, by glslang. Used for shaders that are made at run time (color
// transforms, plugins, live reload); the built-in shaders are compiled when mote is built. A library
// of its own, so that the gpu layer links without glslang. Needs no device and no other part of mote.
//
// Target: Vulkan 1.2, SPIR-V 1.5: subgroup operations, 64-bit atomics and `precise` work. The
// optimizer is off: drivers optimize, and NoContraction must survive.
#pragma once

#include "core/gpu/types.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mote::gpu {

struct GlslSource {
  std::string name{}; // as messages say it, usually the path
  std::string text{}; // begins with #version
};
struct ShaderDefine {
  std::string name{}, value{};
};
// Text of `#include "name"` (or <name>), or nothing when there is no such file. `from` is the name of
// the including source.
using IncludeCallback = std::function<std::optional<GlslSource>(const std::string& name, const std::string& from)>;

struct ShaderMessage {
  std::string file{}; // GlslSource::name of the source or include
  int line{};         // from 1; 0: unknown
  std::string text{};
  bool error{true};   // false: a warning
};
std::string to_string(const ShaderMessage& message); // "file:3: error: text"

struct CompiledShader {
  std::vector<std::uint32_t> spirv{};     // empty when there was an error
  std::vector<ShaderMessage> messages{};
  bool from_cache{};
  [[nodiscard]] explicit operator bool() const { return !spirv.empty(); }
};

CompiledShader compile_glsl(ShaderStage stage, const GlslSource& source, std::span<const ShaderDefine> defines = {},
                            const IncludeCallback& include = {});

// SPIR-V on disk, keyed by everything that decides it: stage, full text with its includes, defines,
// version of glslang. Missing or unwritable directories and damaged entries are no errors: then
// shaders are compiled. Several processes may share a directory.
class SpirvCache {
public:
  explicit SpirvCache(std::string directory) : directory_(std::move(directory)) {} // empty: no cache
  CompiledShader compile(ShaderStage stage, const GlslSource& source, std::span<const ShaderDefine> defines = {},
                         const IncludeCallback& include = {});
  [[nodiscard]] std::uint32_t hits() const { return hits_; }
  [[nodiscard]] std::uint32_t misses() const { return misses_; }

private:
  std::string directory_;
  std::uint32_t hits_{}, misses_{};
};

} // namespace mote::gpu
