// SPDX-License-Identifier: MIT
// A particle file as a source of frames. open() recognizes the format by content (gzip is looked
// through), the name's extension only breaks ties. A source may stream: it indexes a trajectory
// when frame_count() is first asked and holds one frame's worth of text at a time.
//
// Errors are thrown as mote::Failure with Exit::BadInput and a place in the file; things that can
// be read in spite of a flaw go to `warnings`.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/data/dataset.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

class Source {
public:
  virtual ~Source() = default;
  [[nodiscard]] virtual std::string_view format() const = 0; // "xyz", "lammps-dump", "npy", "csv"
  [[nodiscard]] virtual std::uint64_t frame_count() = 0;      // at least 1; reads the whole file once
  [[nodiscard]] virtual Frame read(std::uint64_t frame) = 0;  // 0-based; frame 0 never needs the index
  // Lets go of the file's pages that were looked at: reading them again costs time, no memory stays.
  virtual void release_pages() {}
  [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

protected:
  Diagnostics warnings_;
};

std::unique_ptr<Source> open(const std::filesystem::path& file);

// The formats that open() knows, for `mote formats` and messages.
struct Format {
  std::string_view name{}, summary{}, extensions{};
  bool positions_only{}; // of particles that another file describes (series.hpp)
};
std::span<const Format> formats();

} // namespace mote::data
