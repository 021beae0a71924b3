// SPDX-License-Identifier: MIT
#include "core/compare/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mote::compare {

namespace {

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole ? fmt::format("{:.4g} %", 100.0 * double(part) / double(whole)) : std::string("-");
}

std::string spread_line(std::string_view what, const Spread& s, std::string_view unit) {
  return fmt::format("{}: median {:.3g}, p99 {:.3g}, max {:.3g}{}{}\n", what, s.median, s.p99, s.max,
                     unit.empty() ? "" : " ", unit);
}

// JSON has no infinity.
nlohmann::ordered_json number(double x) {
  return x < 1e308 ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

} // namespace

std::string report_text(const CompareResult& r, const Verdict& verdict) {
  std::string out = fmt::format("{} x {} pixels, {} ambiguous ({})\n", r.width, r.height, r.ambiguous,
                                percent(r.ambiguous, r.pixels));
  if (r.id)
    out += fmt::format("ids: {} of {} pixels differ ({} wrong, {} extra, {} missing)\n", r.id->all(),
                       r.id->compared, r.id->wrong, r.id->extra, r.id->missing);
  if (r.outline)
    out += fmt::format("outlines: {:.3g} px apart on average over {:.0f} px, 99.9th percentile {:.3g} px\n",
                       r.outline->displacement, r.outline->length, r.outline->p999);
  if (r.depth) {
    out += spread_line(fmt::format("depth, relative, {} pixels", r.depth->compared), r.depth->relative, "");
    out += spread_line("depth", r.depth->ulp, "ulp");
  }
  if (r.normal) {
    out += spread_line(fmt::format("normals, {} pixels", r.normal->compared), r.normal->angle, "rad");
    if (r.normal->beyond_bar)
      out += fmt::format("normals beyond 1e-6 + 1.5e-4/R rad: {} pixels\n", *r.normal->beyond_bar);
  }
  if (r.color) {
    out += fmt::format("color, {} pixels: rms {:.4g}, max {:.4g}, alpha max {:.4g} steps of 255\n",
                       r.color->compared, r.color->rms, r.color->max, r.color->alpha_max);
    out += fmt::format("CIEDE2000: mean {:.3g}, p95 {:.3g}, max {:.3g}\n", r.color->de_mean, r.color->de_p95,
                       r.color->de_max);
    out += fmt::format("FLIP: mean {:.3g}, max {:.3g}\n", r.color->flip_mean, r.color->flip_max);
    if (r.color->not_finite)
      out += fmt::format("colors that are no numbers: {} pixels\n", r.color->not_finite);
  }
  for (const Exceeded& e : verdict.exceeded)
    out += fmt::format("above its limit: {} = {:.4g} > {:.4g}\n", e.name, e.value, e.limit);
  out += verdict.equal ? "equal within the limits\n" : "different\n";
  return out;
}

std::string report_json(const CompareResult& r, const Verdict& verdict) {
  nlohmann::ordered_json j;
  j["width"] = r.width;
  j["height"] = r.height;
  j["pixels"] = r.pixels;
  j["ambiguous"] = r.ambiguous;
  j["compared"] = nlohmann::ordered_json::object();
  if (r.id) j["compared"]["id"] = r.id->compared;
  if (r.depth) j["compared"]["depth"] = r.depth->compared;
  if (r.normal) j["compared"]["normal"] = r.normal->compared;
  if (r.color) j["compared"]["color"] = r.color->compared;
  j["measures"] = nlohmann::ordered_json::object();
  for (const Measure& m : measures())
    if (const auto value = m.value(r)) j["measures"][std::string(m.name)] = number(*value);
  j["limits"] = nlohmann::ordered_json::object();
  for (const Limit& limit : verdict.limits) j["limits"][limit.name] = limit.at_most;
  j["exceeded"] = nlohmann::ordered_json::array();
  for (const Exceeded& e : verdict.exceeded)
    j["exceeded"].push_back({{"name", e.name}, {"value", number(e.value)}, {"limit", e.limit}});
  j["equal"] = verdict.equal;
  return j.dump(2);
}

} // namespace mote::compare
