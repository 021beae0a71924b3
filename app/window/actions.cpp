// SPDX-License-Identifier: MIT
#include "app/window/actions.hpp"

namespace mote::window {
namespace {

constexpr Modifiers plain{}, shift{.shift = true}, control{.control = true}, both{.shift = true, .control = true};

constexpr std::array table{
    Shortcut{Action::FrameAll, 'f', plain, "frame all particles"},
    Shortcut{Action::ResetView, 'r', plain, "the view of the start"},
    Shortcut{Action::ResetView, key::equal, plain, {}},
    Shortcut{Action::AxisX, 'x', plain, "look along an axis; with Ctrl or Shift from the other side"},
    Shortcut{Action::AxisX, '3', plain, {}},
    Shortcut{Action::AxisXBack, 'x', shift, {}},
    Shortcut{Action::AxisXBack, '3', control, {}},
    Shortcut{Action::AxisXBack, 'x', control, {}},
    Shortcut{Action::AxisY, 'y', plain, {}},
    Shortcut{Action::AxisY, '1', plain, {}},
    Shortcut{Action::AxisYBack, 'y', shift, {}},
    Shortcut{Action::AxisYBack, '1', control, {}},
    Shortcut{Action::AxisZ, 'z', plain, {}},
    Shortcut{Action::AxisZ, '7', plain, {}},
    Shortcut{Action::AxisZBack, 'z', shift, {}},
    Shortcut{Action::AxisZBack, '7', control, {}},
    Shortcut{Action::ToggleProjection, 'p', plain, "perspective or orthographic"},
    Shortcut{Action::ToggleProjection, '5', plain, {}},
    Shortcut{Action::ToggleTrackball, 't', plain, "turntable (up stays up) or trackball"},
    Shortcut{Action::CenterHere, 'o', plain, "orbit about the particle under the mouse"},
    Shortcut{Action::GizmoMove, 'w', plain, "handles to move, turn or scale data sets and lights"},
    Shortcut{Action::GizmoMove, 'g', plain, {}},
    Shortcut{Action::GizmoTurn, 'e', plain, {}},
    Shortcut{Action::GizmoScale, 'r', shift, {}},
    Shortcut{Action::GizmoNext, 'n', plain, "the next thing for the handles"},
    Shortcut{Action::RollLeft, '[', plain, "roll the camera by 15 degrees"},
    Shortcut{Action::RollRight, ']', plain, {}},
    Shortcut{Action::Play, key::space, plain, "play or pause"},
    Shortcut{Action::PreviousFrame, key::left, plain, "one frame back, one frame on"},
    Shortcut{Action::NextFrame, key::right, plain, {}},
    Shortcut{Action::FirstFrame, key::home, plain, "first frame, last frame"},
    Shortcut{Action::LastFrame, key::end, plain, {}},
    Shortcut{Action::Screenshot, 's', plain, "screenshot"},
    Shortcut{Action::Screenshot, key::f1 + 11, plain, {}},
    Shortcut{Action::CopyCamera, 'c', plain, "copy the camera as TOML"},
    Shortcut{Action::ToggleLegend, 'l', plain, "legend"},
    Shortcut{Action::TogglePanels, key::tab, plain, "panels"},
    Shortcut{Action::ToggleFullScreen, key::f1 + 10, plain, "full screen"},
    Shortcut{Action::Reload, key::f1 + 4, plain, "read all files again"},
    Shortcut{Action::Reload, 'r', control, {}},
    Shortcut{Action::Save, 's', control, "save the scene"},
    Shortcut{Action::Undo, 'z', control, "undo, redo"},
    Shortcut{Action::Redo, 'z', both, {}},
    Shortcut{Action::Redo, 'y', control, {}},
    Shortcut{Action::StepProxy, '1', shift, "with Shift 2 to 6: the steps proxy, discard, shade, depth (all), quadratic, points"},
    Shortcut{Action::StepDiscard, '2', shift, {}},
    Shortcut{Action::StepShade, '3', shift, {}},
    Shortcut{Action::StepDepth, '4', shift, {}},
    Shortcut{Action::StepQuadratic, '5', shift, {}},
    Shortcut{Action::StepPoints, '6', shift, {}},
    Shortcut{Action::ToggleHelp, 'h', plain, "this help"},
    Shortcut{Action::ToggleHelp, key::f1, plain, {}},
    Shortcut{Action::Release, key::escape, plain, "let go: of help, selection, full screen"},
    Shortcut{Action::Quit, 'q', control, "quit"},
};

std::string combination(const Shortcut& s) {
  std::string text;
  if (s.modifiers.control) text += "Ctrl ";
  if (s.modifiers.shift) text += "Shift ";
  return text + key_name(s.key);
}

} // namespace

std::span<const Shortcut> shortcuts() { return table; }

std::optional<Action> action_of(Key pressed, const Modifiers& modifiers) {
  for (const Shortcut& s : table)
    if (s.key == pressed && s.modifiers == modifiers) return s.action;
  return std::nullopt;
}

Gesture gesture_of(Button button, const Modifiers& modifiers) {
  if (button == Button::Left) return modifiers.shift ? Gesture::Pan : modifiers.control ? Gesture::Roll : Gesture::Orbit;
  if (button == Button::Right) return modifiers.shift || modifiers.control ? Gesture::Zoom : Gesture::Pan;
  return modifiers.control ? Gesture::Zoom : Gesture::Pan;
}

std::vector<std::array<std::string, 2>> help_rows() {
  std::vector<std::array<std::string, 2>> rows{
      {"Left drag", "turn"},
      {"Middle, right or Shift left drag", "move"},
      {"Ctrl left drag", "roll about the middle"},
      {"Wheel, Shift right drag", "zoom, to where the mouse is"},
      {"Ctrl click", "pick a particle; again: distance, then angle"},
      {"Drag a handle", "move, turn or scale along an axis; its middle: along two, with Shift scale evenly"},
      {"Double click", "orbit about what is there"},
      {"Drop files", "open them"},
  };
  for (const Shortcut& s : table) {
    if (!s.text.empty()) rows.push_back({combination(s), std::string(s.text)});
    else if (s.modifiers.none() || s.action == Action::Redo || s.action == Action::Reload || s.action == Action::GizmoScale) rows.back()[0] += ", " + combination(s);
  }
  return rows;
}

} // namespace mote::window
