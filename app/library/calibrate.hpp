// SPDX-License-Identifier: MIT
// Measures what drawing costs on a device: a few generated scenes by every expansion that it has, and the cost model
// fitted to their frame times. Takes some seconds; other work on the machine makes the numbers too high, all of them
// alike, which `auto` does not mind.
#pragma once

#include "app/library/device.hpp"
#include "core/color/color_config.hpp"
#include "passes/particles/expansion_cost.hpp"

#include <functional>
#include <string>
#include <vector>

namespace mote::app {

// The middle one, or the mean of the two; 0 for none.
double median(std::vector<double> values);

// `say` is told each measurement as a line of text. Expansions that the device cannot draw keep their shipped numbers.
passes::DeviceCosts measure_costs(DrawingDevice& device, const ColorConfig& config, const std::function<void(const std::string&)>& say);

} // namespace mote::app
