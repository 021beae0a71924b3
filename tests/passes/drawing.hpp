// SPDX-License-Identifier: MIT
// The shipped default graph with an executor that is kept over frames, as a window keeps it: what a frame leaves for the
// next (pipelines, seen chunks, the choice of an expansion) is part of what is tested.
#pragma once

#include "core/color/color_config.hpp"
#include "harness.hpp"
#include "passes/particles/expansion_choice.hpp"
#include "render_graph/executor.hpp"

#include <memory>
#include <string_view>

namespace mote::test {

class Drawing {
public:
  // `every_aov`: AOVs and the linear picture are wanted, too; else the output alone, so that the tiles may do the display
  // pass's work. `settings`: "pass.param=value" each.
  Drawing(gpu::Device device, const passes::FrameOptions& options, bool every_aov = true, std::uint64_t largest_binding = 0, const std::vector<std::string>& settings = {});
  ~Drawing();
  // Vectors that nobody wanted are empty.
  Picture draw(const Scene& scene, const View& view);
  [[nodiscard]] const std::vector<passes::ExpansionReport>& choices() const { return choices_; } // of the last frame
  [[nodiscard]] Diagnostics report();                                                           // of the last frame
  [[nodiscard]] bool display_ran();
  [[nodiscard]] bool stage_ran(std::string_view stage); // of the opaque pass, in the last frame

private:
  gpu::Device device_;
  passes::FrameOptions options_;
  bool every_aov_;
  ColorConfig config_;
  passes::ParticleStore store_;
  std::unique_ptr<rg::Executor> executor_;
  std::vector<passes::ExpansionReport> choices_;
};

// Spheres at random places of a cube, their radii within 5 % of `radius`.
Scene cloud_scene(std::uint32_t count, double radius, std::uint32_t seed, double half = 10.0);
// Ids equal but for pixels on the edge of a particle, where the two may round differently: at most 1 in 10 000.
void expect_same(const Picture& tiles, const Picture& vertex, const std::string& what);

// A device with subgroups, but without atomics of 64 bits.
gpu::Device plain_subgroup_device();
// A device with no optional feature at all, and what the validation layer has said about it.
gpu::Device bare_device();
std::vector<std::string> bare_device_messages();

} // namespace mote::test
