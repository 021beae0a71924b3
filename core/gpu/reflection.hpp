// SPDX-License-Identifier: MIT
// What a SPIR-V module says about itself: entry points, bindings, locations, push constants,
// specialization constants, execution modes, the optional features it needs. Read once when a shader module
// is made (SPIRV-Cross does the reading); pipelines are checked against it. Pure, no device.
//
// Faults: V-SHDR-001 (not SPIR-V), V-SHDR-002 (no entry point of a stage we know), V-SHDR-003 (a
// binding of a kind the layer does not have: combined image samplers, texel buffers, arrays ...).
#pragma once

#include "core/gpu/format.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace mote::gpu {

struct ReflectedBinding {
  std::uint32_t group{}, binding{};
  std::string name{};
  BindingType type{};
  std::uint64_t min_size{};       // buffers: declared size with an unsized array counted as one element
  SampleType sample_type{};       // SampledTexture
  TextureViewDimension dimension{};
  bool multisampled{};
  TextureFormat storage_format{}; // StorageTexture; Undefined: unknown or declared without
};

struct ReflectedVariable { // input or output of a stage
  std::uint32_t location{};
  std::uint32_t components{}; // of one location, 1..4
  FormatKind kind{};          // Float, Uint or Sint
  std::string name{};
  bool flat{};                // not interpolated
};

struct ReflectedGeometry {
  Topology input{};                // PointList, LineList or TriangleList
  Topology output{};               // PointList, LineList (strip) or TriangleStrip
  std::uint32_t max_vertices{};
  std::uint32_t invocations{1};
};

struct ReflectedEntryPoint {
  std::string name{};
  ShaderStage stage{};
  std::vector<ReflectedBinding> bindings{};  // sorted by group, binding; only those the entry point uses
  std::vector<ReflectedVariable> inputs{}, outputs{}; // sorted by location
  std::uint32_t push_constant_size{};        // bytes; 0: none
  std::array<std::uint32_t, 3> local_size{}; // compute
  ReflectedGeometry geometry{};
  bool writes_depth{};
};

struct ReflectedConstant {
  std::uint32_t id{}; // constant_id
  std::string name{};
  std::uint32_t bits{}; // default
};

struct Reflection {
  std::vector<ReflectedEntryPoint> entry_points{};
  std::vector<ReflectedConstant> constants{}; // sorted by id
  Feature features{};                         // that its capabilities ask for
};

Reflection reflect(std::span<const std::uint32_t> spirv);
const ReflectedEntryPoint* find_entry_point(const Reflection& reflection, std::string_view name, ShaderStage stage);

} // namespace mote::gpu
