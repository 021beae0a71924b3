// SPDX-License-Identifier: MIT
// Vectors whose elements start at a memory page and own it to the end of their last one: what a device that draws on the
// processor can use as its own memory, without a copy (core/gpu, BufferDescriptor::contents_owner).
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace mote {

constexpr std::size_t page_bytes = 4096;

template <class T> struct PageAllocator {
  using value_type = T;
  PageAllocator() = default;
  template <class U> PageAllocator(const PageAllocator<U>&) noexcept {} // NOLINT: allocators convert
  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > (static_cast<std::size_t>(-1) - page_bytes) / sizeof(T)) throw std::bad_array_new_length();
    void* pages = std::aligned_alloc(page_bytes, (n * sizeof(T) + page_bytes - 1) / page_bytes * page_bytes);
    if (pages == nullptr) throw std::bad_alloc();
    return static_cast<T*>(pages);
  }
  void deallocate(T* pages, std::size_t) noexcept { std::free(pages); }
  template <class U> bool operator==(const PageAllocator<U>&) const noexcept { return true; }
};

template <class T> using PageVector = std::vector<T, PageAllocator<T>>;

} // namespace mote
