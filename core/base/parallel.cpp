// SPDX-License-Identifier: MIT
#include "core/base/parallel.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace mote {

unsigned worker_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(std::max(CPU_COUNT(&set), 1));
  return std::max(std::thread::hardware_concurrency(), 1u);
}

void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body, unsigned threads) {
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> failed{std::numeric_limits<std::size_t>::max()};
  std::mutex guard;
  std::exception_ptr error;
  auto work = [&] {
    for (std::size_t block = next++; block < blocks && block < failed; block = next++) {
      try {
        body(block);
      } catch (...) {
        const std::scoped_lock lock(guard);
        if (block < failed) {
          failed = block;
          error = std::current_exception();
        }
      }
    }
  };
  std::vector<std::thread> others;
  const std::size_t wanted = std::min<std::size_t>(threads ? threads : worker_count(), blocks);
  for (std::size_t i = 1; i < wanted; ++i) {
    try {
      others.emplace_back(work);
    } catch (const std::system_error&) { // no more threads to be had: the ones there are do it
      break;
    }
  }
  work();
  for (std::thread& thread : others) thread.join();
  if (error) std::rethrow_exception(error);
}

std::uint32_t thread_count(std::uint64_t count, std::uint64_t grain) {
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(count / std::max<std::uint64_t>(1, grain), 1, worker_count()));
}

void parallel_parts(std::uint64_t count, std::uint32_t parts,
                    const std::function<void(std::uint32_t, std::uint64_t, std::uint64_t)>& body) {
  const auto bound = [&](std::uint64_t part) { return count / parts * part + std::min<std::uint64_t>(part, count % parts); };
  for_each_block(parts, [&](std::size_t part) { body(static_cast<std::uint32_t>(part), bound(part), bound(part + 1)); }, parts);
}

} // namespace mote
