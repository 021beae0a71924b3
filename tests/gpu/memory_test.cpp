// SPDX-License-Identifier: MIT
// Memory accounting and budget, loud fresh memory, the pipeline cache on disk, adapters and instances.
#include "tests/gpu/fixture.hpp"

#include <filesystem>
#include <fstream>
#include <cmath>
#include <cstdlib>

namespace mote::gpu {
namespace {

using testing::Each;
using testing::HasSubstr;

class MemoryTest : public DeviceTest {};

TEST_F(MemoryTest, report_follows_what_is_held) {
  const MemoryReport before = device.memory();
  {
    const Buffer b = device.create_buffer({.label = "held", .size = 1 << 16, .usage = BufferUsage::Storage});
    EXPECT_GE(device.memory().bytes, before.bytes + (1 << 16));
    EXPECT_EQ(device.memory().allocations, before.allocations + 1);
  }
  EXPECT_EQ(device.memory().bytes, before.bytes);
  EXPECT_GE(device.memory().peak_bytes, before.bytes + (1 << 16));
}

TEST_F(MemoryTest, budget_says_asked_held_and_allowed) {
  device = make_device({.label = "small", .memory_budget = 100'000});
  const Buffer first = device.create_buffer({.label = "first", .size = 80'000, .usage = BufferUsage::Storage});
  const std::uint64_t held = device.memory().bytes;
  Texture second;
  const Error error = expect_error(ErrorFilter::OutOfMemory, [&] {
    second = device.create_texture({.label = "second", .size = {128, 128, 1}, .format = TextureFormat::RGBA8Unorm, .usage = TextureUsage::Sampled});
  });
  EXPECT_FALSE(second);
  EXPECT_EQ(second.label(), "second");
  EXPECT_EQ(error.code, "V-MEM-001");
  EXPECT_THAT(error.message, testing::AllOf(HasSubstr("[Texture \"second\"] asks for "), HasSubstr(std::to_string(held)), HasSubstr("100000")));
  EXPECT_EQ(device.memory().bytes, held);
  EXPECT_EQ(device.memory().budget, 100'000u);
}

TEST_F(MemoryTest, fresh_memory_is_loud) {
  const Buffer buffer = device.create_buffer({.label = "fresh", .size = 64, .usage = BufferUsage::CopySrc});
  EXPECT_THAT(values_of<std::uint32_t>(device.read_buffer(buffer)), Each(0x7FC0DEADu));
  const Texture real = target(TextureFormat::RGBA32Float, 4, 4), whole = target(TextureFormat::R32Uint, 4, 4), picture = target(TextureFormat::RGBA8Unorm, 4, 4);
  for (const float v : values_of<float>(device.read_texture(real))) EXPECT_TRUE(std::isnan(v));
  EXPECT_THAT(values_of<std::uint32_t>(device.read_texture(whole)), Each(0x7FC0DEADu));
  EXPECT_THAT(values_of<std::uint32_t>(device.read_texture(picture)), Each(0xFFFF00FFu));
  EXPECT_THAT(values_of<float>(device.read_texture(target(TextureFormat::Depth32Float, 4, 4))), Each(0.7734375f));
}

// A buffer that is the caller's memory: a change there, which only a test may make, is seen; nothing was copied; the owner is kept.
TEST_F(MemoryTest, a_buffer_may_lie_in_the_callers_memory) {
  if (!has(adapter().features(), Feature::HostMemory)) GTEST_SKIP() << "the driver takes no memory of the caller";
  device = make_device({.required_features = Feature::HostMemory, .fill_new_memory = true});
  const std::uint64_t held = device.memory().bytes;
  auto owner = std::shared_ptr<std::uint32_t>(static_cast<std::uint32_t*>(std::aligned_alloc(host_page, 3 * host_page)), [](void* p) { std::free(p); });
  const std::weak_ptr<std::uint32_t> watched = owner;
  for (std::uint32_t i = 0; i < 3 * host_page / 4; ++i) owner.get()[i] = i;
  const auto contents = [&](std::uint64_t from, std::uint64_t count) { return std::as_bytes(std::span(owner.get() + from, count)); };
  const Buffer in = device.create_buffer({.label = "in", .size = 2500 * 4, .usage = BufferUsage::CopySrc, .contents = contents(0, 2500), .contents_owner = owner});
  EXPECT_EQ(device.memory().bytes, held + 3 * host_page);
  owner.get()[7] = 70;
  std::vector<std::uint32_t> got = values_of<std::uint32_t>(device.read_buffer(in));
  ASSERT_EQ(got.size(), 2500u);
  EXPECT_EQ(got[7], 70u);
  EXPECT_EQ(got[2499], 2499u);
  // Not at the start of a page: copied.
  const Buffer copied = device.create_buffer({.label = "copied", .size = 400, .usage = BufferUsage::CopySrc, .contents = contents(1, 100), .contents_owner = owner});
  owner.get()[1] = 90;
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(copied))[0], 1u);
  owner.reset();
  EXPECT_FALSE(watched.expired()) << "the buffer keeps it";
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(in))[7], 70u);
}

TEST_F(MemoryTest, without_the_feature_contents_are_copied) {
  auto owner = std::shared_ptr<std::uint32_t>(static_cast<std::uint32_t*>(std::aligned_alloc(host_page, host_page)), [](void* p) { std::free(p); });
  std::fill_n(owner.get(), 1024, 5u);
  device = make_device({});
  const Buffer in = device.create_buffer({.label = "in", .size = 4096, .usage = BufferUsage::CopySrc, .contents = std::as_bytes(std::span(owner.get(), 1024)), .contents_owner = owner});
  owner.get()[3] = 6;
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(in))[3], 5u);
}

TEST_F(MemoryTest, objects_may_be_dropped_before_the_device_is_done) {
  Buffer out = device.create_buffer({.label = "out", .size = 1 << 20, .usage = BufferUsage::CopySrc | BufferUsage::CopyDst});
  {
    const std::vector<std::uint32_t> ones(1 << 18, 1);
    const Buffer in = device.create_buffer({.label = "in", .size = 1 << 20, .usage = BufferUsage::CopySrc, .contents = bytes_of(ones)});
    CommandEncoder encoder = device.create_command_encoder();
    encoder.copy_buffer_to_buffer(in, 0, out, 0, 1 << 20);
    device.queue().submit(encoder.finish());
  }
  EXPECT_THAT(values_of<std::uint32_t>(device.read_buffer(out, 0, 4096)), Each(1u));
}

TEST_F(MemoryTest, device_may_go_before_its_objects) {
  const Buffer b = device.create_buffer({.label = "orphan", .size = 64, .usage = BufferUsage::Storage});
  device = {};
  EXPECT_EQ(b.size(), 64u);
}

TEST_F(MemoryTest, pipeline_cache_is_written_read_and_survives_damage) {
  const std::string folder = output("cache");
  const auto run = [&] {
    device = make_device({.label = "cached", .cache_directory = folder});
    const ShaderModule module = shader(ShaderStage::Compute, "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
    const PipelineLayout layout = device.create_pipeline_layout({});
    EXPECT_TRUE(device.create_compute_pipeline({.layout = &layout, .compute = {.module = &module}}));
    device.save_pipeline_cache();
  };
  run();
  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) file = entry.path();
  ASSERT_FALSE(file.empty());
  EXPECT_THAT(file.filename().string(), HasSubstr(adapter().info().device_uuid));
  run();
  std::ofstream(file, std::ios::trunc) << "not a cache";
  run();
  EXPECT_GT(std::filesystem::file_size(file), 32u) << "the damaged file is replaced";
  device = make_device({.label = "nowhere", .cache_directory = "/proc/nowhere"});
  device.save_pipeline_cache();
}

TEST_F(MemoryTest, adapters_are_listed_and_chosen_by_name) {
  EXPECT_FALSE(instance().adapters().empty());
  Error error;
  EXPECT_TRUE(instance().request_adapter({.name = "LLVMpipe"}, error)) << to_string(error);
  EXPECT_FALSE(instance().request_adapter({.name = "no such device"}, error));
  EXPECT_EQ(error.code, "V-ADPT-002");
  EXPECT_THAT(error.message, testing::AllOf(HasSubstr("\"no such device\""), HasSubstr("llvmpipe")));
  EXPECT_EQ(adapter().info().device_uuid.size(), 32u);
}

TEST_F(MemoryTest, the_first_error_of_a_row_stays) {
  Error error;
  const Adapter none = instance().request_adapter({.name = "no such device"}, error);
  EXPECT_FALSE(none.request_device({}, error));
  EXPECT_EQ(error.code, "V-ADPT-002");
  Error fresh;
  EXPECT_FALSE(none.request_device({}, fresh));
  EXPECT_EQ(fresh.code, "V-OBJ-001");
}

TEST_F(MemoryTest, a_feature_that_is_not_offered_is_named) {
  Error error;
  const Device none = adapter().request_device({.label = "greedy", .required_features = static_cast<Feature>(1u << 20) | Feature::GeometryShader}, error);
  EXPECT_FALSE(none);
  EXPECT_EQ(error.code, "V-FEAT-002");
  EXPECT_THAT(error.message, HasSubstr("[DeviceDescriptor \"greedy\"]"));
}

} // namespace
} // namespace mote::gpu
