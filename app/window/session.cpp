// SPDX-License-Identifier: MIT
#include "app/window/session.hpp"

#include "app/codes.hpp"
#include "app/library/provenance.hpp"
#include "app/window/hud.hpp"
#include "core/overlay/annotate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace mote::window {
namespace {

constexpr double zoom_a_step = 0.87, zoom_a_pixel = 1.006, roll_a_step = 15.0; // degrees
constexpr double message_s = 4.0, double_click_s = 0.35, click_pixels = 4.0;

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// mote-1.png, or the first such name that no file has.
std::string unused_name() {
  std::error_code error;
  for (int i = 1;; ++i) {
    std::string name = fmt::format("mote-{}.png", i);
    if (!std::filesystem::exists(name, error)) return name;
  }
}

} // namespace

Session::Session(app::DrawingDevice& device, std::shared_ptr<const ColorConfig> config, app::JobRequest request, app::Job job, SessionOptions options)
    : device_(device), config_(std::move(config)), options_(std::move(options)), request_(std::move(request)), job_(std::make_shared<app::Job>(std::move(job))),
      document_(request_.words, app::split_settings(request_.settings).scene), loaded_camera_(job_->scene.camera), control_(job_->scene.camera, job_->scene.bounds),
      pace_(options_.pace), painter_(device, options_.display, options_.expansion), presenter_(device.device()), size_(job_->size), panels_(make_panels(device.device())) {
  Diagnostics diagnostics;
  if (!painter_.set(*job_, config_, diagnostics)) {
    for (const Diagnostic& d : diagnostics.list())
      if (d.severity == Severity::Error) throw Failure(Exit::Failed, d);
    fail(Exit::Failed, app::code::device_failed, {}, "the graph cannot be drawn");
  }
  pace_.set_draft_differs(painter_.draft_differs());
  wishes_.title = fmt::format("{} - mote", job_->desc.name);
  watch_files();
}
Session::~Session() = default;

View Session::view(Size2d size) const { return make_view(control_.camera(), size, job_->scene.bounds.diagonal()); }

void Session::message(std::string text) {
  said_.push_back(text);
  message_ = std::move(text);
  message_until_ = now_ + message_s;
  hud_stale_ = stale_ = true;
}

void Session::tell(const Diagnostics& diagnostics) {
  problems_ = diagnostics;
  for (const Diagnostic& d : diagnostics.list()) message(to_string(d));
}

void Session::moved(double now, bool held) {
  job_->scene.camera = control_.camera();
  pace_.changed(now, held);
}

void Session::handle(const Event& event, double now) {
  now_ = now;
  if (panels_shown() && panels_->handle(event)) {
    stale_ = true;
    return;
  }
  switch (event.kind) {
  case Event::Kind::Keyboard: return on_key(event);
  case Event::Kind::Text: return;
  case Event::Kind::MouseButton: return on_button(event, now);
  case Event::Kind::Move: return on_move(event, now);
  case Event::Kind::Wheel:
    mouse_ = {event.x, event.y};
    control_.zoom(std::pow(zoom_a_step, event.wheel), event.x, event.y, size_);
    return moved(now, held_.has_value());
  case Event::Kind::Resize:
    if (event.size != size_) pace_.changed(now, held_.has_value());
    hud_stale_ |= event.size != size_ || event.scale != scale_;
    size_ = event.size;
    scale_ = event.scale > 0.0 ? event.scale : 1.0;
    stale_ = true;
    return;
  case Event::Kind::Drop: return open(event.files);
  case Event::Kind::Files: return reload();
  case Event::Kind::Redraw: stale_ = true; return;
  case Event::Kind::Close: return act(Action::Quit);
  }
}

void Session::on_key(const Event& event) {
  if (!event.pressed) return;
  if (const auto action = action_of(event.key, event.modifiers)) act(*action);
}

void Session::on_button(const Event& event, double now) {
  mouse_ = {event.x, event.y};
  if (event.pressed) {
    if (held_) return; // one drag at a time
    begin_gizmo_drag(event);
    held_ = event.button;
    held_modifiers_ = event.modifiers;
    pressed_at_ = mouse_;
    return;
  }
  if (held_ != event.button) return;
  held_.reset();
  const bool took_gizmo = gizmo_.drag.has_value();
  end_gizmo_drag();
  if (took_gizmo) {
    last_click_ = -1e9;
  } else if (glm::length(mouse_ - pressed_at_) < click_pixels * scale_ && event.button == Button::Left) {
    if (held_modifiers_.control) {
      picked_at(mouse_.x, mouse_.y);
    } else if (now - last_click_ < double_click_s) {
      act(Action::CenterHere);
    }
    last_click_ = now;
  }
  if (!pace_.refined()) pace_.changed(now, false);
  pace_.let_go();
}

void Session::on_move(const Event& event, double now) {
  const glm::dvec2 to{event.x, event.y}, by = to - mouse_;
  mouse_ = to;
  hover_gizmo(to.x, to.y);
  if (!held_ || !visible() || by == glm::dvec2(0)) return;
  if (gizmo_.drag) return drag_gizmo(to, event.modifiers);
  switch (gesture_of(*held_, held_modifiers_)) {
  case Gesture::Orbit: control_.orbit(by.x, by.y, size_); break;
  case Gesture::Pan: control_.pan(by.x, by.y, size_); break;
  case Gesture::Roll: control_.roll(to - by, to, size_); break;
  case Gesture::Zoom: control_.zoom(std::pow(zoom_a_pixel, by.y), pressed_at_.x, pressed_at_.y, size_); break;
  }
  moved(now, true);
}

void Session::act(Action action) {
  const double now = now_;
  switch (action) {
  case Action::ResetView: control_.reset(); return moved(now, false);
  case Action::FrameAll: control_.frame_all(size_); return moved(now, false);
  case Action::AxisX: control_.look_along(0, false); return moved(now, false);
  case Action::AxisXBack: control_.look_along(0, true); return moved(now, false);
  case Action::AxisY: control_.look_along(1, true); return moved(now, false); // from the front
  case Action::AxisYBack: control_.look_along(1, false); return moved(now, false);
  case Action::AxisZ: control_.look_along(2, false); return moved(now, false);
  case Action::AxisZBack: control_.look_along(2, true); return moved(now, false);
  case Action::ToggleProjection: control_.toggle_projection(); return moved(now, false);
  case Action::ToggleTrackball:
    control_.set_trackball(!control_.trackball());
    return message(control_.trackball() ? "trackball" : "turntable");
  case Action::ToggleFullScreen: wishes_.toggle_full_screen = true; return;
  case Action::ToggleHelp:
    help_ = !help_;
    hud_stale_ = stale_ = true;
    return;
  case Action::Release:
    if (!help_ && picked_.empty() && !gizmo_.mode) wishes_.leave_full_screen = true;
    if (const bool dragged = gizmo_.drag && gizmo_.drag->begun; dragged) undo(); // that much of the drag
    set_gizmo({});
    help_ = false;
    picked_.clear();
    message_.clear();
    hud_stale_ = stale_ = true;
    return;
  case Action::CopyCamera:
    wishes_.clipboard = camera_toml(control_.camera());
    return message("the camera is on the clipboard, as TOML");
  case Action::Screenshot: return screenshot(unused_name());
  case Action::Reload: return reload();
  case Action::ToggleLegend:
    legend_ = !legend_;
    return pace_.changed(now, held_.has_value());
  case Action::TogglePanels:
    panels_shown_ = !panels_shown_;
    hud_stale_ = stale_ = true;
    return;
  case Action::Save: save(); return;
  case Action::Undo: return undo();
  case Action::Redo: return redo();
  case Action::GizmoMove: return set_gizmo(gizmo_.mode == GizmoMode::Move ? std::optional<GizmoMode>() : GizmoMode::Move);
  case Action::GizmoTurn: return set_gizmo(gizmo_.mode == GizmoMode::Turn ? std::optional<GizmoMode>() : GizmoMode::Turn);
  case Action::GizmoScale: return set_gizmo(gizmo_.mode == GizmoMode::Scale ? std::optional<GizmoMode>() : GizmoMode::Scale);
  case Action::GizmoNext: return set_gizmo_target((gizmo_.target + 1) % std::max<std::size_t>(1, gizmo_targets().size()));
  case Action::RollLeft: case Action::RollRight:
    control_.roll(glm::radians(action == Action::RollLeft ? -roll_a_step : roll_a_step));
    return moved(now, false);
  case Action::Play: return set_playing(!playing_);
  case Action::NextFrame: return set_frame(frame() + 1 < frame_count() ? frame() + 1 : loop ? 0 : frame());
  case Action::PreviousFrame: return set_frame(frame() > 0 ? frame() - 1 : loop ? frame_count() - 1 : 0);
  case Action::FirstFrame: return set_frame(0);
  case Action::LastFrame: return set_frame(frame_count() - 1);
  case Action::CenterHere:
    if (const auto here = pick(mouse_.x, mouse_.y)) {
      control_.center_at(here->center);
      return moved(now, false);
    }
    return message("there is no particle to turn about");
  case Action::StepProxy:
  case Action::StepDiscard:
  case Action::StepShade:
  case Action::StepDepth:
  case Action::StepQuadratic:
  case Action::StepPoints:
    return show_step(static_cast<passes::Step>(static_cast<int>(action) - static_cast<int>(Action::StepProxy)));
  case Action::Quit:
    if (document_.changed() && now - quit_asked_ > message_s) {
      quit_asked_ = now;
      return message("the scene has changes that are not saved: Ctrl S saves them, closing once more drops them");
    }
    wishes_.quit = true;
    return;
  }
}

bool Session::wants_frame(double now) const { return visible() && (stale_ || pace_.wants_frame(now) || (!message_.empty() && now >= message_until_) || (playing_ && now >= next_frame_at_)); }

std::optional<double> Session::due() const {
  if (!visible()) return std::nullopt;
  std::optional<double> when = pace_.due();
  if (!message_.empty()) when = std::min(when.value_or(message_until_), message_until_);
  if (playing_) when = std::min(when.value_or(next_frame_at_), next_frame_at_);
  return when;
}

void Session::render(double now) {
  now_ = now;
  if (!message_.empty() && now >= message_until_) {
    message_.clear();
    hud_stale_ = true;
  }
  rendered_ = false;
  if (playing_ && now >= next_frame_at_) play(now);
  if (!visible() || !pace_.wants_frame(now)) return;
  const Clock::time_point start = Clock::now();
  draft_shown_ = pace_.draft(now) || !picture_; // something soon at the start, so that all that drafts need is there when a hand comes
  Size2d size = size_;
  if (draft_shown_) {
    const auto part = [this](std::uint32_t length) { return std::max(1u, static_cast<std::uint32_t>(std::lround(length * pace_.scale()))); };
    size = {part(size.width), part(size.height)};
    picture_ = painter_.draft(view(size));
    refined_ms_ = 0.0;
  } else {
    const bool whole = painter_.refine(view(size_), pace_.settled(now) ? pace_.goal_ms() : std::numeric_limits<double>::infinity()); // what moves is shown whole
    refined_ms_ += ms_since(start);
    if (!whole) return; // the rest comes with the next calls, if nothing happens
    picture_ = painter_.refined();
  }
  render_ms_ = draft_shown_ ? ms_since(start) : std::exchange(refined_ms_, 0.0);
  rendered_ = true;
  if (!draft_shown_ || !job_->scene.annotations.cells.empty()) update_annotations();
}

// Legends stay as they are while something moves; edges of cells move along, without what hides them.
void Session::update_annotations() {
  FlatPicture flat;
  if (legend_ && !job_->scene.annotations.empty()) {
    const overlay::Layer layer = overlay::draw_annotations(job_->scene, view(size_), draft_shown_ ? std::vector<float>{} : painter_.depth());
    flat.size = size_;
    flat.rgba.resize(std::size_t{size_.width} * size_.height * 4);
    overlay::lay_over_display(layer, painter_.display(), std::span<std::uint8_t>(flat.rgba));
    flat = cropped(flat);
  }
  presenter_.set("1 annotations", flat);
}

void Session::update_hud(double) {
  std::vector<std::array<std::string, 2>> rows;
  if (help_)
    for (auto& row : help_rows()) rows.push_back(std::move(row));
  presenter_.set("3 help", text_box(rows, HudPlace::Center, size_, scale_));
  rows.clear();
  for (std::size_t i = 0; i < picked_.size(); ++i) {
    for (const auto& row : picked_[i].rows) rows.push_back(row);
    if (i + 1 < picked_.size()) rows.push_back({"distance", fmt::format("{:.6g}", glm::length(picked_[i + 1].center - picked_[i].center))});
  }
  if (picked_.size() == 3)
    if (const auto angle = angle_at(picked_[0].center, picked_[1].center, picked_[2].center)) rows.push_back({"angle at the second", fmt::format("{:.6g} degrees", *angle)});
  const auto beside = [this](FlatPicture box) { // the panels
    if (panels_shown()) box.x += static_cast<std::int32_t>(std::min(panel_width * scale_, size_.width * panel_part));
    return box;
  };
  presenter_.set("2 picked", beside(text_box(rows, HudPlace::TopLeft, size_, scale_)));
  rows.clear();
  for (std::size_t begin = 0; begin < message_.size();) {
    const std::size_t end = std::min(message_.find('\n', begin), message_.size());
    rows.push_back({message_.substr(begin, end - begin), {}});
    begin = end + 1;
  }
  presenter_.set("2 message", beside(text_box(rows, HudPlace::BottomLeft, size_, scale_)));
}

void Session::compose(const gpu::Texture& target) {
  const Clock::time_point start = Clock::now();
  if (hud_stale_) update_hud(now_);
  update_gizmo();
  hud_stale_ = stale_ = false;
  std::function<void(gpu::RenderPass&)> further;
  if (panels_shown()) {
    const Clock::time_point began = Clock::now();
    if (panels_->build(*this, size_, scale_, now_)) stale_ = true;
    panels_->upload();
    panels_ms_ = ms_since(began);
    further = [this, format = target.format()](gpu::RenderPass& pass) { panels_->draw(pass, format); };
  }
  device_.device().queue().wait(presenter_.compose(target, picture_, further));
  device_.check();
  if (rendered_) pace_.drew(draft_shown_, render_ms_, ms_since(start) + present_ms_);
  rendered_ = false;
}

std::string Session::command() const {
  std::string text = "mote render";
  for (const std::string& word : request_.words) text += " " + app::quoted(word);
  if (job_->frame) text += fmt::format(" --frame {}", *job_->frame);
  for (const std::string& setting : request_.settings) text += " --set " + app::quoted(setting);
  text += " --set " + app::quoted("camera=" + camera_inline(control_.camera()));
  if (request_.graph) text += " --graph " + app::quoted(*request_.graph);
  text += fmt::format(" --size {}x{}", size_.width, size_.height);
  return document_.changed() ? text + " # and what was not saved" : text;
}

void Session::screenshot(const std::string& path) {
  if (!visible()) return message("a window without an area has no screenshot");
  try {
    job_->scene.camera = control_.camera();
    app::Job shown = *job_; // of the window's size
    shown.size = size_;
    const app::DrawnPicture picture = painter_.picture(shown, view(size_));
    app::SaveOptions options;
    options.provenance = app::provenance_of(shown, options_.version, command(), device_.info().name, painter_.renderer().display_text());
    app::save_picture(path, picture, options);
    message("screenshot: " + path);
  } catch (const Failure& failure) {
    message(to_string(failure.diagnostic()));
  }
}

} // namespace mote::window
