// SPDX-License-Identifier: MIT
// The parts of the panel, one function each; called inside an ImGui window, they read the session and change it by its own
// calls (set, set_frame, ...), so that undo and saving know of everything. What they remember lives in GuiState.
#pragma once

#include "app/window/gui/gui_renderer.hpp"
#include "app/window/session.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mote::window {

struct GuiState {
  // Histogram of a mapped attribute, made anew when its source changes.
  std::string histogram_of{};
  std::array<float, 64> histogram{};
  double low{}, high{};
  // The slot that is looked at.
  std::string slot{};
  std::string slot_seen{}; // of which camera and size
  std::optional<SlotPixels> pixels{};
  std::pair<double, double> slot_range{};
  std::string slot_problem{};
  std::array<char, 256> setting{};
};

void data_section(Session& session, GuiState& state);
void mapping_section(Session& session, GuiState& state);
void light_section(Session& session);
void gizmo_section(Session& session);
void camera_section(Session& session);
void pass_section(Session& session, GuiState& state);
void diagnostics_section(Session& session);
void slot_section(Session& session, GuiState& state, GuiRenderer& renderer);

} // namespace mote::window
