// SPDX-License-Identifier: MIT
#include "app/window/pace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::window {
namespace {

// Few sizes, so that textures of a size serve many frames.
constexpr std::array steps{0.125, 0.1875, 0.25, 0.375, 0.5, 0.625, 0.75, 1.0};

double step_below(double scale, double least) {
  double best = steps.front();
  for (const double s : steps)
    if (s <= scale) best = s;
  return std::max(best, least);
}

double step_above(double scale) {
  for (const double s : steps)
    if (s > scale) return s;
  return 1.0;
}

} // namespace

void Pace::changed(double now, bool held) {
  dirty_ = true;
  refined_ = false;
  held_ = held;
  last_change_ = now;
}

std::optional<double> Pace::due() const {
  if (refined_ || held_) return std::nullopt;
  return last_change_ + options_.settle_s;
}

double Pace::picture_goal() const { return std::max(options_.goal_ms - fixed_ms_, options_.goal_ms / 3.0); }

void Pace::drew(bool draft, double ms, double fixed_ms) {
  fixed_ms_ = fixed_ms;
  dirty_ = false;
  if (!draft) {
    full_ms_ = ms;
    refined_ = true;
  }
  if (!draft && differs_) return; // says nothing about drafts
  const double drawn_scale = draft ? scale_ : 1.0;
  if (ms > picture_goal()) {
    quick_ = 0;
    // Time goes with the number of pixels, at most; a little more than that would ask is taken off.
    scale_ = std::min(scale_, step_below(0.95 * drawn_scale * std::sqrt(picture_goal() / ms), options_.least_scale));
  } else if (draft) {
    const double next = step_above(scale_), grown = ms * (next * next) / (scale_ * scale_);
    quick_ = grown < 0.9 * picture_goal() ? quick_ + 1 : 0;
    if (quick_ >= 3) {
      scale_ = next;
      quick_ = 0;
    }
  } else {
    scale_ = 1.0;
  }
}

} // namespace mote::window
