// SPDX-License-Identifier: MIT
#include "app/library/sequence.hpp"

#include "app/codes.hpp"
#include "app/library/picture.hpp"
#include "core/base/diagnostic.hpp"
#include "core/image/exr.hpp"
#include "core/image/npy.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>

namespace mote::app {
namespace {

// The place of "%d" or "%0Nd" in a name.
struct Number {
  std::size_t at{}, length{};
  int width{};
};
std::optional<Number> find_number(std::string_view name) {
  for (std::size_t at = name.find('%'); at != std::string_view::npos; at = name.find('%', at)) {
    if (name.substr(at + 1).starts_with('%')) {
      at += 2;
      continue;
    }
    std::size_t end = at + 1;
    int width = 0;
    while (end < name.size() && name[end] >= '0' && name[end] <= '9' && width < 100) width = 10 * width + (name[end++] - '0');
    if (end < name.size() && name[end] == 'd' && width <= 20) return Number{at, end + 1 - at, width};
    at = end;
  }
  return std::nullopt;
}

std::string without_doubles(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    out += text[i];
    if (text[i] == '%' && i + 1 < text.size() && text[i + 1] == '%') ++i;
  }
  return out;
}

bool is_complete_png(const std::string& path, Size2d size) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 24> head{};
  std::array<char, 12> tail{};
  if (!file.read(head.data(), head.size())) return false;
  if (!file.seekg(-12, std::ios::end) || !file.read(tail.data(), tail.size())) return false;
  auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(head[at + k]);
    return value;
  };
  return std::string_view(head.data(), 8) == "\x89PNG\r\n\x1a\n" && word(16) == size.width && word(20) == size.height &&
         std::string_view(tail.data() + 4, 4) == "IEND";
}

} // namespace

bool is_numbered(std::string_view name) { return find_number(name).has_value(); }

std::string numbered(std::string_view name, std::uint64_t number) {
  const std::optional<Number> found = find_number(name);
  if (!found || find_number(name.substr(found->at + found->length)))
    fail(Exit::Usage, code::numbered_output, {"-o"}, fmt::format("'{}' must have one place for the number of the frame", name),
         {"For example -o out_%04d.png; %% is a percent sign"});
  return without_doubles(name.substr(0, found->at)) + fmt::format("{:0{}}", number, found->width) + without_doubles(name.substr(found->at + found->length));
}

Shard parse_shard(std::string_view text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, shard.part);
  const bool middle = first == std::errc{} && slash != end && *slash == '/';
  const auto [last, second] = std::from_chars(middle ? slash + 1 : end, end, shard.parts);
  if (!middle || second != std::errc{} || last != end || shard.parts == 0 || shard.part > shard.parts)
    fail(Exit::Usage, code::shard, {"--shard"}, fmt::format("'{}' is not K/N", text),
         {"--shard 3/8 draws every eighth frame; K counts from 0 to N - 1 or from 1 to N, as the array of jobs does"});
  return shard;
}

std::vector<std::uint64_t> part_of(const std::vector<std::uint64_t>& all, const Shard& shard) {
  std::vector<std::uint64_t> out;
  for (std::uint64_t i = shard.part % shard.parts; i < all.size(); i += shard.parts) out.push_back(all[i]);
  return out;
}

bool is_complete(const std::string& path, Size2d size) {
  try {
    switch (file_kind(path)) {
    case FileKind::Png: return is_complete_png(path, size);
    case FileKind::Exr: {
      if (!std::ifstream(path)) return false;
      const ExrPicture picture = read_exr(path);
      return picture.width == size.width && picture.height == size.height;
    }
    case FileKind::Npy: {
      if (!std::ifstream(path)) return false;
      const NpyArray array = read_npy(path);
      return array.shape.size() >= 2 && array.shape[0] == size.height && array.shape[1] == size.width;
    }
    case FileKind::Unknown: return false;
    }
  } catch (const Failure&) {
  }
  return false;
}

} // namespace mote::app
