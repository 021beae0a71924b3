// SPDX-License-Identifier: MIT
// What radii, colors and opacities share: finding the attribute and the ends of its range; and opacities.
#include "core/scene/particle_values.hpp"

#include "core/color/srgb.hpp"
#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote {

std::optional<Attribute> wanted_attribute(const FrameContext& context, const Located<std::string>& name, bool numbers,
                                          Diagnostics& diagnostics) {
  const std::optional<Attribute> attribute = find_attribute(context.frame, name.value);
  if (!attribute) {
    const std::vector<std::string> names = attribute_names(context.frame);
    diagnostics.error(code::attribute_missing, name.loc, fmt::format("{} has no attribute '{}'", context.name, name.value),
                      {did_you_mean(name.value, names), fmt::format("Attributes: {}", list_of(names))});
    return std::nullopt;
  }
  if (numbers && attribute->is_text()) {
    diagnostics.error(code::attribute_is_text, name.loc,
                      fmt::format("the attribute '{}' of {} holds text; numbers are needed", name.value, context.name));
    return std::nullopt;
  }
  return attribute;
}

ValueScale value_scale(const FrameContext& context, const Mapping& mapping, const Attribute& attribute, Diagnostics& diagnostics) {
  if (mapping.rule == RangeRule::Fixed) return {mapping.range->first, mapping.range->second, mapping.logarithmic};
  const bool percentile = mapping.rule == RangeRule::Percentile;
  RangeCollector values(percentile, mapping.logarithmic);
  if (mapping.rule == RangeRule::Frame || !context.series) values.add(attribute, context.frame.count, context.rows);
  else values = context.series->values(mapping.attribute.value, percentile, mapping.logarithmic);
  if (values.empty()) {
    if (context.frame.count > 0)
      diagnostics.warning(code::range_empty, mapping.attribute.loc,
                          fmt::format("the attribute '{}' of {} has no {} value: its range is taken as 0 to 1", mapping.attribute.value,
                                      context.name, mapping.logarithmic ? "finite positive" : "finite"));
    return {mapping.logarithmic ? 0.1 : 0.0, 1.0, mapping.logarithmic};
  }
  if (percentile) return {values.percentile(mapping.range->first), values.percentile(mapping.range->second), mapping.logarithmic};
  if (mapping.rule == RangeRule::Symmetric) {
    const double most = std::max(std::abs(values.low()), std::abs(values.high()));
    return {-most, most, false};
  }
  return {values.low(), values.high(), mapping.logarithmic};
}

namespace {

// One opacity a row; NaN becomes 0.
std::vector<double> opacities(const FrameContext& context, const AlphaDesc& rule, const Attribute& attribute, Diagnostics& diagnostics) {
  std::vector<double> out(context.frame.count);
  std::uint64_t cut = 0;
  const ValueScale scale = rule.rule == AlphaRule::Mapped ? value_scale(context, rule.mapping, attribute, diagnostics) : ValueScale{};
  const auto [from, to] = rule.mapping.to;
  for (std::uint64_t row = 0; row < out.size(); ++row) {
    double value = attribute.at(row);
    if (rule.rule == AlphaRule::Mapped) value = from + (to - from) * std::clamp(scale(value), 0.0, 1.0);
    else if (!(value >= 0.0 && value <= 1.0)) ++cut;
    out[row] = value > 0.0 ? std::min(value, 1.0) : 0.0;
  }
  if (cut)
    diagnostics.warning(code::alpha_range, context.contents,
                        fmt::format("{} of {} particles have an opacity '{}' outside 0 to 1: cut to it", cut, out.size(), rule.mapping.attribute.value));
  return out;
}

} // namespace

void apply_opacity(const FrameContext& context, const AlphaDesc& rule, ParticleColors& colors, Diagnostics& diagnostics) {
  if (rule.rule == AlphaRule::Constant) return;
  const std::optional<Attribute> attribute = wanted_attribute(context, rule.mapping.attribute, true, diagnostics);
  if (!attribute) return;
  const std::vector<double> alpha = opacities(context, rule, *attribute, diagnostics);
  if (colors.packed.empty()) {
    std::uint32_t same = 0;
    for (int k = 0; k < 3; ++k) same |= std::uint32_t{to_8bit(srgb_encode(colors.constant[k]))} << (8 * k);
    colors.packed.assign(context.frame.count, same);
  }
  for (std::uint64_t row = 0; row < alpha.size(); ++row)
    colors.packed[row] = (colors.packed[row] & 0xFFFFFFu) | std::uint32_t{to_8bit(alpha[row])} << 24;
}

} // namespace mote
