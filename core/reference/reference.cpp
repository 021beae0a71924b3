// SPDX-License-Identifier: MIT
#include "core/reference/reference.hpp"

#include "core/base/diagnostic.hpp"
#include "core/base/parallel.hpp"
#include "core/reference/codes.hpp"
#include "core/reference/layers.hpp"
#include "core/reference/shade.hpp"
#include "core/reference/tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace mote {

namespace {

using reference::Sample;
using reference::Tracer;

constexpr std::uint32_t tile = 32; // pixels: neighbors walk the same nodes

// fn(x, y, index) for every pixel, tile by tile, on several threads.
template <class Function> void each_pixel(Size2d size, unsigned threads, Function&& fn) {
  const std::uint32_t columns = (size.width + tile - 1) / tile, rows = (size.height + tile - 1) / tile;
  for_each_block(std::size_t{columns} * rows, [&](std::size_t i) {
    const auto x0 = static_cast<std::uint32_t>(i % columns) * tile,
               y0 = static_cast<std::uint32_t>(i / columns) * tile;
    for (std::uint32_t y = y0; y < std::min(size.height, y0 + tile); ++y)
      for (std::uint32_t x = x0; x < std::min(size.width, x0 + tile); ++x)
        fn(x, y, std::size_t{y} * size.width + x);
  }, threads);
}

void check_ids(const reference::World& world) {
  if (world.particles <= 0xFFFFFFFEull) return;
  fail(Exit::Failed, reference_codes::too_many_ids, {},
       fmt::format("the scene has {} particles, but ids reach to {} only.", world.particles, 0xFFFFFFFEull),
       {"leave the id AOV out, or draw fewer instances"});
}

} // namespace

ReferencePicture render_reference(const reference::World& world, const View& view,
                                  const ReferenceOptions& options) {
  if (options.ids) check_ids(world);
  const auto start = std::chrono::steady_clock::now();
  ReferencePicture out;
  out.size = view.size;
  const std::size_t n = std::size_t{view.size.width} * view.size.height;
  out.depth.resize(n);
  if (options.ids) out.id.assign(n, reference_no_id);
  if (options.normals) out.normal.assign(n, glm::dvec3(0));
  if (options.normals) out.projected_radius.resize(n);
  if (options.colors) out.color.resize(n);
  if (options.ambiguity) out.ambiguous.resize(n);
  const bool layered = options.colors && !world.transparent_placed.empty();
  if (layered && options.ambiguity) out.layers_ambiguous.resize(n);
  const Tracer tracer(world, view);
  const reference::LayerTracer layer_tracer(tracer, options.two_surfaces);
  each_pixel(view.size, options.threads, [&](std::uint32_t x, std::uint32_t y, std::size_t i) {
    const Sample sample = tracer.sample(x, y, options.ambiguity);
    out.depth[i] = sample.hit.t;
    if (options.ambiguity) out.ambiguous[i] = sample.ambiguous ? 1 : 0;
    if (options.ids && sample.hit) out.id[i] = static_cast<std::uint32_t>(sample.hit.id);
    const bool needed = sample.hit && (options.normals || options.colors);
    const glm::dvec3 normal = needed ? tracer.normal(sample) : glm::dvec3(0);
    if (options.normals) out.normal[i] = normal;
    if (options.normals && sample.hit)
      out.projected_radius[i] = static_cast<float>(tracer.projected_radius(sample.hit));
    if (options.colors) out.color[i] = reference::shade(tracer, sample, normal, options.shadows);
    if (!layered) return;
    const std::vector<reference::Layer> layers = layer_tracer.layers(sample.ray, sample.hit.t);
    out.color[i] = layer_tracer.over(layers, sample.ray, out.color[i], options.shadows);
    if (options.ambiguity) out.layers_ambiguous[i] = sample.ambiguous || layer_tracer.ambiguous(x, y, sample, layers);
  });
  out.transparent = world.transparent;
  out.build_seconds = world.build_seconds;
  out.trace_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

ReferencePicture render_reference(const Scene& scene, const View& view, const ReferenceOptions& options) {
  return render_reference(reference::build_world(scene, options.threads), view, options);
}

std::vector<glm::dvec4> render_reference_area(const reference::World& world, const View& view, unsigned n,
                                              const ReferenceOptions& options) {
  std::vector<glm::dvec4> out(std::size_t{view.size.width} * view.size.height);
  const Tracer tracer(world, view);
  const reference::LayerTracer layer_tracer(tracer, options.two_surfaces);
  each_pixel(view.size, options.threads, [&](std::uint32_t x, std::uint32_t y, std::size_t i) {
    glm::dvec4 sum(0); // premultiplied, so that transparent backgrounds average rightly
    for (unsigned k = 0; k < n * n; ++k) {
      const double dx = (k % n + 0.5) / n - 0.5, dy = (k / n + 0.5) / n - 0.5;
      const Sample sample = tracer.sample(x + dx, y + dy, false);
      const glm::dvec3 normal = sample.hit ? tracer.normal(sample) : glm::dvec3(0);
      glm::dvec4 c = reference::shade(tracer, sample, normal, options.shadows);
      if (!world.transparent_placed.empty()) c = layer_tracer.over(layer_tracer.layers(sample.ray, sample.hit.t), sample.ray, c, options.shadows);
      sum += glm::dvec4(glm::dvec3(c) * c.a, c.a);
    }
    out[i] = sum.a > 0.0 ? glm::dvec4(glm::dvec3(sum) / sum.a, sum.a / (double(n) * n)) : glm::dvec4(0);
  });
  return out;
}

} // namespace mote
