// SPDX-License-Identifier: MIT
// Rules for layouts and bind groups. The resources are invented: only whether a pointer is set counts.
#include "tests/gpu/rules.hpp"

#include "core/gpu/gpu.hpp"

#include <array>

namespace mote::gpu {
namespace {

const DeviceFacts device = made_up_device();

TEST(LayoutRules, entries) {
  std::array<BindGroupLayoutEntry, 2> e{{{.binding = 0, .visibility = ShaderStage::Vertex, .type = BindingType::UniformBuffer},
                                         {.binding = 1, .visibility = ShaderStage::Fragment, .type = BindingType::SampledTexture}}};
  const auto check = [&] { check_bind_group_layout(device, {.label = "frame", .entries = e}); };
  expect_kept(check);
  e[1].binding = 0;
  expect_broken("V-BGL-001", "entries[0] and entries[1] of [BindGroupLayoutDescriptor \"frame\"] both have binding 0", check);
  e[1].binding = 1;
  e[1].type = BindingType::Undefined;
  expect_broken("V-BGL-002", "binding 1", check);
  e[1].type = BindingType::Sampler;
  e[1].visibility = ShaderStage::None;
  expect_broken("V-BGL-003", "binding 1", check);
  e[1].visibility = ShaderStage::Geometry;
  expect_broken("V-FEAT-001", "visible to the geometry stage but Feature GeometryShader", check);
  e[1] = {.binding = 1, .visibility = ShaderStage::Compute, .type = BindingType::StorageTexture, .storage_format = TextureFormat::RGBA8UnormSrgb};
  expect_broken("V-BGL-004", "rgba8unorm_srgb", check);
  e[1].storage_format = TextureFormat::R32Uint;
  e[1].view_dimension = TextureViewDimension::Undefined;
  expect_broken("V-BGL-005", "binding 1", check);
}

TEST(LayoutRules, pipeline_layout) {
  expect_kept([] { check_pipeline_layout(device, 4, 128); });
  expect_broken("V-PLAY-001", "5 bind groups; [Device \"made up\"] allows 4", [] { check_pipeline_layout(device, 5, 0); });
  expect_broken("V-PLAY-002", "is 132", [] { check_pipeline_layout(device, 1, 132); });
  expect_broken("V-PLAY-002", "is 6", [] { check_pipeline_layout(device, 1, 6); });
}

TEST(LayoutRules, equality) {
  const BindGroupLayoutEntry a[] = {{.binding = 0, .visibility = ShaderStage::Vertex, .type = BindingType::UniformBuffer}};
  BindGroupLayoutEntry b[] = {a[0]};
  EXPECT_TRUE(same_layout(a, b));
  b[0].visibility = ShaderStage::Fragment;
  EXPECT_FALSE(same_layout(a, b));
}

TEST(GroupRules, entries) {
  const BindGroupLayoutEntry layout[] = {{.binding = 0, .type = BindingType::UniformBuffer}, {.binding = 2, .type = BindingType::SampledTexture}};
  const Buffer buffer;
  const TextureView view;
  const Sampler sampler;
  std::vector<BindGroupEntry> e{{.binding = 2, .texture = &view}, {.binding = 0, .buffer = {.buffer = &buffer}}};
  const auto check = [&] { check_bind_group_entries("frame", layout, e); };
  expect_kept(check);
  e.pop_back();
  expect_broken("V-BIND-001", "has 1 entries; [BindGroupLayout \"frame\"] has 2 bindings", check);
  e.push_back({.binding = 1, .buffer = {.buffer = &buffer}});
  expect_broken("V-BIND-002", "entries[1] has binding 1", check);
  e[1] = e[0];
  expect_broken("V-BIND-003", "both have binding 2", check);
  e[1] = {.binding = 0};
  expect_broken("V-BIND-004", "sets 0 resources", check);
  e[1] = {.binding = 0, .texture = &view, .sampler = &sampler};
  expect_broken("V-BIND-004", "sets 2 resources", check);
  e[1] = {.binding = 0, .sampler = &sampler};
  expect_broken("V-BIND-005", "is a sampler; [BindGroupLayout \"frame\"] expects a buffer (UniformBuffer)", check);
}

TEST(GroupRules, buffers) {
  const BindGroupLayoutEntry entry{.binding = 0, .type = BindingType::StorageBuffer, .min_binding_size = 32};
  BufferFacts buffer{"particles", 4u << 20, BufferUsage::Storage};
  EXPECT_EQ(check_buffer_binding(device, entry, buffer, (4u << 20) - 64, 0), 64u);
  expect_broken("V-BIND-006", "offset 8, which is no multiple of 16", [&] { check_buffer_binding(device, entry, buffer, 8, 32); });
  expect_broken("V-BIND-007", "4194304 bytes of [Buffer \"particles\"] are bound as StorageBuffer; [Device \"made up\"] allows 1048576",
                [&] { check_buffer_binding(device, entry, buffer, 0, 0); });
  expect_broken("V-BIND-008", "16 bytes of [Buffer \"particles\"] are bound; the layout's min_binding_size is 32",
                [&] { check_buffer_binding(device, entry, buffer, 0, 16); });
  expect_broken("V-BUF-007", "which has 4194304 bytes", [&] { check_buffer_binding(device, entry, buffer, 4u << 20, 64); });
  buffer.usage = BufferUsage::Uniform;
  expect_broken("V-BUF-008", "[Buffer \"particles\"] needs usage Storage; it has Uniform", [&] { check_buffer_binding(device, entry, buffer, 0, 64); });
}

TEST(GroupRules, textures) {
  BindGroupLayoutEntry entry{.binding = 0, .type = BindingType::SampledTexture};
  TextureFacts texture{"t", {8, 8, 1}, TextureFormat::RGBA8Unorm, TextureUsage::Sampled, TextureDimension::D2, 2, 1};
  ViewFacts view{"v", &texture, TextureViewDimension::D2, {0, 2, 0, 1}};
  const auto check = [&] { check_texture_binding(device, entry, view); };
  expect_kept(check);
  entry.view_dimension = TextureViewDimension::D3;
  expect_broken("V-BIND-009", "[TextureView \"v\"] has dimension 2d; the layout expects 3d", check);
  entry.view_dimension = TextureViewDimension::D2;
  texture.format = TextureFormat::R32Float;
  expect_broken("V-BIND-013", "r32float, which cannot be sampled as Float on [Device \"made up\"]", check);
  entry.sample_type = SampleType::UnfilterableFloat;
  expect_kept(check);
  entry.sample_type = SampleType::Uint;
  expect_broken("V-BIND-013", "cannot be sampled as Uint", check);
  texture.usage = TextureUsage::Storage;
  expect_broken("V-TEX-009", "[Texture \"t\"] needs usage Sampled; it has Storage", check);
  entry.type = BindingType::StorageTexture;
  entry.storage_format = TextureFormat::R32Uint;
  expect_broken("V-BIND-011", "has format r32float; the layout expects r32uint", check);
  texture.format = TextureFormat::R32Uint;
  expect_broken("V-BIND-012", "2 mip levels", check);
}

} // namespace
} // namespace mote::gpu
