// SPDX-License-Identifier: MIT
#include "core/image/exr.hpp"
#include "tests/image/scratch.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace {
using namespace mote;
using mote::test::failure_of;
using testing::Contains;
using testing::HasSubstr;
using testing::Pair;
using ExrTest = mote::test::Scratch;

constexpr std::uint32_t width = 61, height = 37;

TEST_F(ExrTest, KeepsEveryChannel) {
  std::vector<float> rgba(width * height * 4), depth(width * height);
  std::vector<std::uint32_t> id(width * height);
  for (std::size_t i = 0; i < rgba.size(); ++i)
    rgba[i] = static_cast<float>(i) / 4096.0f - 0.25f; // halves at 1/4096 up to 1
  for (std::size_t i = 0; i < depth.size(); ++i) {
    depth[i] = i % 5 == 0 ? std::numeric_limits<float>::infinity() : 1.0f / static_cast<float>(i);
    id[i] = static_cast<std::uint32_t>(i) * 2654435761u;
  }
  write_exr(at("a.exr"), width, height,
            {{.name = "R", .type = ExrType::Float, .floats = &rgba[0], .stride = 4},
             {.name = "B", .type = ExrType::Half, .floats = &rgba[2], .stride = 4},
             {.name = "Z", .type = ExrType::Float, .floats = depth.data()},
             {.name = "id", .type = ExrType::Uint, .uints = id.data()},
             {.name = "normal.X", .type = ExrType::Float, .floats = &rgba[1], .stride = 4}},
            {{"software", "mote"}, {"scene", "a.toml"}});
  const ExrPicture back = read_exr(at("a.exr"));
  EXPECT_EQ(back.width, width);
  EXPECT_EQ(back.height, height);
  ASSERT_EQ(back.channels.size(), 5u);
  EXPECT_EQ(back.find("Z")->floats, depth);
  EXPECT_EQ(back.find("id")->uints, id);
  EXPECT_EQ(back.find("id")->type, ExrType::Uint);
  EXPECT_EQ(back.find("B")->type, ExrType::Half);
  EXPECT_EQ(back.find("absent"), nullptr);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    EXPECT_EQ(back.find("R")->floats[i], rgba[4 * i]);
    EXPECT_EQ(back.find("normal.X")->floats[i], rgba[4 * i + 1]);
    EXPECT_NEAR(back.find("B")->floats[i], rgba[4 * i + 2],
                std::max(1e-6, std::fabs(rgba[4 * i + 2]) / 2048.0));
  }
  EXPECT_THAT(back.attributes, Contains(Pair("software", "mote")));
  EXPECT_THAT(back.attributes, Contains(Pair("scene", "a.toml")));
}

TEST_F(ExrTest, KeepsHalvesFinite) {
  const std::vector<float> values{1e6f, -1e6f, std::numeric_limits<float>::infinity(), 65504.0f};
  write_exr(at("a.exr"), 4, 1, {{.name = "R", .type = ExrType::Half, .floats = values.data()}});
  const auto back = read_exr(at("a.exr")).channels[0].floats;
  EXPECT_EQ(back,
            (std::vector<float>{65504.0f, -65504.0f, std::numeric_limits<float>::infinity(), 65504.0f}));
}

TEST_F(ExrTest, RefusesWhatCannotBeStored) {
  const std::vector<float> v(4);
  const ExrPlane r{.name = "R", .floats = v.data()};
  EXPECT_EQ(failure_of(Exit::Failed, [&] { write_exr(at("a.exr"), 0, 4, {r}); }).code, "I008");
  EXPECT_EQ(failure_of(Exit::Failed, [&] { write_exr(at("a.exr"), 4, 1, {}); }).code, "I008");
  EXPECT_THAT(failure_of(Exit::Failed,
                         [&] {
                           write_exr(at("a.exr"), 4, 1, {r, r});
                         })
                  .text,
              HasSubstr("'R' has no name of its own"));
  EXPECT_EQ(
      failure_of(Exit::Failed, [&] { write_exr(at("a.exr"), 4, 1, {{.name = "id", .type = ExrType::Uint}}); })
          .code,
      "I008");
  {
    const mote::test::FileSizeLimit limit(16); // a full disk
    EXPECT_EQ(failure_of(Exit::Failed, [&] { write_exr(at("a"), 4, 1, {r}); }).code, "I002");
  }
  EXPECT_EQ(failure_of(Exit::Failed, [&] { write_exr(at("none/a.exr"), 4, 1, {r}); }).code, "I001");
  EXPECT_EQ(files(), 0u);
}

TEST_F(ExrTest, NamesWhatIsBroken) {
  const std::vector<float> v(64 * 64, 0.5f);
  write_exr(at("a.exr"), 64, 64, {{.name = "R", .floats = v.data()}});
  const std::string good = content("a.exr");
  for (const std::size_t n : {0ul, 3ul, 40ul, good.size() / 2, good.size() - 5}) {
    put("b.exr", good.substr(0, n));
    const Diagnostic d = failure_of(Exit::BadInput, [&] { read_exr(at("b.exr")); });
    EXPECT_EQ(d.code, "I006") << n;
    EXPECT_THAT(d.text, HasSubstr("no readable EXR picture"));
  }
  EXPECT_EQ(failure_of(Exit::BadInput, [&] { read_exr(at("none.exr")); }).code, "I004");
}
} // namespace
