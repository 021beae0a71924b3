// SPDX-License-Identifier: MIT
// The particles of one order on the device: the chunk sets of a selection in one buffer each (one a
// particle type), the order over all of them, and one row of values for each instance, so that one draw
// takes particles of any batch. Owned by a pass that draws transparent particles.
//
// Sorting, placing and uploading happen only when the camera, the instances, materials or data changed
// since the last frame.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/order.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mote::passes {

class OrderedStore {
public:
  explicit OrderedStore(gpu::Device device);

  // True if anything was done again. Throws Failure P004 for more particles than a binding holds.
  bool update(const Scene& scene, const View& view, const Selection& selection, Order order);

  [[nodiscard]] const OrderedParticles& particles() const { return particles_; }
  [[nodiscard]] bool has_colors() const { return has_colors_; } // some particle has a color of its own
  [[nodiscard]] const gpu::BindGroup& group(const std::string& type) const { return groups_.at(type); } // set 1
  [[nodiscard]] const gpu::BindGroupLayout& layout() const { return layout_; }

private:
  struct Signature { // what the order and the rows depend on
    std::vector<double> values{};
    std::vector<std::shared_ptr<const ChunkSet>> sets{};
    bool operator==(const Signature&) const = default;
  };
  static Signature signature_of(const Scene& scene, const View& view, const Selection& selection, Order order);
  void upload_sets(const Scene& scene, const Selection& selection);
  void upload_order();
  void write(gpu::Buffer& buffer, std::string_view label, std::span<const std::byte> contents);

  struct TypeBuffers {
    gpu::Buffer records{}, rows{}, colors{};
  };
  gpu::Device device_;
  gpu::BindGroupLayout layout_;
  gpu::Buffer nothing_; // bound where there is nothing; never read
  gpu::Buffer placements_, near_, order_, owners_, blocks_;
  std::map<std::string, TypeBuffers> types_;
  std::map<std::string, gpu::BindGroup> groups_;
  std::vector<ChunkBase> bases_;
  std::vector<std::shared_ptr<const ChunkSet>> sets_; // in types_, kept alive: their addresses are keys
  bool has_colors_{};
  Signature last_{};
  bool valid_{};
  OrderedParticles particles_{};
};

} // namespace mote::passes
