// SPDX-License-Identifier: MIT
#include "app/window/watch.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <poll.h>
#include <set>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace mote::window {

struct FileWatch::Impl {
  std::function<void()> wake{};
  int notify{-1}, stop{-1};
  std::mutex mutex{};                                    // of what follows
  std::map<int, std::set<std::string>> names{};          // by watch: file names
  std::map<std::pair<int, std::string>, std::string> given{}; // as they were given
  std::set<std::string> changed{};
  std::thread thread{};

  void run();
  void read_events();
};

FileWatch::FileWatch(std::function<void()> wake) : impl_(std::make_unique<Impl>()) {
  impl_->wake = std::move(wake);
  impl_->notify = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  impl_->stop = ::eventfd(0, EFD_CLOEXEC);
  if (impl_->notify >= 0 && impl_->stop >= 0) impl_->thread = std::thread([this] { impl_->run(); });
}

FileWatch::~FileWatch() {
  const std::uint64_t one = 1;
  if (impl_->thread.joinable()) {
    [[maybe_unused]] const auto written = ::write(impl_->stop, &one, sizeof one);
    impl_->thread.join();
  }
  if (impl_->notify >= 0) ::close(impl_->notify);
  if (impl_->stop >= 0) ::close(impl_->stop);
}

void FileWatch::set(const std::vector<std::string>& files) {
  if (impl_->notify < 0) return;
  const std::lock_guard lock(impl_->mutex);
  for (const auto& [watch, names] : impl_->names) ::inotify_rm_watch(impl_->notify, watch);
  impl_->names.clear();
  impl_->given.clear();
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    const int watch = ::inotify_add_watch(impl_->notify, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
    if (watch < 0) continue; // no such folder: nothing will change there
    impl_->names[watch].insert(path.filename().string());
    impl_->given[{watch, path.filename().string()}] = file;
  }
}

std::vector<std::string> FileWatch::take() {
  const std::lock_guard lock(impl_->mutex);
  const std::set<std::string> changed = std::exchange(impl_->changed, {});
  return {changed.begin(), changed.end()};
}

void FileWatch::Impl::run() {
  for (;;) {
    pollfd waits[2] = {{notify, POLLIN, 0}, {stop, POLLIN, 0}};
    if (::poll(waits, 2, -1) < 0) continue;
    if (waits[1].revents != 0) return;
    read_events();
  }
}

void FileWatch::Impl::read_events() {
  alignas(inotify_event) char buffer[8192];
  bool any = false;
  for (ssize_t size = ::read(notify, buffer, sizeof buffer); size > 0; size = ::read(notify, buffer, sizeof buffer)) {
    const std::lock_guard lock(mutex);
    for (ssize_t at = 0; at < size;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      if (event->len == 0) continue;
      const auto found = given.find({event->wd, std::string(event->name)});
      if (found == given.end()) continue;
      changed.insert(found->second);
      any = true;
    }
  }
  if (any) wake();
}

} // namespace mote::window
