// SPDX-License-Identifier: MIT
#include "app/library/device.hpp"

#include "app/codes.hpp"

#include <cstdlib>

namespace mote::app {

std::string cache_directory() {
  // The XDG Base Directory Specification takes absolute paths only.
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && cache[0] == '/') return std::string(cache) + "/mote";
  if (const char* home = std::getenv("HOME"); home && home[0] == '/') return std::string(home) + "/.cache/mote";
  return {};
}

DrawingDevice::DrawingDevice(const DeviceOptions& options) : errors_(std::make_shared<std::vector<gpu::Error>>()), validated_(options.validation) {
  gpu::Error error;
  auto give_up = [&] { fail(Exit::NoDevice, error.code, {}, error.message, error.context); };
  instance_ = gpu::Instance::create({.validation = options.validation, .surface = !options.surface_extensions.empty(), .surface_extensions = options.surface_extensions}, error);
  if (!instance_) give_up();
  adapter_ = instance_.request_adapter({.name = options.name}, error);
  if (!adapter_) give_up();
  const gpu::Feature wanted = gpu::Feature::GeometryShader | gpu::Feature::TimestampQuery | gpu::Feature::Subgroups | gpu::Feature::ShaderInt64 |
                              gpu::Feature::Int64Atomics | gpu::Feature::HostMemory |
                              gpu::Feature::PipelineStatistics | gpu::Feature::ShaderFloat64; // the last for charts only
  const std::string cache = cache_directory();
  device_ = adapter_.request_device({.label = "mote", .required_features = wanted & adapter_.features(), .cache_directory = cache, .memory_budget = options.memory}, error);
  if (!device_) give_up();
  device_.on_uncaptured_error([errors = errors_](const gpu::Error& e) { errors->push_back(e); });
}

DrawingDevice::~DrawingDevice() {
  if (device_) device_.save_pipeline_cache();
}

void DrawingDevice::check() {
  if (!errors_->empty()) {
    const gpu::Error first = errors_->front();
    errors_->clear();
    std::vector<std::string> hints{"device: " + info().name};
    hints.insert(hints.end(), first.context.begin(), first.context.end());
    fail(Exit::Failed, code::device_failed, {}, first.code + ": " + first.message, hints);
  }
  const std::vector<std::string> messages = instance_.validation_messages();
  if (!messages.empty()) fail(Exit::Failed, code::validation, {}, "the validation layer reports: " + messages.front());
}

} // namespace mote::app
