// SPDX-License-Identifier: MIT
#include "core/data/binary.hpp"

#include "core/data/codes_molecular.hpp"

#include <fmt/format.h>

namespace mote::data {
namespace {
constexpr std::uint64_t pages_kept = std::uint64_t{64} << 20; // bytes
}

void ByteReader::refuse(std::string_view code, std::string text, std::vector<std::string> hints) const {
  refuse_at(at_, code, std::move(text), std::move(hints));
}

void ByteReader::refuse_at(std::uint64_t at, std::string_view code, std::string text,
                           std::vector<std::string> hints) const {
  fail(Exit::BadInput, code, byte_place(*bytes_, at), std::move(text), std::move(hints));
}

void ByteReader::ends(std::uint64_t count, std::string_view what) const {
  refuse(code::ends_early, fmt::format("the file ends within {}: {} {} needed here, {} left", what, count,
                                       count == 1 ? "byte is" : "bytes are", left()));
}

BinarySource::BinarySource(std::shared_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
  warnings_.append(bytes_->warnings());
}

void BinarySource::no_such_frame(std::uint64_t frame, std::uint64_t count) const {
  if (count == 0)
    fail(Exit::BadInput, code::no_frame, {bytes_->name()}, "the file has no frame with positions");
  fail(Exit::BadInput, code::no_frame, {bytes_->name()},
       fmt::format("there is no frame {}: the file has {} {} (0 to {})", frame, count,
                   count == 1 ? "frame" : "frames", count - 1));
}

// The next frame with positions; false when there is none.
bool BinaryTrajectory::look_further() {
  ByteReader in = reader(order_, next_);
  while (in.left() > 0) {
    const std::uint64_t start = in.at();
    bool wanted = false;
    try {
      wanted = skip_frame(in);
    } catch (const Failure& failure) {
      if (failure.diagnostic().code != code::ends_early || starts_.empty()) throw;
      warnings_.warning(
          code::cut_frame, byte_place(bytes(), start),
          fmt::format("frame {} is cut off and left out: the file ends within it", starts_.size()));
      break;
    }
    next_ = in.at();
    if (next_ - released_ > pages_kept) { // where the file is in the kernel's cache, whole stretches around a head become resident
      bytes().release_pages();
      released_ = next_;
    }
    if (wanted) {
      starts_.push_back(start);
      return true;
    }
    ++skipped_;
  }
  complete_ = true;
  if (skipped_ > 0)
    warnings_.warning(
        molecule_code::left_out, {bytes().name()},
        fmt::format("{} {} without positions left out", skipped_, skipped_ == 1 ? "frame is" : "frames are"));
  return false;
}

std::uint64_t BinaryTrajectory::frame_count() {
  while (!complete_) look_further();
  if (starts_.empty()) no_such_frame(0, 0);
  return starts_.size();
}

Frame BinaryTrajectory::read(std::uint64_t frame) {
  while (!complete_ && starts_.size() <= frame) look_further();
  if (frame >= starts_.size()) no_such_frame(frame, starts_.size());
  return read_frame(reader(order_, starts_[frame]));
}

} // namespace mote::data
