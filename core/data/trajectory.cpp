// SPDX-License-Identifier: MIT
#include "core/data/trajectory.hpp"

#include "core/data/codes.hpp"
#include "core/data/codes_molecular.hpp"

#include <fmt/format.h>

namespace mote::data {
namespace {
constexpr std::uint64_t pages_kept = std::uint64_t{64} << 20; // bytes
}

TextTrajectory::TextTrajectory(std::shared_ptr<Bytes> bytes)
    : bytes_(std::move(bytes)), text_(bytes_->text()) {
  warnings_.append(bytes_->warnings());
  Cursor begin(text_);
  begin.skip_blank();
  starts_.push_back({begin.offset(), begin.line()});
}

Cursor TextTrajectory::at(std::size_t frame) const {
  return {text_, starts_[frame].offset, starts_[frame].line};
}

// Steps over the last known frame and finds the next one, or that there is none.
void TextTrajectory::look_further() {
  const std::size_t last = starts_.size() - 1;
  Cursor cursor = at(last);
  const Step step = skip_frame(cursor);
  if (cursor.offset() - released_ > pages_kept) { // an index of a large file needs no memory of its size
    bytes_->release_pages();
    released_ = cursor.offset();
  }
  if (step == Step::Whole) {
    cursor.skip_blank();
    complete_ = cursor.at_end();
    if (!complete_) starts_.push_back({cursor.offset(), cursor.line()});
    return;
  }
  if (step == Step::Cut && last > 0) {
    warnings_.warning(code::cut_frame, {file(), starts_[last].line},
                      fmt::format("frame {} is cut off and left out: the file ends within it", last));
    starts_.pop_back();
    complete_ = true;
    return;
  }
  (void)read_frame(at(last)); // says what is wrong
  fail(Exit::BadInput, code::heading, {file(), starts_[last].line},
       fmt::format("frame {} cannot be stepped over", last));
}

void TextTrajectory::check_last_line(const Cursor& end) {
  if (!end.at_end() || text_.empty() || text_.back() == '\n' || warnings_.has(molecule_code::last_line)) return;
  warnings_.warning(molecule_code::last_line, {file(), end.line() - 1}, "the last line has no line end and may be cut off");
}

std::uint64_t TextTrajectory::frame_count() {
  while (!complete_) look_further();
  return starts_.size();
}

Frame TextTrajectory::read(std::uint64_t frame) {
  while (!complete_ && starts_.size() <= frame) look_further();
  if (frame >= starts_.size())
    fail(Exit::BadInput, code::no_frame, {file()},
         fmt::format("there is no frame {}: the file has {} {} (0 to {})", frame, starts_.size(),
                     starts_.size() == 1 ? "frame" : "frames", starts_.size() - 1));
  return read_frame(at(frame));
}

} // namespace mote::data
