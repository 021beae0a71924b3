// SPDX-License-Identifier: MIT
// Scenes of small files that a test writes: parsed, realized, and looked into.
#pragma once

#include "core/scene/realize.hpp"
#include "core/scene/scene_source.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace mote {

class Realize : public testing::Test {
protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() / (std::string("mote_realize_") + info->name() + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

  // A scene with one data set `file` and further lines of its [[data]].
  Scene scene(const std::string& file, const std::string& lines = "", const std::string& top = "") {
    diagnostics = {};
    const std::string text = "schema = 1\n" + top + "\n[[data]]\nfile = \"" + file + "\"\n" + lines;
    const SceneDesc desc = parse_scene(text, "s.toml", folder, {}, diagnostics);
    if (diagnostics.has_errors()) return {};
    return realize(desc, {1280, 720}, diagnostics);
  }
  // Radius and color of the row, from the chunks.
  static float radius(const Scene& s, std::uint32_t row) { return s.batches.at(0).chunks->records.at(place(s, row)).w; }
  static std::uint32_t rgb(const Scene& s, std::uint32_t row) { // 0xRRGGBB
    const std::uint32_t c = s.batches.at(0).chunks->color_of(place(s, row));
    return (c & 0xFFu) << 16 | (c & 0xFF00u) | (c >> 16 & 0xFFu);
  }
  static std::size_t place(const Scene& s, std::uint32_t row) {
    const auto& rows = s.batches.at(0).chunks->rows;
    return static_cast<std::size_t>(std::find(rows.begin(), rows.end(), row) - rows.begin());
  }
  // The same at a frame of the series.
  Scene scene_at(std::uint64_t index, const std::string& file, const std::string& lines = "", const std::string& top = "") {
    return scene(file, lines, "frame = " + std::to_string(index) + "\n" + top);
  }
  [[nodiscard]] std::string printed() const { return to_string(diagnostics); }

  std::filesystem::path folder;
  Diagnostics diagnostics;
};

} // namespace mote
