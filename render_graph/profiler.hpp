// SPDX-License-Identifier: MIT
// What each pass of a frame took: recording on the CPU, and on the device where it has timestamps
// (Feature::TimestampQuery). Results come back three frames later, without waiting; asking for the
// last frame waits for it. Two timestamps a pass, both at the end of all earlier commands.
#pragma once

#include "core/gpu/gpu.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace mote::rg {

struct PassTiming {
  std::string name{};
  double cpu_ms{};                // recording, update() included
  std::optional<double> gpu_ms{}; // nothing without timestamps, 0 if skipped
  std::string skipped{};          // why it was left out of this frame; empty: it ran
};

class Profiler {
public:
  Profiler(gpu::Device device, std::vector<std::string> passes);

  void begin_frame();
  void begin_pass(gpu::CommandEncoder& encoder, std::size_t pass);
  void end_pass(gpu::CommandEncoder& encoder);
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
    std::vector<PassTiming> timings{};
  };
  void read(Frame& frame);

  gpu::Device device_;
  std::vector<std::string> passes_;
  bool timestamps_{};
  std::array<Frame, 3> frames_{};
  std::size_t current_{};
  std::size_t pass_{};
  Clock::time_point start_{};
  std::vector<PassTiming> latest_{};
};

} // namespace mote::rg
