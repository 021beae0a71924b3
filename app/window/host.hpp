// SPDX-License-Identifier: MIT
// The window itself: GLFW (3.3 and 3.4, X11 and Wayland) and a swapchain around a Session. Waits for events, gives them to the
// session, shows its pictures; draws nothing when nothing changed. Plays a script. The only part that knows GLFW.
#pragma once

#include "app/window/script.hpp"
#include "app/window/session.hpp"

#include <memory>
#include <string>
#include <vector>

namespace mote::window {

struct HostOptions {
  Size2d size{1280, 720};
  std::vector<Step> script{};
  std::string instead{}; // a command line that needs no window, for messages
};

// How long inputs waited for their pictures, and what the rest took.
struct HostReport {
  std::uint64_t frames{};
  std::vector<double> input_ms{};  // one for each frame that answers inputs: from the first of them to its picture
  // Of each frame, what a wait is made of: the scene's picture, everything put together (panels among it), the swapchain's part.
  std::vector<double> picture_ms{}, compose_ms{}, panels_ms{}, present_ms{};
};

// Connects to the display. Throws Failure A010 (no display; says `mote render`), A050 (the display cannot show Vulkan pictures).
class Host {
public:
  explicit Host(const HostOptions& options);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  // What the device's instance needs.
  [[nodiscard]] std::vector<const char*> surface_extensions() const;
  // Opens the window on the device. Throws A050 where the device cannot show pictures there.
  void open(app::DrawingDevice& device, const std::string& title);
  // Until the user or the script ends it.
  HostReport run(Session& session);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace mote::window
