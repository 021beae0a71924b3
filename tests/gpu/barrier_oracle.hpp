// SPDX-License-Identifier: MIT
// An independent judge of barriers, written from the Vulkan specification's words and not from the
// planner: it replays accesses and barriers on one buffer or texture subresource and tells the
// first rule that does not hold. Slow and simple on purpose.
#pragma once

#include "core/gpu/barriers.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mote::gpu {

struct OracleUse { // what a single Use means on the device
  VkPipelineStageFlags2 stages{};
  VkAccessFlags2 reads{}, writes{};
};
OracleUse oracle_use(Use use, bool geometry);
VkImageLayout oracle_layout(Use use, bool depth);

class SubresourceOracle {
public:
  explicit SubresourceOracle(bool image, bool depth, bool geometry) : image_(image), depth_(depth), geometry_(geometry) {}
  // A barrier without layouts (buffers), or with (images). Gives a complaint or an empty string.
  std::string barrier(const StageAccess& src, const StageAccess& dst, VkImageLayout old_layout, VkImageLayout new_layout);
  std::string access(Use uses, bool discard);

private:
  struct Event {
    VkPipelineStageFlags2 stages{};
    VkAccessFlags2 writes{};                 // 0: a read
    VkPipelineStageFlags2 happens_before{};  // stages of later commands that wait for it
    bool available{};
    VkPipelineStageFlags2 visible_stages{};
    VkAccessFlags2 visible_access{};
    bool transition{};
  };
  std::vector<Event> events_;
  VkImageLayout layout_{VK_IMAGE_LAYOUT_UNDEFINED};
  bool has_contents_{}, lost_contents_{};
  bool image_{}, depth_{}, geometry_{};
};

} // namespace mote::gpu
