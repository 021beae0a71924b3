// SPDX-License-Identifier: MIT
#include "app/window/glfw_input.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace mote::window {
namespace {

// GLFW's codes of letters are upper-case ASCII; the others have the numbers that events.hpp took over.
Key key_of(int code) {
  if (code >= 'A' && code <= 'Z') return code - 'A' + 'a';
  if (code > 32 && code < 127) return code;
  switch (code) {
  case GLFW_KEY_SPACE: return key::space;
  case GLFW_KEY_ESCAPE: return key::escape;
  case GLFW_KEY_ENTER: case GLFW_KEY_KP_ENTER: return key::enter;
  case GLFW_KEY_TAB: return key::tab;
  case GLFW_KEY_BACKSPACE: return key::backspace;
  case GLFW_KEY_INSERT: return key::insert;
  case GLFW_KEY_DELETE: return key::del;
  case GLFW_KEY_RIGHT: return key::right;
  case GLFW_KEY_LEFT: return key::left;
  case GLFW_KEY_DOWN: return key::down;
  case GLFW_KEY_UP: return key::up;
  case GLFW_KEY_PAGE_UP: return key::page_up;
  case GLFW_KEY_PAGE_DOWN: return key::page_down;
  case GLFW_KEY_HOME: return key::home;
  case GLFW_KEY_END: return key::end;
  case GLFW_KEY_LEFT_SHIFT: case GLFW_KEY_RIGHT_SHIFT: return key::shift;
  case GLFW_KEY_LEFT_CONTROL: case GLFW_KEY_RIGHT_CONTROL: return key::control;
  case GLFW_KEY_LEFT_ALT: case GLFW_KEY_RIGHT_ALT: return key::alt;
  default: break;
  }
  if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9) return '0' + (code - GLFW_KEY_KP_0);
  if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12) return key::f1 + (code - GLFW_KEY_F1);
  return key::none;
}

Modifiers modifiers_of(int bits) { return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_ALT) != 0}; }

Modifiers modifiers_now(GLFWwindow* window) {
  const auto down = [window](int left, int right) { return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS; };
  return {down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT), down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL), down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

} // namespace

GlfwInput::GlfwInput(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window, this);
  static constexpr auto self = [](GLFWwindow* w) -> GlfwInput& { return *static_cast<GlfwInput*>(glfwGetWindowUserPointer(w)); };
  glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int, int action, int mods) {
    self(w).events_.push_back(key_event(key_of(code), modifiers_of(mods), action != GLFW_RELEASE));
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code) {
    Event e{.kind = Event::Kind::Text};
    e.code = code;
    self(w).events_.push_back(e);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    const glm::dvec2 at = self(w).place();
    const Button which = button == GLFW_MOUSE_BUTTON_LEFT ? Button::Left : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::Right : Button::Middle;
    self(w).events_.push_back(button_event(which, at.x, at.y, action == GLFW_PRESS, modifiers_of(mods)));
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    self(w).cursor_ = glm::dvec2(x, y);
    const glm::dvec2 at = self(w).to_pixels(x, y);
    self(w).events_.push_back(move_event(at.x, at.y, modifiers_now(w)));
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double steps) {
    const glm::dvec2 at = self(w).place();
    self(w).events_.push_back(wheel_event(steps, at.x, at.y, modifiers_now(w)));
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    Event e{.kind = Event::Kind::Drop};
    for (int i = 0; i < count; ++i) e.files.emplace_back(paths[i]);
    self(w).events_.push_back(std::move(e));
  });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { self(w).events_.push_back({.kind = Event::Kind::Redraw}); });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { self(w).events_.push_back({.kind = Event::Kind::Close}); });
}

glm::dvec2 GlfwInput::to_pixels(double x, double y) const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return window::to_pixels(x, y, {static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))}, size_);
}

// Where the mouse was when the event came, which is not where it is by now: pictures take time.
glm::dvec2 GlfwInput::place() const {
  double x = 0, y = 0;
  if (!cursor_) glfwGetCursorPos(window_, &x, &y);
  return cursor_ ? to_pixels(cursor_->x, cursor_->y) : to_pixels(x, y);
}

void GlfwInput::check_size() {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  float across = 1.0f, down = 1.0f;
  glfwGetWindowContentScale(window_, &across, &down);
  Size2d now{static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))};
  if (minimized_ || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) now = {};
  const double scale = across > 0.0f ? double{across} : 1.0;
  if (now == size_ && scale == scale_) return;
  size_ = now;
  scale_ = scale;
  events_.push_back(resize_event(now, scale));
}

std::vector<Event> GlfwInput::take() {
  check_size();
  return std::exchange(events_, {});
}

} // namespace mote::window
