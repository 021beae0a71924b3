// SPDX-License-Identifier: MIT
// What happens to the window, as values: keys, mouse, sizes, dropped files. The window system (host.cpp), scripts
// (script.hpp) and tests make them; Session takes them. No GLFW, no Vulkan.
//
// Places are pixels of the picture, (0, 0) its top left corner, y down; on a display of high density these are
// more than the window system's units, and the host multiplies.
#pragma once

#include "core/math/camera.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mote::window {

// Letters and digits are their lower-case ASCII code; the rest is named below.
using Key = std::int32_t;
namespace key {
inline constexpr Key none = 0, space = 32, equal = '=', minus = '-', escape = 256, enter = 257, tab = 258, backspace = 259, insert = 260, del = 261,
                     right = 262, left = 263, down = 264, up = 265, page_up = 266, page_down = 267, home = 268, end = 269, shift = 280, control = 281, alt = 282,
                     f1 = 290; // f2 is f1 + 1, and so on to f12
} // namespace key
// "a", "left", "f11"; none for a word that names no key.
Key key_from_name(std::string_view name);
std::string key_name(Key key); // "A", "Left", "F11", as help texts show it

struct Modifiers {
  bool shift{}, control{}, alt{};
  bool operator==(const Modifiers&) const = default;
  [[nodiscard]] bool none() const { return !shift && !control && !alt; }
};

enum class Button : std::uint8_t { Left, Right, Middle };

struct Event {
  enum class Kind : std::uint8_t { Keyboard, Text, MouseButton, Move, Wheel, Resize, Drop, Files, Redraw, Close };
  Kind kind{};
  Key key{};
  std::uint32_t code{};  // Text: a Unicode code point
  bool pressed{true};    // Keyboard and MouseButton; false: let go
  Modifiers modifiers{};
  Button button{};
  double x{}, y{};       // MouseButton, Move, Wheel: where the mouse is
  double wheel{};        // steps; positive: away from the user
  Size2d size{};         // Resize: pixels; 0x0 while minimized
  double scale{1.0};     // Resize: pixels of the display by the usual ones
  std::vector<std::string> files{}; // Drop; Files: those that changed on disk
};

Event key_event(Key key, Modifiers modifiers = {}, bool pressed = true);
Event button_event(Button button, double x, double y, bool pressed, Modifiers modifiers = {});
Event move_event(double x, double y, Modifiers modifiers = {});
Event wheel_event(double steps, double x, double y, Modifiers modifiers = {});
// A place in the window system's units as one of the picture: a window of `units` shows a picture of `pixels`.
glm::dvec2 to_pixels(double x, double y, Size2d units, Size2d pixels);
Event resize_event(Size2d size, double scale = 1.0);

} // namespace mote::window
