// SPDX-License-Identifier: MIT
#include "core/data/series.hpp"

#include "core/data/codes.hpp"
#include "core/data/frame_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

namespace mote::data {
namespace {

namespace fs = std::filesystem;

// Files one behind the other; the one that was read last stays open.
class FileSeries : public Source {
public:
  explicit FileSeries(std::vector<fs::path> files) : files_(std::move(files)) { (void)source(0); }
  std::string_view format() const override { return format_; }

  std::uint64_t frame_count() override {
    while (ends_.size() < files_.size()) count_next();
    return ends_.back();
  }

  Frame read(std::uint64_t frame) override {
    while (ends_.size() < files_.size() && (ends_.empty() || ends_.back() <= frame)) {
      if (ends_.empty() && frame == 0) return read_of(0, 0); // needs no count
      count_next();
    }
    const auto end = std::upper_bound(ends_.begin(), ends_.end(), frame);
    if (end == ends_.end())
      fail(Exit::BadInput, code::no_frame, {files_.back().string()},
           fmt::format("there is no frame {}: the {} files have {}", frame, files_.size(), ends_.back()));
    const auto file = static_cast<std::size_t>(end - ends_.begin());
    return read_of(file, frame - (file ? ends_[file - 1] : 0));
  }
  void release_pages() override {
    if (open_) open_->release_pages();
  }

private:
  Source& source(std::size_t file) {
    if (!open_ || opened_ != file) {
      open_.reset(); // first, so that two are never open
      open_ = open(files_[file]);
      opened_ = file;
      if (format_.empty()) format_ = open_->format();
      told_ = 0;
    }
    return *open_;
  }
  void tell() { // warnings of a file, once each
    const auto& list = open_->warnings().list();
    for (; told_ < list.size(); ++told_) warnings_.add(list[told_]);
  }
  void count_next() {
    const std::uint64_t before = ends_.empty() ? 0 : ends_.back();
    ends_.push_back(before + source(ends_.size()).frame_count());
    tell();
  }
  Frame read_of(std::size_t file, std::uint64_t frame) {
    Frame out = source(file).read(frame);
    tell();
    return out;
  }

  std::vector<fs::path> files_;
  std::vector<std::uint64_t> ends_{}; // frames of the files up to this one
  std::unique_ptr<Source> open_{};
  std::size_t opened_{}, told_{};
  std::string format_{};
};

constexpr std::array<std::string_view, 5> moving{"position", "velocity", "force", "image", "acceleration"};

// The first frame of a topology with the moving columns of a trajectory.
class PairedSource : public Source {
public:
  PairedSource(std::unique_ptr<Source> topology, std::unique_ptr<Source> trajectory, std::string names)
      : trajectory_(std::move(trajectory)), names_(std::move(names)), still_(topology->read(0)) {
    format_ = fmt::format("{} + {}", topology->format(), trajectory_->format());
    warnings_.append(topology->warnings());
    std::erase_if(still_.columns, [](const Column& c) { return std::find(moving.begin(), moving.end(), c.name) != moving.end(); });
    still_.time.reset();
    still_.step.reset();
  }
  std::string_view format() const override { return format_; }
  std::uint64_t frame_count() override { return trajectory_->frame_count(); }
  void release_pages() override { trajectory_->release_pages(); }

  Frame read(std::uint64_t index) override {
    Frame moved = trajectory_->read(index);
    if (moved.count != still_.count)
      fail(Exit::BadInput, code::pair, {names_},
           fmt::format("the topology has {} particles, frame {} of the trajectory {}", still_.count, index, moved.count),
           {"A trajectory goes with the file that it was made from; a trajectory of some atoms needs a topology of the same atoms"});
    Frame out = still_;
    std::vector<Column> columns = std::move(moved.columns);
    for (Column& column : out.columns)
      if (std::none_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == column.name; }))
        columns.push_back(std::move(column));
    out.columns = std::move(columns);
    if (moved.box) out.box = moved.box;
    out.time = moved.time;
    out.step = moved.step;
    out.properties = std::move(moved.properties);
    const auto& list = trajectory_->warnings().list();
    for (; told_ < list.size(); ++told_) warnings_.add(list[told_]);
    return out;
  }

private:
  std::unique_ptr<Source> trajectory_;
  std::string names_, format_{};
  Frame still_;
  std::size_t told_{};
};

// Gives every frame the order of rows that frame 0 has.
class SteadyRows : public Source {
public:
  explicit SteadyRows(std::unique_ptr<Source> inner) : inner_(std::move(inner)) {}
  std::string_view format() const override { return inner_->format(); }
  std::uint64_t frame_count() override {
    const std::uint64_t count = inner_->frame_count();
    tell();
    return count;
  }
  void release_pages() override { inner_->release_pages(); }

  Frame read(std::uint64_t index) override {
    if (index == 0) return first();
    Frame frame = inner_->read(index);
    tell();
    const std::vector<std::int64_t> ids = ids_of(frame);
    if (ids.empty()) return frame;
    if (!known_) (void)first();
    if (ids == ids_) return frame;
    if (place_.empty() && !ids_.empty())
      for (std::size_t i = 0; i < ids_.size(); ++i) place_.emplace(ids_[i], i);
    if (place_.size() == ids_.size() && !ids_.empty()) take_rows(frame, order_of(ids));
    return frame;
  }

private:
  Frame first() {
    Frame frame = inner_->read(0);
    tell();
    if (!known_) ids_ = ids_of(frame);
    known_ = true;
    return frame;
  }
  std::vector<std::uint32_t> order_of(const std::vector<std::int64_t>& ids) const {
    struct Key {
      std::uint64_t place;
      std::int64_t id;
    };
    std::vector<Key> keys(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto found = place_.find(ids[i]);
      keys[i] = {found == place_.end() ? UINT64_MAX : found->second, ids[i]};
    }
    std::vector<std::uint32_t> rows(ids.size());
    std::iota(rows.begin(), rows.end(), 0u);
    std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
      return keys[a].place != keys[b].place ? keys[a].place < keys[b].place : keys[a].place == UINT64_MAX && keys[a].id < keys[b].id;
    });
    return rows;
  }
  void tell() {
    const auto& list = inner_->warnings().list();
    for (; told_ < list.size(); ++told_) warnings_.add(list[told_]);
  }

  std::unique_ptr<Source> inner_;
  bool known_{};
  std::vector<std::int64_t> ids_{};
  std::unordered_map<std::int64_t, std::uint64_t> place_{};
  std::size_t told_{};
};

std::vector<fs::path> all_of(const std::vector<fs::path>& names) {
  std::vector<fs::path> files;
  for (const fs::path& name : names)
    for (fs::path& file : expand_pattern(name)) files.push_back(std::move(file));
  return files;
}

std::unique_ptr<Source> one_behind_the_other(std::vector<fs::path> files) {
  if (files.size() == 1) return open(files[0]);
  return std::make_unique<FileSeries>(std::move(files));
}

} // namespace

std::unique_ptr<Source> open_series(const SeriesFiles& names) {
  std::vector<fs::path> files = all_of(names.files);
  if (files.empty()) fail(Exit::BadInput, code::series_pattern, {}, "a series of no files");
  if (names.trajectory.empty()) return std::make_unique<SteadyRows>(one_behind_the_other(std::move(files)));
  if (files.size() > 1)
    fail(Exit::BadInput, code::pair, {files[1].string()}, fmt::format("a trajectory goes with one topology, but {} files are given", files.size()));
  const std::string both = fmt::format("{} + {}", files[0].string(), names.trajectory[0].string());
  auto trajectory = std::make_unique<SteadyRows>(one_behind_the_other(all_of(names.trajectory)));
  return std::make_unique<PairedSource>(open(files[0]), std::move(trajectory), both);
}

} // namespace mote::data
