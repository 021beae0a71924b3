// SPDX-License-Identifier: MIT
// A session on a device, without a window: a small scene, events, and what the window would show.
#pragma once

#include "app/window/session.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace mote::window {

class SessionTest : public ::testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("mote_session_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    setenv("XDG_CACHE_HOME", (std::filesystem::temp_directory_path() / "mote_session_cache").c_str(), 0); // the device outlives the test
    write("points.csv", "x,y,z,radius,speed\n0,0,0,1,5\n3,0,0,1,6\n0,0,4,1,7\n");
    write("scene.toml", scene);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  static constexpr const char* scene = "schema = 1 # kept\n[camera]\neye = [0.0, -30.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\nfov_y = 20.0\n"
                                       "[[light]]\nname = \"sun\"\nkind = \"directional\"\ndirection = [0.0, 1.0, 0.0]\n[[data]]\nfile = \"points.csv\"\ncolor = \"#ff0000\"\n";
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name, std::ios::binary) << text; }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }

  static app::DrawingDevice& device() {
    static app::DrawingDevice made{{}};
    return made;
  }
  void open(const std::vector<std::string>& words, Size2d size = {64, 48}, const std::vector<std::string>& settings = {}, PaceOptions pace = {}) {
    app::JobRequest request;
    request.words = words;
    request.size = size;
    request.settings = settings;
    Diagnostics diagnostics;
    app::Job job = app::load_job(request, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors()) << to_string(diagnostics);
    session = std::make_unique<Session>(device(), std::make_shared<const ColorConfig>(ColorConfig::load()), request, std::move(job), SessionOptions{.pace = pace, .version = "test"});
    press(key::tab); // no panels, where there are any
    draw();
  }
  // Draws until nothing better comes; the window's pixels.
  std::vector<std::byte> draw() {
    for (int i = 0; i < 60 && (session->wants_frame(now) || !session->refined()); ++i) {
      frame();
      now += 0.2;
    }
    EXPECT_TRUE(session->refined());
    return target ? device().device().read_texture(target) : std::vector<std::byte>{};
  }
  void frame() {
    session->render(now);
    if (!session->visible()) return;
    const Size2d size = session->size();
    if (!target || target.size().width != size.width || target.size().height != size.height)
      target = device().device().create_texture({.label = "target", .size = {size.width, size.height, 1}, .format = gpu::TextureFormat::BGRA8Unorm,
                                                 .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
    session->compose(target);
  }
  void press(Key key, Modifiers modifiers = {}) {
    session->handle(key_event(key, modifiers), now);
    session->handle(key_event(key, modifiers, false), now);
  }
  void drag(Button button, glm::dvec2 from, glm::dvec2 to, Modifiers modifiers = {}) {
    session->handle(move_event(from.x, from.y, modifiers), now);
    session->handle(button_event(button, from.x, from.y, true, modifiers), now);
    session->handle(move_event(to.x, to.y, modifiers), now);
    session->handle(button_event(button, to.x, to.y, false, modifiers), now);
  }
  [[nodiscard]] std::string said() const {
    std::string all;
    for (const std::string& text : session->messages()) all += text + "\n";
    return all;
  }

  std::filesystem::path folder;
  std::unique_ptr<Session> session;
  gpu::Texture target;
  double now{1.0};
};

} // namespace mote::window
