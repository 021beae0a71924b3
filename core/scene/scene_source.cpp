// SPDX-License-Identifier: MIT
#include "core/scene/scene_source.hpp"

#include "core/data/cell.hpp"
#include "core/data/series.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/expression.hpp"
#include "core/scene/particle_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace mote {
namespace {
constexpr std::uint64_t frames_for_ranges = 64, frames_for_bounds = 8;
}

data::SeriesFiles files_of(const DataDesc& desc) {
  data::SeriesFiles files{{desc.file.value}, desc.trajectory};
  files.files.insert(files.files.end(), desc.further.begin(), desc.further.end());
  return files;
}

std::vector<std::uint64_t> spread_frames(std::uint64_t frames, std::uint64_t count) {
  std::vector<std::uint64_t> out;
  if (frames <= count)
    for (std::uint64_t k = 0; k < frames; ++k) out.push_back(k);
  else
    for (std::uint64_t k = 0; k < count; ++k) out.push_back(k * (frames - 1) / (count - 1));
  return out;
}

// One data set: its source (shared by data sets that name the same files) and what was found out about it.
struct SceneSource::Entry {
  std::shared_ptr<std::unique_ptr<data::Source>> source = std::make_shared<std::unique_ptr<data::Source>>();
  std::shared_ptr<std::size_t> told = std::make_shared<std::size_t>(0); // warnings passed on
  bool failed{};
  std::uint64_t count{};                         // 0: not counted yet
  std::optional<std::uint64_t> held_index{};     // of the frame that is held
  std::shared_ptr<const data::Frame> held{};
  std::unique_ptr<View> view{};
  std::optional<Bounds> centers{};
  std::optional<Reach> reach{};
  std::map<std::string, RangeCollector> ranges{};
  std::map<std::string, std::vector<std::string>> words{};
};

struct SceneSource::View : SeriesView {
  SceneSource& owner;
  std::size_t data;
  Diagnostics* diagnostics; // of the picture that is being made
  View(SceneSource& o, std::size_t d, Diagnostics& list) : owner(o), data(d), diagnostics(&list) {}

  template <class Fn> void for_frames(std::uint64_t most, const Fn& fn) {
    for (const std::uint64_t index : spread_frames(owner.entry(data).count, most)) {
      const auto frame = owner.frame(data, index, *diagnostics);
      if (!frame) return;
      fn(*frame);
    }
  }
  RangeCollector values(const std::string& attribute, bool keep_values, bool positive) override {
    Entry& e = owner.entry(data);
    const std::string key = fmt::format("{}{}{}", keep_values ? "k" : "-", positive ? "p" : "-", attribute);
    const auto known = e.ranges.find(key);
    if (known != e.ranges.end()) return known->second;
    RangeCollector collector(keep_values, positive);
    for_frames(frames_for_ranges, [&](const data::Frame& frame) {
      if (const auto found = find_attribute(frame, attribute)) collector.add(*found, frame.count, owner.selected(data, frame, *diagnostics));
    });
    if (e.count > frames_for_ranges)
      diagnostics->note(code::range_sampled, {owner.desc_.data[data].file.value.string()},
                       fmt::format("the range of '{}' is that of {} of {} frames, evenly spread", attribute, frames_for_ranges, e.count),
                       {"range = [low, high] sets it, range = \"frame\" takes each frame's own"});
    return e.ranges.emplace(key, std::move(collector)).first->second;
  }
  std::vector<std::string> words(const std::string& attribute) override {
    Entry& e = owner.entry(data);
    const auto known = e.words.find(attribute);
    if (known != e.words.end()) return known->second;
    std::vector<std::string> words;
    for_frames(frames_for_ranges, [&](const data::Frame& frame) {
      const auto found = find_attribute(frame, attribute);
      if (!found || !found->is_text()) return;
      for (const std::string& word : std::get<data::TextColumn>(found->column->values).dictionary)
        if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
    });
    return e.words.emplace(attribute, std::move(words)).first->second;
  }
};

SceneSource::SceneSource(const SceneDesc& desc) : desc_(desc) {
  for (std::size_t i = 0; i < desc.data.size(); ++i) {
    entries_.push_back(std::make_shared<Entry>());
    for (std::size_t k = 0; k < i; ++k) // a file that is shown twice is opened once
      if (desc.data[k].file.value == desc.data[i].file.value && desc.data[k].further == desc.data[i].further &&
          desc.data[k].trajectory == desc.data[i].trajectory) {
        entries_[i]->source = entries_[k]->source;
        entries_[i]->told = entries_[k]->told;
        break;
      }
  }
}
SceneSource::~SceneSource() = default;

data::Source* SceneSource::source(std::size_t data, Diagnostics& diagnostics) {
  Entry& e = entry(data);
  if (*e.source) return e.source->get();
  if (e.failed) return nullptr;
  e.failed = true; // until it is open
  const DataDesc& desc = desc_.data[data];
  const auto& file = desc.file;
  std::error_code error;
  if (file.value != "-" && !data::is_pattern(file.value) && !std::filesystem::exists(file.value, error)) {
    diagnostics.error(code::data_file_missing, file.loc, fmt::format("the data file '{}' does not exist", file.value.string()));
    return nullptr;
  }
  try {
    *e.source = data::open_series(files_of(desc));
    e.failed = false;
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
  }
  return e.source->get();
}

std::uint64_t SceneSource::frame_count(Diagnostics& diagnostics) {
  std::uint64_t most = 1;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (desc_.data[i].generated) continue;
    Entry& e = entry(i);
    data::Source* open = source(i, diagnostics);
    if (!open) return 0;
    try {
      if (e.count == 0) e.count = open->frame_count();
    } catch (const Failure& failure) {
      diagnostics.add(failure.diagnostic());
      return 0;
    }
    most = std::max(most, e.count);
  }
  return most;
}

std::shared_ptr<const data::Frame> SceneSource::frame(std::size_t data, std::optional<std::uint64_t> index, Diagnostics& diagnostics) {
  Entry& e = entry(data);
  const DataDesc& desc = desc_.data[data];
  if (index && e.count == 1) index = 0;
  const std::uint64_t wanted = index.value_or(0);
  if (e.held && e.held_index == wanted) return e.held;
  data::Source* open = source(data, diagnostics);
  if (!open) return nullptr;
  e.held.reset();
  auto frame = std::make_shared<data::Frame>();
  try {
    *frame = open->read(wanted);
    open->release_pages();
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
    return nullptr;
  }
  const auto& warnings = open->warnings().list();
  for (; *e.told < warnings.size(); ++*e.told) diagnostics.add(warnings[*e.told]);
  if (desc.wrapping != Wrapping::AsInFile) {
    const bool wraps = desc.wrapping == Wrapping::Wrap;
    if (const std::string hindrance = wraps ? data::wrap(*frame) : data::unwrap(*frame); !hindrance.empty()) {
      diagnostics.error(code::no_cell, desc.loc, fmt::format("{} cannot be {}ped: {}", desc.file.value.string(), wraps ? "wrap" : "unwrap", hindrance));
      return nullptr;
    }
  }
  e.held_index = wanted;
  e.held = std::move(frame);
  return e.held;
}

SeriesView* SceneSource::series(std::size_t data, Diagnostics& diagnostics) {
  Entry& e = entry(data);
  if (desc_.data[data].generated || e.count <= 1) return nullptr;
  if (!e.view) e.view = std::make_unique<View>(*this, data, diagnostics);
  e.view->diagnostics = &diagnostics;
  return e.view.get();
}

std::vector<bool> SceneSource::selected(std::size_t data, const data::Frame& frame, Diagnostics& diagnostics) const {
  const auto& select = desc_.data[data].select;
  if (!select) return {};
  SourceLoc loc = select->loc;
  if (loc.line) ++loc.column; // behind the quote
  std::vector<bool> rows = select_rows(select->value, frame, loc, diagnostics);
  return rows;
}

Bounds SceneSource::series_centers(std::size_t data, Diagnostics& diagnostics) {
  Entry& e = entry(data);
  if (e.centers) return *e.centers;
  Bounds bounds;
  View view(*this, data, diagnostics);
  view.for_frames(frames_for_bounds, [&](const data::Frame& frame) {
    const std::vector<bool> rows = selected(data, frame, diagnostics);
    const data::Column& position = *frame.find("position");
    for (std::uint64_t row = 0; row < frame.count; ++row) {
      if (!rows.empty() && !rows[row]) continue;
      const glm::dvec3 p(position.number(row, 0), position.number(row, 1), position.number(row, 2));
      if (std::abs(p.x) <= 1e30 && std::abs(p.y) <= 1e30 && std::abs(p.z) <= 1e30) bounds.add(p);
    }
  });
  e.centers = bounds;
  return bounds;
}

std::optional<SceneSource::Reach>& SceneSource::reach(std::size_t data) { return entry(data).reach; }

} // namespace mote
