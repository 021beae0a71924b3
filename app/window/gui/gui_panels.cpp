// SPDX-License-Identifier: MIT
// The panel at the left of the window: Dear ImGui (1.86 of Debian 12, 1.90 of Debian 13) between the session's events and
// core/gpu. Button events of one frame come one by one, because ImGui 1.86 looks at the state of buttons, not at events.
#include "app/window/gui/sections.hpp"
#include "app/window/hud.hpp"
#include "app/window/panels.hpp"

#include <imgui.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace mote::window {
namespace {

class GuiPanels final : public Panels {
public:
  explicit GuiPanels(gpu::Device device) : renderer_(std::move(device)) {
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // nothing is left in the folder
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 0.0f;
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.92f;
    plain_style_ = ImGui::GetStyle();
#if IMGUI_VERSION_NUM < 18700
    constexpr std::pair<int, Key> keys[] = {{ImGuiKey_Tab, key::tab}, {ImGuiKey_LeftArrow, key::left}, {ImGuiKey_RightArrow, key::right}, {ImGuiKey_Home, key::home},
                                            {ImGuiKey_End, key::end}, {ImGuiKey_Delete, key::del}, {ImGuiKey_Backspace, key::backspace}, {ImGuiKey_Enter, key::enter},
                                            {ImGuiKey_Escape, key::escape}, {ImGuiKey_A, 'a'}, {ImGuiKey_C, 'c'}, {ImGuiKey_V, 'v'}, {ImGuiKey_X, 'x'}, {ImGuiKey_Z, 'z'}};
    for (const auto& [theirs, ours] : keys) io.KeyMap[theirs] = ours;
#endif
  }
  ~GuiPanels() override { ImGui::DestroyContext(context_); }
  GuiPanels(const GuiPanels&) = delete;
  GuiPanels& operator=(const GuiPanels&) = delete;

  bool handle(const Event& event) override {
    ImGui::SetCurrentContext(context_);
    switch (event.kind) {
    case Event::Kind::Keyboard:
      if (!ImGui::GetIO().WantTextInput) return false;
      waiting_.push_back(event);
      return true;
    case Event::Kind::Text:
      if (!ImGui::GetIO().WantTextInput) return false;
      ImGui::GetIO().AddInputCharacter(event.code);
      return true;
    case Event::Kind::Move:
      mouse_ = {static_cast<float>(event.x), static_cast<float>(event.y)};
      if (held_outside_) return false;
      if (!waiting_.empty() && waiting_.back().kind == Event::Kind::Move) waiting_.back() = event;
      else waiting_.push_back(event);
      return over() || was_over_;
    case Event::Kind::MouseButton:
      if (event.pressed && !held_inside_ && !held_outside_) (over() ? held_inside_ : held_outside_) = true;
      if (held_outside_) {
        held_outside_ = event.pressed;
        return false;
      }
      waiting_.push_back(event);
      if (!event.pressed) held_inside_ = false;
      return true;
    case Event::Kind::Wheel:
      if (!over()) return false;
      waiting_.push_back(event);
      return true;
    default: return false;
    }
  }

  bool build(Session& session, Size2d size, double scale, double now) override {
    ImGui::SetCurrentContext(context_);
    set_scale(static_cast<float>(scale));
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    io.DeltaTime = static_cast<float>(std::clamp(now - last_, 1e-4, 0.25));
    last_ = now;
    feed(io);
    ImGui::NewFrame();
    lay_out(session, size);
    ImGui::Render();
    was_over_ = over() || ImGui::IsAnyItemActive();
    const bool active = ImGui::IsAnyItemActive(), changed = active != was_active_;
    was_active_ = active;
    return !waiting_.empty() || changed;
  }

  void upload() override { renderer_.upload(*ImGui::GetDrawData()); }
  void draw(gpu::RenderPass& pass, gpu::TextureFormat format) override { renderer_.draw(pass, format, *ImGui::GetDrawData()); }

private:
  // Is the mouse where a press would be the panel's?
  [[nodiscard]] bool over() const {
    const bool inside = mouse_.x >= low_.x && mouse_.y >= low_.y && mouse_.x < high_.x && mouse_.y < high_.y;
    return held_inside_ || inside || (ImGui::GetIO().WantCaptureMouse && ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup));
  }

  // Events up to the second change of buttons.
  void feed(ImGuiIO& io) {
    bool changed = false;
    while (!waiting_.empty()) {
      const Event& e = waiting_.front();
      if (e.kind == Event::Kind::MouseButton) {
        if (changed) return;
        changed = true;
        const int button = e.button == Button::Left ? 0 : e.button == Button::Right ? 1 : 2;
#if IMGUI_VERSION_NUM < 18700
        io.MousePos = {static_cast<float>(e.x), static_cast<float>(e.y)};
        io.MouseDown[button] = e.pressed;
#else
        io.AddMousePosEvent(static_cast<float>(e.x), static_cast<float>(e.y));
        io.AddMouseButtonEvent(button, e.pressed);
#endif
      } else if (e.kind == Event::Kind::Move) {
#if IMGUI_VERSION_NUM < 18700
        if (changed) return;
        io.MousePos = {static_cast<float>(e.x), static_cast<float>(e.y)};
#else
        io.AddMousePosEvent(static_cast<float>(e.x), static_cast<float>(e.y));
#endif
      } else if (e.kind == Event::Kind::Wheel) {
#if IMGUI_VERSION_NUM < 18700
        io.MouseWheel += static_cast<float>(e.wheel);
#else
        io.AddMouseWheelEvent(0.0f, static_cast<float>(e.wheel));
#endif
      } else {
        feed_key(io, e);
      }
      waiting_.pop_front();
    }
  }

  static void feed_key(ImGuiIO& io, const Event& e) {
#if IMGUI_VERSION_NUM < 18700
    if (e.key >= 0 && e.key < 512) io.KeysDown[e.key] = e.pressed;
    io.KeyCtrl = e.modifiers.control;
    io.KeyShift = e.modifiers.shift;
#else
    constexpr std::pair<Key, ImGuiKey> keys[] = {{key::tab, ImGuiKey_Tab}, {key::left, ImGuiKey_LeftArrow}, {key::right, ImGuiKey_RightArrow}, {key::home, ImGuiKey_Home},
                                                 {key::end, ImGuiKey_End}, {key::del, ImGuiKey_Delete}, {key::backspace, ImGuiKey_Backspace}, {key::enter, ImGuiKey_Enter},
                                                 {key::escape, ImGuiKey_Escape}};
    io.AddKeyEvent(ImGuiMod_Ctrl, e.modifiers.control);
    io.AddKeyEvent(ImGuiMod_Shift, e.modifiers.shift);
    for (const auto& [ours, theirs] : keys)
      if (ours == e.key) io.AddKeyEvent(theirs, e.pressed);
    if (e.key >= 'a' && e.key <= 'z') io.AddKeyEvent(static_cast<ImGuiKey>(ImGuiKey_A + (e.key - 'a')), e.pressed);
#endif
  }

  void set_scale(float scale) {
    if (scale == scale_) return;
    scale_ = scale;
    ImGui::GetStyle() = plain_style_;
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImFontConfig font;
    font.SizePixels = 13.0f * scale;
    ImGui::GetIO().Fonts->Clear();
    ImGui::GetIO().Fonts->AddFontDefault(&font);
    renderer_.make_letters();
  }

  void lay_out(Session& session, Size2d size) {
    const auto wide = static_cast<float>(std::min(panel_width * static_cast<double>(scale_), size.width * panel_part));
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({wide, static_cast<float>(size.height)});
    ImGui::Begin("mote", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushItemWidth(wide * 0.55f);
    const auto section = [](const char* name, bool open, const auto& body) {
      if (!ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
      ImGui::PushID(name);
      body();
      ImGui::PopID();
    };
    section("Data and frames", true, [&] { data_section(session, state_); });
    section("Mapping", true, [&] { mapping_section(session, state_); });
    section("Lights", true, [&] { light_section(session); });
    section("Handles", false, [&] { gizmo_section(session); });
    section("Camera", false, [&] { camera_section(session); });
    section("Passes", true, [&] { pass_section(session, state_); });
    section("Slots", false, [&] { slot_section(session, state_, renderer_); });
    section("Messages", false, [&] { diagnostics_section(session); });
    ImGui::PopItemWidth();
    low_ = ImGui::GetWindowPos();
    high_ = {low_.x + ImGui::GetWindowWidth(), low_.y + ImGui::GetWindowHeight()};
    ImGui::End();
  }

  GuiRenderer renderer_;
  ImGuiContext* context_{};
  ImGuiStyle plain_style_{};
  GuiState state_{};
  std::deque<Event> waiting_{};
  ImVec2 mouse_{-1, -1}, low_{0, 0}, high_{0, 0};
  bool held_inside_{}, held_outside_{}, was_over_{}, was_active_{};
  float scale_{};
  double last_{};
};

} // namespace

std::unique_ptr<Panels> make_panels(gpu::Device device) { return std::make_unique<GuiPanels>(std::move(device)); }

} // namespace mote::window
