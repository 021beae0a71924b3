// SPDX-License-Identifier: MIT
#include "core/compare/limits.hpp"

#include "core/compare/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace mote::compare {

namespace {

using Value = std::optional<double>;
using R = CompareResult;

constexpr std::array table{
    Measure{"id", "pixels", "show different things",
            [](const R& r) -> Value { return r.id ? Value(double(r.id->all())) : Value{}; }},
    Measure{"id_wrong", "pixels", "show another particle",
            [](const R& r) -> Value { return r.id ? Value(double(r.id->wrong)) : Value{}; }},
    Measure{"coverage", "pixels", "show something in one of the two only",
            [](const R& r) -> Value { return r.id ? Value(double(r.id->coverage())) : Value{}; }},
    Measure{"extra", "pixels", "show something in the first only",
            [](const R& r) -> Value { return r.id ? Value(double(r.id->extra)) : Value{}; }},
    Measure{"missing", "pixels", "show something in the second only",
            [](const R& r) -> Value { return r.id ? Value(double(r.id->missing)) : Value{}; }},
    Measure{"outline", "px", "outlines lie apart on average",
            [](const R& r) -> Value { return r.outline ? Value(r.outline->displacement) : Value{}; }},
    Measure{"outline_p999", "px", "outlines lie apart, 99.9th percentile",
            [](const R& r) -> Value { return r.outline ? Value(r.outline->p999) : Value{}; }},
    Measure{"depth_median", "", "relative depth error, median",
            [](const R& r) -> Value { return r.depth ? Value(r.depth->relative.median) : Value{}; }},
    Measure{"depth_p99", "", "relative depth error, 99th percentile",
            [](const R& r) -> Value { return r.depth ? Value(r.depth->relative.p99) : Value{}; }},
    Measure{"depth_max", "", "relative depth error, largest",
            [](const R& r) -> Value { return r.depth ? Value(r.depth->relative.max) : Value{}; }},
    Measure{"ulp_median", "ulp", "depth error, median",
            [](const R& r) -> Value { return r.depth ? Value(r.depth->ulp.median) : Value{}; }},
    Measure{"ulp_p99", "ulp", "depth error, 99th percentile",
            [](const R& r) -> Value { return r.depth ? Value(r.depth->ulp.p99) : Value{}; }},
    Measure{"ulp_max", "ulp", "depth error, largest",
            [](const R& r) -> Value { return r.depth ? Value(r.depth->ulp.max) : Value{}; }},
    Measure{"normal_median", "rad", "angle between normals, median",
            [](const R& r) -> Value { return r.normal ? Value(r.normal->angle.median) : Value{}; }},
    Measure{"normal_p99", "rad", "angle between normals, 99th percentile",
            [](const R& r) -> Value { return r.normal ? Value(r.normal->angle.p99) : Value{}; }},
    Measure{"normal_max", "rad", "angle between normals, largest",
            [](const R& r) -> Value { return r.normal ? Value(r.normal->angle.max) : Value{}; }},
    Measure{"normal_beyond", "pixels", "have normals beyond 1e-6 + 1.5e-4 / R rad",
            [](const R& r) -> Value {
              return r.normal && r.normal->beyond_bar ? Value(double(*r.normal->beyond_bar)) : Value{};
            }},
    Measure{"rms", "steps of 255", "color difference, root mean square",
            [](const R& r) -> Value { return r.color ? Value(r.color->rms) : Value{}; }},
    Measure{"max", "steps of 255", "color difference, largest",
            [](const R& r) -> Value { return r.color ? Value(r.color->max) : Value{}; }},
    Measure{"alpha_max", "steps of 255", "alpha difference, largest",
            [](const R& r) -> Value { return r.color ? Value(r.color->alpha_max) : Value{}; }},
    Measure{"de_mean", "", "CIEDE2000, mean",
            [](const R& r) -> Value { return r.color ? Value(r.color->de_mean) : Value{}; }},
    Measure{"de_p95", "", "CIEDE2000, 95th percentile",
            [](const R& r) -> Value { return r.color ? Value(r.color->de_p95) : Value{}; }},
    Measure{"de_max", "", "CIEDE2000, largest",
            [](const R& r) -> Value { return r.color ? Value(r.color->de_max) : Value{}; }},
    Measure{"flip_mean", "", "FLIP, mean",
            [](const R& r) -> Value { return r.color ? Value(r.color->flip_mean) : Value{}; }},
    Measure{"flip_max", "", "FLIP, largest",
            [](const R& r) -> Value { return r.color ? Value(r.color->flip_max) : Value{}; }},
    Measure{"not_finite", "pixels", "have colors that are no numbers",
            [](const R& r) -> Value { return r.color ? Value(double(r.color->not_finite)) : Value{}; }},
};

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const Measure& m : table) out.emplace_back(m.name);
  return out;
}

const Measure* find(std::string_view name) {
  const auto at = std::find_if(table.begin(), table.end(), [&](const Measure& m) { return m.name == name; });
  return at == table.end() ? nullptr : &*at;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

void parse_one(std::string_view entry, Limits& limits, Diagnostics& diagnostics) {
  const std::size_t equals = entry.find('=');
  const std::string name(trim(entry.substr(0, equals)));
  if (equals == std::string_view::npos) {
    diagnostics.error(compare_codes::bad_limit, {}, fmt::format("limit '{}' has no number.", name),
                      {"write it as name=number, e.g. id=0,rms=1"});
    return;
  }
  if (!find(name)) {
    diagnostics.error(compare_codes::unknown_limit, {}, fmt::format("there is no limit '{}'.", name),
                      {did_you_mean(name, names()), "limits: " + list_of(names())});
    return;
  }
  const std::string_view number = trim(entry.substr(equals + 1));
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size() || !(value >= 0.0) || std::isinf(value)) {
    diagnostics.error(compare_codes::bad_limit, {},
                      fmt::format("limit '{}' is '{}', which is not a number from 0 up.", name, number));
    return;
  }
  if (std::any_of(limits.begin(), limits.end(), [&](const Limit& l) { return l.name == name; })) {
    diagnostics.error(compare_codes::twice, {}, fmt::format("limit '{}' is given twice.", name));
    return;
  }
  limits.push_back({name, value});
}

} // namespace

std::span<const Measure> measures() { return table; }

Limits parse_limits(std::string_view text, Diagnostics& diagnostics) {
  Limits limits;
  if (trim(text).empty()) return limits;
  for (;;) {
    const std::size_t comma = text.find(',');
    parse_one(trim(text.substr(0, comma)), limits, diagnostics);
    if (comma == std::string_view::npos) return limits;
    text.remove_prefix(comma + 1);
  }
}

Verdict judge(const CompareResult& result, const Limits& given, Diagnostics& diagnostics) {
  Verdict verdict;
  verdict.limits = given;
  if (given.empty())
    for (const Measure& m : table)
      if (m.value(result)) verdict.limits.push_back({std::string(m.name), 0.0});
  for (const Limit& limit : verdict.limits) {
    const Measure* m = find(limit.name);
    const std::optional<double> value = m ? m->value(result) : std::nullopt;
    if (!value) {
      diagnostics.error(
          compare_codes::not_measured, {},
          fmt::format("limit '{}' cannot be checked: the two pictures do not both have what it measures.",
                      limit.name));
      verdict.equal = false;
    } else if (!(*value <= limit.at_most)) {
      verdict.exceeded.push_back({limit.name, *value, limit.at_most});
      verdict.equal = false;
    }
  }
  return verdict;
}

} // namespace mote::compare
