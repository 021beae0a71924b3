// SPDX-License-Identifier: MIT
#include "core/base/atomic_file.hpp"

#include "core/base/diagnostic.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace mote {

namespace {
constexpr std::size_t buffer_size = std::size_t{1} << 20;

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

std::string behind_links(const std::string& path) {
  char* resolved = ::realpath(path.c_str(), nullptr); // null when there is no such file yet
  std::string out = resolved ? resolved : path;
  std::free(resolved);
  return out;
}

std::vector<std::string> reason(int error, const std::string& path) {
  struct stat info {};
  if (error == ENOENT && ::stat(folder_of(path).c_str(), &info) != 0)
    return {fmt::format("there is no folder '{}'", folder_of(path))};
  return {};
}
} // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  buffer_.reserve(buffer_size);
  if (path == "-") {
    fd_ = STDOUT_FILENO;
    close_ = false;
    return;
  }
  struct stat info {};
  const bool exists = ::stat(path.c_str(), &info) == 0;
  target_ = exists ? behind_links(path) : path;
  const bool in_place = exists && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
  if (!in_place) temporary_ = fmt::format("{}.tmp.{}", target_, ::getpid());
  int error = 0;
  if (exists && S_ISDIR(info.st_mode))
    error = EISDIR;
  else if (path.empty())
    error = ENOENT;
  else {
    fd_ =
        ::open(in_place ? path.c_str() : temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd_ < 0) error = errno;
  }
  if (error != 0)
    fail(Exit::Failed, "I001", {path}, fmt::format("'{}' cannot be written: {}", path, std::strerror(error)),
         reason(error, path));
  // an overwritten file keeps its permissions; where that is not allowed the default ones do
  if (exists && !in_place && ::fchmod(fd_, info.st_mode & 07777) != 0) errno = 0;
}

AtomicFile::~AtomicFile() {
  if (fd_ < 0) return;
  if (close_) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::failed_to_write(int error) {
  fail(Exit::Failed, "I002", {path_},
       fmt::format("'{}' cannot be written: {}", path_ == "-" ? "standard output" : path_,
                   std::strerror(error)),
       {error == ENOSPC && !temporary_.empty() ? fmt::format("the disk of '{}' is full", folder_of(target_))
                                               : ""});
}

void AtomicFile::flush() {
  const std::byte* data = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t n = ::write(fd_, data, left);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) failed_to_write(errno);
    data += n;
    left -= static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t n = std::min(bytes.size(), buffer_size - buffer_.size());
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
    bytes = bytes.subspan(n);
    if (buffer_.size() == buffer_size) flush();
  }
}

void AtomicFile::commit(bool sync) {
  flush();
  if (!close_) return;
  if (sync && !temporary_.empty() && ::fsync(fd_) != 0) failed_to_write(errno);
  const int fd = std::exchange(fd_, -1);
  if (::close(fd) != 0 && errno != EINTR) { // network disks report late
    const int error = errno;
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    failed_to_write(error);
  }
  if (temporary_.empty() || ::rename(temporary_.c_str(), target_.c_str()) == 0) return;
  const int error = errno;
  ::unlink(temporary_.c_str());
  fail(Exit::Failed, "I003", {path_},
       fmt::format("'{}' cannot be put in its place: {}", path_, std::strerror(error)));
}

void write_file(const std::string& path, std::span<const std::byte> bytes, bool sync) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit(sync);
}
void write_file(const std::string& path, std::string_view text, bool sync) {
  write_file(path, std::as_bytes(std::span(text)), sync);
}

} // namespace mote
