// SPDX-License-Identifier: MIT
// Every code of writing files (core/base/atomic_file) and of core/image, one line each. docs/errors.md
// prints this table; tests check that each code can be provoked. Codes are never reused.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace mote {

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 8> image_codes{{
    {"I001", "a file cannot be created"},
    {"I002", "a file cannot be written completely"},
    {"I003", "a finished file cannot be renamed to its name"},
    {"I004", "a picture or array cannot be read from the disk"},
    {"I005", "a file is not a PNG, or is a broken one"},
    {"I006", "a file is not an OpenEXR picture, or is a broken one"},
    {"I007", "a file is not a NumPy array, or is a broken one"},
    {"I008", "a picture of this size or shape cannot be stored"},
}};

} // namespace mote
