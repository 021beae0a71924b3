// SPDX-License-Identifier: MIT
// Limits on the measures of a comparison and the judgement "equal within them", the exit status of
// `mote compare`. One table (measures()) names every measure; limits, reports and messages read it.
//
//   --limits id=0,depth_p99=2.5e-7,rms=1
//
// No limits at all mean that everything measured has to be 0.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/compare/compare.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::compare {

struct Measure {
  std::string_view name;                                // "depth_p99"
  std::string_view unit;                                // "", "pixels", "ulp", "rad", "steps of 255", "px"
  std::string_view meaning;                             // half a sentence
  std::optional<double> (*value)(const CompareResult&); // nullopt: the pictures do not both have it
};
std::span<const Measure> measures();

struct Limit {
  std::string name{};
  double at_most{};
};
using Limits = std::vector<Limit>;

// "name=number,name=number"; spaces around are ignored; "" gives none. Errors K001, K002, K003 (all of a text
// at once); what is wrong is left out of the result.
Limits parse_limits(std::string_view text, Diagnostics& diagnostics);

struct Exceeded {
  std::string name{};
  double value{}, limit{};
};
struct Verdict {
  bool equal{true};
  Limits limits{}; // the ones applied
  std::vector<Exceeded> exceeded{};
};
// Error K006 for a limit on what was not measured (such a verdict is not `equal`).
Verdict judge(const CompareResult& result, const Limits& limits, Diagnostics& diagnostics);

} // namespace mote::compare
