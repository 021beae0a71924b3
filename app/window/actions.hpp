// SPDX-License-Identifier: MIT
// Which key does what: one table that the window obeys and the help overlay prints, so that both agree. Keys as
// OVITO's and ParaView's users know them. Mouse gestures are chosen here, too. Pure.
#pragma once

#include "app/window/events.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::window {

enum class Action : std::uint8_t {
  ResetView, FrameAll, AxisX, AxisXBack, AxisY, AxisYBack, AxisZ, AxisZBack, ToggleProjection, ToggleTrackball,
  ToggleFullScreen, TogglePanels, ToggleHelp, ToggleLegend, Screenshot, CopyCamera, Reload, Save, Undo, Redo,
  GizmoMove, GizmoTurn, GizmoScale, GizmoNext, RollLeft, RollRight,
  Play, NextFrame, PreviousFrame, FirstFrame, LastFrame, CenterHere, Release,
  StepProxy, StepDiscard, StepShade, StepDepth, StepQuadratic, StepPoints, // order of passes::Step
  Quit,
};

struct Shortcut {
  Action action{};
  Key key{};
  Modifiers modifiers{};
  std::string_view text{}; // empty: a second key of the action before
};
std::span<const Shortcut> shortcuts();
std::optional<Action> action_of(Key key, const Modifiers& modifiers);

// What a drag with this button does.
enum class Gesture : std::uint8_t { Orbit, Pan, Zoom, Roll };
Gesture gesture_of(Button button, const Modifiers& modifiers);

// Rows of two columns: keys or mouse, and what they do.
std::vector<std::array<std::string, 2>> help_rows();

} // namespace mote::window
