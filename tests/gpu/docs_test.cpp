// SPDX-License-Identifier: MIT
// docs/gpu.md against the public headers: every object, feature and WebGPU method has its place.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace {

std::string read(const std::string& path) {
  std::ifstream in(std::string(MOTE_SOURCE_DIR) + "/" + path);
  EXPECT_TRUE(in) << path;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::set<std::string> all_matches(const std::string& text, const char* pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

bool mentions(const std::string& docs, const std::string& word) { return docs.find("`" + word + "`") != std::string::npos; }

TEST(GpuDocs, every_object_and_method_is_mentioned) {
  const std::string docs = read("docs/gpu.md"), header = read("core/gpu/gpu.hpp");
  for (const std::string& object : all_matches(header, "MOTE_GPU_OBJECT\\((\\w+)\\);")) {
    EXPECT_TRUE(mentions(docs, object)) << object;
  }
  for (const std::string& method : all_matches(header, "\\n  (?:\\[\\[nodiscard\\]\\] )?(?:static )?[\\w:<>&\\* ]+ (\\w+)\\([^)]*\\)(?: const)?;")) {
    if (method == "bool") continue; // operator bool
    EXPECT_TRUE(mentions(docs, method)) << method;
  }
}

TEST(GpuDocs, every_feature_is_mentioned) {
  const std::string docs = read("docs/gpu.md"), types = read("core/gpu/types.hpp");
  const std::size_t begin = types.find("enum class Feature"), end = types.find("};", begin);
  for (const std::string& feature : all_matches(types.substr(begin, end - begin), "\\n  (\\w+) = [1-9]")) {
    EXPECT_TRUE(mentions(docs, feature)) << feature;
  }
}

} // namespace
