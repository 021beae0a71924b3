// SPDX-License-Identifier: MIT
// A scene made ready for rays in double precision: one tree per chunk set, shared by all instances
// of it, and the instances with their matrices. Built once per scene; views come and go.
//
// What counts as a particle: a record in use (a row, a radius above 0, finite numbers). Opaque ones
// (alpha 1) and transparent ones (alpha above 0) have trees of their own: AOVs show opaque surfaces
// only. Exact duplicates of an opaque record are kept once, as the lowest row, and remembered: a scene
// that puts 1e5 spheres in one place costs no more per ray than one sphere.
#pragma once

#include "core/reference/bvh.hpp"
#include "core/reference/shapes.hpp"
#include "core/scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace mote::reference {

// The particles of a chunk set under one type. Item numbers of the tree are records.
struct Tree {
  std::shared_ptr<const ChunkSet> chunks{};
  const Shape* shape{};
  Bvh bvh{};
  std::vector<std::uint32_t> repeated{}; // records that stand for several equal ones, ascending
  std::uint64_t transparent{};           // particles of an opaque tree that it leaves out
  [[nodiscard]] bool is_repeated(std::uint32_t record) const;
};

struct Placed { // one instance of one batch
  const Tree* tree{};
  std::uint32_t batch{};
  std::uint64_t first_id{};      // id of row 0
  glm::dmat3 linear{1};          // of world from data
  glm::dmat3 data_from_world{1}; // its inverse
  glm::dmat3 normal_to_world{1}; // inverse transpose of the matrix's linear part
  glm::dvec3 translation{0};     // world place of the data set's origin
  Bounds bounds{};               // world
  double stretch{1};             // at least the factor by which data_from_world lengthens a vector
  double curvature{1};           // a sphere's smallest radius of curvature becomes this times its radius (similarities: exactly)
};

struct World {
  Scene scene{}; // values; chunk sets are shared
  std::vector<std::unique_ptr<const Tree>> trees{};
  std::vector<Placed> placed{};
  std::vector<Placed> transparent_placed{}; // instances that have transparent particles
  Bvh transparent_top{};
  Bvh top{};                 // over the instances' world boxes; item numbers are indices of `placed`
  std::uint64_t particles{}; // ids run below this
  std::uint64_t transparent{};
  double build_seconds{};
};

// `threads` 0: all cores. Throws Failure R001 (unknown particle type), R002 (singular instance matrix).
World build_world(const Scene& scene, unsigned threads = 0);

} // namespace mote::reference
