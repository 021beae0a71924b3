// SPDX-License-Identifier: MIT
// `--update` writes the golden files instead of comparing with them; a missing one is a failure.
#include "goldens.hpp"

#include <gmock/gmock.h>

#include <string_view>

namespace mote::rg::test {
bool update_goldens = false;
}

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  for (int i = 1; i < argc; ++i) mote::rg::test::update_goldens |= std::string_view(argv[i]) == "--update";
  return RUN_ALL_TESTS();
}
