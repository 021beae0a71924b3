// SPDX-License-Identifier: MIT
// Runs fn(0) ... fn(n - 1) on several threads, each index once, in no order. Called by the
// reference's tree builder and pixel loop; results may not depend on the order or the number of
// threads. An exception of fn ends the loop and is thrown again by the caller's thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace mote::reference {

// 0 asks for one thread per core.
inline unsigned thread_count(unsigned asked) {
  return asked ? asked : std::max(1u, std::thread::hardware_concurrency());
}

template <class Function> void parallel_for(unsigned threads, std::size_t n, Function&& fn) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < n; i = next++) fn(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
      next = n;
    }
  };
  std::vector<std::thread> others;
  const std::size_t count = std::min<std::size_t>(thread_count(threads), n);
  for (std::size_t i = 1; i < count; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

} // namespace mote::reference
