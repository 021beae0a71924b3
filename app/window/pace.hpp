// SPDX-License-Identifier: MIT
// How good a frame may be: pure, times come from outside (seconds of any steady clock, milliseconds of frames). While
// something moves, pictures are drawn smaller (and with one sample a pixel) so that an input shows soon; a moment after the last
// change the picture is drawn once as it should be. Session asks before each frame and tells after it.
#pragma once

#include <optional>

namespace mote::window {

struct PaceOptions {
  double goal_ms{24.0};      // of a frame while something moves; two of them are the longest wait of an input
  double settle_s{0.12};     // from the last change to the refined picture
  double least_scale{0.125}; // of the sides of a picture
};

class Pace {
public:
  explicit Pace(const PaceOptions& options = {}) : options_(options) {}

  // Something that the picture shows is another now. `held`: it goes on (a button is down, a series plays).
  void changed(double now, bool held);
  void let_go() { held_ = false; }
  // `different`: a draft is not what the picture should be even at full size (fewer samples).
  void set_draft_differs(bool different) { differs_ = different; }

  [[nodiscard]] bool dirty() const { return dirty_; }
  [[nodiscard]] bool refined() const { return refined_; }
  // Is the next frame a draft, and of which size by the window's? Each side, (0, 1].
  [[nodiscard]] bool draft(double now) const { return !settled(now) && (differs_ || scale_ < 1.0); }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] double goal_ms() const { return options_.goal_ms; }
  [[nodiscard]] bool wants_frame(double now) const { return dirty_ || (!refined_ && settled(now)); }
  // When a frame will be wanted though nothing happens; nothing: not before the next change.
  [[nodiscard]] std::optional<double> due() const;

  // A frame was drawn: how long its picture took, and what comes on top whatever its size (panels, putting together, presenting).
  void drew(bool draft, double ms, double fixed_ms = 0.0);
  // A frame at full quality will take so long (the first one is known only after it was drawn).
  [[nodiscard]] double expected_full_ms() const { return full_ms_; }

  // Nothing moves any more.
  [[nodiscard]] bool settled(double now) const { return !held_ && now >= last_change_ + options_.settle_s; }

private:
  // Of a picture, so that the whole frame meets the goal; a third of it at least, because smaller pictures help no more then.
  [[nodiscard]] double picture_goal() const;

  PaceOptions options_;
  bool dirty_{true}, refined_{}, held_{}, differs_{};
  double last_change_{-1e9}, scale_{1.0}, full_ms_{}, fixed_ms_{};
  int quick_{}; // frames in a row that left room for larger ones
};

} // namespace mote::window
