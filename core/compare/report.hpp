// SPDX-License-Identifier: MIT
// A comparison in words and as JSON, for `mote compare` and `mote compare --json`. Formats only;
// numbers that are infinite are null in JSON.
//
//   {"width", "height", "pixels", "ambiguous", "compared": {"id": n, "depth": n, "normal": n, "color": n},
//    "measures": {name: number}, "limits": {name: number}, "exceeded": [{"name", "value", "limit"}], "equal":
//    bool}
#pragma once

#include "core/compare/compare.hpp"
#include "core/compare/limits.hpp"

#include <string>

namespace mote::compare {

std::string report_text(const CompareResult& result,
                        const Verdict& verdict); // several lines, each ending in \n
std::string report_json(const CompareResult& result, const Verdict& verdict); // one object, indented by 2

} // namespace mote::compare
