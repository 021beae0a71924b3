// SPDX-License-Identifier: MIT
#include "shaders/embedded.hpp"

namespace mote::shaders {
namespace {
struct SpirvRow {
  std::string_view key;
  std::span<const std::uint32_t> words;
};
struct TextRow {
  std::string_view path;
  std::string_view text;
};
#include "embedded_tables.inc"
} // namespace

std::span<const std::uint32_t> spirv(std::string_view key) {
  for (const SpirvRow& row : spirv_rows)
    if (row.key == key) return row.words;
  return {};
}

std::string_view text(std::string_view path) {
  for (const TextRow& row : text_rows)
    if (row.path == path) return row.text;
  return {};
}

std::vector<std::string_view> spirv_keys() {
  std::vector<std::string_view> keys;
  for (const SpirvRow& row : spirv_rows) keys.push_back(row.key);
  return keys;
}

std::vector<std::string_view> text_paths() {
  std::vector<std::string_view> paths;
  for (const TextRow& row : text_rows) paths.push_back(row.path);
  return paths;
}

} // namespace mote::shaders
