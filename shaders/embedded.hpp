// SPDX-License-Identifier: MIT
// The shipped shaders, embedded: SPIR-V by variant key, GLSL text by path below shaders/.
// Keys: "<type>/vertex.vert", "<type>/geometry.vert", "<type>/geometry.geom",
// "<type>/opaque.frag/aov<mask>", the same with "<type>/near" for particles placed on the CPU,
// "<type>/tiles/<kernel>/<lanes>/int<32|64>", "tiles/<kernel>/int<32|64>", and "post/fullscreen.vert" (shaders/CMakeLists.txt makes them).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace mote::shaders {

std::span<const std::uint32_t> spirv(std::string_view key); // empty: no such variant
std::string_view text(std::string_view path);               // empty: no such file
std::vector<std::string_view> spirv_keys();
std::vector<std::string_view> text_paths();

} // namespace mote::shaders
