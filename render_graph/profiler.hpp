// SPDX-License-Identifier: MIT
// What each pass of a frame took: recording on the CPU, and on the device where it has timestamps
// (Feature::TimestampQuery). Results come back three frames later, without waiting; asking for the
// last frame waits for it. Two timestamps a pass, both at the end of all earlier commands; with stages a pass may
// mark the ends of its parts, whose times are summed by name. With counts, what the pipelines did in each pass, where the
// device tells (Feature::PipelineStatistics).
#pragma once

#include "core/gpu/gpu.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace mote::rg {

struct StageTiming {
  std::string name{};
  double gpu_ms{};
};
// What a pass made the rasterizer do, in all its render passes; kernels are not counted. "Components" are the numbers that the rasterizer hands to each fragment: interpolated,
// or flat from the provoking vertex (of the pipeline that takes most of each).
struct PassCounts : gpu::PipelineStatistics {
  std::uint32_t interpolated{}, flat{}; // components a fragment
  [[nodiscard]] std::uint64_t interpolated_components() const { return fragment_invocations * interpolated; }
  [[nodiscard]] std::uint64_t flat_components() const { return fragment_invocations * flat; }
};
struct PassTiming {
  std::string name{};
  double cpu_ms{};                // recording, update() included
  std::optional<double> gpu_ms{}; // nothing without timestamps, 0 if skipped
  std::vector<StageTiming> stages{}; // in order of first appearance; empty unless asked for
  std::optional<PassCounts> counts{}; // nothing unless asked for
  std::string skipped{};          // why it was left out of this frame; empty: it ran
};

class Profiler {
public:
  Profiler(gpu::Device device, std::vector<std::string> passes);

  void begin_frame();
  void begin_pass(gpu::CommandEncoder& encoder, std::size_t pass);
  void end_pass(gpu::CommandEncoder& encoder);
  void set_stages(bool on) { stages_ = on; }
  void set_counts(bool on); // from the next frame on; false on devices that do not count
  [[nodiscard]] bool counts() const { return counts_; }
  void mark(gpu::CommandEncoder& encoder, std::string_view stage); // ends a stage of the pass that is being recorded
  void skip_pass(std::size_t pass, std::string reason);
  void end_frame(gpu::CommandEncoder& encoder);
  void submitted(gpu::Submission submission);

  // The newest finished frame that was read; empty before that. With `wait` the last submitted one.
  [[nodiscard]] const std::vector<PassTiming>& timings(bool wait);

private:
  using Clock = std::chrono::steady_clock;
  struct Frame {
    gpu::QuerySet queries{};
    gpu::Buffer resolved{}, readable{};
    gpu::Submission submission{}; // 0: nothing to read
    std::uint32_t used{};         // queries
    std::vector<int> query{};     // per pass: its first query, or -1
    struct Mark {
      std::size_t pass{};
      std::string stage{};
      std::uint32_t query{}, before{}; // the stage lies between these two
    };
    std::vector<Mark> marks{};
    gpu::QuerySet statistics{}; // one a render pass
    gpu::Buffer counted{}, readable_counts{};
    struct Counted { // queries of a pass of the graph
      std::size_t pass{};
      std::uint32_t first{}, count{};
    };
    std::vector<Counted> count_of{};
    std::uint32_t counted_passes{};
    std::vector<PassTiming> timings{};
  };
  void read(Frame& frame);
  void read_counts(Frame& frame);

  gpu::Device device_;
  std::vector<std::string> passes_;
  bool timestamps_{}, stages_{}, counts_{};
  std::size_t first_command_{}; // of the pass
  std::uint32_t last_query_{};
  std::array<Frame, 3> frames_{};
  std::size_t current_{};
  std::size_t pass_{};
  Clock::time_point start_{};
  std::vector<PassTiming> latest_{};
};

} // namespace mote::rg
