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

std::string CommandTest::gallery_without(const std::vector<std::string>& words) const {
  const std::string scenes = MOTE_SOURCE_DIR "/app/scenes/";
  std::ifstream file(scenes + "gallery.toml");
  std::string all((std::istreambuf_iterator<char>(file)), {}), kept;
  const auto point = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = all.find(from, at)) != std::string::npos; at += to.size()) all.replace(at, from.size(), to);
  };
  point("\"data/", "\"" + scenes + "data/");
  point("\"gallery_graph", "\"" + scenes + "gallery_graph");
  point("\"../types", "\"" + scenes + "../types");
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t next = std::min(all.find("[[data]]", at + 1), all.size());
    const std::string part = all.substr(at, next - at);
    if (at == 0 || std::none_of(words.begin(), words.end(), [&](const std::string& word) { return part.find(word) != std::string::npos; })) kept += part;
    at = next;
  }
  write("gallery.toml", kept);
  return (folder / "gallery.toml").string();
}

std::string CommandTest::read(const std::string& name) const {
  std::ifstream file(folder / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace mote::test
