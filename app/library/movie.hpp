// SPDX-License-Identifier: MIT
// Pictures into a movie by the program ffmpeg, if there is one: frames go through a pipe as raw pixels, the file is
// written aside and renamed when ffmpeg is done. Which codec is used is ffmpeg's choice by the ending; pictures of
// odd size get a row or column more. A023: ffmpeg is missing, or says why it failed.
#pragma once

#include "core/math/camera.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace mote::app {

[[nodiscard]] bool is_movie(const std::string& path); // .mp4 .mkv .mov .webm .avi .gif

class Movie {
public:
  Movie(const std::string& path, Size2d size, double frames_per_second); // throws Failure A023
  ~Movie();                                                              // without finish(): nothing stays
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;
  void add(std::span<const std::uint8_t> rgba);
  void finish();

private:
  [[noreturn]] void failed(const std::string& why);
  std::string path_, aside_;
  int pipe_{-1};
  int child_{-1};
};

} // namespace mote::app
