// SPDX-License-Identifier: MIT
// One loop over a range on all the cores that this process may use. The range is cut into equal parts,
// one per thread; what a caller writes per index therefore does not depend on the number of threads.
// Short ranges stay on the calling thread, so that small scenes start no thread at all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

namespace mote {

// Threads worth starting for `count` items of which one thread should get at least `grain`; at least 1.
inline std::uint32_t thread_count(std::uint64_t count, std::uint64_t grain) {
  const std::uint64_t cores = std::max(1u, std::thread::hardware_concurrency());
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(count / std::max<std::uint64_t>(1, grain), 1, cores));
}

// Calls fn(part, begin, end) for `parts` consecutive ranges of [0, count), each on its own thread; part < parts.
// fn must not throw.
template <class Fn> void parallel_parts(std::uint64_t count, std::uint32_t parts, const Fn& fn) {
  auto bound = [&](std::uint64_t part) { return count / parts * part + std::min<std::uint64_t>(part, count % parts); };
  std::vector<std::thread> threads;
  threads.reserve(parts);
  for (std::uint32_t part = 1; part < parts; ++part)
    threads.emplace_back([&fn, part, begin = bound(part), end = bound(part + 1)] { fn(part, begin, end); });
  fn(std::uint32_t{0}, std::uint64_t{0}, bound(1));
  for (std::thread& thread : threads) thread.join();
}

} // namespace mote
