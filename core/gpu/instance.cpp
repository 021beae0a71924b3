// SPDX-License-Identifier: MIT
// Instance and Adapter: creation, listing, choice.
#include "core/gpu/vk/handles.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace mote::gpu {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// Smaller is preferred.
int rank(DeviceType type) {
  switch (type) {
    case DeviceType::DiscreteGpu: return 0;
    case DeviceType::IntegratedGpu: return 1;
    case DeviceType::VirtualGpu: return 2;
    case DeviceType::Other: return 3;
    case DeviceType::Cpu: return 4;
  }
  return 5;
}

using AdapterList = std::vector<std::shared_ptr<vk::AdapterCore>>;

std::string names_of(const AdapterList& adapters) {
  std::string text;
  for (const auto& adapter : adapters) {
    text += fmt::format("{}\"{}\"{}", text.empty() ? "" : ", ", adapter->info.name,
                        adapter->unsuitable.empty() ? "" : fmt::format(" (which {})", adapter->unsuitable));
  }
  return text;
}

} // namespace

Instance Instance::create(const InstanceDescriptor& descriptor, Error& error) {
  auto core = vk::create_instance(descriptor, error);
  if (!core) return {};
  auto impl = std::make_shared<Impl>();
  impl->label = descriptor.application;
  impl->core = std::move(core);
  return Instance(std::move(impl));
}

std::vector<Adapter> Instance::adapters() const {
  std::vector<Adapter> result;
  if (!impl_) return result;
  if (!impl_->adapters) impl_->adapters = vk::enumerate_adapters(impl_->core);
  for (const auto& core : *impl_->adapters) {
    if (!core->unsuitable.empty()) continue;
    auto adapter = std::make_shared<Adapter::Impl>();
    adapter->label = core->info.name;
    adapter->core = core;
    result.emplace_back(std::move(adapter));
  }
  return result;
}

Adapter Instance::request_adapter(const AdapterOptions& options, Error& error) const {
  if (!impl_) {
    if (error.code.empty()) error = {ErrorFilter::Validation, "V-OBJ-001", "[Instance] was never made: it is an empty handle.", {}};
    return {}; // else `error` says already why
  }
  std::vector<Adapter> found = adapters();
  std::string wanted(options.name);
  if (const char* variable = std::getenv("MOTE_ADAPTER"); wanted.empty() && variable != nullptr) wanted = variable;
  if (!wanted.empty()) {
    const std::string part = lower(wanted);
    std::erase_if(found, [&](const Adapter& a) { return lower(a.info().name).find(part) == std::string::npos; });
  }
  if (found.empty()) {
    const std::string all = names_of(*impl_->adapters);
    if (impl_->adapters->empty()) {
      error = {ErrorFilter::Internal, "V-INST-001",
               "No Vulkan device is found. Debian's package mesa-vulkan-drivers has a driver that runs on any CPU.", {}};
    } else if (wanted.empty()) {
      error = {ErrorFilter::Internal, "V-ADPT-001", fmt::format("No Vulkan device is suitable; there are: {}.", all), {}};
    } else {
      error = {ErrorFilter::Validation, "V-ADPT-002",
               fmt::format("No suitable Vulkan device has \"{}\" in its name; there are: {}.", wanted, all), {}};
    }
    return {};
  }
  return *std::min_element(found.begin(), found.end(),
                           [](const Adapter& a, const Adapter& b) { return rank(a.info().type) < rank(b.info().type); });
}

std::vector<std::string> Instance::validation_messages() const {
  if (!impl_) return {};
  const std::lock_guard lock(impl_->core->mutex);
  return impl_->core->messages;
}

const AdapterInfo& Adapter::info() const {
  static const AdapterInfo none{};
  return impl_ ? impl_->core->info : none;
}
const Limits& Adapter::limits() const {
  static const Limits none{};
  return impl_ ? impl_->core->facts.limits : none;
}
Feature Adapter::features() const { return impl_ ? impl_->core->facts.features : Feature::None; }

} // namespace mote::gpu
