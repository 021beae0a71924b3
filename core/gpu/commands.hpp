// SPDX-License-Identifier: MIT
// What an encoder records: a flat list of small commands that name Vulkan handles directly, the
// scopes with their uses, and shared ownership of everything named. submit plans the barriers and
// turns each command into one or two Vulkan calls. Private to core/gpu.
#pragma once

#include "core/gpu/barriers.hpp"
#include "core/gpu/usage.hpp"
#include "core/gpu/vk/objects.hpp"

#include <memory>
#include <variant>
#include <vector>

namespace mote::gpu {

// Contents of fresh memory with fill_new_memory: as a float a NaN, as an integer nothing anybody means.
inline constexpr std::uint32_t loud_word = 0x7FC0DEADu;

namespace cmd {

struct BeginRender { std::uint32_t pass{}; };
struct EndRender { std::uint32_t pass{}; };
struct Timestamp { QuerySet::Impl* set{}; std::uint32_t index{}; };
struct BeginStatistics { QuerySet::Impl* set{}; std::uint32_t index{}; };
struct EndStatistics { QuerySet::Impl* set{}; std::uint32_t index{}; };
struct ResolveQueries { QuerySet::Impl* set{}; std::uint32_t first{}, count{}, scope{}; VkBuffer dst{}; std::uint64_t offset{}; };
struct SetPipeline { VkPipeline pipeline{}; VkPipelineBindPoint point{}; std::uint32_t interpolated{}, flat{}; };
struct SetGroup { VkPipelineLayout layout{}; VkDescriptorSet set{}; std::uint32_t index{}; VkPipelineBindPoint point{}; };
struct PushConstants { VkPipelineLayout layout{}; std::uint32_t first_byte{}, size{}; };
struct SetVertexBuffer { VkBuffer buffer{}; std::uint64_t offset{}; std::uint32_t slot{}; };
struct SetIndexBuffer { VkBuffer buffer{}; std::uint64_t offset{}; VkIndexType type{}; };
struct SetViewport { VkViewport viewport{}; };
struct SetScissor { VkRect2D rect{}; };
struct SetBlendConstant { float color[4]{}; };
struct Draw { std::uint32_t vertices{}, instances{}, first_vertex{}, first_instance{}; };
struct DrawIndexed { std::uint32_t indices{}, instances{}, first_index{}; std::int32_t base_vertex{}; std::uint32_t first_instance{}; };
struct DrawIndirect { VkBuffer buffer{}; std::uint64_t offset{}; bool indexed{}; };
struct Dispatch { std::uint32_t x{}, y{}, z{}, scope{}; };
struct DispatchIndirect { VkBuffer buffer{}; std::uint64_t offset{}; std::uint32_t scope{}; };
struct CopyBuffer { VkBuffer src{}, dst{}; VkBufferCopy region{}; std::uint32_t scope{}; };
struct CopyBufferTexture { VkBuffer buffer{}; VkImage image{}; std::uint32_t region{}, scope{}; bool to_texture{}; };
struct CopyTexture { VkImage src{}, dst{}; std::uint32_t region{}, scope{}; };
struct FillBuffer { VkBuffer buffer{}; std::uint64_t offset{}, size{}; std::uint32_t value{}, scope{}; };
struct ClearTexture { Texture::Impl* texture{}; std::uint32_t scope{}; }; // loud value of fill_new_memory
struct BeginLabel { std::uint32_t text{}; };
struct EndLabel {};
struct Synchronize { std::uint32_t scope{}; }; // barriers only (present)

using Any = std::variant<BeginRender, EndRender, Timestamp, BeginStatistics, EndStatistics, ResolveQueries, SetPipeline, SetGroup,
                         PushConstants, SetVertexBuffer, SetIndexBuffer, SetViewport, SetScissor, SetBlendConstant, Draw,
                         DrawIndexed, DrawIndirect, Dispatch, DispatchIndirect, CopyBuffer, CopyBufferTexture, CopyTexture,
                         FillBuffer, ClearTexture, BeginLabel, EndLabel, Synchronize>;

} // namespace cmd

struct RecordedPass {
  std::vector<VkRenderingAttachmentInfo> colors{};
  VkRenderingAttachmentInfo depth{};
  bool has_depth{};
  VkRect2D area{};
  std::uint32_t scope{};
  std::vector<cmd::BeginStatistics> statistics{}; // queries to reset before the pass
};

struct Recording {
  std::uint64_t serial{}; // of its ownership marks
  std::vector<cmd::Any> commands{};
  ScopeList scopes{};
  std::vector<RecordedPass> passes{};
  std::vector<VkBufferImageCopy> buffer_texture_regions{};
  std::vector<VkImageCopy> texture_regions{};
  std::vector<std::byte> bytes{};   // push constants
  std::vector<std::string> texts{}; // debug group labels
  std::vector<std::shared_ptr<vk::Object>> kept{};

  // Shares ownership until the device has finished with the submission.
  template <class T> void keep(const std::shared_ptr<T>& object) {
    if (object->kept_by == serial) return;
    object->kept_by = serial;
    kept.push_back(object);
  }
  void clear();
  [[nodiscard]] bool empty() const { return commands.empty(); }
};

// From the device's pool of emptied recordings, and back.
std::unique_ptr<Recording> take_recording(vk::DeviceCore& core);
void give_back(vk::DeviceCore& core, std::unique_ptr<Recording> recording);

// Vulkan calls of one recording, barriers planned on the way. Keeps its scratch lists between recordings.
class Replayer {
public:
  void begin(vk::DeviceCore& core, VkCommandBuffer commands);
  void replay(const Recording& recording);
  void end(); // makes writes visible to the host if anybody will look

private:
  struct Visitor;
  void barriers(std::uint32_t scope);
  vk::DeviceCore* core_{};
  VkCommandBuffer commands_{};
  VkShaderStageFlags push_stages_{};
  bool host_reads_{};
  BarrierPlan plan_{};
  std::vector<VkImageMemoryBarrier2> images_{};
};

} // namespace mote::gpu
