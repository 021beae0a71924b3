// SPDX-License-Identifier: MIT
// Bytes::unpack_other(): files packed with xz (.xz format 1.1.0) and zstd (RFC 8878), several streams behind
// one another, into memory. gzip is in bytes.cpp.
#include "core/data/bytes.hpp"
#include "core/data/codes_fields.hpp"

#include <fmt/format.h>
#include <lzma.h>
#include <zstd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <tuple>
#include <utility>

namespace mote::data {
namespace {

// Memory that grows by half, never beyond the limit.
class Growing {
public:
  Growing(const std::string& name, std::uint64_t limit) : name_(name), limit_(limit) {}
  Growing(const Growing&) = delete;
  Growing& operator=(const Growing&) = delete;
  ~Growing() { std::free(data_); }

  [[nodiscard]] char* free_begin() { return data_ + size_; }
  [[nodiscard]] std::size_t free_size() const { return capacity_ - size_; }
  void used(std::size_t bytes) { size_ += bytes; }
  void make_room() {
    if (size_ < capacity_) return;
    const std::uint64_t wanted =
        std::min<std::uint64_t>(limit_, std::max<std::uint64_t>(1 << 16, capacity_ + capacity_ / 2));
    void* larger = wanted > capacity_ ? std::realloc(data_, wanted) : nullptr;
    if (!larger)
      fail(Exit::BadInput, code::memory, {name_},
           fmt::format("the content needs more than {} MiB of memory, which is all that may be used",
                       size_ >> 20),
           {"unpack the file first: a plain file is mapped and may be larger than the memory"});
    data_ = static_cast<char*>(larger);
    capacity_ = wanted;
  }
  std::pair<char*, std::size_t> take() { return {std::exchange(data_, nullptr), size_}; }

private:
  const std::string& name_;
  std::uint64_t limit_;
  char* data_{};
  std::size_t size_{}, capacity_{};
};

[[noreturn]] void damaged(const Bytes& bytes, std::uint64_t at, std::string_view kind, std::string_view why) {
  if (at >= bytes.view().size())
    fail(Exit::BadInput, field_code::packed, byte_place(bytes, at),
         fmt::format("the {} stream is cut off: the file ends after {} bytes, and its end is missing", kind,
                     at));
  fail(Exit::BadInput, field_code::packed, byte_place(bytes, at),
       fmt::format("the {} stream is damaged ({})", kind, why));
}

void unpack_xz(const Bytes& bytes, Growing& out, std::uint64_t limit) {
  const std::string_view packed = bytes.view();
  lzma_stream stream = LZMA_STREAM_INIT;
  const auto close = [](lzma_stream* s) { lzma_end(s); };
  const std::unique_ptr<lzma_stream, decltype(close)> guard(&stream, close);
  if (lzma_stream_decoder(&stream, limit, LZMA_CONCATENATED) != LZMA_OK)
    damaged(bytes, 0, "xz", "no memory for the decoder");
  stream.next_in = reinterpret_cast<const std::uint8_t*>(packed.data());
  stream.avail_in = packed.size();
  for (;;) {
    out.make_room();
    const std::size_t room = out.free_size();
    stream.next_out = reinterpret_cast<std::uint8_t*>(out.free_begin());
    stream.avail_out = room;
    const lzma_ret state = lzma_code(&stream, stream.avail_in ? LZMA_RUN : LZMA_FINISH);
    out.used(room - stream.avail_out);
    if (state == LZMA_STREAM_END) return;
    const std::uint64_t at = packed.size() - stream.avail_in;
    if (state == LZMA_BUF_ERROR) damaged(bytes, packed.size(), "xz", "");
    if (state == LZMA_MEMLIMIT_ERROR || state == LZMA_MEM_ERROR)
      fail(Exit::BadInput, code::memory, byte_place(bytes, at),
           fmt::format("the xz decoder needs {} MiB of memory", lzma_memusage(&stream) >> 20));
    if (state != LZMA_OK)
      damaged(bytes, std::min<std::uint64_t>(at, packed.size() - 1), "xz",
              state == LZMA_OPTIONS_ERROR ? "unknown options" : "bad data");
  }
}

void unpack_zstd(const Bytes& bytes, Growing& out) {
  const std::string_view packed = bytes.view();
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(),
                                                                             ZSTD_freeDStream);
  if (!stream || ZSTD_isError(ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, 31)))
    damaged(bytes, 0, "zstd", "no memory for the decoder");
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t more = 1; // 0: a frame is complete
  while (in.pos < in.size || more != 0) {
    out.make_room();
    ZSTD_outBuffer to{out.free_begin(), out.free_size(), 0};
    const std::size_t before = in.pos;
    more = ZSTD_decompressStream(stream.get(), &to, &in);
    if (ZSTD_isError(more)) damaged(bytes, std::min(in.pos, in.size - 1), "zstd", ZSTD_getErrorName(more));
    out.used(to.pos);
    if (more != 0 && in.pos == before && to.pos == 0) damaged(bytes, packed.size(), "zstd", "");
  }
}

} // namespace

void Bytes::unpack_other(std::uint64_t limit) {
  const bool xz = view().starts_with(std::string_view("\xfd"
                                                      "7zXZ\0",
                                                      6));
  const bool zstd = view().starts_with("\x28\xb5\x2f\xfd");
  if (!xz && !zstd) return;
  Growing out(name_, limit);
  xz ? unpack_xz(*this, out, limit) : unpack_zstd(*this, out);
  release();
  compressed_ = true;
  std::tie(data_, size_) = out.take();
}

} // namespace mote::data
