// SPDX-License-Identifier: MIT
#include "core/data/bytes.hpp"

#include "core/data/codes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

namespace mote::data {
namespace {

[[noreturn]] void refuse(std::string_view code, const SourceLoc& loc, std::string text,
                         std::vector<std::string> hints = {}) {
  fail(Exit::BadInput, code, loc, std::move(text), std::move(hints));
}

std::uint64_t default_limit() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::uint64_t{1} << 32;
  return static_cast<std::uint64_t>(pages) / 4 * 3 * static_cast<std::uint64_t>(page);
}

std::string as_mebibytes(std::uint64_t bytes) {
  return fmt::format("{} MiB", (bytes + (1u << 20) - 1) >> 20);
}

// A growing block of memory that is not zeroed first; grows by half, never beyond `limit`.
struct Block {
  char* data{};
  std::size_t size{}, capacity{};
  Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  ~Block() { std::free(data); }
  bool reserve(std::size_t wanted) {
    if (wanted <= capacity) return true;
    char* larger = static_cast<char*>(std::realloc(data, wanted));
    if (!larger) return false;
    data = larger;
    capacity = wanted;
    return true;
  }
  bool grow(std::uint64_t limit) {
    if (capacity >= limit) return false;
    return reserve(static_cast<std::size_t>(
        std::min<std::uint64_t>(limit, std::max<std::size_t>(1 << 16, capacity + capacity / 2))));
  }
};

[[noreturn]] void too_large(const std::string& name, std::uint64_t need, bool exact, std::uint64_t limit) {
  refuse(code::memory, {name},
         fmt::format("the content needs {} {} of memory, but {} may be used", exact ? "about" : "more than",
                     as_mebibytes(need), as_mebibytes(limit)),
         {"unpack the file first: a plain file is mapped and may be larger than the memory"});
}

std::string near_name(const std::filesystem::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  const auto folder = file.parent_path().empty() ? std::filesystem::path(".") : file.parent_path();
  for (std::filesystem::directory_iterator it(folder, ignored), end; it != end && names.size() < 2000;
       it.increment(ignored)) {
    if (ignored) break;
    names.push_back(it->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return did_you_mean(file.filename().string(), names);
}

struct Descriptor {
  int number{-1};
  ~Descriptor() {
    if (number > 0) ::close(number);
  }
};

// One zlib inflater for gzip members.
struct Inflater {
  z_stream stream{};
  Inflater() { ready = inflateInit2(&stream, 15 + 16) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream); }
  bool ready{};
};

bool is_gzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

// The length that the last member states about itself, modulo 2^32 (RFC 1952, ISIZE), as a guess of
// how much to reserve; deflate packs at most 1032 : 1.
std::uint64_t stated_length(std::string_view packed) {
  if (packed.size() < 18) return 0;
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= static_cast<std::uint32_t>(static_cast<unsigned char>(packed[packed.size() - 4 + i]))
              << (8 * i);
  return std::min<std::uint64_t>(length, packed.size() * std::uint64_t{1032});
}

} // namespace

SourceLoc byte_place(const Bytes& bytes, std::uint64_t at) {
  return {bytes.name(), 0, 0, static_cast<std::int64_t>(at)};
}

Bytes::~Bytes() { release(); }

void Bytes::release() {
  if (mapped_)
    ::munmap(data_, size_);
  else
    std::free(data_);
  data_ = nullptr;
  size_ = 0;
  mapped_ = false;
}

void Bytes::release_pages() const {
  if (mapped_) ::madvise(data_, size_, MADV_DONTNEED);
}

std::shared_ptr<Bytes> Bytes::load(const std::filesystem::path& file, std::uint64_t limit) {
  std::shared_ptr<Bytes> bytes(new Bytes);
  const bool standard_input = file == "-";
  bytes->name_ = standard_input ? "(standard input)" : file.string();
  if (limit == 0) limit = default_limit();
  Descriptor descriptor;
  descriptor.number = standard_input ? 0 : ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor.number < 0) {
    const int reason = errno;
    refuse(code::cannot_open, {bytes->name_},
           fmt::format("the file cannot be opened: {}", std::generic_category().message(reason)),
           {reason == ENOENT ? near_name(file) : std::string{}});
  }
  bytes->map_or_read(descriptor.number, limit);
  if (is_gzip(bytes->view())) bytes->inflate_all(limit);
  else bytes->unpack_other(limit);
  if (bytes->size_ == 0) refuse(code::empty, {bytes->name_}, "the file is empty");
  return bytes;
}

std::shared_ptr<Bytes> Bytes::from_memory(std::string name, std::string_view content, std::uint64_t limit) {
  std::shared_ptr<Bytes> bytes(new Bytes);
  bytes->name_ = std::move(name);
  if (limit == 0) limit = default_limit();
  bytes->data_ = static_cast<char*>(std::malloc(std::max<std::size_t>(content.size(), 1)));
  if (!bytes->data_) too_large(bytes->name_, content.size(), true, limit);
  std::copy(content.begin(), content.end(), bytes->data_);
  bytes->size_ = content.size();
  if (is_gzip(bytes->view())) bytes->inflate_all(limit);
  else bytes->unpack_other(limit);
  if (bytes->size_ == 0) refuse(code::empty, {bytes->name_}, "the file is empty");
  return bytes;
}

void Bytes::map_or_read(int descriptor, std::uint64_t limit) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    refuse(code::cannot_open, {name_},
           fmt::format("the file cannot be read: {}", std::generic_category().message(errno)));
  if (S_ISDIR(status.st_mode)) refuse(code::cannot_open, {name_}, "this is a folder, not a file");
  if (S_ISREG(status.st_mode) && status.st_size > 0) {
    void* memory =
        ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (memory != MAP_FAILED) {
      data_ = static_cast<char*>(memory);
      size_ = static_cast<std::size_t>(status.st_size);
      mapped_ = true;
      ::madvise(memory, size_, MADV_SEQUENTIAL);
      return;
    }
  }
  Block block; // a pipe, a device, or a file system that does not map
  for (;;) {
    if (block.size == block.capacity && !block.grow(limit)) too_large(name_, block.size, false, limit);
    const ssize_t got = ::read(descriptor, block.data + block.size, block.capacity - block.size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      refuse(code::cannot_open, {name_},
             fmt::format("the file cannot be read: {}", std::generic_category().message(errno)));
    if (got == 0) break;
    block.size += static_cast<std::size_t>(got);
  }
  data_ = std::exchange(block.data, nullptr);
  size_ = block.size;
}

// Inflates every gzip member, one behind the other (RFC 1952). Zero bytes behind the last member are
// padding; other bytes are ignored with a warning, as gzip(1) does. A missing end or a wrong check
// sum is D003, at the byte of the packed file.
void Bytes::inflate_all(std::uint64_t limit) {
  const std::string_view packed = view();
  const std::uint64_t stated = stated_length(packed);
  if (stated > limit) too_large(name_, stated, true, limit);
  Block out;
  if (!out.reserve(static_cast<std::size_t>(stated) + 64)) too_large(name_, stated, true, limit);
  Inflater inflater;
  if (!inflater.ready) too_large(name_, 1 << 16, true, limit);
  z_stream& z = inflater.stream;
  std::size_t used = 0;
  for (;;) {
    if (out.size == out.capacity && !out.grow(limit)) too_large(name_, out.size, false, limit);
    const std::size_t piece_in = std::min<std::size_t>(packed.size() - used, 1u << 30);
    const std::size_t piece_out = std::min<std::size_t>(out.capacity - out.size, 1u << 30);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + used));
    z.avail_in = static_cast<uInt>(piece_in);
    z.next_out = reinterpret_cast<Bytef*>(out.data + out.size);
    z.avail_out = static_cast<uInt>(piece_out);
    const int state = ::inflate(&z, Z_NO_FLUSH);
    used += piece_in - z.avail_in;
    out.size += piece_out - z.avail_out;
    if (state == Z_STREAM_END) {
      const std::size_t next = packed.find_first_not_of('\0', used);
      if (next == std::string_view::npos) break;
      if (!is_gzip(packed.substr(next))) {
        warnings_.warning(code::trailing, byte_place(*this, next),
                          "bytes behind the gzip stream are ignored");
        break;
      }
      used = next;
      inflateReset(&z);
    } else if (state == Z_BUF_ERROR && used == packed.size() && out.size < out.capacity) {
      refuse(code::gzip, byte_place(*this, used),
             fmt::format("the gzip stream is cut off: the file ends after {} bytes, and its end is missing",
                         used));
    } else if (state != Z_OK && state != Z_BUF_ERROR) {
      refuse(code::gzip, byte_place(*this, used),
             fmt::format("the gzip stream is damaged ({})", z.msg ? z.msg : "bad data"));
    }
  }
  release();
  compressed_ = true;
  data_ = std::exchange(out.data, nullptr);
  size_ = out.size;
}

std::string_view Bytes::text() {
  std::string_view all = view();
  if (all.starts_with("\xef\xbb\xbf")) all.remove_prefix(3);
  const std::string_view head = all.substr(0, 1 << 16);
  bool lone = false;
  for (std::size_t at = head.find('\r'); at != std::string_view::npos && !lone; at = head.find('\r', at + 1))
    lone = at + 1 < all.size() && all[at + 1] != '\n' && all[at + 1] != '\r';
  if (!lone) return all;
  rewritten_.assign(all);
  for (std::size_t i = 0; i < rewritten_.size(); ++i)
    if (rewritten_[i] == '\r' && (i + 1 == rewritten_.size() || rewritten_[i + 1] != '\n'))
      rewritten_[i] = '\n';
  return rewritten_;
}

} // namespace mote::data
