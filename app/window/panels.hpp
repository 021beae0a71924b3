// SPDX-License-Identifier: MIT
// What draws controls over the window's picture and may take events for itself. A build with Dear ImGui has one (gui/), a
// build with -DGUI=OFF has none; Session works with both.
#pragma once

#include "app/window/events.hpp"
#include "core/gpu/gpu.hpp"

#include <memory>

namespace mote::window {

class Session;

class Panels {
public:
  virtual ~Panels() = default;
  // True: the event was for a panel, and nobody else gets it.
  virtual bool handle(const Event& event) = 0;
  // Lays the controls out and lets them change the session. True: once more, something is still moving.
  virtual bool build(Session& session, Size2d size, double scale, double now) = 0;
  // Draws what build() laid out; inside a render pass on a target of `format`.
  virtual void draw(gpu::RenderPass& pass, gpu::TextureFormat format) = 0;
  // Before the render pass: what has to be on the device.
  virtual void upload() = 0;
};
// Null in a build without panels.
std::unique_ptr<Panels> make_panels(gpu::Device device);

} // namespace mote::window
