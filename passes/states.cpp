// SPDX-License-Identifier: MIT
#include "passes/states.hpp"

#include <array>
#include <string>
#include <vector>

namespace mote::passes {
namespace {

using gpu::BlendFactor;
using gpu::BlendOperation;
using gpu::CompareFunction;

constexpr std::array compares{CompareFunction::Never, CompareFunction::Less, CompareFunction::LessEqual, CompareFunction::Equal,
                              CompareFunction::Greater, CompareFunction::GreaterEqual, CompareFunction::NotEqual, CompareFunction::Always};
constexpr std::array factors{BlendFactor::Zero, BlendFactor::One, BlendFactor::Src, BlendFactor::OneMinusSrc, BlendFactor::SrcAlpha,
                             BlendFactor::OneMinusSrcAlpha, BlendFactor::Dst, BlendFactor::OneMinusDst, BlendFactor::DstAlpha,
                             BlendFactor::OneMinusDstAlpha, BlendFactor::SrcAlphaSaturated};
constexpr std::array operations{BlendOperation::Add, BlendOperation::Subtract, BlendOperation::ReverseSubtract, BlendOperation::Min,
                                BlendOperation::Max};
const std::vector<std::string> culls{"none", "front", "back"};

template <class Values> std::vector<std::string> words_of(const Values& values) {
  std::vector<std::string> words;
  for (const auto value : values) words.emplace_back(to_string(value));
  return words;
}

template <class Values> auto choose(rg::Params& params, std::string_view name, const Values& values, typename Values::value_type fallback,
                                    std::string_view summary) {
  const std::vector<std::string> words = words_of(values);
  const std::string word = params.word(name, to_string(fallback), words, summary);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (words[i] == word) return values[i];
  return fallback;
}

// blend = { source, destination, operation } for color; the same with _alpha behind for alpha, which takes the color's
// where it says nothing.
gpu::BlendState read_blend_table(rg::Params table) {
  gpu::BlendState blend = blend_over();
  blend.color.src = choose(table, "source", factors, BlendFactor::SrcAlpha, "factor of the fragment's color");
  blend.color.dst = choose(table, "destination", factors, BlendFactor::OneMinusSrcAlpha, "factor of the color that is there");
  blend.color.operation = choose(table, "operation", operations, BlendOperation::Add, "what joins the two products");
  blend.alpha.src = choose(table, "source_alpha", factors, BlendFactor::One, "factor of the fragment's alpha");
  blend.alpha.dst = choose(table, "destination_alpha", factors, BlendFactor::OneMinusSrcAlpha, "factor of the alpha that is there");
  blend.alpha.operation = choose(table, "operation_alpha", operations, BlendOperation::Add, "what joins the two products");
  return blend;
}

std::uint32_t read_blend(rg::Params& params, std::uint32_t fallback) {
  std::uint32_t packed = fallback;
  if (!params.is_table("blend")) {
    const std::string word = params.word("blend", fallback == 0 ? "none" : "over", {"none", "over"},
                                         "over: by alpha; none: replaces; or a table of source, destination, operation");
    packed = word == "over" ? pack(blend_over()) : 0;
  }
  if (params.is_table("blend") || !params.has("blend")) {
    const gpu::BlendState table = read_blend_table(params.table("blend"));
    if (params.has("blend")) packed = pack(table);
  }
  return packed;
}

} // namespace

std::uint32_t pack(const gpu::BlendState& blend) {
  auto bits = [](const gpu::BlendComponent& c) {
    return static_cast<std::uint32_t>(c.src) | static_cast<std::uint32_t>(c.dst) << 4 | static_cast<std::uint32_t>(c.operation) << 8;
  };
  return 1u << 31 | bits(blend.color) | bits(blend.alpha) << 12;
}

std::optional<gpu::BlendState> unpack_blend(std::uint32_t packed) {
  if (packed == 0) return std::nullopt;
  auto component = [](std::uint32_t bits) {
    return gpu::BlendComponent{static_cast<BlendFactor>(bits & 15u), static_cast<BlendFactor>(bits >> 4 & 15u),
                               static_cast<BlendOperation>(bits >> 8 & 15u)};
  };
  return gpu::BlendState{component(packed & 0xFFFu), component(packed >> 12 & 0xFFFu)};
}

gpu::BlendState blend_over() {
  return {{BlendFactor::SrcAlpha, BlendFactor::OneMinusSrcAlpha, BlendOperation::Add},
          {BlendFactor::One, BlendFactor::OneMinusSrcAlpha, BlendOperation::Add}};
}

gpu::BlendState blend_over_premultiplied() {
  constexpr gpu::BlendComponent over{BlendFactor::One, BlendFactor::OneMinusSrcAlpha, BlendOperation::Add};
  return {over, over};
}

CompareFunction encoded(CompareFunction distance) {
  switch (distance) {
  case CompareFunction::Less: return CompareFunction::Greater;
  case CompareFunction::LessEqual: return CompareFunction::GreaterEqual;
  case CompareFunction::Greater: return CompareFunction::Less;
  case CompareFunction::GreaterEqual: return CompareFunction::LessEqual;
  default: return distance;
  }
}

double cleared_depth(const DrawStates& states) {
  return states.depth_test == CompareFunction::Greater || states.depth_test == CompareFunction::GreaterEqual ? 1.0 : 0.0;
}

DrawStates read_states(rg::Params& params, const DrawStates& defaults) {
  DrawStates states;
  states.depth_test = choose(params, "depth_test", compares, defaults.depth_test, "what a surface's distance must be to the one that is there");
  states.depth_write = params.boolean("depth_write", defaults.depth_write, "surfaces that are drawn leave their depth");
  states.blend = read_blend(params, defaults.blend);
  const std::string cull = params.word("cull", culls[static_cast<std::size_t>(defaults.cull)], culls, "surfaces that are not drawn: entries are front, exits back");
  for (std::size_t i = 0; i < culls.size(); ++i)
    if (culls[i] == cull) states.cull = static_cast<Cull>(i);
  return states;
}

} // namespace mote::passes
