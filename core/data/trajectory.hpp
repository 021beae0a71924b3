// SPDX-License-Identifier: MIT
// A text file of frames one behind the other. The base of such readers: it remembers where frames
// begin (16 bytes each), goes through the file no further than asked, and leaves a cut last frame out
// with a warning. A format says only how to step over a frame and how to read one.
#pragma once

#include "core/data/bytes.hpp"
#include "core/data/source.hpp"
#include "core/data/text.hpp"

#include <memory>
#include <vector>

namespace mote::data {

class TextTrajectory : public Source {
public:
  std::uint64_t frame_count() override;
  Frame read(std::uint64_t frame) override; // D017 when there is no such frame
  void release_pages() override { bytes_->release_pages(); }

protected:
  explicit TextTrajectory(std::shared_ptr<Bytes> bytes);
  enum class Step : std::uint8_t {
    Whole,  // the cursor stands behind the frame
    Cut,    // the text ends within it
    Broken, // it is not a frame; read_frame() says why
  };
  // Lenient and fast: looks at counts only. The cursor stands on the frame's first line.
  virtual Step skip_frame(Cursor& cursor) const = 0;
  // Strict: everything of the frame and what follows it.
  virtual Frame read_frame(Cursor cursor) = 0;
  [[nodiscard]] const std::string& file() const { return bytes_->name(); }
  // Warns (D051) when the file ends at `end` without a line end: its last number may have lost digits.
  void check_last_line(const Cursor& end);

private:
  struct Place {
    std::uint64_t offset{}, line{};
  };
  [[nodiscard]] Cursor at(std::size_t frame) const;
  void look_further();

  std::shared_ptr<Bytes> bytes_;
  std::string_view text_;
  std::vector<Place> starts_{}; // of frames 0..k; the last one may still be cut
  std::uint64_t released_{}; // how far into the text pages were let go
  bool complete_{};
};

} // namespace mote::data
