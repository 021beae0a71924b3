// SPDX-License-Identifier: MIT
#include "app/library/user_types.hpp"

#include "passes/particles/user_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace mote::app {

void take_types(SceneDesc& desc, const DeviceOptions& device, Diagnostics& left_out) {
  if (desc.types.empty()) return;
  std::set<const UserType*> broken;
  const auto opened = std::make_shared<std::unique_ptr<DrawingDevice>>();
  DeviceOptions plain = device;
  plain.surface_extensions = {};
  for (const std::shared_ptr<UserType>& type : desc.types) {
    if (!passes::take_type(*type, cache_directory(), left_out)) {
      broken.insert(type.get());
      continue;
    }
    type->measure = [opened, plain, self = type.get()](std::span<const glm::vec4> records) {
      if (!*opened) *opened = std::make_unique<DrawingDevice>(plain);
      auto measured = passes::measure((*opened)->device(), *self, records);
      (*opened)->check();
      return measured;
    };
  }
  std::erase_if(desc.data, [&](const DataDesc& data) { return broken.contains(data.user.get()); });
}

Diagnostics as_warnings(const Diagnostics& left_out) {
  Diagnostics out;
  for (Diagnostic d : left_out.list()) {
    d.severity = Severity::Warning;
    d.text += "; what is of it is left out";
    out.add(std::move(d));
  }
  return out;
}

} // namespace mote::app
