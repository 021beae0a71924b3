// SPDX-License-Identifier: MIT
// The driver's pipeline cache on disk. The file is ours (header, checksum, payload), because drivers
// have crashed on damaged caches of their own; its name holds device uuid and driver version.
// A missing, damaged or foreign file is no error: the cache starts empty. Private to core/gpu.
#pragma once

#include "core/gpu/vk/core.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mote::gpu::vk {

struct PipelineCacheKey {
  std::string device_uuid{};
  std::uint32_t driver_version{};
};
// Pure: header + checksum + payload, and back. Nothing comes back from damaged bytes or another key.
std::vector<std::byte> pack_pipeline_cache(const PipelineCacheKey& key, std::span<const std::byte> payload);
std::optional<std::vector<std::byte>> unpack_pipeline_cache(const PipelineCacheKey& key, std::span<const std::byte> file);
std::string pipeline_cache_name(const PipelineCacheKey& key);

void load_pipeline_cache(DeviceCore& core, const std::string& directory);
void save_pipeline_cache(DeviceCore& core);

} // namespace mote::gpu::vk
