// SPDX-License-Identifier: MIT
// Builds without HDF5 know such a file when they see one, and say what is missing.
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

namespace mote::data {
namespace {

TEST(WithoutHdf5, SaysWhatIsMissing) {
  std::string file("\x89HDF\r\n\x1a\n", 8);
  file.append(100, '\0');
  const Diagnostic d = test::failure_of_text(file, "h5");
  EXPECT_EQ(d.code, "D042");
  EXPECT_THAT(to_string(d), testing::HasSubstr("-DMOTE_HDF5=ON"));
}

} // namespace
} // namespace mote::data
