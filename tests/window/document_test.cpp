// SPDX-License-Identifier: MIT
// The text of the scene under change: undo and redo over everything, saving that loses nothing, files that change meanwhile.
#include "app/window/document.hpp"
#include "app/window/watch.hpp"

#include "core/scene/scene_file.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace mote::window {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* scene = "schema = 1 # one\n[camera]\neye = [0, -9, 0]\nfov_y = 20.0 # narrow\n[[data]]\nfile = \"a.npy\"\nalpha = 1.0\n";

class DocumentTest : public ::testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("mote_document_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    path = (folder / "scene.toml").string();
    write(scene);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
  [[nodiscard]] std::string on_disk() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] Document open(const std::vector<std::string>& settings = {}) const { return Document(std::vector<std::string>{path}, settings); }
  static std::string code_of(const std::function<void()>& body) {
    try {
      body();
    } catch (const Failure& failure) {
      return failure.diagnostic().code;
    }
    return "";
  }

  std::filesystem::path folder;
  std::string path;
};

TEST_F(DocumentTest, UndoAndRedo) {
  Document d = open();
  EXPECT_FALSE(d.changed());
  EXPECT_FALSE(d.undo());
  d.set("data[0].alpha", "0.5");
  d.set("background", "#000000");
  const std::string both = d.text();
  EXPECT_TRUE(d.changed());
  EXPECT_TRUE(d.undo());
  EXPECT_THAT(d.text(), HasSubstr("alpha = 0.5"));
  EXPECT_TRUE(d.undo());
  EXPECT_EQ(d.text(), scene);
  EXPECT_FALSE(d.changed());
  EXPECT_FALSE(d.undo());
  EXPECT_TRUE(d.redo());
  EXPECT_TRUE(d.redo());
  EXPECT_EQ(d.text(), both);
  EXPECT_FALSE(d.redo());
  d.undo();
  d.set("data[0].alpha", "0.1"); // a new way: what was undone is gone
  EXPECT_FALSE(d.redo());
}

TEST_F(DocumentTest, ADragIsOneStep) {
  Document d = open();
  d.set("data[0].alpha", "0.9");
  for (int i = 1; i < 9; ++i) d.set("data[0].alpha", "0." + std::to_string(i), true);
  d.set("background", "#112233", true); // another value: another step
  EXPECT_TRUE(d.undo());
  EXPECT_THAT(d.text(), HasSubstr("alpha = 0.8"));
  EXPECT_TRUE(d.undo());
  EXPECT_EQ(d.text(), scene);
}

TEST_F(DocumentTest, SavesAndKeepsComments) {
  Document d = open();
  d.set("data[0].alpha", "0.5");
  d.save();
  EXPECT_FALSE(d.changed());
  EXPECT_EQ(on_disk(), d.text());
  EXPECT_THAT(on_disk(), HasSubstr("schema = 1 # one"));
  EXPECT_TRUE(d.undo()); // also over a save
  EXPECT_TRUE(d.changed());
  d.save();
  EXPECT_EQ(on_disk(), scene);
}

TEST_F(DocumentTest, ReadOnlyFilesAreLeftAlone) {
  Document d = open();
  d.set("data[0].alpha", "0.5");
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  EXPECT_EQ(code_of([&] { d.save(); }), "A052");
  EXPECT_EQ(on_disk(), scene);
  EXPECT_TRUE(d.changed()) << "nothing is lost";
  d.save(folder / "other.toml");
  EXPECT_FALSE(d.changed());
}

TEST_F(DocumentTest, WhatOthersWroteIsNotOverwritten) {
  Document d = open();
  d.set("data[0].alpha", "0.5");
  const std::string mine = d.text();
  write("schema = 1\n[[data]]\nfile = \"theirs.npy\"\n");
  EXPECT_TRUE(d.differs_on_disk());
  EXPECT_EQ(code_of([&] { d.save(); }), "A053");
  EXPECT_THAT(on_disk(), HasSubstr("theirs"));
  EXPECT_EQ(d.text(), mine);
  EXPECT_TRUE(d.reread());
  EXPECT_THAT(d.text(), HasSubstr("theirs"));
  EXPECT_TRUE(d.undo());
  EXPECT_EQ(d.text(), mine);
  d.save(); // known by now
  EXPECT_EQ(on_disk(), mine);
}

TEST_F(DocumentTest, WhatCannotBeWrittenChangesNothing) {
  Document d = open();
  EXPECT_EQ(code_of([&] { d.set("camera", "3"); }), "A054");
  EXPECT_EQ(d.text(), scene);
  EXPECT_FALSE(d.undo());
}

TEST_F(DocumentTest, TheCameraKeepsItsTable) {
  Document d = open();
  Camera c;
  c.eye = {1, 2, 3};
  c.projection = Projection::Orthographic;
  c.height = 5;
  d.set_camera(c);
  EXPECT_THAT(d.text(), HasSubstr("eye = [1.0, 2.0, 3.0]"));
  Diagnostics diagnostics;
  const SceneDesc flat = parse_scene(d.text(), "s", {}, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << to_string(diagnostics);
  EXPECT_EQ(flat.camera.height, 5.0);
  c.projection = Projection::Perspective;
  d.set_camera(c);
  const SceneDesc deep = parse_scene(d.text(), "s", {}, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << to_string(diagnostics);
  EXPECT_EQ(deep.camera.projection, Projection::Perspective);
  EXPECT_TRUE(d.undo());
  EXPECT_TRUE(d.undo());
  EXPECT_EQ(d.text(), scene);
}

TEST_F(DocumentTest, TheDefaultLightIsWrittenDown) {
  Document d = open();
  d.set("light.headlight.intensity", "0.3");
  Diagnostics diagnostics;
  const SceneDesc desc = parse_scene(d.text(), "s", {}, {}, diagnostics);
  ASSERT_EQ(desc.lights.size(), 1u);
  EXPECT_EQ(desc.lights[0].intensity, 0.3);
  EXPECT_TRUE(d.undo());
  EXPECT_EQ(d.text(), scene);
}

TEST_F(DocumentTest, CommandLinesBecomeScenes) {
  Diagnostics diagnostics;
  const auto desc_of = [&](const std::vector<std::string>& words, const std::vector<std::string>& settings) {
    const Document d(words, settings);
    const SceneDesc made = parse_scene(d.text(), d.name(), {}, {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << to_string(diagnostics) << d.text();
    return made;
  };
  const SceneDesc files = desc_of({"a \"b\".gro", "c.xtc", "d.xyz"}, {"data[1].alpha=0.5", "background=#000"});
  ASSERT_EQ(files.data.size(), 2u);
  EXPECT_EQ(files.data[0].file.value, "a \"b\".gro");
  EXPECT_THAT(files.data[0].trajectory, ElementsAre("c.xtc"));
  EXPECT_EQ(files.data[1].alpha, 0.5);
  EXPECT_EQ(files.background.r, 0.0);
  const SceneDesc generated = desc_of({"spheres:1e3:fill:seed=7"}, {});
  ASSERT_EQ(generated.data.size(), 1u);
  ASSERT_TRUE(generated.data[0].generated);
  EXPECT_EQ(generated.data[0].generated->count, 1000u);
  EXPECT_EQ(generated.data[0].generated->seed, 7u);
}

TEST_F(DocumentTest, WatchTellsOfChanges) {
  std::atomic<int> woken{};
  FileWatch watch([&] { ++woken; });
  watch.set({path, (folder / "none" / "x.toml").string()});
  const auto changed = [&] {
    for (int i = 0; i < 500 && woken == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    woken = 0;
    return watch.take();
  };
  write("schema = 1\n");
  EXPECT_THAT(changed(), ElementsAre(path));
  std::ofstream(folder / "new.toml") << "schema = 1\n";
  std::filesystem::rename(folder / "new.toml", path); // as editors do
  EXPECT_THAT(changed(), ElementsAre(path));
  EXPECT_TRUE(watch.take().empty());
}

} // namespace
} // namespace mote::window
