// SPDX-License-Identifier: MIT
// Selections: `type == "O" && speed > 2`. Text to a checked program over the columns of one frame, and its value
// for every row. Words, from loosest to tightest:
//
//   a || b (or)    a && b (and)    !a (not)    == != < <= > >=    in [a, b, ...]    + -    * / %    ^ (right to left)    -a
//   numbers, "texts" or 'texts', true, false, attributes as in attributes.hpp (velocity.x, stress.3, speed), index (row from 0)
//   abs sqrt floor ceil min max log exp sin cos (radians)
//
// Texts compare with == != and in, with numbers not at all; a comparison with NaN is false, as in C. Kinds are
// checked before a row is looked at. Errors are S021 (no such attribute), S027 (syntax), S028 (kinds), at the column
// of the word, with what exists instead.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/data/dataset.hpp"

#include <string_view>
#include <vector>

namespace mote {

// One truth value a row; empty when `diagnostics` got an error. `loc` is the place of the first character of `text`.
std::vector<bool> select_rows(std::string_view text, const data::Frame& frame, const SourceLoc& loc, Diagnostics& diagnostics);

} // namespace mote
