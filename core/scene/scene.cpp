// SPDX-License-Identifier: MIT
#include "core/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace mote {

std::uint64_t Scene::particle_count() const {
  std::uint64_t count = 0;
  for (const Batch& batch : batches) count += batch.instances.size() * batch.row_count;
  return count;
}

std::optional<double> similarity_scale(const glm::dmat4& m) {
  const glm::dmat3 linear(m);
  const glm::dmat3 gram = glm::transpose(linear) * linear; // s^2 times the identity, for a similarity
  const double square = (gram[0][0] + gram[1][1] + gram[2][2]) / 3.0;
  if (!(square > 0.0) || !std::isfinite(square)) return std::nullopt;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(gram[i][j] - (i == j ? square : 0.0)) <= 1e-9 * square)) return std::nullopt;
  for (int i = 0; i < 3; ++i)
    if (m[i][3] != 0.0) return std::nullopt;
  if (m[3][3] != 1.0) return std::nullopt;
  return std::sqrt(square);
}

} // namespace mote
