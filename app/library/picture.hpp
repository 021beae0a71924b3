// SPDX-License-Identifier: MIT
// A finished picture in memory, and its way into files: PNG (display values), EXR (scene-linear, with
// AOVs as channels), NPY (AOVs). Whoever drew it, device or reference, fills the same arrays. Row 0
// is on top; arrays that nobody asked for are empty.
#pragma once

#include "core/math/camera.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mote::app {

struct DrawnPicture {
  Size2d size{};
  std::vector<std::uint8_t> rgba8{}; // display values, straight alpha
  std::vector<float> display{};      // the same as 4 floats a pixel, 0..1, when more than 8 bits are wanted
  std::vector<float> linear{};       // scene-linear RGBA, straight alpha
  std::vector<float> depth{};        // along the view axis; +inf where nothing is
  std::vector<std::uint32_t> id{};   // 0xFFFFFFFF where nothing is
  std::vector<float> normal{};       // x y z, world; 0 where nothing is
};

using Provenance = std::vector<std::pair<std::string, std::string>>;

struct SaveOptions {
  unsigned bits{8}; // of a PNG: 8 or 16
  bool keep_alpha{};
  Provenance provenance{};
};

enum class FileKind : std::uint8_t { Png, Exr, Npy, Unknown };
// By the ending, in any case; "-" is a PNG on standard output.
FileKind file_kind(const std::string& path);

// PNG or EXR by the ending. An EXR holds RGBA as half and, of the AOVs that are there, Z, id and normal.X/Y/Z.
// Throws what the writers throw (I001..I008).
void save_picture(const std::string& path, const DrawnPicture& picture, const SaveOptions& options);

// One AOV as .npy: depth <f4 [h, w], id <u4 [h, w], normal <f4 [h, w, 3].
void save_depth(const std::string& path, const DrawnPicture& picture);
void save_id(const std::string& path, const DrawnPicture& picture);
void save_normal(const std::string& path, const DrawnPicture& picture);

} // namespace mote::app
