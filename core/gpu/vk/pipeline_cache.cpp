// SPDX-License-Identifier: MIT
#include "core/gpu/vk/pipeline_cache.hpp"

#include "core/gpu/cache_file.hpp"

#include <algorithm>
#include <cstring>

namespace mote::gpu::vk {
namespace {

struct Header {
  char magic[8]{'m', 'o', 't', 'e', 'p', 'i', 'p', '1'};
  std::uint64_t key{}, size{}, checksum{};
};

std::uint64_t hash_key(const PipelineCacheKey& key) {
  return hash_bytes(std::as_bytes(std::span(&key.driver_version, 1)), hash_text(key.device_uuid));
}

} // namespace

std::vector<std::byte> pack_pipeline_cache(const PipelineCacheKey& key, std::span<const std::byte> payload) {
  Header header;
  header.key = hash_key(key);
  header.size = payload.size();
  header.checksum = hash_bytes(payload);
  std::vector<std::byte> file(sizeof header + payload.size());
  std::memcpy(file.data(), &header, sizeof header);
  std::copy(payload.begin(), payload.end(), file.begin() + sizeof header);
  return file;
}

std::optional<std::vector<std::byte>> unpack_pipeline_cache(const PipelineCacheKey& key, std::span<const std::byte> file) {
  Header header;
  const Header expected;
  if (file.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, file.data(), sizeof header);
  const auto payload = file.subspan(sizeof header);
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0 || header.key != hash_key(key) ||
      header.size != payload.size() || header.checksum != hash_bytes(payload)) {
    return std::nullopt;
  }
  return std::vector<std::byte>(payload.begin(), payload.end());
}

std::string pipeline_cache_name(const PipelineCacheKey& key) {
  return fmt::format("pipelines-{}-{:08x}.bin", key.device_uuid, key.driver_version);
}

void load_pipeline_cache(DeviceCore& core, const std::string& directory) {
  std::vector<std::byte> initial;
  if (!directory.empty()) {
    const PipelineCacheKey key{core.adapter->info.device_uuid, core.adapter->info.driver_version};
    core.pipeline_cache_file = fmt::format("{}/{}", directory, pipeline_cache_name(key));
    if (const auto file = read_cache_file(core.pipeline_cache_file)) {
      if (auto payload = unpack_pipeline_cache(key, *file)) initial = std::move(*payload);
    }
  }
  auto info = vk::init<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
  info.initialDataSize = initial.size();
  info.pInitialData = initial.data();
  check(vkCreatePipelineCache(core.device, &info, nullptr, &core.pipeline_cache), "vkCreatePipelineCache");
}

void save_pipeline_cache(DeviceCore& core) {
  if (core.pipeline_cache_file.empty()) return;
  std::size_t size = 0;
  if (vkGetPipelineCacheData(core.device, core.pipeline_cache, &size, nullptr) != VK_SUCCESS) return;
  std::vector<std::byte> payload(size);
  if (vkGetPipelineCacheData(core.device, core.pipeline_cache, &size, payload.data()) != VK_SUCCESS) return;
  payload.resize(size);
  const PipelineCacheKey key{core.adapter->info.device_uuid, core.adapter->info.driver_version};
  write_cache_file(core.pipeline_cache_file, pack_pipeline_cache(key, payload));
}

} // namespace mote::gpu::vk
