// SPDX-License-Identifier: MIT
// Small scenes for the reference's tests, and the slow, plain answer to compare with: every sphere
// against every pixel, in any arithmetic (double, long double, __float128), written from the
// definition and sharing nothing with the tracer. Chunks are filled in the order given, not by
// build_spheres, so that this folder tests the reference alone.
#pragma once

#include "core/reference/reference.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace mote::test {

__extension__ typedef __float128 quad;

template <class Real> Real root(Real x) {
  if (!(x > Real(0))) return Real(0);
  Real y = Real(std::sqrt(static_cast<double>(x)));
  for (int i = 0; i < 3; ++i) y = (y + x / y) * Real(0.5);
  return y;
}

struct Ball {
  glm::dvec3 center{0};
  double radius{1};
};

inline std::shared_ptr<ChunkSet> chunks_of(const std::vector<Ball>& balls) {
  auto set = std::make_shared<ChunkSet>();
  const std::size_t chunks = (balls.size() + chunk_capacity - 1) / chunk_capacity;
  set->records.assign(chunks * chunk_capacity, glm::vec4(0));
  set->rows.assign(chunks * chunk_capacity, no_row);
  for (std::size_t c = 0; c < chunks; ++c) {
    Chunk chunk;
    chunk.origin = balls[c * chunk_capacity].center;
    chunk.count =
        static_cast<std::uint32_t>(std::min<std::size_t>(chunk_capacity, balls.size() - c * chunk_capacity));
    for (std::size_t i = c * chunk_capacity; i < c * chunk_capacity + chunk.count; ++i) {
      set->records[i] =
          glm::vec4(glm::vec3(balls[i].center - chunk.origin), static_cast<float>(balls[i].radius));
      set->rows[i] = static_cast<std::uint32_t>(i);
    }
    set->chunks.push_back(chunk);
  }
  return set;
}

inline Scene scene_of(const std::vector<Ball>& balls,
                      const std::vector<glm::dmat4>& instances = {glm::dmat4(1)}) {
  Scene scene;
  Batch batch;
  batch.name = "balls";
  batch.chunks = chunks_of(balls);
  batch.row_count = balls.size();
  for (const glm::dmat4& m : instances) batch.instances.push_back({m});
  scene.batches.push_back(batch);
  scene.lights.push_back({});
  return scene;
}

inline std::vector<Ball> random_balls(std::size_t n, double half, double r_min, double r_max,
                                      unsigned seed = 1, const glm::dvec3& center = glm::dvec3(0)) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-half, half), size(r_min, r_max);
  std::vector<Ball> balls(n);
  for (Ball& b : balls) {
    b.center = center + glm::dvec3(place(random), place(random), place(random));
    b.radius = size(random);
  }
  return balls;
}

inline View look(const glm::dvec3& eye, const glm::dvec3& target, Size2d size, double fov = 40.0) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0.1, 0.2, 1.0};
  camera.fov_y = fov;
  return make_view(camera, size, 1.0);
}

inline View look_parallel(const glm::dvec3& eye, const glm::dvec3& target, Size2d size, double height) {
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0.1, 0.2, 1.0};
  camera.height = height;
  return make_view(camera, size, 1.0);
}

template <class Real> struct Point { Real x{}, y{}, z{}; };
template <class Real> Real dot(const Point<Real>& a, const Point<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Plain { // one pixel's answer
  double t{std::numeric_limits<double>::infinity()};
  std::uint32_t id{reference_no_id};
  glm::dvec3 normal{0}; // world
};

// Spheres of a scene in view space, in Real. Instances must be similarities.
template <class Real> struct PlainSpheres {
  std::vector<Point<Real>> center{};
  std::vector<Real> radius{};
  std::vector<std::uint32_t> id{};

  PlainSpheres(const Scene& scene, const View& view) {
    for (const Batch& batch : scene.batches)
      for (std::size_t k = 0; k < batch.instances.size(); ++k) {
        const glm::dmat4& m = batch.instances[k].world_from_data;
        const Real scale = root(Real(m[0][0]) * Real(m[0][0]) + Real(m[0][1]) * Real(m[0][1]) +
                                Real(m[0][2]) * Real(m[0][2]));
        for (std::uint64_t i = 0; i < batch.chunks->record_count(); ++i) {
          if (batch.chunks->rows[i] == no_row) continue;
          const glm::vec4& record = batch.chunks->records[i];
          const glm::dvec3 c = batch.chunks->center(i);
          const auto world = [&](int row) {
            return Real(m[0][row]) * Real(c.x) + Real(m[1][row]) * Real(c.y) + Real(m[2][row]) * Real(c.z) +
                   Real(m[3][row]) - Real(view.eye[row]);
          };
          const Point<Real> w{world(0), world(1), world(2)};
          const auto turned = [&](int row) {
            return Real(view.rotation[0][row]) * w.x + Real(view.rotation[1][row]) * w.y +
                   Real(view.rotation[2][row]) * w.z;
          };
          center.push_back({turned(0), turned(1), turned(2)});
          radius.push_back(Real(record.w) * scale);
          id.push_back(
              static_cast<std::uint32_t>(batch.id_base + k * batch.row_count + batch.chunks->rows[i]));
        }
      }
  }

  [[nodiscard]] Plain at(const View& view, double px, double py) const {
    const Real u =
        (Real(px) + Real(view.sample_offset.x) - Real(0.5) * Real(view.size.width)) / Real(view.focal);
    const Real v =
        (Real(py) + Real(view.sample_offset.y) - Real(0.5) * Real(view.size.height)) / Real(view.focal);
    const bool parallel = view.projection == Projection::Orthographic;
    const Point<Real> o = parallel ? Point<Real>{u, v, Real(0)} : Point<Real>{};
    const Point<Real> d = parallel ? Point<Real>{Real(0), Real(0), Real(1)} : Point<Real>{u, v, Real(1)};
    Plain best;
    Real best_t = Real(1e300);
    for (std::size_t i = 0; i < center.size(); ++i) {
      // |o + t d - c|^2 = r^2, solved as the textbook does; Real has the digits for it
      const Point<Real> f{o.x - center[i].x, o.y - center[i].y, o.z - center[i].z};
      const Real a = dot(d, d), b = dot(f, d), c = dot(f, f) - radius[i] * radius[i];
      const Real discriminant = b * b - a * c;
      if (discriminant < Real(0)) continue;
      const Real h = root(discriminant);
      for (const Real t : {(-b - h) / a, (-b + h) / a}) {
        if (!(t > Real(0)) || t < Real(view.near_cut) || (view.far_cut > 0 && t > Real(view.far_cut)))
          continue;
        if (t < best_t || (t == best_t && id[i] < best.id)) {
          best_t = t;
          best.t = static_cast<double>(t);
          best.id = id[i];
          const bool exit = t == (-b + h) / a && h > Real(0);
          const Real s = (exit ? Real(-1) : Real(1)) / radius[i];
          const glm::dvec3 n(static_cast<double>((f.x + t * d.x) * s),
                             static_cast<double>((f.y + t * d.y) * s),
                             static_cast<double>((f.z + t * d.z) * s));
          best.normal = glm::transpose(view.rotation) * n;
        }
        break;
      }
    }
    return best;
  }
};

} // namespace mote::test
