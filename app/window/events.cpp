// SPDX-License-Identifier: MIT
#include "app/window/events.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <utility>

namespace mote::window {
namespace {

constexpr std::array<std::pair<std::string_view, Key>, 19> names{{
    {"space", key::space}, {"escape", key::escape}, {"enter", key::enter}, {"tab", key::tab}, {"backspace", key::backspace},
    {"insert", key::insert}, {"delete", key::del}, {"right", key::right}, {"left", key::left}, {"down", key::down}, {"up", key::up},
    {"page_up", key::page_up}, {"page_down", key::page_down}, {"home", key::home}, {"end", key::end},
    {"shift", key::shift}, {"control", key::control}, {"alt", key::alt}, {"equal", key::equal},
}};

} // namespace

Key key_from_name(std::string_view name) {
  for (const auto& [word, code] : names)
    if (word == name) return code;
  if (name.size() >= 2 && (name[0] == 'f' || name[0] == 'F')) {
    int number = 0;
    const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size() && number >= 1 && number <= 12) return key::f1 + number - 1;
  }
  if (name.size() != 1 || name[0] < 33 || name[0] > 126) return key::none;
  return std::tolower(static_cast<unsigned char>(name[0]));
}

std::string key_name(Key code) {
  if (code >= key::f1 && code < key::f1 + 12) return fmt::format("F{}", code - key::f1 + 1);
  if (code > 32 && code < 127) return std::string(1, static_cast<char>(std::toupper(code)));
  for (const auto& [word, known] : names) {
    if (known != code) continue;
    std::string text(word);
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    for (char& c : text)
      if (c == '_') c = ' ';
    return text;
  }
  return "?";
}

Event key_event(Key code, Modifiers modifiers, bool pressed) {
  Event e{.kind = Event::Kind::Keyboard};
  e.key = code;
  e.modifiers = modifiers;
  e.pressed = pressed;
  return e;
}

Event button_event(Button button, double x, double y, bool pressed, Modifiers modifiers) {
  Event e{.kind = Event::Kind::MouseButton};
  e.button = button;
  e.x = x;
  e.y = y;
  e.pressed = pressed;
  e.modifiers = modifiers;
  return e;
}

Event move_event(double x, double y, Modifiers modifiers) {
  Event e{.kind = Event::Kind::Move};
  e.x = x;
  e.y = y;
  e.modifiers = modifiers;
  return e;
}

Event wheel_event(double steps, double x, double y, Modifiers modifiers) {
  Event e{.kind = Event::Kind::Wheel};
  e.wheel = steps;
  e.x = x;
  e.y = y;
  e.modifiers = modifiers;
  return e;
}

glm::dvec2 to_pixels(double x, double y, Size2d units, Size2d pixels) {
  if (units.width == 0 || units.height == 0) return {x, y};
  return {x * pixels.width / units.width, y * pixels.height / units.height};
}

Event resize_event(Size2d size, double scale) {
  Event e{.kind = Event::Kind::Resize};
  e.size = size;
  e.scale = scale;
  return e;
}

} // namespace mote::window
