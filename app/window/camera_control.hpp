// SPDX-License-Identifier: MIT
// The camera under the mouse: turns, moves, zooms, axis views. Pure: no window, no device; drags are pixels of a picture of a
// given size, y down. The camera it holds can always see (check() of core/math is empty), whatever it is asked.
//
// Turntable: turns about the world's up through the target, and up or down until half a degree before the pole. Trackball:
// turns about the axes of the picture; up goes along.
#pragma once

#include "core/math/camera.hpp"

#include <string>

namespace mote::window {

class CameraControl {
public:
  // `bounds` of what is shown: for frame_all, and for how near and far zooming goes.
  CameraControl(const Camera& camera, const Bounds& bounds);

  [[nodiscard]] const Camera& camera() const { return camera_; }
  void set_camera(const Camera& camera); // ignored if it cannot see
  void set_bounds(const Bounds& bounds) { bounds_ = bounds; }

  // A drag over the whole height of the picture is half a turn.
  void orbit(double dx, double dy, Size2d size);
  // What lies at the target's depth follows the mouse.
  void pan(double dx, double dy, Size2d size);
  // Everything `factor` times as far (orthographic: as large a part is seen); what lies under pixel (x, y) at the target's depth stays there.
  void zoom(double factor, double x, double y, Size2d size);
  // About the view: the picture turns with the mouse about its middle, or clockwise by an angle. A turntable then turns about what is up
  // in the picture; axis views and reset() bring the world's up back.
  void roll(const glm::dvec2& from, const glm::dvec2& to, Size2d size);
  void roll(double radians);
  // Along a world axis: from +axis, or from the other side. The target and the distance stay.
  void look_along(int axis, bool from_back);
  void frame_all(Size2d size);
  void reset();
  void toggle_projection(); // things at the target's depth keep their size
  // The target there, the eye stays; what was under the mouse moves to the middle.
  void center_at(const glm::dvec3& world);
  void set_trackball(bool on) { trackball_ = on; }
  [[nodiscard]] bool trackball() const { return trackball_; }

  // Length in the world of a pixel at the target's depth.
  [[nodiscard]] double pixel_length(Size2d size) const;

private:
  [[nodiscard]] glm::dvec3 right() const, true_up() const, forward() const;
  [[nodiscard]] double distance() const { return glm::length(camera_.target - camera_.eye); }
  [[nodiscard]] double extent() const;
  void try_camera(const Camera& wanted); // keeps the present one if that cannot see

  Camera camera_, start_;
  Bounds bounds_;
  glm::dvec3 scene_up_, world_up_; // the scene's, and what a turntable turns about
  bool trackball_{};
};

// A [camera] table of a scene file that gives exactly this camera.
std::string camera_toml(const Camera& camera);
// The same as a value: "{ projection = ..., eye = [...] }".
std::string camera_inline(const Camera& camera);
// "[1.5, 0.0, 2.0]" and "1.5": numbers that read back as they are.
std::string toml_number(double value);
std::string toml_vector(const glm::dvec3& value);

} // namespace mote::window
