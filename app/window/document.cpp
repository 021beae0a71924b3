// SPDX-License-Identifier: MIT
#include "app/window/document.hpp"

#include "app/window/camera_control.hpp"
#include "app/window/codes.hpp"
#include "core/base/atomic_file.hpp"
#include "core/data/series.hpp"
#include "core/scene/generated.hpp"
#include "core/scene/scene_file.hpp"
#include "core/toml/patch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mote::window {
namespace {

constexpr std::size_t most_states = 500;
constexpr std::string_view default_light = "\n[[light]]\nname = \"headlight\"\nkind = \"headlight\"\nintensity = 0.8\n";

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(Exit::BadInput, "S001", {file.string()}, "the scene file cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

// A scene file that shows what the words name.
std::string scene_text(std::span<const std::string> words) {
  std::string text = "schema = 1\n";
  if (words.size() == 1 && is_generated_name(words[0]) && !std::filesystem::exists(words[0])) {
    const Camera c = generated_camera(parse_generated_name(words[0]));
    return text + "\n" + camera_toml(c) + "\n[[data]]\nfile = " + quoted(words[0]) + "\n";
  }
  std::string trajectory;
  const auto end_data = [&] {
    if (!trajectory.empty()) text += "trajectory = [" + trajectory + "]\n";
    trajectory.clear();
  };
  bool first = true, last_moves = false;
  for (const std::string& word : words) {
    const bool moves = data::is_trajectory_name(word);
    if (!first && moves && !last_moves) {
      trajectory += (trajectory.empty() ? "" : ", ") + quoted(word);
      continue;
    }
    end_data();
    text += "\n[[data]]\nfile = " + quoted(word) + "\n";
    last_moves = moves;
    first = false;
  }
  end_data();
  return text;
}

} // namespace

Document::Document(std::span<const std::string> words, std::span<const std::string> settings) {
  if (words.size() == 1 && is_scene_path(words[0])) {
    file_ = words[0];
    name_ = words[0];
    texts_[0].text = on_disk_ = read_text(file_);
  } else {
    for (const std::string& word : words) name_ += (name_.empty() ? "" : " ") + word;
    texts_[0].text = on_disk_ = scene_text(words);
  }
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals != std::string::npos) set(setting.substr(0, equals), setting.substr(equals + 1));
  }
  texts_ = {{text(), {}}}; // what a command line says is not to be undone
  place_ = 0;
}

void Document::push(std::string text, std::string what, bool merge) {
  if (text == this->text()) return;
  texts_.resize(place_ + 1);
  if (merge && place_ > 0 && texts_[place_].what == what) {
    texts_[place_].text = std::move(text);
    return;
  }
  texts_.push_back({std::move(text), std::move(what)});
  if (texts_.size() > most_states) texts_.erase(texts_.begin());
  place_ = texts_.size() - 1;
}

// A scene without lights has one that stands in no file: it is written down before it is changed.
std::string Document::with_light(const std::string& text, const std::string& path) {
  const bool of_light = path.starts_with("light.") || path.starts_with("light[");
  if (!of_light || config::written_value(text, "light", code::not_patchable)) return text;
  return text + (text.ends_with('\n') ? "" : "\n") + std::string(default_light);
}

std::string Document::with(const std::string& text, const std::string& path, const std::string& value) {
  return config::patched(with_light(text, path), path, value, code::not_patchable);
}

std::string Document::with_appended(const std::string& text, const std::string& path, const std::string& values) {
  return config::appended(text, path, values, code::not_patchable);
}

void Document::set(const std::string& path, const std::string& value, bool merge) { push(with(text(), path, value), path, merge); }

void Document::back_to(const Mark& mark) {
  place_ = std::min(mark.place, texts_.size() - 1);
  texts_.resize(place_ + 1);
  texts_[place_] = {mark.text, mark.what};
}

void Document::set_camera(const Camera& c) {
  const bool flat = c.projection == Projection::Orthographic;
  std::string next = config::removed(text(), flat ? "camera.fov_y" : "camera.height", code::not_patchable);
  const auto put = [&](const char* key, const std::string& value) { next = config::patched(next, std::string("camera.") + key, value, code::not_patchable); };
  if (flat || config::written_value(next, "camera.projection", code::not_patchable)) put("projection", flat ? "\"orthographic\"" : "\"perspective\"");
  put("eye", toml_vector(c.eye));
  put("target", toml_vector(c.target));
  put("up", toml_vector(c.up));
  put(flat ? "height" : "fov_y", toml_number(flat ? c.height : c.fov_y));
  push(std::move(next), "camera", false);
}

bool Document::undo() {
  if (place_ == 0) return false;
  --place_;
  return true;
}

bool Document::redo() {
  if (place_ + 1 >= texts_.size()) return false;
  ++place_;
  return true;
}

bool Document::differs_on_disk() const {
  std::error_code error;
  return !file_.empty() && std::filesystem::exists(file_, error) && read_text(file_) != on_disk_;
}

bool Document::reread() {
  if (file_.empty()) return false;
  std::string now = read_text(file_);
  on_disk_ = now;
  if (now == text()) return false;
  push(std::move(now), "the file on the disk", false);
  return true;
}

void Document::save(const std::filesystem::path& other) {
  const std::filesystem::path target = other.empty() ? file_ : other;
  if (target.empty()) fail(Exit::Failed, code::read_only, {}, "the scene has no file yet");
  std::error_code error;
  const bool exists = std::filesystem::exists(target, error);
  if (target == file_ && differs_on_disk())
    fail(Exit::Failed, code::changed_meanwhile, {target.string()}, "another program has changed the file; it was not written over",
         {"F5 takes what it says now; undo then brings back yours, which can be saved"});
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  const bool may = exists ? ::access(target.c_str(), W_OK) == 0 && (std::filesystem::status(target, error).permissions() & std::filesystem::perms::owner_write) != std::filesystem::perms::none
                          : ::access(folder.c_str(), W_OK) == 0;
  if (!may) fail(Exit::Failed, code::read_only, {target.string()}, "the file is read-only; what was changed stays in the window", {"Saving under another name is possible"});
  write_file(target.string(), text());
  on_disk_ = text();
  file_ = target;
  name_ = target.string();
}

} // namespace mote::window
