// SPDX-License-Identifier: MIT
// The part of a session that reads and changes the scene: files, edits, frames, and what a particle is.
#include "app/codes.hpp"
#include "app/library/job_text.hpp"
#include "app/library/user_types.hpp"
#include "app/window/codes.hpp"
#include "app/window/session.hpp"
#include "core/scene/realize.hpp"
#include "core/scene/scene_file.hpp"
#include "render_graph/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace mote::window {
namespace {

constexpr std::uint32_t search_pixels = 8; // around the mouse, of a usual display
constexpr std::size_t most_rows = 14;      // of a picked particle

// Lights and background change no particle: nothing has to be read again for them.
bool only_light(const std::string& path) {
  const std::string_view word = app::first_word(path);
  return word == "light" || word == "ambient" || word == "background";
}

// Transforms change no particle either.
bool only_transform(const std::string& path) { return path.starts_with("data[") && path.find("].transform") != std::string::npos; }

std::string cell_text(const data::Column& column, std::uint64_t row) {
  if (const auto* text = std::get_if<data::TextColumn>(&column.values)) return text->at(row);
  std::string out;
  for (std::uint32_t k = 0; k < column.components; ++k) out += fmt::format("{}{:.7g}", k ? ", " : "", column.number(row, k));
  return out + (column.unit.empty() ? "" : " " + column.unit);
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.projection == b.projection && a.eye == b.eye && a.target == b.target && a.up == b.up && a.fov_y == b.fov_y && a.height == b.height;
}

} // namespace

std::vector<std::string> Session::type_settings() const {
  app::JobRequest types;
  types.types = request_.types;
  return app::scene_settings(types);
}

app::Job Session::described(Diagnostics& diagnostics) const {
  app::JobRequest request = request_;
  request.size = job_->size;
  if (job_->frame) request.frame = static_cast<std::int64_t>(*job_->frame);
  SceneDesc desc = parse_scene(document_.text(), document_.name(), document_.folder(), type_settings(), diagnostics);
  return app::load_described(std::move(desc), request, diagnostics);
}

bool Session::take_job(app::Job next, Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) return false;
  diagnostics.append(app::as_warnings(next.left_out));
  watch_files(&next.graph);
  const bool camera_changed = !same_camera(next.scene.camera, loaded_camera_);
  const Camera camera = next.scene.camera;
  if (!camera_changed) next.scene.camera = control_.camera(); // the user's view stays
  auto shared = std::make_shared<app::Job>(std::move(next));
  if (!painter_.set(*shared, config_, diagnostics)) return false;
  job_ = std::move(shared);
  loaded_camera_ = camera;
  frames_known_ = 0;
  control_.set_bounds(job_->scene.bounds);
  if (camera_changed) control_.set_camera(camera);
  pace_.set_draft_differs(painter_.draft_differs());
  watch_files();
  moved(now_, held_.has_value());
  return true;
}

bool Session::take_lights(Diagnostics& diagnostics) {
  SceneDesc desc = parse_scene(document_.text(), document_.name(), document_.folder(), type_settings(), diagnostics);
  if (diagnostics.has_errors()) return false;
  job_->desc = std::move(desc);
  job_->scene.lights = job_->desc.lights;
  job_->scene.ambient = job_->desc.ambient;
  job_->scene.background = job_->desc.background;
  pace_.changed(now_, held_.has_value());
  return true;
}

// Particles stay as they are; only their instances stand elsewhere.
bool Session::take_transforms(Diagnostics& diagnostics) {
  SceneDesc desc = parse_scene(document_.text(), document_.name(), document_.folder(), type_settings(), diagnostics);
  if (diagnostics.has_errors() || desc.data.size() != job_->desc.data.size()) return false;
  auto next = std::make_shared<app::Job>(*job_);
  desc.frame = next->desc.frame;
  next->desc = std::move(desc);
  if (!place_again(next->scene, next->desc, *next->source, next->frame, diagnostics)) return false;
  loaded_camera_ = complete_camera(next->desc.camera, next->scene.bounds, next->size); // that the file would show
  job_ = std::move(next);
  painter_.set_scene(job_->scene);
  control_.set_bounds(job_->scene.bounds);
  moved(now_, held_.has_value());
  return true;
}

// False: the scene stays as it was, and the reasons have been told.
bool Session::take_text(const std::string& changed) {
  Diagnostics diagnostics;
  bool taken = false;
  try {
    if (only_light(changed)) taken = take_lights(diagnostics);
    else if (only_transform(changed)) taken = take_transforms(diagnostics);
    else {
      app::Job next = described(diagnostics);
      taken = take_job(std::move(next), diagnostics);
    }
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
    taken = false;
  }
  tell(diagnostics);
  return taken;
}

bool Session::set(const std::string& path, const std::string& value, bool merge) {
  const std::vector<std::string> setting{path + "=" + value};
  if (app::split_settings(setting).graph.empty()) return change_text(path, [&] { return Document::with(document_.text(), path, value); }, merge);
  return set_of_pass(path, setting);
}

bool Session::set_of_pass(const std::string& path, const std::vector<std::string>& setting) {
  app::JobRequest before = request_;
  std::erase_if(request_.settings, [&](const std::string& s) { return s.starts_with(path + "="); });
  request_.settings.insert(request_.settings.end(), setting.begin(), setting.end());
  if (take_text("graph")) return true;
  request_ = std::move(before);
  return false;
}

bool Session::change_text(const std::string& what, const std::function<std::string()>& make, bool merge) {
  const Document::Mark before = document_.mark();
  try {
    document_.change(make(), what, merge);
  } catch (const Failure& failure) {
    message(to_string(failure.diagnostic()));
    return false;
  }
  if (take_text(what)) return true;
  document_.back_to(before);
  return false;
}

void Session::show_step(passes::Step step) {
  for (const rg::PlannedPass& pass : painter_.renderer().plan().passes)
    if (pass.kind == "opaque_impostors") {
      const std::string path = pass.name + ".steps", word = passes::to_string(step);
      std::vector<std::string> setting; // the whole thing is what the graph says, smoothed outlines included
      if (step != passes::Step::Depth) setting.push_back(path + "=\"" + word + "\"");
      if (set_of_pass(path, setting)) message("step: " + word);
      return;
    }
  message("no pass of this graph has steps");
}

void Session::undo() {
  end_gizmo_drag();
  const std::string what = document_.last_change();
  if (!document_.undo()) return message("there is nothing to undo");
  if (take_text(what)) message("undone: " + what);
  else document_.redo();
}

void Session::redo() {
  end_gizmo_drag();
  if (!document_.redo()) return message("there is nothing to redo");
  const std::string what = document_.last_change();
  if (take_text(what)) message("redone: " + what);
  else document_.undo();
}

bool Session::save(const std::string& path) {
  try {
    if (!same_camera(control_.camera(), loaded_camera_)) document_.set_camera(control_.camera());
    loaded_camera_ = control_.camera();
    std::string target = path;
    std::error_code error;
    for (int i = 1; target.empty() && document_.file().empty(); ++i)
      if (const std::string name = fmt::format("mote-{}.toml", i); !std::filesystem::exists(name, error)) target = name;
    document_.save(target);
    watch_files();
    message("saved: " + document_.file().string());
    return true;
  } catch (const Failure& failure) {
    message(to_string(failure.diagnostic()));
    return false;
  }
}

void Session::open(const std::vector<std::string>& files) {
  if (files.empty()) return;
  set_gizmo({});
  app::JobRequest request = request_;
  request.words = files;
  request.settings.clear();
  request.graph.reset();
  request.frame.reset();
  request.size = size_;
  Diagnostics diagnostics;
  try {
    Document document(files, {});
    app::Job next = app::load_job(request, diagnostics);
    const app::JobRequest before = std::exchange(request_, request);
    if (diagnostics.has_errors() || !painter_.set(next, config_, diagnostics)) {
      request_ = before;
    } else {
      job_ = std::make_shared<app::Job>(std::move(next));
      painter_.set_scene(job_->scene);
      document_ = std::move(document);
      loaded_camera_ = job_->scene.camera;
      control_ = CameraControl(job_->scene.camera, job_->scene.bounds);
      picked_.clear();
      frames_known_ = 0;
      playing_ = false;
      wishes_.title = fmt::format("{} - mote", job_->desc.name);
      watch_files();
      tell(diagnostics);
      return moved(now_, false);
    }
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
  }
  tell(diagnostics);
  message(said_.empty() ? "what was dropped cannot be shown" : said_.back() + "\nthis cannot be shown: the picture before stays");
}

void Session::reload() {
  end_gizmo_drag();
  try {
    if (document_.differs_on_disk() && document_.changed() && document_.last_change() != "the file on the disk")
      message("the scene file was changed on the disk: undo brings back what you had here");
    document_.reread();
    config_ = std::make_shared<const ColorConfig>(ColorConfig::load(options_.display.config));
  } catch (const Failure& failure) {
    return message(to_string(failure.diagnostic()));
  }
  if (take_text({})) message("read again");
  else message(said_.back() + "\nthe picture before stays");
}

// All files that the picture depends on and that may be edited beside the window; a further kind of them is added here. `graph`: one that
// could not be read yet, so that mending it is seen.
void Session::watch_files(const app::GraphRequest* graph) {
  std::vector<std::string> files;
  if (!document_.file().empty()) files.push_back(document_.file().string());
  const char* ocio = std::getenv("OCIO");
  if (!options_.display.config.empty()) files.push_back(options_.display.config);
  else if (ocio && ocio[0]) files.emplace_back(ocio);
  for (const auto& type : job_->desc.types)
    for (const char* file : {"type.toml", "type.glsl"}) files.push_back((type->folder / file).string());
  for (std::string& file : app::graph_files(graph ? *graph : job_->graph)) files.push_back(std::move(file));
  wishes_.watch = std::move(files);
}

std::uint64_t Session::frame_count() {
  if (frames_known_ > 0) return frames_known_;
  Diagnostics diagnostics;
  frames_known_ = job_->source ? std::max<std::uint64_t>(1, job_->source->frame_count(diagnostics)) : 1;
  return frames_known_;
}

void Session::set_frame(std::uint64_t index) {
  if (frame_count() < 2 || index >= frame_count() || (job_->frame && index == *job_->frame)) return;
  Diagnostics diagnostics;
  auto next = std::make_shared<app::Job>(*job_);
  app::load_frame(*next, index, diagnostics);
  if (diagnostics.has_errors()) return tell(diagnostics);
  job_ = std::move(next);
  painter_.set_scene(job_->scene);
  picked_.clear();
  hud_stale_ = true;
  moved(now_, held_.has_value() || playing_);
}

void Session::set_playing(bool on) {
  if (on && frame_count() < 2) return message("there is one frame");
  playing_ = on;
  next_frame_at_ = now_;
  if (!on) pace_.let_go();
  stale_ = true;
}

void Session::play(double now) {
  next_frame_at_ = std::max(next_frame_at_ + 1.0 / std::max(frames_a_second, 0.01), now);
  if (!loop && frame() + 1 >= frame_count()) return set_playing(false);
  set_frame((frame() + 1) % frame_count());
}

void Session::set_camera(const Camera& camera) {
  if (!check(camera).empty()) return;
  control_.set_camera(camera);
  moved(now_, held_.has_value());
}

std::optional<Session::Picked> Session::describe(std::uint32_t id) const {
  for (const Batch& batch : job_->scene.batches) {
    if (id < batch.id_base || batch.row_count == 0) continue;
    const std::uint64_t instance = (id - batch.id_base) / batch.row_count, row = (id - batch.id_base) % batch.row_count;
    if (instance >= batch.instances.size()) continue;
    Picked out;
    out.id = id;
    out.rows.push_back({fmt::format("particle {}", id), fmt::format("row {} of {}{}", row, batch.name, batch.instances.size() > 1 ? fmt::format(", copy {}", instance) : "")});
    for (std::uint64_t i = 0; i < batch.chunks->record_count(); ++i)
      if (batch.chunks->rows[i] == row) out.center = glm::dvec3(batch.instances[instance].world_from_data * glm::dvec4(batch.chunks->center(i), 1.0));
    Diagnostics ignored;
    if (const std::size_t d = batch.data; d < job_->desc.data.size() && !job_->desc.data[d].generated) {
      const auto frame = job_->source->frame(d, job_->frame, ignored);
      for (std::size_t c = 0; frame && row < frame->count && c < frame->columns.size(); ++c)
        if (out.rows.size() < most_rows) out.rows.push_back({frame->columns[c].name, cell_text(frame->columns[c], row)});
      if (frame && row < frame->count) return out;
    }
    out.rows.push_back({"center", fmt::format("{:.7g}, {:.7g}, {:.7g}", out.center.x, out.center.y, out.center.z)});
    return out;
  }
  return std::nullopt;
}

std::optional<Session::Picked> Session::pick(double x, double y) {
  if (!visible()) return std::nullopt;
  const auto radius = static_cast<std::uint32_t>(search_pixels * std::clamp(scale_, 1.0, 8.0));
  const std::optional<PickArea> area = painter_.pick(view(size_), x, y, radius);
  if (!area) return std::nullopt;
  const std::optional<Pick> hit = nearest_particle(*area, x, y, view(size_));
  return hit ? describe(hit->id) : std::optional<Picked>();
}

// First a particle, then a distance, then an angle; a fourth begins anew.
void Session::picked_at(double x, double y) {
  const auto hit = pick(x, y);
  if (!hit) return message("there is no particle");
  if (picked_.size() == 3) picked_.clear();
  picked_.push_back(*hit);
  hud_stale_ = stale_ = true;
}

} // namespace mote::window
