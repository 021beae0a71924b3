// SPDX-License-Identifier: MIT
// A session as a text file, for tests and demonstrations: `mote view FILE --script session.txt`. Pure: reading, and which
// step comes when; the host does what a step says. One step a line, # begins a comment:
//
//   size 640x480            the window's size in pixels          minimize | restore
//   key r | key ctrl+s      press and let go                     text abc       type characters
//   move X Y                the mouse                            click left X Y [ctrl|shift]
//   press left X Y, release left X Y                             drag left X0 Y0 X1 Y1 [ctrl|shift] [steps N] [over S]
//   wheel STEPS X Y [ctrl]                                       drop FILE
//   set PATH=VALUE          as --set, undone by Ctrl Z           save [FILE]
//   wait refined | wait 0.5                                      screenshot FILE.png | window FILE.png (with panels)
//   print TEXT              a line on standard output            quit
//
// "@1.5 key r" waits until 1.5 s after the start. A frame is drawn after each event, so a script gives the same
// refined pictures on a slow machine as on a fast one; the steps of a drag `over` some seconds come at their times, as a hand's do,
// several for one frame if need be.
#pragma once

#include "app/window/events.hpp"
#include "core/base/diagnostic.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote::window {

struct Step {
  enum class Kind : std::uint8_t { Event, Size, Minimize, Restore, Set, Save, Screenshot, WindowShot, WaitRefined, WaitTime, Print, Quit };
  Kind kind{};
  Event event{};
  Size2d size{};
  std::string text{};           // path, setting, or what to print
  double seconds{};             // WaitTime
  std::optional<double> at{};    // not before, seconds after the start
  std::optional<double> after{}; // not before, seconds after the last step that has none
  SourceLoc loc{};
};

// All mistakes go to `diagnostics` (A051).
std::vector<Step> parse_script(std::string_view text, const std::string& name, Diagnostics& diagnostics);

class ScriptPlayer {
public:
  explicit ScriptPlayer(std::vector<Step> steps) : steps_(std::move(steps)) {}
  struct Now {
    double seconds{};       // since the start
    bool refined{};         // nothing is left to draw
  };
  // The next step that is due; nothing while the script waits or after its end.
  std::optional<Step> next(const Now& now);
  // When the step that came last was to come, seconds after the start: inputs wait since then.
  [[nodiscard]] double scheduled() const { return scheduled_; }
  [[nodiscard]] bool ended() const { return place_ >= steps_.size(); }
  // When to look again though nothing happens: seconds from `now`; nothing when the script waits for a frame or has ended.
  [[nodiscard]] std::optional<double> due(const Now& now) const;

private:
  std::vector<Step> steps_;
  std::size_t place_{};
  std::optional<double> began_{};             // WaitTime: when it began to wait
  double anchor_{}, scheduled_{};
};

} // namespace mote::window
