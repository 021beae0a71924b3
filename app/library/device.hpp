// SPDX-License-Identifier: MIT
// The Vulkan device as the library uses it: found, opened with every feature that passes can use, its
// errors collected instead of printed. One per process is enough; nothing here draws.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/gpu/gpu.hpp"

#include <memory>
#include <string>
#include <vector>

namespace mote::app {

struct DeviceOptions {
  std::string name{}; // part of the device's name; empty: $MOTE_ADAPTER, else the fastest kind there is
  std::uint64_t memory{}; // bytes that buffers and textures may have; 0: what there is
  bool validation{};  // Khronos validation layer; its messages are collected
  std::vector<const char*> surface_extensions{}; // of the window system, for a device that shows pictures in a window
};

class DrawingDevice {
public:
  // Throws Failure (NoDevice) with the layer's own code.
  explicit DrawingDevice(const DeviceOptions& options);
  ~DrawingDevice(); // keeps the pipeline cache for the next run
  DrawingDevice(const DrawingDevice&) = delete;
  DrawingDevice& operator=(const DrawingDevice&) = delete;

  [[nodiscard]] gpu::Device& device() { return device_; }
  [[nodiscard]] const gpu::Instance& instance() const { return instance_; }
  [[nodiscard]] const gpu::AdapterInfo& info() const { return adapter_.info(); }
  [[nodiscard]] bool validated() const { return validated_; } // then pictures show in magenta what shaders find wrong
  // Throws Failure (Failed) A007 if the device has reported an error since the last call, A014 if the validation
  // layer has said something.
  void check();

private:
  gpu::Instance instance_;
  gpu::Adapter adapter_;
  gpu::Device device_;
  std::shared_ptr<std::vector<gpu::Error>> errors_;
  bool validated_{};
};

// $XDG_CACHE_HOME/mote, else $HOME/.cache/mote, else empty: no cache. Nothing is made here.
std::string cache_directory();

} // namespace mote::app
