// SPDX-License-Identifier: MIT
// The content of a file as one run of bytes, whatever it came from: a plain file is mapped (nothing
// is copied, the kernel pages it in and out), a gzip file is inflated into memory, and so is what a
// pipe delivers. Memory is bounded: what would not fit is refused with the need stated (D004).
// Called by open(); readers keep a shared pointer to it for as long as they live.
// Never writes to the file, never looks at the name to decide what is inside.
#pragma once

#include "core/base/diagnostic.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace mote::data {

class Bytes {
public:
  // `limit`: the most bytes that may be held in memory (not counting mapped files); 0 = three
  // quarters of the machine's memory. "-" is standard input. Errors D001..D004.
  static std::shared_ptr<Bytes> load(const std::filesystem::path& file, std::uint64_t limit = 0);
  // A copy of `content` under the name `name`; gzip is inflated as above. For tests and fuzzing.
  static std::shared_ptr<Bytes> from_memory(std::string name, std::string_view content,
                                            std::uint64_t limit = 0);

  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;
  ~Bytes();

  [[nodiscard]] const std::string& name() const { return name_; }        // for SourceLoc::file
  [[nodiscard]] std::string_view view() const { return {data_, size_}; } // as in the file, inflated
  // The same without a UTF-8 byte order mark. A file whose first 64 KiB hold a line end of the old
  // Macintosh kind (a lone \r) is copied with these turned into \n.
  [[nodiscard]] std::string_view text();
  // Pages of a mapped file leave the memory of this process (the kernel may keep them); nothing otherwise.
  void release_pages() const;
  [[nodiscard]] bool compressed() const { return compressed_; }
  [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

private:
  Bytes() = default;
  void map_or_read(int descriptor, std::uint64_t limit);
  void inflate_all(std::uint64_t limit);
  void unpack_other(std::uint64_t limit); // xz and zstd (unpack_bytes.cpp); nothing for other content
  void release();

  std::string name_{};
  char* data_{};
  std::size_t size_{};
  bool mapped_{};
  bool compressed_{};
  std::string rewritten_{}; // text() with other line ends
  Diagnostics warnings_{};
};

// The same place for all: byte `at` of the file (binary formats).
[[nodiscard]] SourceLoc byte_place(const Bytes& bytes, std::uint64_t at);

} // namespace mote::data
