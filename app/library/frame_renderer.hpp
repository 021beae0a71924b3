// SPDX-License-Identifier: MIT
// Draws one scene with one graph on one device, as often as asked, and reads pictures back: the glue
// between scene, passes and render graph that the command line, the library and the window share.
//
//   FrameRenderer renderer(device, ready_graph, display);
//   renderer.set_scene(scene);
//   renderer.draw(view);                   // submits, does not wait
//   DrawnPicture picture = renderer.read(); // waits
#pragma once

#include "app/library/device.hpp"
#include "app/library/graphs.hpp"
#include "app/library/picture.hpp"
#include "core/color/color_config.hpp"
#include "core/scene/scene.hpp"
#include "passes/frame.hpp"
#include "passes/particles/expansion_choice.hpp"
#include "passes/particles/particle_store.hpp"
#include "render_graph/executor.hpp"

#include <memory>
#include <string>

namespace mote::app {

struct DisplayOptions {
  std::string config{};           // path of an OpenColorIO config; empty: $OCIO, else the shipped one
  std::string display{}, view{};  // empty: the config's defaults
  double exposure{};              // stops
  bool exact{};                   // OpenColorIO's arithmetic instead of baked curves
};

class FrameRenderer {
public:
  // `config` and `device` must outlive the renderer. `frames`: how many are expected to be drawn, for `auto`. Renderers
  // of one scene may share a `store`, so that its particles are on the device once.
  FrameRenderer(DrawingDevice& device, ReadyGraph graph, const ColorConfig& config, const DisplayOptions& display,
                passes::Expansion expansion, double frames = 1, std::shared_ptr<passes::ParticleStore> store = {});

  void set_scene(const Scene& scene); // uploads; `scene` must outlive the drawing
  // Records and submits a frame. Throws Failure when a pass or the device reports an error.
  gpu::Submission draw(const View& view);
  void wait(gpu::Submission submission);
  // What the frames waited for lacked (memory that overflowed, ...), each message once.
  const Diagnostics& report() const { return report_; }
  // What the last frame gave: the output, and whatever the graph was asked for. Waits.
  DrawnPicture read();
  // The picture of the last frame, still on the device; and what else the graph was asked for.
  [[nodiscard]] gpu::Texture output() const { return executor_.output(); }
  [[nodiscard]] gpu::Texture texture(const std::string& source) const { return executor_.texture(source); }
  [[nodiscard]] const ReadyGraph& graph() const { return graph_; } // its plan is the executor's
  [[nodiscard]] const std::shared_ptr<passes::ParticleStore>& store() const { return store_; }
  // What passes from files have to say about files that changed.
  void set_reports(std::function<void(const Diagnostic&)> report) { reports_.report = std::move(report); }
  // One texture or buffer of the graph, to .npy, or to .exr if it is a color or a number a pixel.
  void dump(const std::string& source, const std::string& path);

  [[nodiscard]] const gpu::Limits& limits() const { return device_.device().limits(); }
  [[nodiscard]] const rg::Plan& plan() const { return executor_.plan(); }
  [[nodiscard]] const std::vector<rg::PassTiming>& timings(bool wait = true) { return executor_.timings(wait); }
  void set_stage_times(bool on) { executor_.set_stage_times(on); }
  void count_work(); // PassTiming::counts from the next frame on; a device that cannot gives the warning A024
  // "sRGB / Un-tone-mapped", once a frame was drawn.
  [[nodiscard]] const std::string& display_text() const { return *display_text_; }
  // The one that the last frame was drawn with; before it, the one that was asked for.
  [[nodiscard]] passes::Expansion expansion() const;
  // What each pass that draws particles chose in the last frame, in the order of the plan.
  [[nodiscard]] const std::vector<passes::ExpansionReport>& choices() const { return choices_; }
  [[nodiscard]] const passes::DeviceCosts& costs() const { return costs_; }
  void set_costs(passes::DeviceCosts costs) { costs_ = std::move(costs); }

  FrameRenderer(const FrameRenderer&) = delete; // its options point into it
  FrameRenderer& operator=(const FrameRenderer&) = delete;

private:
  void check_memory(const Scene& scene); // throws Failure A025
  void name_choices();
  [[nodiscard]] std::vector<float> read_floats(const std::string& source); // RGBA

  DrawingDevice& device_;
  ReadyGraph graph_;
  passes::DeviceCosts costs_{};
  std::vector<passes::ExpansionReport> choices_{};
  passes::FrameOptions options_{};
  passes::DisplaySettings display_{};
  passes::PassReports reports_{};
  std::shared_ptr<std::string> display_text_ = std::make_shared<std::string>();
  std::shared_ptr<passes::ParticleStore> store_;
  rg::Executor executor_;
  const Scene* scene_{};
  View view_{};
  Diagnostics report_{};
};

} // namespace mote::app
