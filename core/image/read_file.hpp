// SPDX-License-Identifier: MIT
// Private to core/image: a whole file in memory, with the message that every reader here gives when
// the disk refuses. Pictures and arrays are read for comparison and tests; particle data have their
// own readers.
#pragma once

#include "core/base/diagnostic.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace mote {

// Failure(BadInput) I004.
inline std::vector<std::byte> read_whole_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  int error = file ? 0 : errno;
  std::vector<std::byte> out;
  while (error == 0) {
    const std::size_t start = out.size(), step = start < 65536 ? 65536 : start;
    out.resize(start + step);
    errno = 0;
    const std::size_t n = std::fread(out.data() + start, 1, step, file.get());
    out.resize(start + n);
    if (n < step) {
      if (std::ferror(file.get())) error = errno != 0 ? errno : EIO;
      break;
    }
  }
  if (error != 0)
    fail(Exit::BadInput, "I004", {path}, fmt::format("'{}' cannot be read: {}", path, std::strerror(error)));
  return out;
}

} // namespace mote
