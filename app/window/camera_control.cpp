// SPDX-License-Identifier: MIT
#include "app/window/camera_control.hpp"

#include "core/math/fit.hpp"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace mote::window {
namespace {

constexpr double pole_margin = 0.5; // degrees between the view and up on a turntable
constexpr double nearest = 1e-7, farthest = 1e4; // of the distance or the height, by the extent of the scene
constexpr double border = 1.02;     // frame_all leaves two percent

glm::dvec3 turned(const glm::dvec3& v, double radians, const glm::dvec3& axis) {
  return glm::dvec3(glm::rotate(glm::dmat4(1.0), radians, axis) * glm::dvec4(v, 0.0));
}

double half_tangent(const Camera& c) { return std::tan(glm::radians(c.fov_y) * 0.5); }

} // namespace

CameraControl::CameraControl(const Camera& camera, const Bounds& bounds)
    : camera_(camera), start_(camera), bounds_(bounds), scene_up_(glm::normalize(camera.up)), world_up_(scene_up_) {}

void CameraControl::set_camera(const Camera& camera) {
  if (!check(camera).empty()) return;
  camera_ = start_ = camera;
  scene_up_ = world_up_ = glm::normalize(camera.up);
}

void CameraControl::reset() {
  camera_ = start_;
  world_up_ = scene_up_;
}

glm::dvec3 CameraControl::forward() const { return glm::normalize(camera_.target - camera_.eye); }
glm::dvec3 CameraControl::right() const { return glm::normalize(glm::cross(forward(), camera_.up)); }
glm::dvec3 CameraControl::true_up() const { return glm::cross(right(), forward()); }
double CameraControl::extent() const { return bounds_.diagonal() > 0.0 ? bounds_.diagonal() : 1.0; }

void CameraControl::try_camera(const Camera& wanted) {
  if (check(wanted).empty()) camera_ = wanted;
}

double CameraControl::pixel_length(Size2d size) const {
  const double height = camera_.projection == Projection::Orthographic ? camera_.height : 2.0 * distance() * half_tangent(camera_);
  return height / std::max(1u, size.height);
}

void CameraControl::orbit(double dx, double dy, Size2d size) {
  const double per_pixel = glm::radians(180.0) / std::max(1u, size.height);
  Camera c = camera_;
  glm::dvec3 arm = c.eye - c.target;
  if (trackball_) {
    const glm::dvec3 up = true_up(), side = right();
    arm = turned(turned(arm, -dx * per_pixel, up), -dy * per_pixel, side);
    c.up = glm::normalize(turned(up, -dy * per_pixel, side));
  } else {
    // The angle between the arm and up stays off the poles.
    const double angle = std::acos(std::clamp(glm::dot(glm::normalize(arm), world_up_), -1.0, 1.0));
    const double least = glm::radians(pole_margin);
    const double wanted = std::clamp(angle - dy * per_pixel, least, glm::radians(180.0) - least);
    glm::dvec3 side = glm::cross(-arm, world_up_);
    if (!(glm::length(side) > 1e-9 * glm::length(arm))) side = right(); // straight above or below
    arm = turned(arm, wanted - angle, glm::normalize(side));
    arm = turned(arm, -dx * per_pixel, world_up_);
    c.up = world_up_;
  }
  c.eye = c.target + arm;
  try_camera(c);
}

void CameraControl::pan(double dx, double dy, Size2d size) {
  const glm::dvec3 shift = pixel_length(size) * (-dx * right() + dy * true_up());
  Camera c = camera_;
  c.eye += shift;
  c.target += shift;
  try_camera(c);
}

void CameraControl::zoom(double factor, double x, double y, Size2d size) {
  if (!(factor > 0.0) || !std::isfinite(factor)) return;
  const bool flat = camera_.projection == Projection::Orthographic;
  const double now = flat ? camera_.height : distance();
  factor = std::clamp(factor, nearest * extent() / now, std::max(1.0, farthest * extent() / now));
  const double pixel = pixel_length(size);
  const glm::dvec3 under = camera_.target + pixel * ((x - 0.5 * size.width) * right() - (y - 0.5 * size.height) * true_up());
  Camera c = camera_;
  c.target = under + (camera_.target - under) * factor;
  c.eye = flat ? camera_.eye + (c.target - camera_.target) : under + (camera_.eye - under) * factor;
  if (flat) c.height *= factor;
  try_camera(c);
}

void CameraControl::roll(const glm::dvec2& from, const glm::dvec2& to, Size2d size) {
  const glm::dvec2 middle(0.5 * size.width, 0.5 * size.height), a = from - middle, b = to - middle;
  const double turn = std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)); // clockwise: y is down
  if (std::isfinite(turn)) roll(turn);
}

void CameraControl::roll(double radians) {
  Camera c = camera_;
  c.up = glm::normalize(turned(true_up(), -radians, forward())); // things turn clockwise, so the camera the other way
  try_camera(c);
  world_up_ = glm::normalize(camera_.up);
}

void CameraControl::look_along(int axis, bool from_back) {
  glm::dvec3 arm(0);
  arm[axis] = from_back ? -1.0 : 1.0;
  Camera c = camera_;
  c.eye = c.target + arm * distance();
  c.up = world_up_ = scene_up_;
  if (std::abs(glm::dot(arm, world_up_)) > 0.99) c.up = std::abs(world_up_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -arm[axis]);
  try_camera(c);
}

void CameraControl::frame_all(Size2d size) {
  Bounds b = bounds_;
  if (b.empty()) b.add(glm::dvec3(0), 0.5);
  Camera c = camera_;
  const glm::dvec3 arm = -forward();
  c.target = b.center();
  const Extent e = extent_of(b, c, arm, size);
  const double least = 1e-9 * (extent() + glm::length(c.target));
  c.height = std::max(border * e.height, least);
  const bool flat = c.projection == Projection::Orthographic;
  c.eye = c.target + arm * std::max(flat ? border * e.depth + 0.5 * e.height : border * e.distance, least);
  try_camera(c);
}

void CameraControl::toggle_projection() {
  Camera c = camera_;
  if (c.projection == Projection::Perspective) {
    c.projection = Projection::Orthographic;
    c.height = 2.0 * distance() * half_tangent(c);
    // Nothing lies behind the eye: an orthographic picture ends there.
    c.eye = c.target - forward() * std::max(distance(), extent() + glm::length(bounds_.empty() ? glm::dvec3(0) : bounds_.center() - c.target));
  } else {
    c.projection = Projection::Perspective;
    c.eye = c.target - forward() * (c.height / (2.0 * half_tangent(c)));
  }
  try_camera(c);
}

void CameraControl::center_at(const glm::dvec3& world) {
  Camera c = camera_;
  if (c.projection == Projection::Orthographic) c.eye += world - c.target;
  c.target = world;
  try_camera(c);
}

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_vector(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", toml_number(v.x), toml_number(v.y), toml_number(v.z)); }

namespace {

std::vector<std::pair<std::string, std::string>> camera_values(const Camera& c) {
  const bool flat = c.projection == Projection::Orthographic;
  std::vector<std::pair<std::string, std::string>> out{{"projection", flat ? "\"orthographic\"" : "\"perspective\""},
                                                       {"eye", toml_vector(c.eye)}, {"target", toml_vector(c.target)}, {"up", toml_vector(c.up)}};
  out.emplace_back(flat ? "height" : "fov_y", toml_number(flat ? c.height : c.fov_y));
  if (c.near) out.emplace_back("near", toml_number(*c.near));
  if (c.far) out.emplace_back("far", toml_number(*c.far));
  return out;
}

} // namespace

std::string camera_toml(const Camera& c) {
  std::string text = "[camera]\n";
  for (const auto& [key, value] : camera_values(c)) text += key + " = " + value + "\n";
  return text;
}

std::string camera_inline(const Camera& c) {
  std::string text;
  for (const auto& [key, value] : camera_values(c)) text += (text.empty() ? "" : ", ") + key + " = " + value;
  return "{ " + text + " }";
}

} // namespace mote::window
