// SPDX-License-Identifier: MIT
// Sections of the panel about how the scene is seen: lights and camera.
#include "app/window/gui/sections.hpp"
#include "core/color/srgb.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace mote::window {
namespace {

std::string color_text(const float* rgb) {
  std::string text = "\"#";
  for (int k = 0; k < 3; ++k) text += fmt::format("{:02x}", to_8bit(double{rgb[k]}));
  return text + "\"";
}

void light(Session& session, std::size_t i) {
  const Light l = session.job().desc.lights[i];
  const std::string path = fmt::format("light[{}].", i);
  constexpr const char* kinds[] = {"directional", "point", "spot", "headlight"};
  ImGui::Text("%s (%s)", l.name.empty() ? fmt::format("light {}", i).c_str() : l.name.c_str(), kinds[static_cast<int>(l.kind)]);
  auto intensity = static_cast<float>(l.intensity);
  if (ImGui::SliderFloat("intensity", &intensity, 0.0f, 3.0f, "%.2f")) session.set(path + "intensity", toml_number(static_cast<double>(std::max(intensity, 0.0f))), true);
  float rgb[3];
  for (int k = 0; k < 3; ++k) rgb[k] = static_cast<float>(srgb_encode(std::clamp(l.color[k], 0.0, 1.0)));
  if (ImGui::ColorEdit3("color", rgb)) session.set(path + "color", color_text(rgb), true);
  if (l.kind == LightKind::Directional || l.kind == LightKind::Spot) {
    float d[3] = {static_cast<float>(l.direction.x), static_cast<float>(l.direction.y), static_cast<float>(l.direction.z)};
    if (ImGui::DragFloat3("direction", d, 0.01f, -1.0f, 1.0f, "%.2f") && glm::length(glm::vec3(d[0], d[1], d[2])) > 1e-3f)
      session.set(path + "direction", toml_vector({d[0], d[1], d[2]}), true);
  }
  if (l.kind == LightKind::Point || l.kind == LightKind::Spot) {
    float p[3] = {static_cast<float>(l.position.x), static_cast<float>(l.position.y), static_cast<float>(l.position.z)};
    if (ImGui::DragFloat3("position", p, static_cast<float>(session.job().scene.bounds.diagonal()) / 300.0f, 0.0f, 0.0f, "%.3g"))
      session.set(path + "position", toml_vector({p[0], p[1], p[2]}), true);
  }
}

} // namespace

void light_section(Session& session) {
  for (std::size_t i = 0; i < session.job().desc.lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    light(session, i);
    ImGui::PopID();
  }
  auto ambient = static_cast<float>(session.job().desc.ambient.y);
  if (ImGui::SliderFloat("ambient", &ambient, 0.0f, 1.0f, "%.2f")) session.set("ambient.intensity", toml_number(static_cast<double>(ambient)), true);
}

void gizmo_section(Session& session) {
  const std::vector<GizmoTarget> targets = session.gizmo_targets();
  if (targets.empty()) return ImGui::TextDisabled("there is nothing to move");
  const std::size_t now = std::min(session.gizmo_target(), targets.size() - 1);
  if (ImGui::BeginCombo("of", targets[now].name.c_str())) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(targets[i].name.c_str(), i == now)) session.set_gizmo_target(i);
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  constexpr std::pair<const char*, GizmoMode> modes[] = {{"move", GizmoMode::Move}, {"turn", GizmoMode::Turn}, {"scale", GizmoMode::Scale}};
  if (ImGui::RadioButton("none", !session.gizmo_mode())) session.set_gizmo({});
  for (const auto& [word, mode] : modes) {
    if (!targets[now].can(mode)) continue;
    ImGui::SameLine();
    if (ImGui::RadioButton(word, session.gizmo_mode() == mode)) session.set_gizmo(mode);
  }
}

void camera_section(Session& session) {
  Camera c = session.camera();
  const auto vector = [](const char* label, glm::dvec3& v, double speed) {
    float f[3] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    if (!ImGui::DragFloat3(label, f, static_cast<float>(speed), 0.0f, 0.0f, "%.4g")) return false;
    v = {f[0], f[1], f[2]};
    return true;
  };
  const double speed = std::max(session.job().scene.bounds.diagonal(), 1e-9) / 300.0;
  bool changed = vector("eye", c.eye, speed) | vector("target", c.target, speed);
  const bool flat = c.projection == Projection::Orthographic;
  auto value = static_cast<float>(flat ? c.height : c.fov_y);
  if (flat ? ImGui::DragFloat("height", &value, static_cast<float>(speed), 1e-6f, 1e12f, "%.4g") : ImGui::SliderFloat("field of view", &value, 5.0f, 120.0f, "%.0f degrees")) {
    (flat ? c.height : c.fov_y) = value;
    changed = true;
  }
  if (changed) session.set_camera(c);
  if (ImGui::Button(flat ? "perspective" : "orthographic")) session.act(Action::ToggleProjection);
  ImGui::SameLine();
  if (ImGui::Button("frame all")) session.act(Action::FrameAll);
  ImGui::SameLine();
  if (ImGui::Button("reset")) session.act(Action::ResetView);
  ImGui::SameLine();
  if (ImGui::Button("copy")) session.act(Action::CopyCamera);
  if (ImGui::Button("roll left")) session.act(Action::RollLeft);
  ImGui::SameLine();
  if (ImGui::Button("roll right")) session.act(Action::RollRight);
}

} // namespace mote::window
