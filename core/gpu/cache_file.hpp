// SPDX-License-Identifier: MIT
// Small files that may be lost at any time: read whole, written aside and renamed, checksummed.
// Used by the pipeline cache and the SPIR-V cache. Header-only, so that the two libraries share it
// without depending on each other. Nothing here reports an error: a cache that fails is an empty cache.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::gpu {

// FNV-1a, 64 bit (Fowler, Noll, Vo; draft-eastlake-fnv).
inline std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = 14695981039346656037ull) {
  std::uint64_t hash = seed;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 1099511628211ull;
  return hash;
}
// Its length goes in first, so that ("ab","c") and ("a","bc") differ.
inline std::uint64_t hash_text(std::string_view text, std::uint64_t seed = 14695981039346656037ull) {
  const std::uint64_t size = text.size();
  return hash_bytes(std::as_bytes(std::span(text)), hash_bytes(std::as_bytes(std::span(&size, 1)), seed));
}

inline std::optional<std::vector<std::byte>> read_cache_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return std::nullopt;
  const std::streamoff size = in.tellg();
  if (size < 0) return std::nullopt;
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) return std::nullopt;
  return bytes;
}

// Readers see the old file or the new one, never half of it. False: nothing was changed.
inline bool write_cache_file(const std::string& path, std::span<const std::byte> bytes) {
  std::error_code ignored;
  const std::filesystem::path target(path);
  std::filesystem::create_directories(target.parent_path(), ignored);
  const std::string aside = path + ".tmp" + std::to_string(::getpid());
  {
    std::ofstream out(aside, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.flush();
    if (!out) {
      out.close();
      std::filesystem::remove(aside, ignored);
      return false;
    }
  }
  std::error_code failed;
  std::filesystem::rename(aside, target, failed);
  if (failed) std::filesystem::remove(aside, ignored);
  return !failed;
}

} // namespace mote::gpu
