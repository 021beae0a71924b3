// SPDX-License-Identifier: MIT
// For tests of pure rules: a made-up device, and the expectation that a rule breaks with a code and words.
#pragma once

#include "core/gpu/error.hpp"
#include "core/gpu/shader_compiler.hpp"
#include "core/gpu/validation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace mote::gpu {

// Plain numbers that differ from each other, so that a message naming the wrong limit is noticed.
inline DeviceFacts made_up_device() {
  DeviceFacts device;
  device.label = "made up";
  Limits& l = device.limits;
  l.max_texture_dimension_1d = 4096;
  l.max_texture_dimension_2d = 8192;
  l.max_texture_dimension_3d = 512;
  l.max_texture_array_layers = 128;
  l.max_bind_groups = 4;
  l.max_uniform_buffer_binding_size = 65536;
  l.max_storage_buffer_binding_size = 1u << 20;
  l.max_buffer_size = 1u << 30;
  l.min_uniform_buffer_offset_alignment = 64;
  l.min_storage_buffer_offset_alignment = 16;
  l.max_push_constant_size = 128;
  l.max_color_attachments = 4;
  l.max_compute_workgroup_size_x = 256;
  l.max_compute_workgroup_size_y = 128;
  l.max_compute_workgroup_size_z = 64;
  l.max_compute_invocations_per_workgroup = 512;
  l.max_geometry_output_vertices = 32;
  l.max_geometry_total_output_components = 512;
  for (std::size_t i = 1; i < format_count; ++i) {
    const FormatKind kind = format_info(static_cast<TextureFormat>(i)).kind;
    const bool number = kind == FormatKind::Float || kind == FormatKind::Unorm;
    device.formats[i] = {true, number, kind != FormatKind::Depth, true, number, number};
  }
  device.formats[static_cast<std::size_t>(TextureFormat::R32Float)].filterable = false;
  device.formats[static_cast<std::size_t>(TextureFormat::RGBA8UnormSrgb)].storage = false;
  return device;
}

template <class Body> void expect_kept(Body&& rule) {
  try {
    rule();
  } catch (const Fault& fault) {
    ADD_FAILURE() << to_string(fault.error());
  }
}

template <class Body> void expect_broken(std::string_view code, std::string_view words, Body&& rule) {
  try {
    rule();
    ADD_FAILURE() << code << " was expected, but nothing was thrown";
  } catch (const Fault& fault) {
    EXPECT_EQ(fault.error().code, code) << fault.error().message;
    EXPECT_THAT(fault.error().message, testing::HasSubstr(std::string(words)));
  }
}

inline std::vector<std::uint32_t> spirv_of(ShaderStage stage, const std::string& glsl) {
  const CompiledShader compiled = compile_glsl(stage, {"test", glsl});
  for (const ShaderMessage& message : compiled.messages) ADD_FAILURE() << to_string(message);
  return compiled.spirv;
}

} // namespace mote::gpu
