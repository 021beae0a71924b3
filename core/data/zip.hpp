// SPDX-License-Identifier: MIT
// The members of a zip archive by its central directory (APPNOTE.TXT, with zip64), stored or deflated; check
// sums are compared. For .npz files; knows nothing of what the members mean.
//
// Errors: D006 (the directory or a member lies outside of the file), D060 (damaged), D065 (encrypted, other
// methods).
#pragma once

#include "core/data/bytes.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mote::data {

struct ZipMember {
  std::string name{};
  std::uint64_t packed{}, size{}; // bytes in the archive and unpacked
  std::uint64_t header{};         // offset of the local header
  std::uint32_t check{};          // CRC-32 of the unpacked bytes
  std::uint16_t method{}, flags{};
};

std::vector<ZipMember> zip_members(const Bytes& archive);
std::string unzip(const Bytes& archive, const ZipMember& member);

} // namespace mote::data
