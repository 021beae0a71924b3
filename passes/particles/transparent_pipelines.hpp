// SPDX-License-Identifier: MIT
// Render pipelines that draw transparent particles from an OrderedStore: shaders of phase `transparent`,
// by expansion and by what becomes of the surfaces. Made when first asked for and kept, as
// ParticlePipelines does for phase `opaque`. Used by sorted_glyphs.
//
// Sets: 0 the frame block, 1 the ordered particles, 2 the depth of an earlier pass, 3 (Exact) the lists.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/pipelines.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace mote::passes {

// What becomes of a fragment's surfaces; MODE of shaders/particles/phase/transparent.frag.
enum class Layering : std::uint8_t { Sorted, SortedDepth, Weighted, Exact };

// Push constants of phase `transparent`.
struct TransparentBlock {
  float depth_scale{1};
  std::uint32_t strip{}, capacity{}, width{};
};

struct TransparentKey {
  ParticlePipelineKey particle{}; // phase, aovs and opaque_only unused
  Layering layering{Layering::Sorted};
  bool two_surfaces{true};
  bool has_depth{};               // set 2 holds an earlier pass's depth
  bool straight{};                // a blend state of the user's: color is not multiplied by alpha
  bool under{};                   // front to back: each fragment goes under what is there
  bool saturation{};              // an attached depth rejects what lies behind saturated pixels
  auto operator<=>(const TransparentKey&) const = default;
};

class TransparentPipelines {
public:
  TransparentPipelines(gpu::Device device, const gpu::BindGroupLayout& ordered);
  [[nodiscard]] const gpu::RenderPipeline& get(const TransparentKey& key);
  [[nodiscard]] const gpu::BindGroupLayout& frame_layout() const { return frame_layout_; }
  [[nodiscard]] const gpu::BindGroupLayout& depth_layout() const { return depth_layout_; }
  [[nodiscard]] const gpu::BindGroupLayout& lists_layout() const { return lists_layout_; }

private:
  gpu::ShaderModule module(const std::string& key);
  gpu::Device device_;
  gpu::BindGroupLayout frame_layout_, depth_layout_, lists_layout_;
  gpu::PipelineLayout layout_, exact_layout_;
  std::map<std::string, gpu::ShaderModule> modules_;
  std::map<TransparentKey, gpu::RenderPipeline> pipelines_;
};

} // namespace mote::passes
