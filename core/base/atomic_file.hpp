// SPDX-License-Identifier: MIT
// A file that is there completely or not at all. Everything that mote writes goes through here: bytes
// go to NAME.tmp.PID in the same folder, every error is looked at (a full disk often shows only on
// the last write), and only commit() gives the file its name, so that a reader, a second process of a
// job array or a power cut never meets half a picture. Without commit() the destructor removes the
// temporary and an older file of that name stays as it was.
//
// "-" is standard output. A name that exists and is no regular file (/dev/full, a pipe) is written in
// place, as nothing may be renamed over it. A symbolic link is followed. Not for concurrent use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

class AtomicFile {
public:
  explicit AtomicFile(const std::string& path); // Failure(Failed) I001
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes); // I002
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  // Flushes, closes and renames. `sync`: waits for the disk, too. At most once. I002, I003.
  void commit(bool sync = false);

private:
  void flush();
  [[noreturn]] void failed_to_write(int error);

  std::string path_, target_, temporary_; // as given, behind links, written to (empty: in place)
  int fd_{-1};
  bool close_{true};
  std::vector<std::byte> buffer_;
};

// The whole content at once.
void write_file(const std::string& path, std::span<const std::byte> bytes, bool sync = false);
void write_file(const std::string& path, std::string_view text, bool sync = false);

} // namespace mote
