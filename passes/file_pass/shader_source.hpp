// SPDX-License-Identifier: MIT
// The GLSL file of a pass from a file: read, compiled behind its preamble, checked against what its
// pass.toml declares, and watched for changes. No device. Used by file_pass.cpp.
#pragma once

#include "core/base/diagnostic.hpp"
#include "passes/file_pass/pass_file.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mote::passes {

struct CheckedShader {
  std::vector<std::uint32_t> spirv{};         // empty when there was an error
  std::array<std::uint32_t, 3> local_size{};  // compute
  Diagnostics problems{};                     // P002 does not compile, P013 uses what is not declared; at the shader's lines
};

class ShaderSource {
public:
  // `word`: a path, or the name of a shipped pass (no '/' and no ending): its folder of shaders/passes.
  static ShaderSource locate(const std::string& word, const std::string& resolved_path);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string description_path() const; // pass.toml beside it
  [[nodiscard]] std::optional<std::string> description() const;
  [[nodiscard]] bool exists() const { return text_of(path_).has_value(); }
  static std::vector<std::string> shipped(); // names

  CheckedShader compile(const PassFile& file, bool compute);
  // Has the shader, its pass.toml or anything that it includes another time of writing than at the last compile()?
  [[nodiscard]] bool changed() const;

private:
  [[nodiscard]] std::optional<std::string> text_of(const std::string& path) const;
  [[nodiscard]] std::string on_disk(const std::string& path) const; // empty: only within the program
  void watch(const std::string& path);

  std::string path_{};
  bool shipped_{};
  std::vector<std::pair<std::string, std::filesystem::file_time_type>> watched_{};
};

} // namespace mote::passes
