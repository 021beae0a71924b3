// SPDX-License-Identifier: MIT
// A loaded color config: which displays, view transforms and color spaces exist, and the way of
// single colors and textures into the working space. Scene readers check names and decode colors
// here; make_display_transform() (display_transform.hpp) builds the way out of the working space.
//
// The working space of all shading is Linear Rec.709. Order of choice of the config: the path given,
// then $OCIO when it is set and not empty, then the one that mote ships (default_config.hpp).
// A value: copies are cheap and share the config, which never changes. Const calls are thread-safe.
// Nothing here prints; what OpenColorIO logs is kept in messages().
#pragma once

#include "core/base/diagnostic.hpp"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

class ColorConfig {
public:
  // `path` empty: $OCIO, else the shipped config. Throws Failure C001 (file), C002 (content), C006.
  static ColorConfig load(const std::string& path = {});
  // The config text itself, as in a file without neighbours. `origin` names it in messages.
  static ColorConfig from_text(std::string_view text, const std::string& origin);

  [[nodiscard]] const std::string& origin() const; // path, or "shipped"
  [[nodiscard]] const std::string& working_space() const;
  [[nodiscard]] const std::vector<std::string>& messages() const; // one line each; often none

  [[nodiscard]] std::vector<std::string> displays() const;                        // the default first
  [[nodiscard]] std::vector<std::string> views(const std::string& display) const; // as the config orders them
  [[nodiscard]] std::vector<std::string> color_spaces() const;
  [[nodiscard]] std::string default_display() const;
  [[nodiscard]] std::string default_view(const std::string& display) const;

  // Throw Failure(BadInput) C003, C004, C005 that list what exists. `loc`: where the name was written.
  void check_display(const std::string& display, const SourceLoc& loc = {}) const;
  void check_view(const std::string& display, const std::string& view, const SourceLoc& loc = {}) const;
  void check_color_space(const std::string& space, const SourceLoc& loc = {}) const;

  // One color of `space` in the working space. "sRGB" with a Rec.709 working space is exact (the
  // formula in double); everything else is OCIO's float arithmetic. C005, C007.
  [[nodiscard]] std::array<double, 3> to_working(const std::string& space, const std::array<double, 3>& rgb,
                                                 const SourceLoc& loc = {}) const;
  // A picture, in place: straight RGBA float, size a multiple of 4; alpha stays. C005, C007.
  void to_working(const std::string& space, std::span<float> rgba, const SourceLoc& loc = {}) const;

  struct Inner; // OpenColorIO lives behind it (ocio_bridge.hpp)
  [[nodiscard]] const Inner& inner() const { return *inner_; }

private:
  explicit ColorConfig(std::shared_ptr<const Inner> inner) : inner_(std::move(inner)) {}
  std::shared_ptr<const Inner> inner_;
};

} // namespace mote
