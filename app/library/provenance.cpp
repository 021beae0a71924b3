// SPDX-License-Identifier: MIT
#include "app/library/provenance.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace mote::app {
namespace {

constexpr std::size_t longest_scene = 65536; // bytes of a scene file that a picture carries

std::string vec_text(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

// The files that were read, as they were named.
std::string input_text(const SceneDesc& desc) {
  std::string text;
  auto add = [&](const std::filesystem::path& file) {
    if (!file.empty()) text += (text.empty() ? "" : ", ") + file.string();
  };
  for (const DataDesc& data : desc.data) {
    add(data.file.value);
    for (const auto& file : data.further) add(file);
    for (const auto& file : data.trajectory) add(file);
  }
  return text.empty() ? desc.name : text;
}

std::string scene_text(const SceneDesc& desc) {
  if (!is_scene_path(desc.name)) return {};
  std::ifstream file(desc.name, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  return text.size() <= longest_scene ? text : std::string{};
}

// Bytes that are no UTF-8 become '?': file names may be anything, the texts of a PNG may not.
std::string as_utf8(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80 ? 1 : first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : first >= 0xF0 && first < 0xF5 ? 4 : 0;
    bool whole = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; whole && k < length; ++k) whole = (static_cast<unsigned char>(text[i + k]) & 0xC0u) == 0x80u;
    out += whole ? text.substr(i, length) : "?";
    i += whole ? length : 1;
  }
  return out;
}

} // namespace

std::string camera_text(const Camera& c) {
  std::string text = fmt::format("eye = {}, target = {}, up = {}, ", vec_text(c.eye), vec_text(c.target), vec_text(c.up));
  text += c.projection == Projection::Perspective ? fmt::format("fov_y = {}", c.fov_y)
                                                  : fmt::format("projection = \"orthographic\", height = {}", c.height);
  if (c.near) text += fmt::format(", near = {}", *c.near);
  if (c.far) text += fmt::format(", far = {}", *c.far);
  return text;
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+@%") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

Provenance provenance_of(const Job& job, const std::string& version, const std::string& command, const std::string& drawn_by,
                         const std::string& display) {
  Provenance p{{"Software", version},
               {"Command", command},
               {"Source", job.desc.name},
               {"Input", input_text(job.desc)},
               {"Camera", camera_text(job.scene.camera)},
               {"Graph", drawn_by.starts_with("double-precision") ? "reference" : job.graph.graph},
               {"Device", drawn_by},
               {"View transform", display}};
  if (job.frame) p.emplace_back("Frame", fmt::format("{}", *job.frame));
  if (std::string scene = scene_text(job.desc); !scene.empty()) p.emplace_back("Scene", std::move(scene));
  for (auto& [key, value] : p) value = as_utf8(value);
  return p;
}

} // namespace mote::app
