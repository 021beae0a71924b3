// SPDX-License-Identifier: MIT
// Real files against reference values that VTK and stand-alone decoders read out of them: counts, bounds,
// means, first and last points, the range of each array (of the magnitude for vectors).
#include "core/data/names.hpp"
#include "tests/data_fields/support.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace mote::data::testing {
namespace {

using nlohmann::json;

#define NEEDS_PACK()                                                                                         \
  if (!std::filesystem::exists(pack_file("reference_values.json")))                                          \
  GTEST_SKIP() << "SKIPPED: the pack of real files is not at " << pack_file("").string()

const json& reference() {
  static const json values = json::parse(content_of(pack_file("reference_values.json")));
  return values;
}

void expect_near(double seen, double wanted, double size, const std::string& what) {
  // VTK rounds decimal "float" values to 32 bits, the readers keep the digits of the file.
  EXPECT_NEAR(seen, wanted, 1.2e-7 * std::max(size, std::abs(wanted))) << what;
}

void expect_points(const Frame& frame, const json& wanted) {
  const std::vector<double> p = numbers_of(frame, "position");
  ASSERT_EQ(frame.count, wanted["count"].get<std::uint64_t>());
  for (std::size_t k = 0; k < 3; ++k) {
    double least = INFINITY, most = -INFINITY, sum = 0;
    for (std::size_t i = k; i < p.size(); i += 3)
      least = std::min(least, p[i]), most = std::max(most, p[i]), sum += p[i];
    const double size = most - least;
    expect_near(least, wanted["min"][k], size, "min");
    expect_near(most, wanted["max"][k], size, "max");
    // the reference summed some files in 32 bits
    EXPECT_NEAR(sum / static_cast<double>(frame.count), wanted["mean"][k].get<double>(), 1e-6 * size + 1e-12)
        << "mean " << k;
    expect_near(p[k], wanted["first"][k], size, "first");
    expect_near(p[p.size() - 3 + k], wanted["last"][k], size, "last");
  }
}

void expect_array(const Frame& frame, const std::string& name, const json& wanted) {
  const auto components = wanted["components"].get<std::uint32_t>();
  const Column* column = frame.find(canonical_name(name, components));
  ASSERT_NE(column, nullptr) << name;
  EXPECT_EQ(column->components, components);
  EXPECT_EQ(column->type(), wanted["type"].get<std::string>().find("int") != std::string::npos
                                ? ColumnType::Int
                                : ColumnType::Double);
  double least = INFINITY, most = -INFINITY;
  for (std::uint64_t r = 0; r < column->rows(); ++r) {
    double square = 0;
    for (std::uint32_t k = 0; k < components; ++k) square += column->number(r, k) * column->number(r, k);
    const double value = components == 1 ? column->number(r) : std::sqrt(square);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  expect_near(least, wanted["range"][0], most, name + " least");
  expect_near(most, wanted["range"][1], 0, name + " most");
}

class VtkFile : public ::testing::TestWithParam<std::string> {};

TEST_P(VtkFile, AgreesWithVtk) {
  NEEDS_PACK();
  const json& wanted = reference().at(GetParam());
  const Frame frame = open(pack_file(GetParam()))->read(0);
  if (!wanted.contains("dims") || GetParam() != "flow/cth.vtr") expect_points(frame, wanted);
  std::size_t arrays = 1;
  for (const auto& [name, array] : wanted["arrays"].items()) {
    const bool of_points = name.starts_with("point:");
    if (!of_points && GetParam() != "flow/cth.vtr") continue;
    expect_array(frame, name.substr(name.find(':') + 1), array);
    ++arrays;
  }
  const std::size_t texts = GetParam() == "flow/uniform-001371-5x5x5.vtp" ? 1 : 0;
  EXPECT_EQ(frame.columns.size(), arrays + texts);
}

INSTANTIATE_TEST_SUITE_P(
    Pack, VtkFile,
    ::testing::Values("flow/SurfaceVectors.vtk", "flow/blow.vtk", "flow/cth.vtr",
                      "flow/cylinder_flow_gerris.vti", "flow/disk_out_ref_surface.vtp", "flow/fire_ug.vtu",
                      "flow/heart.vti", "flow/office.binary.vtk", "flow/track1.binary.vtk",
                      "flow/uniform-001371-5x5x5.vtp", "mesh/cow.vtp", "mesh/fran_cut.vtk",
                      "sph/bunny_frame_14_7705_particles.vtk", "sph/cube_2366_particles.vtk",
                      "sph/double_dam_break_frame_01_4732_particles.vtk",
                      "sph/double_dam_break_frame_26_4732_particles.vtk", "sph/fluid_250_particles.vtu",
                      "sph/fluid_encoded_250_particles.vtu", "sph/free_particles_1000_particles.vtk",
                      "sph/hilbert2_18856_particles.vtk", "sph/sailors_knot_19539_particles.vtk"));

// Only cell data: the particles are the centers of its 128 x 64 x 64 cells.
TEST(PackVtr, CellCenters) {
  NEEDS_PACK();
  const auto source = open(pack_file("flow/cth.vtr"));
  const Frame frame = source->read(0);
  ASSERT_EQ(frame.count, 128u * 64 * 64);
  EXPECT_TRUE(source->warnings().has("D072"));
  const std::vector<double> p = numbers_of(frame, "position");
  EXPECT_DOUBLE_EQ(p[0], -7.445310115814209); // the steps differ
  EXPECT_DOUBLE_EQ(p[1], -2.953125);
  EXPECT_DOUBLE_EQ(p[p.size() - 1], 2.9375);
}

TEST(PackVtp, StringArrayIsText) {
  NEEDS_PACK();
  const Frame frame = open(pack_file("flow/uniform-001371-5x5x5.vtp"))->read(0);
  const auto text = std::find_if(frame.columns.begin(), frame.columns.end(),
                                 [](const Column& c) { return c.type() == ColumnType::Text; });
  ASSERT_NE(text, frame.columns.end());
  EXPECT_EQ(text->rows(), 1371u);
  EXPECT_FALSE(std::get<TextColumn>(text->values).at(0).empty());
}

// Both encodings of one SPH frame hold the same numbers.
TEST(PackVtu, RawZlibEqualsBase64) {
  NEEDS_PACK();
  const Frame a = open(pack_file("sph/fluid_250_particles.vtu"))->read(0);
  const Frame b = open(pack_file("sph/fluid_encoded_250_particles.vtu"))->read(0);
  for (const char* name : {"position", "velocity", "density", "pressure", "id"})
    EXPECT_EQ(numbers_of(a, name), numbers_of(b, name)) << name;
}

class BgeoFile : public ::testing::TestWithParam<std::string> {};

TEST_P(BgeoFile, AgreesWithTheReference) {
  NEEDS_PACK();
  const json& wanted = reference().at(GetParam());
  const Frame frame = open(pack_file(GetParam()))->read(0);
  expect_points(frame, wanted);
  EXPECT_EQ(frame.columns.size(), wanted["attributes"].size() + 1);
  for (const json& attribute : wanted["attributes"]) {
    const Column* column = frame.find(canonical_name(attribute[0].get<std::string>(), attribute[1]));
    ASSERT_NE(column, nullptr) << attribute;
    EXPECT_EQ(column->components, attribute[1].get<std::uint32_t>());
    const std::string type = attribute[2];
    EXPECT_EQ(column->type(), type == "int"                         ? ColumnType::Int
                              : type == "float" || type == "vector" ? ColumnType::Double
                                                                    : ColumnType::Text)
        << attribute;
  }
}

INSTANTIATE_TEST_SUITE_P(Pack, BgeoFile,
                         ::testing::Values("sph/dam_break_frame_9_6859_particles.bgeo",
                                           "sph/octocat_32614_particles.bgeo", "sph/reindeer.bgeo"));

TEST(PackBgeo, Values) {
  NEEDS_PACK();
  const Frame frame = open(pack_file("sph/dam_break_frame_9_6859_particles.bgeo"))->read(0);
  const std::vector<double> density = numbers_of(frame, "density"), id = numbers_of(frame, "id"),
                            v = numbers_of(frame, "velocity");
  EXPECT_DOUBLE_EQ(*std::min_element(density.begin(), density.end()),
                   278.2429504394531); // a stand-alone decoder's
  EXPECT_DOUBLE_EQ(*std::max_element(density.begin(), density.end()), 1049.8309326171875);
  EXPECT_EQ(id[0], 30);
  EXPECT_EQ(id.back(), 6489);
  EXPECT_DOUBLE_EQ(v.back(), 0.013067423366010189);
}

struct OvfCase {
  std::string file{}, column{};
  std::uint64_t count{};
  double least{}, most{}, mean{}; // magnitudes; mean of all components
  std::vector<double> first{}, last{};
};

// Numbers of a stand-alone decoder; those of stdprob3 are in the file's own header, too.
TEST(PackOvf, TextAndBinaryOfBothVersions) {
  NEEDS_PACK();
  const std::vector<OvfCase> cases{{"magnetic/oommf-ovf2-bin8.omf",
                                    "Magnetization",
                                    125,
                                    7999999.999999998,
                                    8000000.000000002,
                                    2651410.710051373,
                                    {7826205.191224749, 1172713.1580553013, 1172713.159204221},
                                    {7826205.191224749, 1172713.1580553013, 1172713.159204221}},
                                   {"magnetic/skyrmion-disk.omf",
                                    "Magnetization",
                                    800,
                                    0,
                                    1100000.0000000047,
                                    186810.59419643786,
                                    {0, 0, 0},
                                    {0, 0, 0}},
                                   {"magnetic/stdprob3_32x32x32_bin4.omf",
                                    "magnetization",
                                    32768,
                                    1261566.1929034186,
                                    1261566.328412675,
                                    -147199.67594719818,
                                    {-212694.859375, -966110.0625, 782905.9375},
                                    {-252579.5625, 442315.71875, -1154170.625}}};
  for (const OvfCase& test : cases) {
    const Frame frame = open(pack_file(test.file))->read(0);
    ASSERT_EQ(frame.count, test.count) << test.file;
    const std::vector<double> v = numbers_of(frame, test.column);
    ASSERT_EQ(v.size(), 3 * test.count);
    double least = INFINITY, most = 0, sum = 0;
    for (std::size_t i = 0; i < v.size(); i += 3) {
      const double magnitude = std::hypot(v[i], v[i + 1], v[i + 2]);
      least = std::min(least, magnitude), most = std::max(most, magnitude), sum += v[i] + v[i + 1] + v[i + 2];
    }
    EXPECT_NEAR(least, test.least, 1e-3);
    EXPECT_NEAR(most, test.most, 1e-3);
    EXPECT_NEAR(sum / static_cast<double>(v.size()), test.mean, 1e-3);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_DOUBLE_EQ(v[k], test.first[k]);
      EXPECT_DOUBLE_EQ(v[v.size() - 3 + k], test.last[k]);
    }
    EXPECT_EQ(frame.find(test.column)->unit, "A/m");
    EXPECT_EQ(frame.find("position")->unit, "m");
  }
}

TEST(PackOvf, NodesAreWhereTheHeaderSays) {
  NEEDS_PACK();
  const std::vector<double> p =
      numbers_of(open(pack_file("magnetic/skyrmion-disk.omf"))->read(0), "position");
  EXPECT_DOUBLE_EQ(p[0], -4.75e-08);
  EXPECT_NEAR(p[3] - p[0], 5e-9, 1e-20);
  EXPECT_NEAR(p[p.size() - 1], 7.5e-9, 1e-20);
}

class MeshFile : public ::testing::TestWithParam<std::string> {};

TEST_P(MeshFile, AgreesWithTheReference) {
  NEEDS_PACK();
  const json& wanted = reference().at(GetParam());
  const Frame frame = open(pack_file(GetParam()))->read(0);
  expect_points(frame, wanted);
  EXPECT_EQ(frame.find("normal") != nullptr, wanted.value("normals", 0) > 0) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Pack, MeshFile,
                         ::testing::Values("mesh/bunny.off", "mesh/fandisk.obj", "mesh/spot.obj",
                                           "mesh/suzanne.obj", "mesh/teapot.obj",
                                           "protein/1crn_surface.obj"));

TEST(PackStl, SixtyFourDifferentCorners) {
  NEEDS_PACK();
  const Frame frame = open(pack_file("mesh/humanoid_tri.stl"))->read(0);
  EXPECT_EQ(frame.count, 64u);
  const std::vector<double> p = numbers_of(frame, "position"), n = numbers_of(frame, "normal");
  EXPECT_THAT(std::vector<double>(p.begin(), p.begin() + 3), ::testing::ElementsAre(3.25, -2.48, 14.0));
  EXPECT_THAT(std::vector<double>(p.end() - 3, p.end()), ::testing::ElementsAre(0.795, 2.45, 3.05));
  for (std::size_t i = 0; i < n.size(); i += 3) EXPECT_NEAR(std::hypot(n[i], n[i + 1], n[i + 2]), 1.0, 1e-12);
}

TEST(PackXz, EqualsThePlainTrajectory) {
  NEEDS_PACK();
  const auto packed = open(pack_file("md/water.xyz.xz")), plain = open(pack_file("md/water.xyz"));
  EXPECT_EQ(packed->format(), "xyz");
  ASSERT_EQ(packed->frame_count(), 100u);
  for (const std::uint64_t f : {0, 57, 99})
    EXPECT_EQ(numbers_of(packed->read(f), "position"), numbers_of(plain->read(f), "position"));
}

// Raw files of the pack under a description written next to nothing: paths are absolute here.
class PackRaw : public ::testing::Test {
protected:
  static Frame read(const std::string& text) { return read_memory("pack.toml", "mote_raw = 1\n" + text); }
  static std::string path(const std::string& name) {
    return "path = '" + std::filesystem::absolute(pack_file(name)).string() + "'\n";
  }
};

TEST_F(PackRaw, GalaxyOfTwoKindsOfRecords) {
  NEEDS_PACK();
  const Frame frame = read("[[file]]\n" + path("nbody/galaxy_20K.bin") +
                           "header = 32\n"
                           "[[file.records]]\nname = 'dark'\ncount = 2500\nlayout = ['mass f4', 'pos f4 3', "
                           "'vel f4 3', 'eps f4', 'id i4']\n"
                           "[[file.records]]\nname = 'star'\nlayout = ['mass f4', 'pos f4 3', 'vel f4 3', "
                           "'metals f4', 'tform f4', 'eps f4', 'id i4']\n");
  const json& wanted = reference().at("nbody/galaxy_20K.bin");
  expect_points(frame, wanted);
  const std::vector<double> mass = numbers_of(frame, "mass"), v = numbers_of(frame, "velocity"),
                            metals = numbers_of(frame, "metals");
  EXPECT_DOUBLE_EQ(*std::min_element(mass.begin(), mass.end()), wanted["mass"][0].get<double>());
  EXPECT_DOUBLE_EQ(*std::max_element(mass.begin(), mass.end()), wanted["mass"][1].get<double>());
  double most = 0;
  for (std::size_t i = 0; i < v.size(); i += 3) most = std::max(most, std::hypot(v[i], v[i + 1], v[i + 2]));
  EXPECT_NEAR(most, wanted["speed"][1].get<double>(), 1e-9);
  EXPECT_TRUE(std::isnan(metals[2499]));
  EXPECT_EQ(metals[2500], 0.0);
  EXPECT_EQ(numbers_of(frame, "id")[0], 200000000.0);
  EXPECT_EQ(frame.find("id")->type(), ColumnType::Int);
  const auto& kinds = std::get<TextColumn>(frame.find("type")->values);
  EXPECT_EQ(kinds.at(2499), "dark");
  EXPECT_EQ(kinds.at(2500), "star");
}

TEST_F(PackRaw, PackedSpheres) {
  NEEDS_PACK();
  for (const std::string name : {"dem/packing_equilibrated.xyzd", "dem/packing_initial.xyzd"}) {
    const Frame frame = read("box = [20.0823593086113, 20.0823593086113, 20.0823593086113]\n[[file]]\n" +
                             path(name) + "layout = ['position f8 3', 'diameter f8']\n");
    const json& wanted = reference().at(name);
    expect_points(frame, wanted);
    EXPECT_DOUBLE_EQ(numbers_of(frame, "radius")[9999], wanted["diameter"][1].get<double>() / 2);
    EXPECT_DOUBLE_EQ(frame.box->edges[1][1], 20.0823593086113);
  }
}

TEST_F(PackRaw, SmokeOfTwoFiles) {
  NEEDS_PACK();
  const Frame frame = read(
      "[[file]]\n" + path("nbody/smoke_pos_float4.bin") + "layout = ['position f4 3', '- f4']\n[[file]]\n" +
      path("nbody/smoke_vel_float4.bin") + "layout = ['velocity f4 3', 'lifetime f4']\n");
  expect_points(frame, reference().at("nbody/smoke_pos_float4.bin"));
  EXPECT_EQ(frame.columns.size(), 3u);
  const std::vector<double> v = numbers_of(frame, "velocity"), lifetime = numbers_of(frame, "lifetime");
  EXPECT_DOUBLE_EQ(v[0], reference().at("nbody/smoke_vel_float4.bin")["first"][0].get<double>());
  EXPECT_DOUBLE_EQ(*std::max_element(lifetime.begin(), lifetime.end()), 100.0);
}

TEST_F(PackRaw, PoreNetworkOfTwoTextFiles) {
  NEEDS_PACK();
  const Frame frame = read("[[file]]\n" + path("porenetwork/Berea_node1.dat") +
                           "kind = 'text'\nheader = 1\nlayout = ['id integer', 'position real 3 m', "
                           "'coordination integer']\n[[file]]\n" +
                           path("porenetwork/Berea_node2.dat") +
                           "kind = 'text'\nlayout = ['id integer', 'volume real', 'radius real 1 m', "
                           "'shape_factor real', 'clay_volume real']\n");
  expect_points(frame, reference().at("porenetwork/Berea_node1.dat"));
  EXPECT_EQ(frame.find("position")->unit, "m");
  const std::vector<double> radius = numbers_of(frame, "radius"), volume = numbers_of(frame, "volume");
  EXPECT_DOUBLE_EQ(radius.front(), 8.992342e-06);
  EXPECT_DOUBLE_EQ(radius.back(), 4.970332e-06);
  double sum = 0;
  for (const double v : volume) sum += v;
  EXPECT_NEAR(sum, 1.702398406457002e-09, 1e-18);
  EXPECT_EQ(numbers_of(frame, "id").back(), 6298);
}

} // namespace
} // namespace mote::data::testing
