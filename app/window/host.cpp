// SPDX-License-Identifier: MIT
#include "app/window/host.hpp"

#include "app/codes.hpp"
#include "app/window/glfw_input.hpp"
#include "app/window/watch.hpp"
#include "core/image/png.hpp"

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace mote::window {
namespace {

std::string& last_problem() {
  static std::string text;
  return text;
}

[[noreturn]] void no_vulkan(const std::string& why, const std::string& instead) {
  fail(Exit::Failed, app::code::cannot_present, {}, fmt::format("this display cannot show the pictures of a Vulkan device: {}", why),
       {"A picture without a window: " + instead, "Another device of this machine: --device NAME"});
}

class Seconds { // since its making
public:
  [[nodiscard]] double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_{Clock::now()};
};

} // namespace

struct Host::Impl {
  HostOptions options{};
  GLFWwindow* window{};
  std::unique_ptr<GlfwInput> input{};
  app::DrawingDevice* device{};
  gpu::Surface surface{};
  Size2d configured{};
  ScriptPlayer script{{}};
  FileWatch watch{[] { glfwPostEmptyEvent(); }};
  bool quit{};
  Seconds clock{};
  HostReport report{};
  std::optional<double> first_input{}; // that no picture has answered
  int windowed_x{}, windowed_y{}, windowed_width{}, windowed_height{};

  void make_window(const std::string& title);
  void configure();
  gpu::Texture acquire();
  void wait(const Session& session);
  void play(Session& session);
  void perform(const Step& step, Session& session);
  void grant(Session& session);
  void set_full_screen(bool on);
  void frame(Session& session);
  void window_shot(Session& session, const std::string& path);
};

Host::Host(const HostOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  impl_->script = ScriptPlayer(options.script);
  glfwSetErrorCallback([](int, const char* text) { last_problem() = text; });
  if (glfwInit() != GLFW_TRUE)
    fail(Exit::Failed, app::code::no_window, {}, fmt::format("there is no display for a window ({})", last_problem()), {"A picture without a window: " + options.instead});
}

Host::~Host() {
  impl_->surface = {};
  impl_->input.reset();
  if (impl_->window) glfwDestroyWindow(impl_->window);
  glfwTerminate();
}

std::vector<const char*> Host::surface_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwVulkanSupported() == GLFW_TRUE ? glfwGetRequiredInstanceExtensions(&count) : nullptr;
  if (!names) {
    const app::DrawingDevice without{{}}; // the message is another one where there is no device at all
    no_vulkan(last_problem().empty() ? "the window system has no such surfaces" : last_problem(), impl_->options.instead);
  }
  return {names, names + count};
}

void Host::Impl::make_window(const std::string& title) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "mote");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "mote");
  window = glfwCreateWindow(static_cast<int>(options.size.width), static_cast<int>(options.size.height), title.c_str(), nullptr, nullptr);
  if (!window) fail(Exit::Failed, app::code::no_window, {}, fmt::format("the window cannot be opened ({})", last_problem()), {"A picture without a window: " + options.instead});
  input = std::make_unique<GlfwInput>(window);
}

void Host::open(app::DrawingDevice& device, const std::string& title) {
  impl_->device = &device;
  impl_->make_window(title);
  gpu::Error error;
  impl_->surface = device.instance().create_surface(
      {.create = [this](void* instance, std::string& why) -> void* {
        VkSurfaceKHR made{};
        if (glfwCreateWindowSurface(static_cast<VkInstance>(instance), impl_->window, nullptr, &made) == VK_SUCCESS) return reinterpret_cast<void*>(made);
        why = last_problem();
        return nullptr;
      }},
      error);
  if (!impl_->surface) no_vulkan(error.message, impl_->options.instead);
  impl_->input->check_size();
  device.device().push_error_scope(gpu::ErrorFilter::Validation);
  impl_->configure();
  if (const auto problem = device.device().pop_error_scope()) no_vulkan(problem->message, impl_->options.instead);
  device.check();
}

void Host::Impl::configure() {
  configured = input->size();
  surface.configure(device->device(), {.width = configured.width, .height = configured.height});
}

// Nothing while the window has no area, or has another one by now.
gpu::Texture Host::Impl::acquire() {
  input->check_size();
  if (input->size().width == 0 || input->size().height == 0) return {};
  if (input->size() != configured) configure(); // not every driver says that it is out of date
  gpu::Texture target = surface.acquire();
  if (!target) {
    configure();
    target = surface.acquire();
  }
  device->check();
  return target;
}

void Host::Impl::frame(Session& session) {
  const double began = clock.now();
  session.render(began);
  if (!session.shows_new()) return first_input.reset(); // a piece of a picture: inputs before it have changed nothing
  const double drawn = clock.now();
  const gpu::Texture target = acquire();
  if (!target) return;
  const double acquired = clock.now();
  session.compose(target);
  const double composed = clock.now();
  if (!surface.present()) configured = {};
  device->check();
  ++report.frames;
  report.picture_ms.push_back((drawn - began) * 1000.0);
  report.compose_ms.push_back((composed - acquired) * 1000.0);
  report.present_ms.push_back((clock.now() - composed + acquired - drawn) * 1000.0);
  session.presented(report.present_ms.back());
  if (session.panels_shown()) report.panels_ms.push_back(session.panels_ms());
  if (first_input) report.input_ms.push_back((clock.now() - *first_input) * 1000.0);
  first_input.reset();
}

void Host::Impl::wait(const Session& session) {
  if (session.wants_frame(clock.now())) return glfwPollEvents();
  std::optional<double> seconds;
  if (const auto due = session.due()) seconds = std::max(0.0, *due - clock.now());
  if (const auto due = script.due({clock.now(), session.refined()})) seconds = std::min(seconds.value_or(*due), *due);
  if (!seconds) return glfwWaitEvents();
  if (*seconds <= 0.0) return glfwPollEvents();
  glfwWaitEventsTimeout(*seconds);
}

void Host::Impl::set_full_screen(bool on) {
  const bool is = glfwGetWindowMonitor(window) != nullptr;
  if (is == on) return;
  if (!on) return glfwSetWindowMonitor(window, nullptr, windowed_x, windowed_y, windowed_width, windowed_height, GLFW_DONT_CARE);
  glfwGetWindowPos(window, &windowed_x, &windowed_y);
  glfwGetWindowSize(window, &windowed_width, &windowed_height);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (mode) glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Host::Impl::grant(Session& session) {
  const Wishes wishes = session.take_wishes();
  if (wishes.watch) watch.set(*wishes.watch);
  quit |= wishes.quit;
  if (wishes.title) glfwSetWindowTitle(window, wishes.title->c_str());
  if (wishes.clipboard) glfwSetClipboardString(window, wishes.clipboard->c_str());
  if (wishes.toggle_full_screen) set_full_screen(glfwGetWindowMonitor(window) == nullptr);
  if (wishes.leave_full_screen) set_full_screen(false);
}

// What the window shows, panels and all: the next frame goes into a texture of ours.
void Host::Impl::window_shot(Session& session, const std::string& path) {
  const Size2d size = session.size();
  if (!session.visible()) return session.message("a window without an area has no screenshot");
  const gpu::Texture target = device->device().create_texture({.label = "screenshot", .size = {size.width, size.height, 1}, .format = gpu::TextureFormat::RGBA8Unorm,
                                                               .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
  do session.render(clock.now()); // all pieces of it
  while (!session.shows_new() && session.wants_frame(clock.now()));
  session.compose(target);
  const std::vector<std::byte> bytes = device->device().read_texture(target);
  device->check();
  try {
    write_png(path, size.width, size.height, std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  } catch (const Failure& failure) {
    session.message(to_string(failure.diagnostic()));
  }
}

void Host::Impl::perform(const Step& step, Session& session) {
  switch (step.kind) {
  case Step::Kind::Event: return session.handle(step.event, clock.now());
  case Step::Kind::Size: return glfwSetWindowSize(window, static_cast<int>(step.size.width), static_cast<int>(step.size.height));
  case Step::Kind::Minimize: input->simulate_minimized(true); return glfwIconifyWindow(window);
  case Step::Kind::Restore: input->simulate_minimized(false); return glfwRestoreWindow(window);
  case Step::Kind::Screenshot: return session.screenshot(step.text);
  case Step::Kind::WindowShot: return window_shot(session, step.text);
  case Step::Kind::Print: fmt::print("{}\n", step.text); std::fflush(stdout); return;
  case Step::Kind::Set: {
    const std::size_t equals = step.text.find('=');
    if (equals == std::string::npos) return session.message("'" + step.text + "' is not PATH=VALUE");
    session.set(step.text.substr(0, equals), step.text.substr(equals + 1));
    return;
  }
  case Step::Kind::Save: session.save(step.text); return;
  case Step::Kind::Quit: quit = true; return;
  default: return;
  }
}

// One step, or all steps of a drag that are due.
void Host::Impl::play(Session& session) {
  while (const auto step = script.next({clock.now(), session.refined() && !session.wants_frame(clock.now())})) {
    if (step->kind == Step::Kind::Event && !first_input) first_input = script.scheduled();
    perform(*step, session);
    if (!step->after) return;
  }
}

HostReport Host::run(Session& session) {
  Impl& i = *impl_;
  while (!i.quit) {
    i.wait(session);
    if (Event changed{.kind = Event::Kind::Files}; !(changed.files = i.watch.take()).empty()) session.handle(changed, i.clock.now());
    for (const Event& event : i.input->take()) {
      const bool input = event.kind != Event::Kind::Redraw && event.kind != Event::Kind::Resize;
      if (input && !i.first_input) i.first_input = i.clock.now();
      session.handle(event, i.clock.now());
    }
    i.play(session);
    i.grant(session);
    if (i.quit) break;
    if (session.wants_frame(i.clock.now())) i.frame(session);
    else i.first_input.reset(); // it changed nothing
  }
  return i.report;
}

} // namespace mote::window
