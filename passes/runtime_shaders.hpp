// SPDX-License-Identifier: MIT
// Shaders that can only be compiled at run time, because a part of their text is made then (the
// display transform) or comes from a user. The stage follows from the file's ending. Texts come from
// the embedded shaders, or from the folder that MOTE_SHADERS names (for work on shaders).
#pragma once

#include "core/gpu/shader_compiler.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mote::passes {

// A text that is made, not read: found by #include under `name`.
struct MadeText {
  std::string name{}, text{};
  std::string shown{}; // what messages call it; empty: its name
};

// `made` are texts that #include finds by name before any file. Results are kept in
// `cache_directory` (none if empty). Throws Failure (P002) with the compiler's messages.
std::vector<std::uint32_t> compile_shader(const std::string& path, const std::vector<MadeText>& made,
                                          const std::string& cache_directory, std::span<const gpu::ShaderDefine> defines = {});

} // namespace mote::passes
