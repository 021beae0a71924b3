// SPDX-License-Identifier: MIT
// A window's session without the window: events go in, pictures come out, wishes to the window system (title, clipboard,
// full screen, the end) are left to be fetched. The host (host.hpp) gives it events of GLFW and a swapchain; tests give it
// events of their own and a texture.
//
//   session.handle(event);                      // as many as there are
//   if (session.wants_frame(now)) { session.render(now); session.compose(target); }
//
// One thread. Throws Failure only for what ends the program (the device is lost); everything a user does wrong becomes a message in
// the window.
#pragma once

#include "app/window/actions.hpp"
#include "app/window/camera_control.hpp"
#include "app/window/document.hpp"
#include "app/window/handles.hpp"
#include "app/window/pace.hpp"
#include "app/window/painter.hpp"
#include "app/window/panels.hpp"
#include "app/window/presenter.hpp"
#include "core/toml/node.hpp"

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mote::window {

struct SessionOptions {
  app::DisplayOptions display{};
  passes::Expansion expansion{passes::Expansion::Auto};
  PaceOptions pace{};
  std::string version{}; // for the provenance of screenshots
};

// What the session wants of the window system; fetched and cleared by the host.
struct Wishes {
  bool quit{}, toggle_full_screen{}, leave_full_screen{};
  std::optional<std::string> clipboard{}, title{};
  std::optional<std::vector<std::string>> watch{}; // files and folders to be told of
};

// What the gizmo can take.
struct GizmoTarget {
  enum class Kind : std::uint8_t { Data, Light };
  Kind kind{};
  std::size_t index{};
  std::string name{};
  bool moves{}, turns{}, scales{};
  [[nodiscard]] bool can(GizmoMode mode) const { return mode == GizmoMode::Move ? moves : mode == GizmoMode::Turn ? turns : scales; }
};

class Session {
public:
  // `request` is what `job` was loaded from: the session loads it again when files change.
  Session(app::DrawingDevice& device, std::shared_ptr<const ColorConfig> config, app::JobRequest request, app::Job job, SessionOptions options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void handle(const Event& event, double now);
  [[nodiscard]] bool wants_frame(double now) const;
  // When the next frame will be wanted though nothing happens.
  [[nodiscard]] std::optional<double> due() const;
  [[nodiscard]] bool refined() const { return pace_.refined() || !visible(); } // nothing better will come
  // Draws the scene, if it or the way it is seen has changed; of a picture as it should be, a piece (shows_new() tells when it is whole).
  void render(double now);
  // Is there something that compose() would show and the window does not?
  [[nodiscard]] bool shows_new() const { return stale_ || hud_stale_ || rendered_; }
  // The last picture with all that goes over it, into a texture of the window's size; waits.
  void compose(const gpu::Texture& target);
  // How long the window system took to show what was composed.
  void presented(double ms) { present_ms_ = ms; }
  [[nodiscard]] bool visible() const { return size_.width > 0 && size_.height > 0; }
  [[nodiscard]] Size2d size() const { return size_; }

  // ---- what panels, gizmos and scripts change; problems become messages ----
  // A value of the scene ("light.sun.intensity") or of the graph ("opaque.samples"), as --set takes it. `merge`: as Document::set.
  bool set(const std::string& path, const std::string& value, bool merge = false);
  void undo();
  void redo();
  bool save(const std::string& path = {}); // with the camera as it is; empty: the scene's file, or a new one
  void set_frame(std::uint64_t index);
  [[nodiscard]] std::uint64_t frame() const { return job_->frame.value_or(0); }
  [[nodiscard]] std::uint64_t frame_count();
  void set_playing(bool on);
  [[nodiscard]] bool playing() const { return playing_; }
  double frames_a_second{10.0};
  bool loop{true};
  void set_camera(const Camera& camera); // no undo: cameras come and go
  void act(Action action);               // what a key would do

  // ---- moving things with the mouse ----
  [[nodiscard]] std::vector<GizmoTarget> gizmo_targets() const; // data sets, then lights that have a place or a direction
  void set_gizmo(std::optional<GizmoMode> mode);                // nothing: no handles
  void set_gizmo_target(std::size_t target);
  [[nodiscard]] std::optional<GizmoMode> gizmo_mode() const { return gizmo_.mode; }
  [[nodiscard]] std::size_t gizmo_target() const { return gizmo_.target; }
  [[nodiscard]] std::vector<GizmoStroke> gizmo_strokes_now() const; // where its handles are, pixels

  // ---- what was picked ----
  struct Picked {
    std::uint32_t id{no_particle};
    glm::dvec3 center{0};             // world
    std::vector<std::array<std::string, 2>> rows{}; // attributes, in words
  };
  // The particle at a pixel, within a few pixels; nothing where there is none.
  std::optional<Picked> pick(double x, double y);
  [[nodiscard]] const std::vector<Picked>& picked() const { return picked_; }

  Wishes take_wishes() { return std::exchange(wishes_, {}); }
  void screenshot(const std::string& path); // the picture as `mote render` makes it; a failure becomes a message
  void message(std::string text);           // shown for some seconds
  [[nodiscard]] const Camera& camera() const { return control_.camera(); }
  [[nodiscard]] const app::Job& job() const { return *job_; }
  [[nodiscard]] const Pace& pace() const { return pace_; }
  [[nodiscard]] const Document& document() const { return document_; }
  [[nodiscard]] Painter& painter() { return painter_; }
  [[nodiscard]] const CameraControl& control() const { return control_; }
  [[nodiscard]] View view() const { return view(size_); }
  [[nodiscard]] double panels_ms() const { return panels_ms_; }   // of the last frame
  [[nodiscard]] double frame_ms() const { return render_ms_; }
  [[nodiscard]] bool panels_shown() const { return panels_ && panels_shown_; }
  [[nodiscard]] const Diagnostics& problems() const { return problems_; } // of what was read last
  [[nodiscard]] const std::vector<std::string>& messages() const { return said_; } // all so far, for tests and the terminal

private:
  void on_key(const Event& event);
  void on_button(const Event& event, double now);
  void on_move(const Event& event, double now);
  void moved(double now, bool held); // the camera
  struct GizmoDrag {
    GizmoTarget target{};
    GizmoPart part{};
    View view{};               // as it was when the drag began, as is all here
    glm::dvec3 pivot{0};
    glm::dvec2 from{0};
    Light light{};
    std::optional<std::string> base{};        // data sets: the scene's text
    std::optional<config::Node> last{};       // their last step, if the drag is to go on with it
    std::size_t last_index{};
    bool begun{};              // something was changed
  };
  [[nodiscard]] glm::dvec3 gizmo_pivot(const GizmoTarget& target) const;
  bool begin_gizmo_drag(const Event& event);
  void end_gizmo_drag();
  void hover_gizmo(double x, double y);
  void drag_gizmo(const glm::dvec2& to, const Modifiers& modifiers);
  bool move_light(const GizmoDrag& drag, const GizmoChange& change);
  bool move_data(GizmoDrag& drag, const GizmoChange& change);
  void update_gizmo();
  void open(const std::vector<std::string>& files);
  void reload();
  bool take_text(const std::string& changed);  // the document's text as the scene; `changed`: the path that is another
  bool take_lights(Diagnostics& diagnostics);
  bool take_transforms(Diagnostics& diagnostics);
  // The text that `make` gives becomes the scene, or all stays as it was; `what`, `merge`: as Document::set.
  bool change_text(const std::string& what, const std::function<std::string()>& make, bool merge);
  bool take_job(app::Job next, Diagnostics& diagnostics);
  [[nodiscard]] app::Job described(Diagnostics& diagnostics) const;
  [[nodiscard]] std::vector<std::string> type_settings() const; // types that the command line names
  void tell(const Diagnostics& diagnostics);
  void watch_files(const app::GraphRequest* graph = nullptr);
  void picked_at(double x, double y);
  // Parameters of a pass: `setting` in place of what was said of `path` before; empty: what the graph says.
  bool set_of_pass(const std::string& path, const std::vector<std::string>& setting);
  void show_step(passes::Step step); // of the first pass that has steps
  [[nodiscard]] std::optional<Picked> describe(std::uint32_t id) const;
  void play(double now);
  void update_annotations();
  void update_hud(double now);
  [[nodiscard]] View view(Size2d size) const;
  [[nodiscard]] std::string command() const;

  app::DrawingDevice& device_;
  std::shared_ptr<const ColorConfig> config_;
  SessionOptions options_;
  app::JobRequest request_;
  std::shared_ptr<app::Job> job_;
  Document document_;
  Camera loaded_camera_; // that the scene had when it was read
  CameraControl control_;
  Pace pace_;
  Painter painter_;
  Presenter presenter_;
  Wishes wishes_{};
  Size2d size_{};
  double scale_{1.0};
  gpu::Texture picture_{};
  bool stale_{true};      // the window shows something older than the state
  bool draft_shown_{};
  double present_ms_{}, render_ms_{}, refined_ms_{}; // of the last picture; of the pieces so far
  bool rendered_{};       // since the last compose
  std::optional<Button> held_{};
  Modifiers held_modifiers_{};
  glm::dvec2 mouse_{0}, pressed_at_{0};
  double last_click_{-1e9};
  bool help_{}, hud_stale_{true}, legend_{true}, playing_{}, panels_shown_{true};
  double next_frame_at_{}, quit_asked_{-1e9}, panels_ms_{};
  std::uint64_t frames_known_{}; // 0: not asked yet
  std::vector<Picked> picked_{};
  struct {
    std::optional<GizmoMode> mode{};
    std::size_t target{};
    std::optional<GizmoPart> lit{};
    std::optional<GizmoDrag> drag{};
    bool shown{};
  } gizmo_{};
  std::unique_ptr<Panels> panels_{};
  Diagnostics problems_{};
  std::vector<std::string> said_{};
  std::string message_{};
  double message_until_{-1e9}, now_{};
};

} // namespace mote::window
