// SPDX-License-Identifier: MIT
// Runs a plan: makes its textures and buffers for a view size, prepares the passes once, and records
// and submits frames. One encoder, one submission a frame; barriers are core/gpu's business.
//
//   Executor executor(device, *result.plan, result.passes);
//   executor.execute(frame, {640, 480});                       // does not wait
//   auto pixels = device.read_texture(executor.output());      // waits
//
// The window copies output() to its surface; a graph never sees the surface. A hot reload makes a new
// Executor beside the old one and swaps when prepare() did not throw.
#pragma once

#include "render_graph/idle.hpp"
#include "render_graph/pass.hpp"
#include "render_graph/plan.hpp"
#include "render_graph/profiler.hpp"
#include "render_graph/resources.hpp"
#include "render_graph/uses.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mote::rg {

struct ExecuteOptions {
  bool camera_cut{}; // state slots start again from zero
};

struct ExecutorOptions {
  bool check_uses{validation_asked()}; // compare what passes declared with what they did (uses.hpp)
  static bool validation_asked();      // MOTE_VALIDATION=1
};

class Executor {
public:
  // `passes` belong to `plan` one by one, as compile() returns them.
  Executor(gpu::Device device, Plan plan, std::vector<std::shared_ptr<Pass>> passes, const ExecutorOptions& options = {});
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  // Makes resources for the view and, the first time, prepares all passes. execute() does it by itself;
  // call it before to find errors early. Throws Failure: G070, G071, or what a pass's prepare throws.
  void prepare(const FrameInput& frame, ViewSize view);
  // Records and submits one frame. The view may have another size each time: only what depends on it is
  // made anew. Throws as prepare() does and what passes throw while recording, and G072 (nothing is then submitted).
  gpu::Submission execute(const FrameInput& frame, ViewSize view, const ExecuteOptions& options = {});
  void reset_state();
  // What the passes of the last frame have to say about it; only after its submission was waited for.
  void report(Diagnostics& out);

  // Of a root ("display.color", or what --dump asked for), valid after a frame; else an invalid object.
  [[nodiscard]] gpu::Texture texture(std::string_view source) const;
  [[nodiscard]] gpu::Buffer buffer(std::string_view source) const;
  [[nodiscard]] gpu::Texture output() const;

  [[nodiscard]] const Plan& plan() const { return plan_; }
  [[nodiscard]] ViewSize view_size() const { return resources_.view_size(); }
  [[nodiscard]] const FrameChoice& last_choice() const { return choice_; } // which passes ran, and why others did not
  // Slots that passes declared and no frame has used (G073, notes); empty without check_uses.
  [[nodiscard]] Diagnostics unused_slots() const { return check_ ? check_->unused() : Diagnostics{}; }
  // One per pass in plan order, of a frame up to three old; with `wait` of the last one.
  [[nodiscard]] const std::vector<PassTiming>& timings(bool wait = false) { return profiler_.timings(wait); }
  void set_stage_times(bool on) { profiler_.set_stages(on); } // PassTiming::stages, from the next frame on
  // PassTiming::counts, likewise; false: the device does not count.
  bool set_counts(bool on) { return profiler_.set_counts(on), profiler_.counts() == on; }

private:
  class Context;
  void choose(const FrameInput& frame);
  void record_pass(std::size_t i, const FrameInput& frame, gpu::CommandEncoder& encoder);
  gpu::RenderPass open(std::size_t i, const FrameInput& frame, gpu::CommandEncoder& encoder, bool loaded);
  void open_and_record(std::size_t i, const FrameInput& frame, gpu::CommandEncoder& encoder);
  void check_uses(std::size_t i, const gpu::CommandEncoder& encoder, std::size_t first_scope);
  void record_copies(std::size_t after, gpu::CommandEncoder& encoder);

  gpu::Device device_;
  Plan plan_;
  std::vector<std::shared_ptr<Pass>> passes_;
  Resources resources_;
  Profiler profiler_;
  std::vector<std::unique_ptr<Context>> contexts_{};
  std::optional<UseCheck> check_{};
  FrameChoice choice_{};
  std::vector<std::string> taken_over_{}; // by pass: which one did its work in this frame; empty: none
  bool prepared_{};
};

} // namespace mote::rg
