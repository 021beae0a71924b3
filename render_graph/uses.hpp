// SPDX-License-Identifier: MIT
// Declared against observed: a pass declares slots, core/gpu sees what its commands touch, and this
// compares the two after each recorded pass. Part of the Executor, on while Vulkan validation is asked
// for (MOTE_VALIDATION=1, as in all tests) or by ExecutorOptions.
//
// G072: a texture or buffer of the graph was used in a way that the pass did not declare. Found before
// anything is submitted. G073: a slot was declared and has not been used in any frame; only a note,
// since a frame may have nothing to draw.
// Resources that a pass owns itself are its own business and are not looked at.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/gpu/observe.hpp"
#include "render_graph/plan.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace mote::rg {

// One resource of the graph that a pass touched.
struct SeenUse {
  bool buffer{};
  std::uint32_t physical{}; // as in PlannedTexture, PlannedBuffer
  gpu::Use use{};
};

// What an access allows, and what of it makes the slot a used one.
gpu::Use allowed_uses(Access access, bool buffer);
gpu::Use needed_uses(Access access, bool buffer);

class UseCheck {
public:
  explicit UseCheck(const Plan& plan); // `plan` must outlive it
  // What pass `i` did in a frame; with `successors_work` it did that of pass i + 1, too, and may write what that one
  // declared. Throws Failure G072 (exit 1) for the first use that was not declared.
  void recorded(std::size_t i, std::span<const SeenUse> seen, bool successors_work = false);
  // G073 for each slot that no frame so far has used, of passes that ran at all.
  [[nodiscard]] Diagnostics unused() const;

private:
  // What a declared use allows, if it is of this resource.
  [[nodiscard]] gpu::Use allows(const Use& use, const SeenUse& seen) const;
  [[nodiscard]] std::uint32_t physical(const Use& use) const;
  [[nodiscard]] std::string name(const SeenUse& seen, std::size_t pass) const;
  const Plan& plan_;
  std::vector<std::vector<bool>> used_; // [pass][use]
  std::vector<bool> ran_;
};

} // namespace mote::rg
