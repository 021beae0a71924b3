// SPDX-License-Identifier: MIT
#include "run_mote.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace mote::test {

void CommandTest::SetUp() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(info->test_suite_name()) + "_" + info->name();
  std::replace(name.begin(), name.end(), '/', '_');
  folder = std::filesystem::temp_directory_path() / ("mote_" + name + "_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
}

void CommandTest::TearDown() { std::filesystem::remove_all(folder); }

Ran CommandTest::shell(const std::string& command) const {
  const std::string full = "cd '" + folder.string() + "' && export XDG_CACHE_HOME=\"$PWD/cache\" MOTE='" MOTE_COMMAND "' && unset DISPLAY WAYLAND_DISPLAY OCIO; { " +
                           command + "\n} >.stdout 2>.stderr";
  const int status = std::system(full.c_str());
  Ran ran;
  ran.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ran.out = read(".stdout");
  ran.err = read(".stderr");
  return ran;
}

Ran CommandTest::mote(const std::string& words, const std::string& environment) const {
  return shell(environment + " \"$MOTE\" " + words);
}

void CommandTest::write(const std::string& name, const std::string& text) const {
  std::filesystem::create_directories((folder / name).parent_path());
  std::ofstream(folder / name, std::ios::binary) << text;
}

std::string CommandTest::read(const std::string& name) const {
  std::ifstream file(folder / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace mote::test
