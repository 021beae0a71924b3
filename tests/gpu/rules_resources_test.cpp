// SPDX-License-Identifier: MIT
// Rules for resources: a good descriptor, then one thing broken at a time.
#include "tests/gpu/rules.hpp"

#include <array>

namespace mote::gpu {
namespace {

const DeviceFacts device = made_up_device();

BufferDescriptor good_buffer() { return {.label = "positions", .size = 64, .usage = BufferUsage::Storage | BufferUsage::CopyDst}; }

TEST(BufferRules, good) { expect_kept([] { check_buffer(device, good_buffer()); }); }
TEST(BufferRules, size) {
  auto d = good_buffer();
  d.size = 0;
  expect_broken("V-BUF-001", "[BufferDescriptor \"positions\"] is 0", [&] { check_buffer(device, d); });
  d.size = (1u << 30) + 1ull;
  expect_broken("V-BUF-002", "1073741825 bytes; [Device \"made up\"] allows 1073741824", [&] { check_buffer(device, d); });
}
TEST(BufferRules, storage_larger_than_a_binding_may_be_made) {
  auto d = good_buffer();
  d.size = device.limits.max_storage_buffer_binding_size * 4;
  expect_kept([&] { check_buffer(device, d); });
}
TEST(BufferRules, usage) {
  auto d = good_buffer();
  d.usage = BufferUsage::None;
  expect_broken("V-BUF-003", "is None", [&] { check_buffer(device, d); });
  d.usage = BufferUsage::MapRead | BufferUsage::Storage;
  expect_broken("V-BUF-004", "MapRead|Storage", [&] { check_buffer(device, d); });
  d.usage = BufferUsage::MapWrite | BufferUsage::CopyDst;
  expect_broken("V-BUF-004", "MapWrite combines with CopySrc only", [&] { check_buffer(device, d); });
  d.usage = BufferUsage::MapRead | BufferUsage::CopyDst;
  expect_kept([&] { check_buffer(device, d); });
}
TEST(BufferRules, contents) {
  const std::array<std::byte, 65> bytes{};
  auto d = good_buffer();
  d.contents = bytes;
  expect_broken("V-BUF-005", "65 bytes; its size is 64", [&] { check_buffer(device, d); });
}

TextureDescriptor good_texture() {
  return {.label = "color", .size = {64, 32, 1}, .format = TextureFormat::RGBA16Float, .usage = TextureUsage::Sampled | TextureUsage::RenderAttachment};
}

TEST(TextureRules, good) { expect_kept([] { check_texture(device, good_texture()); }); }
TEST(TextureRules, size) {
  auto d = good_texture();
  d.size.height = 0;
  expect_broken("V-TEX-001", "64x0x1", [&] { check_texture(device, d); });
  d.size = {8193, 1, 1};
  expect_broken("V-TEX-002", "8193x1x1; [Device \"made up\"] allows 8192x8192x128", [&] { check_texture(device, d); });
  d.size = {513, 4, 4};
  d.dimension = TextureDimension::D3;
  expect_broken("V-TEX-002", "512x512x512 for dimension 3d", [&] { check_texture(device, d); });
  d.size = {16, 2, 1};
  d.dimension = TextureDimension::D1;
  expect_broken("V-TEX-002", "4096x1x1 for dimension 1d", [&] { check_texture(device, d); });
}
TEST(TextureRules, mips) {
  auto d = good_texture();
  d.mip_level_count = 8;
  expect_broken("V-TEX-003", "8 mip levels; a size of 64x32x1 has 1 to 7", [&] { check_texture(device, d); });
  d.mip_level_count = 0;
  expect_broken("V-TEX-003", "0 mip levels", [&] { check_texture(device, d); });
}
TEST(TextureRules, format_and_usage) {
  auto d = good_texture();
  d.format = TextureFormat::Undefined;
  expect_broken("V-TEX-004", "Undefined", [&] { check_texture(device, d); });
  d = good_texture();
  d.usage = TextureUsage::None;
  expect_broken("V-TEX-005", "is None", [&] { check_texture(device, d); });
  d.format = TextureFormat::RGBA8UnormSrgb;
  d.usage = TextureUsage::Storage;
  expect_broken("V-TEX-006", "Storage, which [Device \"made up\"] does not offer for format rgba8unorm_srgb", [&] { check_texture(device, d); });
  d = good_texture();
  d.dimension = TextureDimension::D3;
  d.size = {4, 4, 4};
  expect_broken("V-TEX-006", "RenderAttachment", [&] { check_texture(device, d); });
}
TEST(TextureRules, samples) {
  auto d = good_texture();
  d.sample_count = 2;
  expect_broken("V-TEX-007", "is 2; there are 1 and 4", [&] { check_texture(device, d); });
  d.sample_count = 4;
  expect_kept([&] { check_texture(device, d); });
  d.mip_level_count = 2;
  expect_broken("V-TEX-008", "one mip level", [&] { check_texture(device, d); });
  d = good_texture();
  d.sample_count = 4;
  d.format = TextureFormat::R32Uint;
  expect_broken("V-TEX-007", "for format r32uint", [&] { check_texture(device, d); });
}

TextureFacts layered() {
  return {"layers", {16, 16, 6}, TextureFormat::R32Float, TextureUsage::Sampled, TextureDimension::D2, 3, 1};
}

TEST(ViewRules, defaults) {
  const TextureFacts texture = layered();
  const ViewFacts all = check_view(texture, {});
  EXPECT_EQ(all.dimension, TextureViewDimension::D2Array);
  EXPECT_EQ(all.range, (SubresourceRange{0, 3, 0, 6}));
  const ViewFacts one = check_view(texture, {.base_mip_level = 1, .mip_level_count = 1, .base_array_layer = 4, .array_layer_count = 1});
  EXPECT_EQ(one.dimension, TextureViewDimension::D2);
  EXPECT_EQ(one.range, (SubresourceRange{1, 1, 4, 1}));
}
TEST(ViewRules, ranges) {
  const TextureFacts texture = layered();
  expect_broken("V-VIEW-001", "[2, 4) of [TextureViewDescriptor] are not inside [Texture \"layers\"], which has 3",
                [&] { check_view(texture, {.base_mip_level = 2, .mip_level_count = 2}); });
  expect_broken("V-VIEW-002", "Layers [6, 7)", [&] { check_view(texture, {.base_array_layer = 6}); });
  expect_broken("V-VIEW-003", "dimension 3d; [Texture \"layers\"] has dimension 2d", [&] { check_view(texture, {.dimension = TextureViewDimension::D3}); });
  expect_broken("V-VIEW-004", "2 layers", [&] { check_view(texture, {.dimension = TextureViewDimension::D2, .array_layer_count = 2}); });
}

TEST(SamplerRules, all) {
  expect_kept([] { check_sampler({}); });
  expect_broken("V-SAMP-001", "[3, 2]", [] { check_sampler({.lod_min = 3, .lod_max = 2}); });
  expect_broken("V-SAMP-002", "is 4", [] { check_sampler({.max_anisotropy = 4}); });
}

TEST(QueryRules, all) {
  DeviceFacts with = device;
  with.features = Feature::TimestampQuery;
  expect_kept([&] { check_query_set(with, {.count = 2}); });
  expect_broken("V-QRY-001", "is 0", [&] { check_query_set(with, {.count = 0}); });
  expect_broken("V-FEAT-001", "Feature PipelineStatistics is not enabled on [Device \"made up\"]",
                [&] { check_query_set(with, {.type = QueryType::PipelineStatistics, .count = 1}); });
  expect_broken("V-QRY-002", "index 2 is not inside [QuerySet \"q\"], which has 2",
                [] { check_query("the query", "q", QueryType::Timestamp, 2, QueryType::Timestamp, 2); });
  expect_broken("V-QRY-002", "must have type PipelineStatistics; it has Timestamp",
                [] { check_query("the query", "q", QueryType::Timestamp, 2, QueryType::PipelineStatistics, 0); });
}

} // namespace
} // namespace mote::gpu
