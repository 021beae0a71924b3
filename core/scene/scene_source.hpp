// SPDX-License-Identifier: MIT
// The particle files of a scene, kept open: frames of any index, and what must be the same in all pictures
// of a series: ranges of values, words of categories, the box of everything. Batches of pictures keep one;
// a single picture makes one and lets it go. Holds one frame of every file at a time.
//
// Long series are not read from end to end for that: ranges look at 64 frames and bounds at 8, spread evenly,
// the first and the last among them, always the same ones. So a picture does not depend on which
// frames were drawn before it, or by which process.
#pragma once

#include "core/data/series.hpp"
#include "core/math/camera.hpp"
#include "core/scene/scene_file.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mote {

class SeriesView;

class SceneSource {
public:
  explicit SceneSource(const SceneDesc& desc); // opens nothing yet
  ~SceneSource();
  SceneSource(const SceneSource&) = delete;
  SceneSource& operator=(const SceneSource&) = delete;

  // Frames of the longest data set, at least 1; 0 after an error. Indexes the files.
  std::uint64_t frame_count(Diagnostics& diagnostics);
  // Frame `index` of data set `data`, wrapped or unwrapped as it asks; data sets of one frame show it at every index.
  // No index: the first, without looking further. Null after an error (S018, D...).
  std::shared_ptr<const data::Frame> frame(std::size_t data, std::optional<std::uint64_t> index, Diagnostics& diagnostics);
  // The series that a data set is; null for a single frame.
  SeriesView* series(std::size_t data, Diagnostics& diagnostics);
  // Which rows of a frame are drawn; empty: all. Errors and warnings of the selection go to `diagnostics`.
  std::vector<bool> selected(std::size_t data, const data::Frame& frame, Diagnostics& diagnostics) const;
  // Centers of the drawn particles over the series (8 frames), data space.
  Bounds series_centers(std::size_t data, Diagnostics& diagnostics);
  // The largest radius and the copies of frame 0, which the bounds of a series are made with; set by realize().
  struct Reach {
    double radius{};
    std::vector<glm::dmat4> transforms{};
  };
  std::optional<Reach>& reach(std::size_t data);
  // What making particles of frames took so far, in ms of wall time; kept by realize(), for `mote bench`.
  struct Preparing {
    double values{}; // positions, radii, colors and shapes from columns
    double chunks{}; // sort, boxes and records
  };
  Preparing preparing{};

private:
  struct Entry;
  struct View;
  Entry& entry(std::size_t data) { return *entries_[data]; }
  data::Source* source(std::size_t data, Diagnostics& diagnostics);

  SceneDesc desc_;
  std::vector<std::shared_ptr<Entry>> entries_{}; // one a data set
};

// The files of a data set, as open_series() takes them.
data::SeriesFiles files_of(const DataDesc& desc);

// `count` indices at most out of [0, frames): all, or evenly spread with both ends.
std::vector<std::uint64_t> spread_frames(std::uint64_t frames, std::uint64_t count);

} // namespace mote
