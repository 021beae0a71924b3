// SPDX-License-Identifier: MIT
// Particle types from folders, as a user meets them: scene, --type, what is told when something is wrong.
#include "run_mote.hpp"

#include "core/image/npy.hpp"

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* toml = "name = \"ball\"\n[attributes.size]\nunit = \"length\"\n";
constexpr const char* glsl = R"(real3 bound(Shape s) { return real3(s.size); }
real inside(Shape s, real3 p) { return length(p) - s.size; }
real3 surface(Shape s, real3 p) { return p; }
bool hit(Shape s, real3 o, real3 d, out real t_in, out real t_out) {
  real h2 = (s.size * s.size - dot(o, o)) / dot(d, d);
  t_out = sqrt(max(h2, real(0.0)));
  t_in = -t_out;
  return h2 > real(0.0);
}
)";

class Types : public CommandTest {
protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::filesystem::create_directory(folder / "ball");
    write("ball/type.toml", toml);
    write("ball/type.glsl", glsl);
    write("two.csv", "x,y,z,radius,size\n0,0,0,1,1\n3,0,0,1,0.5\n");
    write("bare.csv", "x,y,z,radius,width\n0,0,0,1,1\n3,0,0,1,0.5\n");
    write("scene.toml", scene);
  }
  void change(const std::string& from, const std::string& to) {
    std::string text = glsl;
    ASSERT_NE(text.find(from), std::string::npos);
    write("ball/type.glsl", text.replace(text.find(from), from.size(), to));
  }
  [[nodiscard]] std::size_t seen(const std::string& file, std::uint32_t id) const {
    const auto ids = read_npy((folder / file).string()).values<std::uint32_t>();
    return static_cast<std::size_t>(std::count(ids.begin(), ids.end(), id));
  }
  const std::string camera = "[camera]\neye = [1.5, -10, 0]\ntarget = [1.5, 0, 0]\nfov_y = 30\n";
  const std::string scene = "schema = 1\nparticle_types = [\"ball\"]\n" + camera + "[[data]]\nfile = \"two.csv\"\ntype = \"ball\"\n[[data]]\nfile = \"two.csv\"\nradius = 0.2\ntransform = [ { translate = [0, 0, 1.5] } ]\n";
};

TEST_F(Types, AreDrawnFromASceneAndByTheCommandLine) {
  const Ran ran = mote("render scene.toml --size 120x80 --aov id=id.npy -o out.png");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_GT(seen("id.npy", 0), 3 * seen("id.npy", 1));
  EXPECT_GT(seen("id.npy", 1), 20u);
  const Ran alone = mote("render two.csv --type ball --size 120x80 --aov id=alone.npy --expansion compute");
  ASSERT_EQ(alone.exit, 0) << alone.err;
  EXPECT_GT(seen("alone.npy", 0), 3 * seen("alone.npy", 1));
  const Ran spheres = mote("render two.csv --size 120x80 --aov id=spheres.npy");
  ASSERT_EQ(spheres.exit, 0) << spheres.err;
  EXPECT_LT(seen("spheres.npy", 0), 2 * seen("spheres.npy", 1));
}

TEST_F(Types, OneThatDoesNotCompileLeavesTheRest) {
  change("return p; }", "return q; }");
  const Ran ran = mote("render scene.toml --size 120x80 --aov id=id.npy -o out.png");
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("ball/type.glsl:3"), HasSubstr("error P022"), HasSubstr("'q' : undeclared identifier")));
  EXPECT_TRUE(exists("out.png"));
  EXPECT_GT(seen("id.npy", 0), 5u) << "the spheres are there";
}

TEST_F(Types, WhatIsMissingIsNamed) {
  const Ran missing = mote("render bare.csv --type ball -o out.png");
  EXPECT_EQ(missing.exit, 3);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("error S021"), HasSubstr("'size'"), HasSubstr("width")));
  const Ran said = mote("render bare.csv --type ball --set 'data[0].attributes={ size = \"width\" }' --size 60x40 -o out.png");
  EXPECT_EQ(said.exit, 0) << said.err;
  const Ran unknown = mote("render two.csv --type ball --set 'data[0].attributes={ sice = 1 }' -o no.png");
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("error S003"), HasSubstr("Did you mean 'size'?")));
  const Ran folder_gone = mote("render two.csv --type bal -o no.png");
  EXPECT_NE(folder_gone.exit, 0);
  EXPECT_THAT(folder_gone.err, HasSubstr("error S063"));
  EXPECT_FALSE(exists("no.png"));
}

TEST_F(Types, NaNAndWrongBoundsAreCounted) {
  change("max(h2, real(0.0))", "h2 - real(0.1)");
  const Ran nan = mote("render scene.toml --size 60x40 -o out.png");
  EXPECT_EQ(nan.exit, 0);
  EXPECT_THAT(nan.err, AllOf(HasSubstr("warning S064"), HasSubstr("NaN"), HasSubstr("of 2 particles")));
  change("return real3(s.size)", "return real3(s.size * real(0.4))");
  EXPECT_THAT(mote("render scene.toml --size 60x40 -o out.png").err, HasSubstr("bound() leaves out"));
  change("t_in = -t_out", "t_in = -t_out * real(0.7)");
  EXPECT_THAT(mote("render scene.toml --size 60x40 -o out.png").err, HasSubstr("do not agree"));
}

TEST_F(Types, TypeTomlIsChecked) {
  const auto said = [&](const std::string& text) {
    write("ball/type.toml", text);
    const Ran ran = mote("render scene.toml -o out.png");
    EXPECT_EQ(ran.exit, 3);
    return ran.err;
  };
  EXPECT_THAT(said("name = \"sphere\"\n[attributes.size]\n"), AllOf(HasSubstr("type.toml:1"), HasSubstr("S063"), HasSubstr("'sphere' is no name")));
  EXPECT_THAT(said("name = \"ball\"\n"), AllOf(HasSubstr("S007"), HasSubstr("attributes")));
  EXPECT_THAT(said("name = \"ball\"\n[attributes.size]\nunit = \"meter\"\n"), AllOf(HasSubstr("S006"), HasSubstr("length")));
  EXPECT_THAT(said("name = \"ball\"\n[attributes.a]\n[attributes.b]\n[attributes.c]\n[attributes.d]\n"), HasSubstr("at most 3"));
  EXPECT_THAT(said("name = [\n"), HasSubstr("type.toml"));
}

TEST_F(Types, InfoAndKindsKnowThem) {
  const Ran info = mote("info bare.csv --type ball");
  EXPECT_EQ(info.exit, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("type ball"), HasSubstr("size"), HasSubstr("in no file, and without a default")));
  const Ran kinds = mote("graph --kinds --type ball");
  EXPECT_EQ(kinds.exit, 0) << kinds.err;
  EXPECT_THAT(kinds.out, HasSubstr("ball        compute     yes"));
  EXPECT_THAT(mote("graph --kinds").out, Not(HasSubstr("ball ")));
}

// Two chains by the rows' order, one row of which a selection takes out; and what density says beside alpha.
TEST_F(Types, PolylinesAndDensity) {
  write("line.csv", "x,y,z,chain,radius\n0,0,0,1,0.2\n0,0,1,2,0.2\n3,0,0,1,0.2\n3,0,1,2,0.2\n");
  write("line.toml", "schema = 1\n" + camera + "[[data]]\nfile = \"line.csv\"\ntype = \"polyline\"\n");
  const Ran ran = mote("render line.toml --size 120x80 --aov id=id.npy -o out.png");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_GT(seen("id.npy", 0), 100u);
  EXPECT_GT(seen("id.npy", 1), 100u);
  EXPECT_EQ(seen("id.npy", 2) + seen("id.npy", 3), 0u) << "ends of chains";
  const Ran one = mote("render line.toml --set 'data[0].select=\"chain == 2\"' --size 120x80 --aov id=id.npy -o out.png");
  ASSERT_EQ(one.exit, 0) << one.err;
  EXPECT_EQ(seen("id.npy", 0), 0u);
  EXPECT_GT(seen("id.npy", 1), 100u);
  EXPECT_EQ(mote("render line.toml --set 'data[0].density=0.7' --size 60x40 -o dense.png").exit, 0);
  const Ran both = mote("render line.toml --set 'data[0].density=0.7' --set 'data[0].alpha=0.5' -o no.png");
  EXPECT_EQ(both.exit, 2);
  EXPECT_THAT(both.err, AllOf(HasSubstr("error S015"), HasSubstr("one of them is enough")));
  const Ran chain = mote("render line.toml --set 'data[0].chain=\"chian\"' -o no.png");
  EXPECT_EQ(chain.exit, 2);
  EXPECT_THAT(chain.err, AllOf(HasSubstr("error S021: line.csv has no attribute 'chian'"), HasSubstr("Attributes: position, chain, radius")));
}

} // namespace
} // namespace mote::test
