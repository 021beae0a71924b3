// SPDX-License-Identifier: MIT
#include "app/window/script.hpp"

#include "app/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace mote::window {
namespace {

const std::vector<std::string> verbs{"size", "minimize", "restore", "key", "text", "move", "click", "press", "release", "drag", "wheel", "drop",
                                     "set", "save", "wait", "screenshot", "window", "print", "quit"};

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < line.size() && line[end] != ' ' && line[end] != '\t' && line[end] != '\r') ++end;
    words.emplace_back(line.substr(i, end - i));
    i = end;
  }
  return words;
}

// One line. Readers throw a sentence; the line becomes a diagnostic.
class LineReader {
public:
  LineReader(std::string_view line, SourceLoc loc) : loc_(std::move(loc)), words_(words_of(line)), line_(line) {}

  void read(std::vector<Step>& out) {
    if (words_.front().starts_with('@')) {
      at_ = number(words_.front().substr(1), "a time in seconds");
      next_ = 1;
    }
    const std::string verb = word("a step");
    read_step(verb, out);
    if (next_ < words_.size()) throw fmt::format("'{}' is too much behind '{}'", words_[next_], verb);
  }

private:
  void read_step(const std::string& verb, std::vector<Step>& out) {
    using Kind = Step::Kind;
    if (verb == "minimize") add(out, Kind::Minimize);
    else if (verb == "restore") add(out, Kind::Restore);
    else if (verb == "quit") add(out, Kind::Quit);
    else if (verb == "size") add(out, Kind::Size).size = size();
    else if (verb == "key") read_key(out);
    else if (verb == "text") read_text(out);
    else if (verb == "move") read_move(out);
    else if (verb == "press" || verb == "release" || verb == "click") read_button(verb, out);
    else if (verb == "drag") read_drag(out);
    else if (verb == "wheel") read_wheel(out);
    else if (verb == "wait") read_wait(out);
    else if (verb == "drop") {
      Event e{.kind = Event::Kind::Drop};
      e.files = {rest("a file")};
      add(out, Kind::Event).event = std::move(e);
    } else if (verb == "set") add(out, Kind::Set).text = rest("PATH=VALUE");
    else if (verb == "save") add(out, Kind::Save).text = next_ < words_.size() ? rest("") : std::string();
    else if (verb == "screenshot") add(out, Kind::Screenshot).text = rest("a file");
    else if (verb == "window") add(out, Kind::WindowShot).text = rest("a file");
    else if (verb == "print") add(out, Kind::Print).text = rest("a text");
    else throw fmt::format("there is no step '{}'; {}", verb, did_you_mean(verb, verbs));
  }

  Step& add(std::vector<Step>& out, Step::Kind kind) {
    Step& step = out.emplace_back();
    step.kind = kind;
    step.at = at_;
    step.loc = loc_;
    return step;
  }
  void add(std::vector<Step>& out, const Event& event) { add(out, Step::Kind::Event).event = event; }

  void read_key(std::vector<Step>& out) {
    std::string name = word("a key");
    Modifiers modifiers;
    for (std::size_t plus = name.find('+'); plus != std::string::npos && plus + 1 < name.size(); plus = name.find('+')) {
      modify(modifiers, name.substr(0, plus));
      name = name.substr(plus + 1);
    }
    const Key code = key_from_name(name);
    if (code == key::none) throw fmt::format("there is no key '{}'", name);
    add(out, key_event(code, modifiers, true));
    add(out, key_event(code, modifiers, false));
  }

  void read_text(std::vector<Step>& out) {
    for (const char c : rest("characters")) {
      Event e{.kind = Event::Kind::Text};
      e.code = static_cast<unsigned char>(c);
      add(out, e);
    }
  }

  void read_move(std::vector<Step>& out) {
    const double x = number("x"), y = number("y");
    add(out, move_event(x, y));
  }

  void read_button(const std::string& verb, std::vector<Step>& out) {
    const Button b = button();
    const double x = number("x"), y = number("y");
    const Modifiers m = modifiers();
    if (verb == "click") add(out, move_event(x, y, m));
    if (verb != "release") add(out, button_event(b, x, y, true, m));
    if (verb != "press") add(out, button_event(b, x, y, false, m));
  }

  void read_drag(std::vector<Step>& out) {
    const Button b = button();
    const double x0 = number("x"), y0 = number("y"), x1 = number("x"), y1 = number("y");
    const Modifiers m = modifiers();
    int steps = 10;
    if (next_ < words_.size() && words_[next_] == "steps") {
      ++next_;
      const double n = number("a number of steps");
      if (!(n >= 1 && n <= 10000 && n == std::floor(n))) throw fmt::format("'{}' is no number of steps from 1 to 10000", n);
      steps = static_cast<int>(n);
    }
    double over = 0.0;
    if (next_ < words_.size() && words_[next_] == "over") {
      ++next_;
      over = number("a number of seconds");
      if (!(over > 0.0 && over <= 3600.0)) throw fmt::format("'{}' is no time for a drag", over);
    }
    add(out, move_event(x0, y0, m));
    add(out, button_event(b, x0, y0, true, m));
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      add(out, move_event(x0 + (x1 - x0) * t, y0 + (y1 - y0) * t, m));
      if (over > 0.0) out.back().after = over * t;
    }
    add(out, button_event(b, x1, y1, false, m));
  }

  void read_wheel(std::vector<Step>& out) {
    const double steps = number("steps"), x = number("x"), y = number("y");
    const Modifiers m = modifiers();
    add(out, move_event(x, y, m));
    add(out, wheel_event(steps, x, y, m));
  }

  void read_wait(std::vector<Step>& out) {
    const std::string what = word("refined or a number of seconds");
    if (what == "refined") {
      add(out, Step::Kind::WaitRefined);
      return;
    }
    const double s = number(what, "refined or a number of seconds");
    if (!(s >= 0)) throw fmt::format("'{}' is no time to wait", what);
    add(out, Step::Kind::WaitTime).seconds = s;
  }

  std::string word(std::string_view wanted) {
    if (next_ >= words_.size()) throw fmt::format("{} is missing", wanted);
    return words_[next_++];
  }
  // What is left of the line, with its blanks.
  std::string rest(std::string_view wanted) {
    const std::string first = word(wanted);
    std::size_t place = 0;
    for (std::size_t i = 0; i < next_; ++i) {
      place = line_.find(words_[i], place);
      if (i + 1 < next_) place += words_[i].size();
    }
    next_ = words_.size();
    std::string text(line_.substr(place));
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.pop_back();
    return text;
  }
  double number(std::string_view wanted) { return number(word(wanted), wanted); }
  static double number(const std::string& text, std::string_view wanted) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) throw fmt::format("'{}' is not {}", text, wanted);
    return value;
  }
  Size2d size() {
    const std::string text = word("WIDTHxHEIGHT");
    Size2d s;
    const char* const last = text.data() + text.size();
    const auto [x, first] = std::from_chars(text.data(), last, s.width);
    const bool middle = first == std::errc{} && x != last && *x == 'x';
    const auto [y, second] = std::from_chars(middle ? x + 1 : last, last, s.height);
    if (!middle || second != std::errc{} || y != last || s.width < 1 || s.height < 1 || s.width > 16384 || s.height > 16384)
      throw fmt::format("'{}' is not a size: WIDTHxHEIGHT, each from 1 to 16384", text);
    return s;
  }
  Button button() {
    const std::string name = word("left, middle or right");
    if (name == "left") return Button::Left;
    if (name == "middle") return Button::Middle;
    if (name == "right") return Button::Right;
    throw fmt::format("there is no button '{}': left, middle or right", name);
  }
  static void modify(Modifiers& m, const std::string& name) {
    if (name == "ctrl") m.control = true;
    else if (name == "shift") m.shift = true;
    else if (name == "alt") m.alt = true;
    else throw fmt::format("'{}' is not ctrl, shift or alt", name);
  }
  Modifiers modifiers() {
    Modifiers m;
    while (next_ < words_.size() && words_[next_] != "steps" && words_[next_] != "over") modify(m, words_[next_++]);
    return m;
  }

  SourceLoc loc_;
  std::vector<std::string> words_;
  std::string_view line_;
  std::size_t next_{};
  std::optional<double> at_{};
};

} // namespace

std::vector<Step> parse_script(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  std::vector<Step> steps;
  std::uint64_t line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    const SourceLoc loc{name, line_number, first + 1};
    try {
      LineReader(line.substr(first), loc).read(steps);
    } catch (const std::string& problem) {
      diagnostics.error(app::code::script, loc, problem, {fmt::format("Steps: {}", list_of(verbs))});
    }
  }
  return steps;
}

std::optional<Step> ScriptPlayer::next(const Now& now) {
  while (place_ < steps_.size()) {
    const Step& step = steps_[place_];
    const double earliest = step.at ? *step.at : step.after ? anchor_ + *step.after : 0.0;
    if (now.seconds < earliest) return std::nullopt;
    if (step.kind == Step::Kind::WaitRefined && !now.refined) return std::nullopt;
    if (step.kind == Step::Kind::WaitTime) {
      if (!began_) began_ = now.seconds;
      if (now.seconds < *began_ + step.seconds) return std::nullopt;
      began_.reset();
    }
    ++place_;
    scheduled_ = earliest > 0.0 ? earliest : now.seconds;
    if (!step.after) anchor_ = now.seconds;
    if (step.kind != Step::Kind::WaitRefined && step.kind != Step::Kind::WaitTime) return step;
  }
  return std::nullopt;
}

std::optional<double> ScriptPlayer::due(const Now& now) const {
  if (ended()) return std::nullopt;
  const Step& step = steps_[place_];
  if (step.at || step.after) return std::max(0.0, (step.at ? *step.at : anchor_ + *step.after) - now.seconds);
  if (step.kind == Step::Kind::WaitTime) return began_ ? std::max(0.0, *began_ + step.seconds - now.seconds) : 0.0;
  if (step.kind == Step::Kind::WaitRefined && !now.refined) return std::nullopt;
  return 0.0;
}

} // namespace mote::window
