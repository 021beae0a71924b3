// SPDX-License-Identifier: MIT
// What drawing costs on a device, kept beside the caches: `mote calibrate` writes it, everything that draws reads it at the
// start. One JSON file a device and driver version; without one, or with a bad one, the shipped numbers serve.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/gpu/gpu.hpp"
#include "passes/particles/expansion_cost.hpp"

#include <string>

namespace mote::app {

// "<directory>/costs-<device uuid>-<driver version>.json"; empty without a directory.
std::string costs_path(const gpu::AdapterInfo& info, const std::string& directory);
// A040 (warning) for a file that is no such file.
passes::DeviceCosts device_costs(const gpu::AdapterInfo& info, const std::string& directory, Diagnostics& diagnostics);
std::string costs_json(const passes::DeviceCosts& costs, const gpu::AdapterInfo& info);
// Writes aside and renames; makes the folder. Failure A041 without a directory, I001..I003 where it cannot be written.
void save_costs(const passes::DeviceCosts& costs, const gpu::AdapterInfo& info, const std::string& directory);

} // namespace mote::app
