// SPDX-License-Identifier: MIT
// Runs the command line as a user does: words in, exit status and both streams out. Every test has a
// folder of its own, which is also the working folder and holds the caches.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mote::test {

struct Ran {
  int exit{};
  std::string out{}, err{};
};

class CommandTest : public ::testing::Test {
protected:
  void SetUp() override;
  void TearDown() override;
  // `words` as a shell reads them, with "mote" before; `environment` like "A=b C=d".
  [[nodiscard]] Ran mote(const std::string& words, const std::string& environment = "") const;
  [[nodiscard]] Ran shell(const std::string& command) const; // $MOTE is the program
  void write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  // The path of the shipped gallery, copied without the data sets whose text has one of the words.
  [[nodiscard]] std::string gallery_without(const std::vector<std::string>& words) const;
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder / name); }

  std::filesystem::path folder;
};

} // namespace mote::test
