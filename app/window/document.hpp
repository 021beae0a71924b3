// SPDX-License-Identifier: MIT
// The text of the scene that the window shows: what a user changes is changed in it, by the regions of its values, so that
// comments and order stay; undo and redo are former texts; saving writes it, and never over what somebody else has written since.
// One stack for everything that a panel or a gizmo changes. Pure but for the reading and writing of its file.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/math/camera.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace mote::window {

class Document {
public:
  // The words of a command line: a scene file, a generated scene or particle files; settings of the scene become changes that
  // are not saved yet. Throws Failure.
  Document(std::span<const std::string> words, std::span<const std::string> settings);

  [[nodiscard]] const std::string& text() const { return texts_[place_].text; }
  [[nodiscard]] const std::string& name() const { return name_; }             // for messages
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }   // empty: no scene file yet
  [[nodiscard]] std::filesystem::path folder() const { return file_.parent_path(); }
  [[nodiscard]] bool changed() const { return text() != on_disk_; }           // and not saved
  [[nodiscard]] std::string last_change() const { return texts_[place_].what; }

  // Throws Failure A054; nothing is changed then. `merge`: goes on changing what the last change changed (a slider that is
  // dragged), so that one undo takes all of it back.
  void set(const std::string& path, const std::string& value, bool merge = false);
  // The text that set() would make of `text`; and one with `values` behind what the list at `path` holds. Nothing is changed. Throw A054.
  [[nodiscard]] static std::string with(const std::string& text, const std::string& path, const std::string& value);
  [[nodiscard]] static std::string with_appended(const std::string& text, const std::string& path, const std::string& values);
  // Another text, as `what` changed it; `merge`: as set().
  void change(std::string text, const std::string& what, bool merge) { push(std::move(text), what, merge); }
  // Where undo stands, and back to it: for a change that turns out to be none that can be drawn.
  struct Mark {
    std::size_t place{};
    std::string text{}, what{};
  };
  [[nodiscard]] Mark mark() const { return {place_, texts_[place_].text, texts_[place_].what}; }
  void back_to(const Mark& mark);
  // The camera into its table; like set().
  void set_camera(const Camera& camera);
  bool undo(); // false: there is nothing to take back
  bool redo();

  // Takes over what is on the disk now; the former text can be had back by undo. True if it differs.
  bool reread();
  [[nodiscard]] bool differs_on_disk() const; // from what was read or saved last
  // To its file, or to `other`. Throws Failure A052, A053, I00x; nothing is lost then.
  void save(const std::filesystem::path& other = {});

private:
  struct State {
    std::string text{}, what{}; // and what led to it
  };
  void push(std::string text, std::string what, bool merge);
  [[nodiscard]] static std::string with_light(const std::string& text, const std::string& path);

  std::vector<State> texts_{1};
  std::size_t place_{};
  std::filesystem::path file_{};
  std::string name_{}, on_disk_{};
};

} // namespace mote::window
