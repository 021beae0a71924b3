// SPDX-License-Identifier: MIT
// One instance and adapter per process, a fresh device per test. A test fails on any error nobody
// expected and on any message of the validation layer.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace mote::gpu {

template <class T> std::vector<T> values_of(const std::vector<std::byte>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}
template <class T> std::span<const std::byte> bytes_of(const std::vector<T>& values) { return std::as_bytes(std::span(values)); }
template <class T> std::span<const std::byte> bytes_of_value(const T& value) { return std::as_bytes(std::span(&value, 1)); }

class DeviceTest : public testing::Test {
protected:
  void SetUp() override;
  void TearDown() override;
  Device make_device(const DeviceDescriptor& descriptor); // with the test's error handler
  static const Instance& instance();
  static const Adapter& adapter();
  static Feature all_features() { return adapter().features(); }

  ShaderModule shader(ShaderStage stage, const std::string& glsl, std::string_view label = "shader");
  // One expected error: what `body` reports, or a failed expectation.
  template <class Body> Error expect_error(ErrorFilter filter, Body&& body) {
    device.push_error_scope(filter);
    body();
    auto error = device.pop_error_scope();
    EXPECT_TRUE(error.has_value()) << "no error was reported";
    return error.value_or(Error{});
  }
  Texture target(TextureFormat format, std::uint32_t width, std::uint32_t height, std::string_view label = "target");
  void submit_and_wait(CommandEncoder& encoder);
  std::string output(const std::string& name); // a fresh path for files

  Device device;

private:
  std::vector<Error> uncaptured_;
  std::size_t messages_before_{};
};

inline const std::string fullscreen_vertex = R"(#version 450
void main() {
  vec2 p = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, 0.5, 1.0);
}
)";

} // namespace mote::gpu
