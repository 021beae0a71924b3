// SPDX-License-Identifier: MIT
// The part of a session that moves, turns and scales things with the mouse: data sets by a step of their transform, lights by
// their place and direction. All of it goes through Document, so that one Ctrl Z takes a whole drag back and saving writes it.
#include "app/window/codes.hpp"
#include "app/window/session.hpp"
#include "core/scene/realize.hpp"
#include "core/toml/node.hpp"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace mote::window {
namespace {

// The last step of a transform as it is written, where it is of the word asked for.
std::optional<config::Node> last_step(const std::string& text, std::size_t data, const char* word, std::size_t& index) {
  const config::Node root = config::parse(text, "scene", code::not_patchable);
  const config::Node* tables = root.find("data");
  const config::Node* list = tables && data < tables->items.size() ? tables->items[data].find("transform") : nullptr;
  if (!list || list->items.empty()) return std::nullopt;
  index = list->items.size() - 1;
  const config::Node* step = list->items.back().find(word);
  return step ? std::optional(*step) : std::nullopt;
}

glm::dvec3 vector_of(const config::Node* node) {
  glm::dvec3 out(0);
  for (std::size_t k = 0; node && k < node->items.size() && k < 3; ++k) out[static_cast<int>(k)] = node->items[k].real;
  return out;
}

// Sums of numbers with few digits have few digits: twelve are kept.
glm::dvec3 legible(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0.0)) return v;
  const double step = std::pow(10.0, std::floor(std::log10(largest)) - 12.0);
  for (int k = 0; k < 3; ++k) v[k] = step < 1.0 ? std::round(v[k] / step) / std::round(1.0 / step) : std::round(v[k] / step) * step;
  return v;
}

} // namespace

std::vector<GizmoTarget> Session::gizmo_targets() const {
  std::vector<GizmoTarget> out;
  const SceneDesc& desc = job_->desc;
  for (std::size_t i = 0; i < desc.data.size(); ++i) {
    const std::string name = desc.data[i].generated ? desc.name : desc.data[i].file.value.filename().string();
    out.push_back({GizmoTarget::Kind::Data, i, desc.data.size() > 1 ? fmt::format("{} (data {})", name, i) : name, true, true, true});
  }
  for (std::size_t i = 0; i < desc.lights.size(); ++i) {
    const Light& light = desc.lights[i];
    const bool placed = light.kind == LightKind::Point || light.kind == LightKind::Spot, aimed = light.kind == LightKind::Directional || light.kind == LightKind::Spot;
    if (placed || aimed) out.push_back({GizmoTarget::Kind::Light, i, "light " + light.name, placed, aimed, false});
  }
  return out;
}

void Session::set_gizmo(std::optional<GizmoMode> mode) {
  end_gizmo_drag();
  const std::vector<GizmoTarget> targets = gizmo_targets();
  if (gizmo_.target >= targets.size()) gizmo_.target = 0;
  stale_ = true;
  gizmo_.mode.reset();
  gizmo_.lit.reset();
  if (!mode) return;
  if (targets.empty()) return message("there is nothing to move");
  const GizmoTarget& target = targets[gizmo_.target];
  if (!target.can(*mode)) return message(fmt::format("{} can only be {}", target.name, target.moves && target.turns ? "moved and turned" : target.moves ? "moved" : "turned"));
  gizmo_.mode = mode;
  message(fmt::format("{}: {} (N: the next thing, Esc: let go)", *mode == GizmoMode::Move ? "move" : *mode == GizmoMode::Turn ? "turn" : "scale", target.name));
}

void Session::set_gizmo_target(std::size_t target) {
  const std::vector<GizmoTarget> targets = gizmo_targets();
  if (target >= targets.size()) return;
  const std::optional<GizmoMode> mode = gizmo_.mode;
  gizmo_.target = target;
  if (!mode) return;
  set_gizmo(targets[target].can(*mode) ? *mode : targets[target].moves ? GizmoMode::Move : GizmoMode::Turn);
}

// Data sets: the middle of what the transform takes, so that a turn leaves it where it is. Lights: their place, or the scene's middle.
glm::dvec3 Session::gizmo_pivot(const GizmoTarget& target) const {
  const Scene& scene = job_->scene;
  if (target.kind == GizmoTarget::Kind::Light) {
    const Light& light = job_->desc.lights[target.index];
    return target.moves ? light.position : scene.bounds.empty() ? glm::dvec3(0) : scene.bounds.center();
  }
  const glm::dmat4& transform = job_->desc.data[target.index].transform;
  const glm::dmat4 back = glm::inverse(transform);
  Bounds bounds;
  for (const Batch& batch : scene.batches)
    if (batch.data == target.index && !batch.chunks->bounds.empty())
      for (const Instance& instance : batch.instances) {
        const glm::dmat4 m = back * instance.world_from_data;
        const Bounds& box = batch.chunks->bounds;
        for (int i = 0; i < 8; ++i) bounds.add(glm::dvec3(m * glm::dvec4(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z, 1.0)));
      }
  return glm::dvec3(transform * glm::dvec4(bounds.empty() ? glm::dvec3(0) : bounds.center(), 1.0));
}

std::vector<GizmoStroke> Session::gizmo_strokes_now() const {
  if (!gizmo_.mode || !visible()) return {};
  const std::vector<GizmoTarget> targets = gizmo_targets();
  if (gizmo_.target >= targets.size()) return {};
  return gizmo_strokes(*gizmo_.mode, view(size_), gizmo_pivot(targets[gizmo_.target]), scale_);
}

void Session::update_gizmo() {
  FlatPicture picture;
  if (gizmo_.mode) picture = gizmo_picture(gizmo_strokes_now(), gizmo_.drag ? gizmo_.drag->part : gizmo_.lit, scale_);
  if (picture.size.width > 0 || gizmo_.shown) presenter_.set("0 gizmo", picture);
  gizmo_.shown = picture.size.width > 0;
}

bool Session::begin_gizmo_drag(const Event& event) {
  if (!gizmo_.mode || event.button != Button::Left || event.modifiers.control) return false;
  const std::optional<GizmoPart> part = gizmo_part_at(gizmo_strokes_now(), event.x, event.y, scale_);
  if (!part) return false;
  const GizmoTarget target = gizmo_targets()[gizmo_.target];
  GizmoDrag drag{.target = target, .part = *part, .view = view(size_), .pivot = gizmo_pivot(target), .from = {event.x, event.y}};
  if (target.kind == GizmoTarget::Kind::Light) drag.light = job_->desc.lights[target.index];
  gizmo_.drag = drag;
  stale_ = true;
  return true;
}

void Session::end_gizmo_drag() {
  if (gizmo_.drag) stale_ = true;
  gizmo_.drag.reset();
}

void Session::hover_gizmo(double x, double y) {
  if (!gizmo_.mode || held_) return;
  const std::optional<GizmoPart> lit = gizmo_part_at(gizmo_strokes_now(), x, y, scale_);
  if (lit != gizmo_.lit) stale_ = true;
  gizmo_.lit = lit;
}

void Session::drag_gizmo(const glm::dvec2& to, const Modifiers& modifiers) {
  GizmoDrag& drag = *gizmo_.drag;
  const glm::dvec2 by = to - drag.from;
  const GizmoChange change = drag.part == GizmoPart::Both ? gizmo_change(*gizmo_.mode, drag.view, drag.pivot, by.x, by.y, modifiers.shift)
                                                          : gizmo_change_along(*gizmo_.mode, static_cast<int>(drag.part), drag.view, drag.pivot, gizmo_length(drag.view, drag.pivot, handle_pixels * scale_), drag.from, by.x, by.y);
  if (change.nothing() && !drag.begun) return;
  const bool done = drag.target.kind == GizmoTarget::Kind::Light ? move_light(drag, change) : move_data(drag, change);
  if (done && gizmo_.drag) gizmo_.drag->begun = true;
}

bool Session::move_light(const GizmoDrag& drag, const GizmoChange& change) {
  const std::string path = fmt::format("light[{}].", drag.target.index);
  if (change.mode == GizmoMode::Move) return set(path + "position", toml_vector(legible(drag.light.position + change.shift)), drag.begun);
  glm::dvec3 direction = glm::dvec3(change.matrix() * glm::dvec4(drag.light.direction, 0.0));
  for (int k = 0; k < 3; ++k) direction[k] = std::round(direction[k] * 1e6) / 1e6;
  return set(path + "direction", toml_vector(direction), drag.begun);
}

// A drag goes on where the one before it stopped, if that was of its kind: the file gets one step, not one for each drag.
bool Session::move_data(GizmoDrag& drag, const GizmoChange& change) {
  const std::string path = fmt::format("data[{}].transform", drag.target.index);
  if (!drag.base) {
    drag.base = document_.text();
    const char* word = change.mode == GizmoMode::Move ? "translate" : change.mode == GizmoMode::Turn ? "rotate" : "matrix";
    drag.last = last_step(*drag.base, drag.target.index, word, drag.last_index);
  }
  return change_text(path, [&] {
    const std::string last = fmt::format("{}[{}].", path, drag.last_index);
    if (change.nothing()) return *drag.base;
    if (drag.last && change.mode == GizmoMode::Move)
      return document_.with(*drag.base, last + "translate", toml_vector(legible(vector_of(&*drag.last) + change.shift)));
    if (drag.last && change.mode == GizmoMode::Turn && change.turns[1].degrees == 0.0) {
      const config::Node* angle = drag.last->find("angle");
      const bool same = angle && vector_of(drag.last->find("axis")) == axis_unit(change.turns[0].axis) &&
                        glm::length(vector_of(drag.last->find("through")) - change.pivot) <= 1e-6 * std::max(1e-300, job_->scene.bounds.diagonal());
      if (same) return document_.with(*drag.base, last + "rotate.angle", toml_number(std::round((angle->real + change.turns[0].degrees) * 100.0) / 100.0));
    }
    return document_.with_appended(*drag.base, path, change.steps());
  }, drag.begun);
}

} // namespace mote::window
