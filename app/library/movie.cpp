// SPDX-License-Identifier: MIT
#include "app/library/movie.hpp"

#include "app/codes.hpp"
#include "core/base/diagnostic.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

extern char** environ;

namespace mote::app {
namespace {

std::string ending(const std::string& path) {
  std::string out = std::filesystem::path(path).extension().string();
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

} // namespace

bool is_movie(const std::string& path) {
  static constexpr std::array<std::string_view, 6> endings{".mp4", ".mkv", ".mov", ".webm", ".avi", ".gif"};
  return std::find(endings.begin(), endings.end(), ending(path)) != endings.end();
}

Movie::Movie(const std::string& path, Size2d size, double frames_per_second)
    : path_(path), aside_(fmt::format("{}.part{}{}", path, ::getpid(), ending(path))) {
  std::vector<std::string> words{"ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s",
                                 fmt::format("{}x{}", size.width, size.height), "-r", fmt::format("{}", frames_per_second), "-i", "-"};
  if (ending(path) != ".gif")
    for (const char* word : {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"}) words.emplace_back(word);
  words.push_back(aside_.starts_with('-') ? "./" + aside_ : aside_);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) failed(std::generic_category().message(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  pipe_ = ends[1];
  if (error != 0) {
    ::close(pipe_);
    pipe_ = -1;
    fail(Exit::Failed, code::movie, {path_},
         error == ENOENT ? "movies are made by ffmpeg, which is not installed" : fmt::format("ffmpeg does not start: {}", std::generic_category().message(error)),
         {"apt-get install ffmpeg, or write numbered pictures: -o out_%04d.png"});
  }
  child_ = child;
}

void Movie::failed(const std::string& why) { fail(Exit::Failed, code::movie, {path_}, fmt::format("the movie cannot be made: {}", why)); }

void Movie::add(std::span<const std::uint8_t> rgba) {
  while (!rgba.empty()) {
    const ssize_t written = ::write(pipe_, rgba.data(), rgba.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) failed("ffmpeg has stopped (its message is above)");
    rgba = rgba.subspan(static_cast<std::size_t>(written));
  }
}

void Movie::finish() {
  ::close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {}
  child_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) failed(fmt::format("ffmpeg ended with status {}", WIFEXITED(status) ? WEXITSTATUS(status) : -1));
  std::error_code error;
  std::filesystem::rename(aside_, path_, error);
  if (error) failed(error.message());
}

Movie::~Movie() {
  if (pipe_ >= 0) ::close(pipe_);
  if (child_ >= 0) ::waitpid(child_, nullptr, 0);
  std::error_code ignored;
  std::filesystem::remove(aside_, ignored);
}

} // namespace mote::app
