// SPDX-License-Identifier: MIT
#include "app/library/picture.hpp"

#include "core/image/exr.hpp"
#include "core/image/npy.hpp"
#include "core/image/png.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace mote::app {
namespace {

bool ends_with(const std::string& path, std::string_view ending) {
  if (path.size() < ending.size()) return false;
  return std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

std::uint16_t to_16bit(float value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value > 0.0f ? value : 0.0f, 0.0f, 1.0f) * 65535.0f));
}

void save_png(const std::string& path, const DrawnPicture& picture, const SaveOptions& options) {
  const PngOptions png{.text = options.provenance, .keep_alpha = options.keep_alpha};
  if (options.bits == 16) {
    std::vector<std::uint16_t> deep(picture.display.size());
    std::transform(picture.display.begin(), picture.display.end(), deep.begin(), to_16bit);
    write_png(path, picture.size.width, picture.size.height, std::span<const std::uint16_t>(deep), png);
  } else {
    write_png(path, picture.size.width, picture.size.height, std::span<const std::uint8_t>(picture.rgba8), png);
  }
}

void save_exr(const std::string& path, const DrawnPicture& picture, const SaveOptions& options) {
  std::vector<ExrPlane> planes;
  const std::array<const char*, 4> colors{"R", "G", "B", "A"};
  for (std::size_t k = 0; k < 4; ++k)
    planes.push_back({.name = colors[k], .type = ExrType::Half, .floats = picture.linear.data() + k, .stride = 4});
  if (!picture.depth.empty()) planes.push_back({.name = "Z", .type = ExrType::Float, .floats = picture.depth.data()});
  if (!picture.id.empty()) planes.push_back({.name = "id", .type = ExrType::Uint, .uints = picture.id.data()});
  const std::array<const char*, 3> axes{"normal.X", "normal.Y", "normal.Z"};
  for (std::size_t k = 0; k < 3 && !picture.normal.empty(); ++k)
    planes.push_back({.name = axes[k], .type = ExrType::Float, .floats = picture.normal.data() + k, .stride = 3});
  write_exr(path, picture.size.width, picture.size.height, planes, options.provenance);
}

} // namespace

FileKind file_kind(const std::string& path) {
  if (path == "-" || ends_with(path, ".png")) return FileKind::Png;
  if (ends_with(path, ".exr")) return FileKind::Exr;
  if (ends_with(path, ".npy")) return FileKind::Npy;
  return FileKind::Unknown;
}

void save_picture(const std::string& path, const DrawnPicture& picture, const SaveOptions& options) {
  if (file_kind(path) == FileKind::Exr) save_exr(path, picture, options);
  else save_png(path, picture, options);
}

void save_depth(const std::string& path, const DrawnPicture& picture) {
  const std::array<std::size_t, 2> shape{picture.size.height, picture.size.width};
  write_npy<float>(path, shape, picture.depth);
}
void save_id(const std::string& path, const DrawnPicture& picture) {
  const std::array<std::size_t, 2> shape{picture.size.height, picture.size.width};
  write_npy<std::uint32_t>(path, shape, picture.id);
}
void save_normal(const std::string& path, const DrawnPicture& picture) {
  const std::array<std::size_t, 3> shape{picture.size.height, picture.size.width, 3};
  write_npy<float>(path, shape, picture.normal);
}

} // namespace mote::app
