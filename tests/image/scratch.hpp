// SPDX-License-Identifier: MIT
// A folder of its own for each test, gone afterwards, and the failure that a call ends with.
#pragma once

#include "core/base/diagnostic.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace mote::test {

class Scratch : public testing::Test {
protected:
  Scratch() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() / (std::string("mote-") + info->test_suite_name() + "-" +
                                                       info->name() + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  ~Scratch() override { std::filesystem::remove_all(folder); }
  std::string at(const std::string& name) const { return (folder / name).string(); }
  std::string content(const std::string& name) const {
    std::ifstream in(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
  }
  std::filesystem::path folder;
};

// Writing above `bytes` fails with EFBIG: a full disk that needs no privileges.
struct FileSizeLimit {
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    old = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old);
  }
  rlimit before{};
  void (*old)(int){};
};

// The diagnostic with its hints appended to the text.
template <class F> Diagnostic failure_of(Exit exit, F&& f) {
  try {
    f();
  } catch (const Failure& failure) {
    EXPECT_EQ(static_cast<int>(failure.exit()), static_cast<int>(exit));
    Diagnostic d = failure.diagnostic();
    for (const std::string& hint : d.hints) d.text += "\n" + hint;
    return d;
  }
  ADD_FAILURE() << "no failure";
  return {};
}

} // namespace mote::test
