// SPDX-License-Identifier: MIT
// The texts of app/graphs/*.toml, embedded when mote is built.
#pragma once

#include <span>
#include <string_view>

namespace mote::app {

struct ShippedGraph {
  std::string_view name{}, text{};
};
std::span<const ShippedGraph> shipped_graph_texts();

} // namespace mote::app
