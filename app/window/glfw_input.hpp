// SPDX-License-Identifier: MIT
// GLFW's callbacks as events: collects what happens to a window until the host fetches it. Only host.cpp uses it.
#pragma once

#include "app/window/events.hpp"

#include <optional>
#include <vector>

struct GLFWwindow;

namespace mote::window {

class GlfwInput {
public:
  explicit GlfwInput(GLFWwindow* window); // sets the callbacks and the window's user pointer
  GlfwInput(const GlfwInput&) = delete;
  GlfwInput& operator=(const GlfwInput&) = delete;

  std::vector<Event> take(); // what came since the last call
  // Looks at the window's size: some window systems report no change of it.
  void check_size();
  void simulate_minimized(bool on) { minimized_ = on; }
  [[nodiscard]] Size2d size() const { return size_; }

private:
  [[nodiscard]] glm::dvec2 to_pixels(double x, double y) const;
  [[nodiscard]] glm::dvec2 place() const;

  GLFWwindow* window_;
  std::vector<Event> events_{};
  Size2d size_{};
  double scale_{};
  std::optional<glm::dvec2> cursor_{}; // the window system's units; of the last move
  bool minimized_{};
  Modifiers modifiers_{};
};

} // namespace mote::window
