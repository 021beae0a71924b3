// SPDX-License-Identifier: MIT
// Tells when files change on the disk. A thread sleeps in the kernel (inotify) and costs nothing while nothing happens; it
// watches folders, because programs replace files as often as they write them. Linux; elsewhere nothing is told.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mote::window {

class FileWatch {
public:
  // `wake` is called from the thread when there is something to take().
  explicit FileWatch(std::function<void()> wake);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  // From now on these files; what was watched before is not.
  void set(const std::vector<std::string>& files);
  // Those that changed since the last call, each once.
  std::vector<std::string> take();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace mote::window
