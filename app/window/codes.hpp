// SPDX-License-Identifier: MIT
// Codes of the window beside those of the whole application (app/codes.hpp), one line each for docs/errors.md. A code keeps its
// meaning for ever; new ones go to the end.
#pragma once

#include <array>
#include <string_view>

namespace mote::window {

namespace code {
inline constexpr std::string_view read_only = "A052";
inline constexpr std::string_view changed_meanwhile = "A053";
inline constexpr std::string_view not_patchable = "A054";
} // namespace code

struct WindowCode {
  std::string_view code{}, line{};
};
inline constexpr std::array<WindowCode, 3> window_codes{{
    {code::read_only, "failed: a scene file cannot be written; what was changed stays in the window"},
    {code::changed_meanwhile, "failed: another program has changed a scene file since it was read; it is not overwritten"},
    {code::not_patchable, "failed: a value cannot be changed where it stands in the scene file"},
}};

} // namespace mote::window
