// SPDX-License-Identifier: MIT
// Draws the scene of the window: as it should be, as a draft while something moves, and a few pixels of ids where the mouse
// is. One FrameRenderer for each of these, over one store of particles. Knows no window; Session calls it.
//
// A graph that cannot be drawn leaves the one before in place.
#pragma once

#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"
#include "app/window/pick.hpp"
#include "app/window/slot.hpp"
#include "core/color/display_transform.hpp"

#include <memory>
#include <optional>

namespace mote::window {

class Painter {
public:
  // The device must outlive it.
  Painter(app::DrawingDevice& device, const app::DisplayOptions& display, passes::Expansion expansion);

  // What draws `job` from now on, its scene included. False with errors in `diagnostics`: all stays as it was. The
  // job must outlive the drawing.
  bool set(const app::Job& job, std::shared_ptr<const ColorConfig> config, Diagnostics& diagnostics);
  // Another scene for the same graph.
  void set_scene(const Scene& scene);

  // A draft: one sample a pixel. Draws and waits; the picture stays on the device until the next call. Throws Failure.
  gpu::Texture draft(const View& view);
  // The picture as it should be, piece by piece, so that inputs need not wait for all of it: draws the next strip of rows and
  // waits, as high as fits `goal_ms`. True: the picture is whole, and refined() is it until it is whole again. Another view, another scene
  // and another graph begin anew. Graphs with passes from files are one piece: those may look at neighbors. Throws Failure.
  bool refine(const View& view, double goal_ms);
  [[nodiscard]] const gpu::Texture& refined() const { return shown_; }
  [[nodiscard]] std::uint32_t pieces() const { return pieces_; } // of the last whole picture
  // Of the last whole picture: depth for annotations, empty if the graph makes none.
  [[nodiscard]] const std::vector<float>& depth() const { return depth_; }
  // The whole picture as `mote render` makes it, annotated.
  app::DrawnPicture picture(const app::Job& job, const View& view);
  // Ids and depths within `radius` pixels of pixel (x, y) of the view. Nothing where the graph has no ids.
  std::optional<PickArea> pick(const View& view, double x, double y, std::uint32_t radius);
  // A source of the graph ("opaque.color") as the view shows it; nothing with errors in `diagnostics`.
  std::optional<SlotPixels> slot(const std::string& source, const View& view, Diagnostics& diagnostics);

  [[nodiscard]] bool draft_differs() const { return draft_differs_; } // fewer samples
  [[nodiscard]] const DisplayTransform& display() const { return *display_; }
  [[nodiscard]] app::FrameRenderer& renderer() { return *final_; }
  [[nodiscard]] const std::string& graph_output() const { return final_->graph().output; }
  [[nodiscard]] const app::DrawingDevice& device() const { return device_; }

private:
  void draw_strip(const View& view, std::uint32_t first, std::uint32_t rows);
  [[nodiscard]] std::uint32_t strip_rows(std::uint32_t height, double goal_ms) const;
  std::unique_ptr<app::FrameRenderer> make(const app::GraphRequest& request, const ColorConfig& config, Diagnostics& diagnostics);

  app::DrawingDevice& device_;
  std::shared_ptr<const ColorConfig> config_{}; // before the renderers, which point to it
  app::DisplayOptions options_;
  passes::Expansion expansion_;
  std::shared_ptr<passes::ParticleStore> store_{};
  app::GraphRequest request_{};
  const Scene* scene_{};
  std::unique_ptr<app::FrameRenderer> final_{}, draft_{}, pick_{}, slot_{};
  std::string slot_source_{};
  std::optional<DisplayTransform> display_{};
  bool draft_differs_{}, picks_{true}, local_{}; // local: no pass looks at neighbors of its pixel
  // The refinement that is under way, and how long its rows take.
  std::optional<View> refining_{};
  std::uint32_t next_row_{}, strip_{}, drawn_pieces_{}, pieces_{};
  double row_ms_{}, slowest_row_ms_{};
  gpu::Texture shown_{}, under_way_{};
  std::vector<float> depth_{}, depth_under_way_{};
};

} // namespace mote::window
