// SPDX-License-Identifier: MIT
// Uploads, copies and reads of buffers and of 1D, 2D, 3D, layered and mipmapped textures.
#include "tests/gpu/fixture.hpp"

#include <numeric>

namespace mote::gpu {
namespace {

std::vector<std::uint32_t> counting(std::size_t count, std::uint32_t first = 0) {
  std::vector<std::uint32_t> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

class CopyTest : public DeviceTest {
protected:
  Buffer buffer(std::uint64_t size, BufferUsage usage = BufferUsage::CopySrc | BufferUsage::CopyDst, std::span<const std::byte> contents = {}) {
    return device.create_buffer({.label = "buffer", .size = size, .usage = usage, .contents = contents});
  }
  Texture texture(Extent3d size, TextureDimension dimension = TextureDimension::D2, std::uint32_t mips = 1) {
    return device.create_texture({.label = "texture",
                                  .size = size,
                                  .format = TextureFormat::R32Uint,
                                  .usage = TextureUsage::CopySrc | TextureUsage::CopyDst,
                                  .dimension = dimension,
                                  .mip_level_count = mips});
  }
};

TEST_F(CopyTest, buffer_contents_and_partial_reads) {
  const auto values = counting(100);
  const Buffer b = buffer(400, BufferUsage::CopySrc, bytes_of(values));
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(b)), values);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(b, 40, 8)), counting(2, 10));
}

TEST_F(CopyTest, buffer_to_buffer_and_clear) {
  const auto values = counting(16, 1);
  const Buffer a = buffer(64, BufferUsage::CopySrc, bytes_of(values)), b = buffer(64);
  CommandEncoder encoder = device.create_command_encoder();
  encoder.clear_buffer(b, 0, 0, 7);
  encoder.copy_buffer_to_buffer(a, 0, b, 32, 16);
  submit_and_wait(encoder);
  std::vector<std::uint32_t> expected(16, 7);
  std::copy_n(values.begin(), 4, expected.begin() + 8);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(b)), expected);
}

TEST_F(CopyTest, odd_sizes) {
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5};
  const Buffer a = buffer(5, BufferUsage::CopySrc | BufferUsage::CopyDst, bytes_of(bytes));
  EXPECT_EQ(values_of<std::uint8_t>(device.read_buffer(a)), bytes);
  CommandEncoder encoder = device.create_command_encoder();
  encoder.clear_buffer(a, 4);
  submit_and_wait(encoder);
  EXPECT_EQ(values_of<std::uint8_t>(device.read_buffer(a)), (std::vector<std::uint8_t>{1, 2, 3, 4, 0}));
}

TEST_F(CopyTest, writes_are_ordered_with_submissions) {
  // Each write must reach the copy that follows it, also while the device still works on the copy before.
  const Buffer a = buffer(4), b = buffer(400);
  for (std::uint32_t i = 0; i < 100; ++i) {
    device.queue().write_buffer(a, 0, bytes_of_value(i));
    CommandEncoder encoder = device.create_command_encoder();
    encoder.copy_buffer_to_buffer(a, 0, b, i * 4, 4);
    device.queue().submit(encoder.finish());
  }
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(b)), counting(100));
}

TEST_F(CopyTest, later_write_to_the_same_place_wins) {
  constexpr std::uint64_t large = 1u << 25; // copied often enough for the device to be at work below
  const Buffer a = buffer(large), b = buffer(large);
  const std::uint32_t first = 1, second = 2;
  CommandEncoder encoder = device.create_command_encoder();
  for (int i = 0; i < 8; ++i) encoder.copy_buffer_to_buffer(a, 0, b, 0, large);
  device.queue().submit(encoder.finish()); // a is busy: the next write is staged
  device.queue().write_buffer(a, 0, bytes_of_value(first));
  device.queue().wait_idle(); // no longer busy, but the first write has not been submitted
  device.queue().write_buffer(a, 0, bytes_of_value(second));
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(a, 0, 4)), counting(1, 2));
}

TEST_F(CopyTest, large_writes) {
  const auto values = counting(1'000'000);
  const Buffer a = buffer(values.size() * 4);
  device.queue().write_buffer(a, 0, bytes_of(values));
  device.queue().write_buffer(a, 4, bytes_of(values).first(4'000)); // staged or not: after the first
  const auto back = values_of<std::uint32_t>(device.read_buffer(a));
  EXPECT_EQ(back[1], 0u);
  EXPECT_EQ(back[1000], 999u);
  EXPECT_EQ(back[1001], 1001u);
  EXPECT_EQ(back.back(), 999'999u);
}

TEST_F(CopyTest, mapped_buffers) {
  const auto values = counting(8, 5);
  Buffer up = buffer(32, BufferUsage::MapWrite | BufferUsage::CopySrc), down = buffer(32, BufferUsage::MapRead | BufferUsage::CopyDst);
  std::memcpy(up.mapped().data(), values.data(), 32);
  CommandEncoder encoder = device.create_command_encoder();
  encoder.copy_buffer_to_buffer(up, 0, down, 0, 32);
  submit_and_wait(encoder);
  EXPECT_EQ(std::memcmp(down.mapped().data(), values.data(), 32), 0);
  EXPECT_TRUE(buffer(32).mapped().empty());
}

struct Shape {
  Extent3d size;
  TextureDimension dimension;
};

TEST_F(CopyTest, texture_shapes_round_trip) {
  for (const Shape& shape : {Shape{{37, 1, 1}, TextureDimension::D1}, Shape{{13, 7, 1}, TextureDimension::D2}, Shape{{5, 4, 6}, TextureDimension::D2},
                             Shape{{5, 3, 4}, TextureDimension::D3}}) {
    const Texture t = texture(shape.size, shape.dimension);
    const auto values = counting(std::size_t{shape.size.width} * shape.size.height * shape.size.depth_or_layers, 9);
    device.queue().write_texture({.texture = &t}, bytes_of(values), 0, 0, shape.size);
    EXPECT_EQ(values_of<std::uint32_t>(device.read_texture(t)), values) << to_string(shape.dimension);
  }
}

TEST_F(CopyTest, every_mip_level_on_its_own) {
  const Texture t = texture({8, 4, 2}, TextureDimension::D2, 3);
  for (const std::uint32_t level : {2u, 0u, 1u}) {
    const Extent3d size{8u >> level, 4u >> level, 2};
    const auto values = counting(std::size_t{size.width} * size.height * 2, 100 * level);
    device.queue().write_texture({.texture = &t, .mip_level = level}, bytes_of(values), 0, 0, size);
  }
  for (std::uint32_t level = 0; level < 3; ++level) {
    EXPECT_EQ(values_of<std::uint32_t>(device.read_texture(t, level)), counting(64u >> (2 * level), 100 * level)) << level;
  }
}

TEST_F(CopyTest, regions_with_pitches_and_layers) {
  const Texture t = texture({8, 8, 3});
  const std::vector<std::uint32_t> zero(8 * 8 * 3, 0);
  device.queue().write_texture({.texture = &t}, bytes_of(zero), 0, 0, {8, 8, 3});
  // 2x2 texels for two layers, out of rows of 3 texels and images of 4 rows.
  const auto values = counting(3 * 4 * 2, 1);
  device.queue().write_texture({.texture = &t, .origin = {5, 6, 1}}, bytes_of(values), 12, 4, {2, 2, 2});
  const auto back = values_of<std::uint32_t>(device.read_texture(t));
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t layer) { return back[(layer * 8 + y) * 8 + x]; };
  EXPECT_EQ(at(5, 6, 1), 1u);
  EXPECT_EQ(at(6, 7, 1), 5u);
  EXPECT_EQ(at(5, 6, 2), 13u);
  EXPECT_EQ(at(4, 6, 1), 0u);
  EXPECT_EQ(at(5, 6, 0), 0u);
}

TEST_F(CopyTest, texture_to_texture_between_layers_and_levels) {
  const Texture t = texture({4, 4, 2}, TextureDimension::D2, 2);
  const auto values = counting(32);
  device.queue().write_texture({.texture = &t}, bytes_of(values), 0, 0, {4, 4, 2});
  CommandEncoder encoder = device.create_command_encoder();
  encoder.copy_texture_to_texture({.texture = &t, .origin = {0, 0, 1}}, {.texture = &t}, {4, 2, 1});
  encoder.copy_texture_to_texture({.texture = &t, .origin = {2, 2, 0}}, {.texture = &t, .mip_level = 1}, {2, 2, 1});
  submit_and_wait(encoder);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_texture(t))[0], 16u);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_texture(t, 1))[0], 10u);
}

TEST_F(CopyTest, volume_to_layers) {
  const Texture volume = texture({3, 3, 4}, TextureDimension::D3), layers = texture({3, 3, 4});
  const auto values = counting(36);
  device.queue().write_texture({.texture = &volume}, bytes_of(values), 0, 0, {3, 3, 4});
  const Buffer b = buffer(36 * 4);
  CommandEncoder encoder = device.create_command_encoder();
  encoder.copy_texture_to_buffer({.texture = &volume}, {.buffer = &b}, {3, 3, 4});
  encoder.copy_buffer_to_texture({.buffer = &b}, {.texture = &layers}, {3, 3, 4});
  submit_and_wait(encoder);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_texture(layers)), values);
}

} // namespace
} // namespace mote::gpu
