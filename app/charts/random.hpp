// SPDX-License-Identifier: MIT
// Random numbers that are the same on every machine: the standard's distributions are not.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <random>

namespace mote::app {

class Random {
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; } // [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  glm::dvec3 direction() { // uniform on the unit sphere
    const double z = uniform(-1.0, 1.0), angle = uniform(0.0, 6.283185307179586), rho = std::sqrt(1.0 - z * z);
    return {rho * std::cos(angle), rho * std::sin(angle), z};
  }

private:
  std::mt19937_64 engine_;
};

} // namespace mote::app
