// SPDX-License-Identifier: MIT
#include "render_graph/slots.hpp"

namespace mote::rg {

std::string_view to_string(Access access) {
  switch (access) {
  case Access::Sampled: return "sampled";
  case Access::ColorWrite: return "color write";
  case Access::ColorReadWrite: return "color read-write";
  case Access::DepthWrite: return "depth write";
  case Access::DepthReadWrite: return "depth read-write";
  case Access::DepthRead: return "depth read";
  case Access::StorageRead: return "storage read";
  case Access::StorageWrite: return "storage write";
  case Access::StorageReadWrite: return "storage read-write";
  case Access::Indirect: return "indirect";
  }
  return "?";
}

bool reads(Access access) {
  return access != Access::ColorWrite && access != Access::DepthWrite && access != Access::StorageWrite;
}
bool writes(Access access) {
  switch (access) {
  case Access::ColorWrite: case Access::ColorReadWrite: case Access::DepthWrite: case Access::DepthReadWrite:
  case Access::StorageWrite: case Access::StorageReadWrite: return true;
  case Access::Sampled: case Access::DepthRead: case Access::StorageRead: case Access::Indirect: return false;
  }
  return false;
}
bool is_attachment(Access access) { return is_color(access) || is_depth(access); }
bool is_color(Access access) { return access == Access::ColorWrite || access == Access::ColorReadWrite; }
bool is_depth(Access access) {
  return access == Access::DepthWrite || access == Access::DepthReadWrite || access == Access::DepthRead;
}

} // namespace mote::rg
