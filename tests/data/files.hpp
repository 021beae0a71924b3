// SPDX-License-Identifier: MIT
// Where the files of the tests are: a few beside the tests, the large ones in a reference pack that may
// be missing, and a folder for files that a test writes.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace mote::data::test {

inline std::filesystem::path fixture(std::string_view name) {
  return std::filesystem::path(MOTE_SOURCE_DIR) / "tests/data/files" / name;
}
inline std::filesystem::path pack() {
  return std::filesystem::path(MOTE_SOURCE_DIR).parent_path() / "shared/data";
}

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in.good()) << file;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A folder that goes away with the test.
class Folder {
public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "mote-data-XXXXXX").string();
    path_ = ::mkdtemp(name.data()) ? name : std::string{};
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  std::filesystem::path write(std::string_view name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

private:
  std::filesystem::path path_;
};

} // namespace mote::data::test

#define MOTE_NEED_PACK()                                                                                     \
  if (!std::filesystem::exists(mote::data::test::pack() / "reference_values.json"))                          \
  GTEST_SKIP() << "NOT TESTED: the reference pack is missing: " << mote::data::test::pack()
