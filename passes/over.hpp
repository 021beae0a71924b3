// SPDX-License-Identifier: MIT
// Puts what a transparent pass gathered (a layer, weighted sums, lists) over the color that is there, with
// a full-screen shader of shaders/post. Used by sorted_glyphs.
//
// The color of a graph is straight, its alpha 1 wherever the scene is opaque: there the device blends. With a
// background that is not opaque the color is copied first, and the shader computes the straight color of both.
#pragma once

#include "core/gpu/gpu.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace mote::passes {

// A color attachment that several RenderPasses of one graph pass draw into: cleared by the first, if at all.
struct ColorTarget {
  gpu::TextureView view{};
  gpu::TextureFormat format{};
  bool clear{};
  gpu::Color value{};
  gpu::ColorAttachment attachment(); // the first one clears
};

struct Rows {
  std::uint32_t begin{}, end{}; // rows of the picture
};

class Over {
public:
  // `lists`: layout of group 1 of "exact", or null where that is not used.
  Over(gpu::Device device, const gpu::BindGroupLayout* lists);

  // Copies the color for the frame's apply() calls, if it is not opaque everywhere; call it once before them.
  void begin(gpu::CommandEncoder& encoder, ColorTarget& color, bool opaque, std::uint32_t width, std::uint32_t height);
  // One full-screen draw of "post/<name>.frag" over the rows. `textures`: bindings 1 and 2 of group 0.
  void apply(gpu::CommandEncoder& encoder, ColorTarget& color, const std::string& name, std::span<const gpu::TextureView> textures,
             Rows rows, const gpu::BindGroup& lists = {}, std::span<const std::byte> constants = {});
  // Writes the nearest depth into `depth` where the layer is opaque.
  void mark_saturated(gpu::CommandEncoder& encoder, const gpu::TextureView& layer, const gpu::TextureView& depth);

private:
  struct PipelineKey {
    std::string name{};
    gpu::TextureFormat format{};
    bool copied{};
    bool copying{}; // the copy itself: replaces
    auto operator<=>(const PipelineKey&) const = default;
  };
  const gpu::RenderPipeline& pipeline(const PipelineKey& key);
  gpu::BindGroup group(const gpu::TextureView& there, std::span<const gpu::TextureView> textures);
  gpu::ShaderModule module(const std::string& key);

  gpu::Device device_;
  gpu::BindGroupLayout textures_layout_;
  gpu::PipelineLayout layout_, lists_layout_;
  gpu::TextureView nothing_; // bound where there is no texture; never read
  gpu::Texture copy_;
  bool copied_{};
  std::map<PipelineKey, gpu::RenderPipeline> pipelines_;
};

} // namespace mote::passes
