// SPDX-License-Identifier: MIT
// What render and compute passes share: bind groups, push constants, timestamps, debug groups.
#include "core/gpu/vk/handles.hpp"

#include <bit>
#include <cstring>

namespace mote::gpu {

void BindState::set_group(const DeviceFacts& device, std::uint32_t index, std::shared_ptr<BindGroup::Impl> group) {
  if (index >= max_groups || index >= device.limits.max_bind_groups) {
    invalid("V-BIND-010", "Group index {} is set; {} has {} groups.", index, named("Device", device.label),
            std::min<std::size_t>(max_groups, device.limits.max_bind_groups));
  }
  if (groups[index] == group) return;
  groups[index] = std::move(group);
  dirty[index] = true;
}

void BindState::set_push(const DeviceFacts& device, std::uint32_t offset, std::span<const std::byte> data) {
  const std::uint64_t limit = std::min<std::uint64_t>(max_push_bytes, device.limits.max_push_constant_size);
  if (offset % 4 != 0 || data.size() % 4 != 0 || offset + data.size() > limit) {
    invalid("V-PUSH-001", "Push constants [{}, {}) are set; both ends must be multiples of 4 and at most {}.", offset,
            offset + data.size(), limit);
  }
  std::memcpy(push.data() + offset, data.data(), data.size());
  for (std::size_t word = offset / 4; word < (offset + data.size()) / 4; ++word) push_words |= std::uint64_t{1} << word;
  push_dirty = true;
}

void BindState::apply(Recording& recording, const PipelineLayout::Impl& pipeline_layout, std::uint32_t push_needed,
                      std::string_view pipeline_name, VkPipelineBindPoint point) {
  const bool other_layout = layout != pipeline_layout.handle;
  for (std::uint32_t i = 0; i < pipeline_layout.groups.size(); ++i) {
    const BindGroupLayout::Impl& expected = *pipeline_layout.groups[i];
    if (!groups[i]) {
      if (expected.entries.empty()) continue;
      invalid("V-DRAW-002", "{} needs group {} of {}, but none is set.", pipeline_name, i, named("BindGroupLayout", expected.label));
    }
    const BindGroup::Impl& group = *groups[i];
    if (group.layout.get() != &expected && !same_layout(group.layout->entries, expected.entries)) {
      invalid("V-DRAW-003", "{} of {} is set as group {}, where {} needs {}.", named("BindGroup", group.label),
              named("BindGroupLayout", group.layout->label), i, pipeline_name, named("BindGroupLayout", expected.label));
    }
    if (!dirty[i] && !other_layout) continue;
    recording.commands.push_back(cmd::SetGroup{pipeline_layout.handle, group.handle, i, point});
    dirty[i] = false;
  }
  const std::uint32_t words = pipeline_layout.push_constant_size / 4;
  const auto low = [](std::uint32_t count) { return count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1; };
  if ((push_words & low(push_needed / 4)) != low(push_needed / 4)) {
    invalid("V-DRAW-004", "{} reads {} bytes of push constants, but not all of them are set.", pipeline_name, push_needed);
  }
  const std::uint32_t bytes = static_cast<std::uint32_t>(std::bit_width(push_words & low(words))) * 4;
  if (bytes > 0 && (push_dirty || other_layout)) {
    const auto first = static_cast<std::uint32_t>(recording.bytes.size());
    recording.bytes.insert(recording.bytes.end(), push.begin(), push.begin() + bytes);
    recording.commands.push_back(cmd::PushConstants{pipeline_layout.handle, first, bytes});
    push_dirty = false;
  }
  layout = pipeline_layout.handle;
}

void PassBase::take_timestamps(const std::optional<TimestampWrites>& writes) {
  if (!writes) return;
  timestamp_set = vk::require(writes->query_set, "QuerySet", *core);
  for (const auto& index : {writes->begin, writes->end}) {
    if (index) {
      check_query("a timestamp of the pass", timestamp_set->label, timestamp_set->type, timestamp_set->count, QueryType::Timestamp, *index);
    }
  }
  timestamps = writes;
  recording().keep(timestamp_set);
  record_timestamp(writes->begin);
}

void PassBase::record_timestamp(const std::optional<std::uint32_t>& index) {
  if (index) recording().commands.push_back(cmd::Timestamp{timestamp_set.get(), *index});
}

void PassBase::push_label(std::string_view text) {
  recording().commands.push_back(cmd::BeginLabel{static_cast<std::uint32_t>(recording().texts.size())});
  recording().texts.emplace_back(text);
  ++debug_groups;
}
void PassBase::pop_label() {
  if (debug_groups == 0) invalid("V-ENC-003", "{} has no open debug group to pop.", named("Pass", label));
  recording().commands.push_back(cmd::EndLabel{});
  --debug_groups;
}

void PassBase::close() {
  ended = true;
  encoder->in_pass = false;
  if (debug_groups > 0) invalid("V-ENC-003", "{} ends with {} open debug groups.", named("Pass", label), debug_groups);
}

} // namespace mote::gpu
