// SPDX-License-Identifier: MIT
// Linked into every test program: on lavapipe with the validation layer on, whatever else the machine
// has and however the program is started, and without the color settings of whoever runs it.
#include <cstdlib>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

[[maybe_unused]] const bool prepared = [] {
  setenv("MOTE_ADAPTER", "llvmpipe", 0);
  setenv("MOTE_VALIDATION", "1", 0);
  std::vector<std::string> ocio;
  for (char** entry = environ; *entry; ++entry) {
    const std::string variable = *entry;
    if (variable.starts_with("OCIO")) ocio.push_back(variable.substr(0, variable.find('=')));
  }
  for (const std::string& name : ocio) unsetenv(name.c_str());
  return true;
}();

} // namespace
