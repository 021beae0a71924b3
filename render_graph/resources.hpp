// SPDX-License-Identifier: MIT
// The textures and buffers of a plan on a device, for one view size. Textures that share memory are
// one texture; what does not depend on the view survives a resize. Used by the Executor only.
#pragma once

#include "core/gpu/gpu.hpp"
#include "render_graph/pass.hpp"
#include "render_graph/plan.hpp"

#include <optional>
#include <vector>

namespace mote::rg {

class Resources {
public:
  Resources(gpu::Device device, const Plan& plan); // makes nothing yet; `plan` must outlive it

  // Makes what is missing or has another size. True if anything was made. Throws Failure (G070, exit 1)
  // if the device does not allow the size, G071 if it has no memory for it.
  bool realize(ViewSize view);
  [[nodiscard]] ViewSize view_size() const { return view_; }
  [[nodiscard]] const gpu::Texture& texture(std::uint32_t i) const { return textures_[plan_.textures[i].physical]; }
  [[nodiscard]] const gpu::Buffer& buffer(std::uint32_t i) const { return buffers_[plan_.buffers[i].physical]; }
  [[nodiscard]] const gpu::TextureView& view(std::size_t pass, std::size_t use) const { return views_[pass][use]; } // invalid for buffers
  // The physical number of a resource of the graph by its gpu::native_id(); nothing for a resource of somebody else.
  [[nodiscard]] std::optional<std::uint32_t> find(bool buffer, std::uint64_t native) const;
  // State: which textures and buffers hold an earlier frame.
  [[nodiscard]] bool fresh(const Use& use) const { return use.buffer ? fresh_buffers_[use.resource] : fresh_textures_[use.resource]; }
  void reset_state(); // all of it is fresh again
  void zero_fresh_state(gpu::CommandEncoder& encoder); // storage textures and buffers; attachments are cleared when opened
  void state_written() { mark_state(false); }

private:
  bool make_textures(ViewSize view);
  bool make_buffers(ViewSize view);
  void make_views();
  void mark_state(bool fresh);

  gpu::Device device_;
  const Plan& plan_;
  ViewSize view_{};
  std::vector<gpu::Texture> textures_{}; // by physical number
  std::vector<gpu::Buffer> buffers_{};
  std::vector<std::vector<gpu::TextureView>> views_{}; // [pass][use]
  std::vector<bool> fresh_textures_{}, fresh_buffers_{}; // by index in the plan; false for what is no state
};

} // namespace mote::rg
