// SPDX-License-Identifier: MIT
#include "core/data/workers.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace mote::data {

unsigned worker_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    return static_cast<unsigned>(std::clamp(CPU_COUNT(&set), 1, 16));
  return std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
}

void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body) {
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
  std::vector<std::thread> threads;
  const std::size_t wanted = std::min<std::size_t>(worker_count(), blocks);
  for (std::size_t i = 1; i < wanted; ++i) {
    try {
      threads.emplace_back(work);
    } catch (const std::system_error&) { // no more threads to be had: the ones there are do it
      break;
    }
  }
  work();
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
}

} // namespace mote::data
