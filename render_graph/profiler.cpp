// SPDX-License-Identifier: MIT
#include "render_graph/profiler.hpp"

#include "core/gpu/observe.hpp"

#include <algorithm>
#include <cstring>

namespace mote::rg {
namespace {
constexpr std::uint32_t most_marks = 1024; // of a frame; later ones are left out
constexpr std::uint32_t most_counted = 512; // render passes of a frame, likewise
}

Profiler::Profiler(gpu::Device device, std::vector<std::string> passes)
    : device_(std::move(device)), passes_(std::move(passes)), timestamps_(has(device_.features(), gpu::Feature::TimestampQuery) && !passes_.empty()) {
  if (!timestamps_) return;
  const auto count = static_cast<std::uint32_t>(passes_.size() * 2) + most_marks;
  for (Frame& frame : frames_) {
    frame.queries = device_.create_query_set({.label = "pass timestamps", .type = gpu::QueryType::Timestamp, .count = count});
    frame.resolved = device_.create_buffer({.label = "pass timestamps", .size = count * 8u, .usage = gpu::BufferUsage::QueryResolve | gpu::BufferUsage::CopySrc});
    frame.readable = device_.create_buffer({.label = "pass timestamps (readable)", .size = count * 8u, .usage = gpu::BufferUsage::MapRead | gpu::BufferUsage::CopyDst});
  }
}

void Profiler::set_counts(bool on) {
  counts_ = on && has(device_.features(), gpu::Feature::PipelineStatistics) && !passes_.empty();
  if (!counts_ || frames_[0].statistics) return;
  constexpr std::uint64_t bytes = most_counted * sizeof(gpu::PipelineStatistics);
  for (Frame& frame : frames_) {
    frame.statistics = device_.create_query_set({.label = "pass statistics", .type = gpu::QueryType::PipelineStatistics, .count = most_counted});
    frame.counted = device_.create_buffer({.label = "pass statistics", .size = bytes, .usage = gpu::BufferUsage::QueryResolve | gpu::BufferUsage::CopySrc});
    frame.readable_counts = device_.create_buffer({.label = "pass statistics (readable)", .size = bytes, .usage = gpu::BufferUsage::MapRead | gpu::BufferUsage::CopyDst});
  }
}

void Profiler::begin_frame() {
  current_ = (current_ + 1) % frames_.size();
  Frame& frame = frames_[current_];
  if (frame.submission != 0) read(frame); // three frames old: done, or the device is far behind and should be waited for
  frame.used = 0;
  frame.marks.clear();
  frame.count_of.clear();
  frame.counted_passes = 0;
  frame.query.assign(passes_.size(), -1);
  frame.timings.assign(passes_.size(), {});
  for (std::size_t i = 0; i < passes_.size(); ++i) frame.timings[i].name = passes_[i];
}

void Profiler::begin_pass(gpu::CommandEncoder& encoder, std::size_t pass) {
  Frame& frame = frames_[current_];
  pass_ = pass;
  if (timestamps_) {
    frame.query[pass] = static_cast<int>(frame.used);
    encoder.write_timestamp(frame.queries, frame.used);
    last_query_ = frame.used;
    frame.used += 2;
  }
  first_command_ = gpu::command_count(encoder);
  if (counts_ && frame.counted_passes < most_counted) encoder.begin_pipeline_statistics(frame.statistics, frame.counted_passes);
  start_ = Clock::now();
}

void Profiler::end_pass(gpu::CommandEncoder& encoder) {
  Frame& frame = frames_[current_];
  frame.timings[pass_].cpu_ms = std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  if (counts_) {
    const gpu::FragmentInputs inputs = gpu::fragment_inputs(encoder, first_command_);
    frame.timings[pass_].counts = PassCounts{{}, inputs.interpolated, inputs.flat};
    if (frame.counted_passes < most_counted) {
      const std::uint32_t taken = gpu::counted_passes(encoder);
      encoder.end_pipeline_statistics();
      frame.count_of.push_back({pass_, frame.counted_passes, taken});
      frame.counted_passes += taken;
    }
  }
  if (timestamps_) encoder.write_timestamp(frame.queries, static_cast<std::uint32_t>(frame.query[pass_]) + 1);
}

void Profiler::mark(gpu::CommandEncoder& encoder, std::string_view stage) {
  Frame& frame = frames_[current_];
  if (!timestamps_ || !stages_ || frame.marks.size() == most_marks) return;
  frame.marks.push_back({pass_, std::string(stage), frame.used, last_query_});
  encoder.write_timestamp(frame.queries, frame.used);
  last_query_ = frame.used++;
}

void Profiler::skip_pass(std::size_t pass, std::string reason) {
  PassTiming& timing = frames_[current_].timings[pass];
  timing.skipped = std::move(reason);
  if (timestamps_) timing.gpu_ms = 0.0;
}

void Profiler::end_frame(gpu::CommandEncoder& encoder) {
  Frame& frame = frames_[current_];
  if (frame.counted_passes > 0) {
    encoder.resolve_query_set(frame.statistics, 0, frame.counted_passes, frame.counted, 0);
    encoder.copy_buffer_to_buffer(frame.counted, 0, frame.readable_counts, 0, frame.counted_passes * sizeof(gpu::PipelineStatistics));
  }
  if (frame.used == 0) return;
  encoder.resolve_query_set(frame.queries, 0, frame.used, frame.resolved, 0);
  encoder.copy_buffer_to_buffer(frame.resolved, 0, frame.readable, 0, frame.used * 8u);
}

void Profiler::submitted(gpu::Submission submission) { frames_[current_].submission = submission; }

void Profiler::read_counts(Frame& frame) {
  if (frame.counted_passes == 0) return;
  std::vector<gpu::PipelineStatistics> queries(frame.counted_passes);
  std::memcpy(queries.data(), frame.readable_counts.mapped().data(), queries.size() * sizeof(gpu::PipelineStatistics));
  for (const Frame::Counted& counted : frame.count_of) {
    PassCounts& sum = *frame.timings[counted.pass].counts;
    for (std::uint32_t i = 0; i < counted.count; ++i) {
      const gpu::PipelineStatistics& q = queries[counted.first + i];
      sum.vertices += q.vertices;
      sum.primitives += q.primitives;
      sum.vertex_invocations += q.vertex_invocations;
      sum.geometry_invocations += q.geometry_invocations;
      sum.geometry_primitives += q.geometry_primitives;
      sum.clipping_invocations += q.clipping_invocations;
      sum.clipping_primitives += q.clipping_primitives;
      sum.fragment_invocations += q.fragment_invocations;
    }
  }
}

void Profiler::read(Frame& frame) {
  device_.queue().wait(frame.submission);
  read_counts(frame);
  const auto bytes = frame.used ? frame.readable.mapped() : std::span<std::byte>{};
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    if (frame.query[i] < 0 || bytes.empty()) continue;
    std::uint64_t ticks[2];
    std::memcpy(ticks, bytes.data() + static_cast<std::size_t>(frame.query[i]) * 8, sizeof ticks);
    const double nanoseconds = ticks[1] > ticks[0] ? static_cast<double>(ticks[1] - ticks[0]) * static_cast<double>(device_.limits().timestamp_period_ns) : 0.0;
    frame.timings[i].gpu_ms = nanoseconds * 1e-6;
  }
  for (const Frame::Mark& mark : frame.marks) {
    std::uint64_t before = 0, after = 0;
    std::memcpy(&before, bytes.data() + mark.before * 8u, 8);
    std::memcpy(&after, bytes.data() + mark.query * 8u, 8);
    auto& stages = frame.timings[mark.pass].stages;
    auto it = std::find_if(stages.begin(), stages.end(), [&](const StageTiming& s) { return s.name == mark.stage; });
    if (it == stages.end()) it = stages.insert(it, {mark.stage, 0.0});
    it->gpu_ms += after > before ? static_cast<double>(after - before) * static_cast<double>(device_.limits().timestamp_period_ns) * 1e-6 : 0.0;
  }
  latest_ = frame.timings;
  frame.submission = 0;
}

const std::vector<PassTiming>& Profiler::timings(bool wait) {
  if (wait && frames_[current_].submission != 0) read(frames_[current_]);
  return latest_;
}

} // namespace mote::rg
