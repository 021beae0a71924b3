// SPDX-License-Identifier: MIT
// Files of other programs against readings of other programs (ASE, MDAnalysis, gsd): counts, boxes,
// first and last positions, extents, records. Skipped loudly when the reference pack is not there.
#include "tests/data_molecular/support.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <set>

namespace mote::data::test {
namespace {

using nlohmann::json;

const json& truth(const std::string& file) {
  static const json all = json::parse(content_of(pack() / "reference_values.json"));
  return all.at(file);
}
glm::dvec3 vec(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }
void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance, const std::string& what) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << what << " axis " << k;
}

// Positions times `scale` against count, first, last, min, max, mean; `turn` is applied before.
void expect_positions(const Frame& frame, const json& want, double scale, double tolerance,
                      const glm::dmat4& turn = glm::dmat4(1.0)) {
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, want.at("count").get<std::uint64_t>());
  glm::dvec3 low(1e300), high(-1e300), sum(0);
  auto at = [&](std::uint64_t row) {
    return glm::dvec3(turn * glm::dvec4(vector_at(frame, "position", row) * scale, 1));
  };
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    low = glm::min(low, at(row));
    high = glm::max(high, at(row));
    sum += at(row);
  }
  expect_near(at(0), vec(want["first"]), tolerance, "first");
  expect_near(at(frame.count - 1), vec(want["last"]), tolerance, "last");
  expect_near(low, vec(want["min"]), tolerance, "min");
  expect_near(high, vec(want["max"]), tolerance, "max");
  expect_near(sum / static_cast<double>(frame.count), vec(want["mean"]), 10 * tolerance, "mean");
}
void expect_cell(const Frame& frame, const json& rows, double scale) {
  ASSERT_TRUE(frame.box);
  for (int k = 0; k < 3; ++k)
    expect_near(frame.box->edges[k] * scale, vec(rows[static_cast<std::size_t>(k)]), 1e-9, "cell");
}
std::uint64_t numbers(const Frame& frame, std::string_view column) {
  std::uint64_t count = 0;
  for (std::uint64_t row = 0; row < frame.count; ++row) count += !std::isnan(frame.find(column)->number(row));
  return count;
}

class PdbFile : public testing::TestWithParam<const char*> {};
TEST_P(PdbFile, AgreesWithAse) {
  MOTE_NEED_PACK();
  const std::string name = std::string("protein/") + GetParam();
  const json& want = truth(name);
  const auto source = open(pack() / name);
  const Frame frame = source->read(0);
  // ASE applies ORIGX, which is the identity in all of them but 4hhb; here positions are the file's own
  glm::dmat4 origx(1.0);
  if (name == "protein/4hhb.pdb")
    origx = glm::dmat4(0.963457, -0.158977, -0.215598, 0, 0.136613, 0.983924, -0.115048, 0, 0.230424,
                       0.081383, 0.969683, 0, 16.61, 13.72, 37.65, 1);
  expect_positions(frame, want, 1, 1e-7, origx);
  expect_cell(frame, want["cell"], 1);
  EXPECT_EQ(source->frame_count(), 1u);
  EXPECT_EQ(frame.count, want["atom_records"].get<std::uint64_t>());
  EXPECT_EQ(frame.find("anisou") ? numbers(frame, "anisou") : 0, want["anisou"].get<std::uint64_t>());
  std::uint64_t operators = 0;
  for (const Assembly& assembly : frame.assemblies)
    for (const AssemblyPart& part : assembly.parts) operators += part.transforms.size();
  EXPECT_EQ(operators, want["biomt_operators"].get<std::uint64_t>());
  EXPECT_EQ(frame.bonds.rows.empty(), want["conect"].get<int>() == 0);
  const json& b = want["arrays"]["bfactor"]["range"];
  const auto& factors = std::get<std::vector<double>>(frame.find("b_factor")->values);
  EXPECT_EQ(*std::min_element(factors.begin(), factors.end()), b[0].get<double>());
  EXPECT_EQ(*std::max_element(factors.begin(), factors.end()), b[1].get<double>());
  const json& residues = want["arrays"]["residuenumbers"]["range"];
  const auto& ids = std::get<std::vector<std::int64_t>>(frame.find("residue_id")->values);
  EXPECT_EQ(*std::max_element(ids.begin(), ids.end()), residues[1].get<double>());
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}
INSTANTIATE_TEST_SUITE_P(Pack, PdbFile,
                         testing::Values("1IHM.pdb", "1M4X.pdb", "1crn.pdb", "1d66.pdb", "4hhb.pdb",
                                         "4opj.pdb"),
                         [](const auto& param) { return "f" + std::string(param.param).substr(0, 4); });

TEST(PdbPack, AnisotropyTraceIsTheBFactor) { // B = 8 pi^2 (U11 + U22 + U33) / 3
  MOTE_NEED_PACK();
  const Frame frame = open(pack() / "protein/4opj.pdb")->read(0);
  const Column &u = *frame.find("anisou"), &b = *frame.find("b_factor");
  std::uint64_t agree = 0; // three atoms of the entry disagree with themselves
  for (std::uint64_t row = 0; row < frame.count; ++row)
    agree +=
        std::abs(26.318945 * (u.number(row, 0) + u.number(row, 1) + u.number(row, 2)) - b.number(row)) < 0.02;
  EXPECT_EQ(agree, frame.count - 3);
}

TEST(PdbPack, CapsidOperatorsAreRotationsAndPartsNameChains) {
  MOTE_NEED_PACK();
  const Frame capsid = open(pack() / "protein/1M4X.pdb")->read(0);
  ASSERT_EQ(capsid.assemblies.size(), 1u);
  ASSERT_EQ(capsid.assemblies[0].parts.size(), 1u);
  EXPECT_EQ(capsid.assemblies[0].parts[0].transforms.size() * capsid.count, 16284240u);
  for (const glm::dmat4& m : capsid.assemblies[0].parts[0].transforms)
    ASSERT_NEAR(glm::determinant(glm::dmat3(m)), 1, 1e-4);
  const Frame two = open(pack() / "protein/4opj.pdb")->read(0);
  ASSERT_EQ(two.assemblies.size(), 2u);
  EXPECT_THAT(two.assemblies[0].parts[0].chains, testing::ElementsAre("D"));
  EXPECT_THAT(two.assemblies[0].parts[1].chains, testing::ElementsAre("A", "B"));
  EXPECT_EQ(two.assemblies[0].parts[0].transforms[0][3].x, 42.387);
  EXPECT_THAT(open(pack() / "protein/1crn.pdb")->read(0).bonds.rows, testing::SizeIs(3)); // disulfide bridges
}

TEST(MmcifPack, EqualsThePdbFileOfTheSameEntry) {
  MOTE_NEED_PACK();
  for (const auto& [cif, pdb] : {std::pair("protein/1CRN.cif", "protein/1crn.pdb"),
                                 std::pair("protein/1CRN.cif.gz", "protein/1crn.pdb"),
                                 std::pair("protein/4hhb.cif", "protein/4hhb.pdb")}) {
    SCOPED_TRACE(cif);
    const auto source = open(pack() / cif);
    EXPECT_EQ(source->format(), "mmcif");
    const Frame a = source->read(0), b = open(pack() / pdb)->read(0);
    EXPECT_EQ(broken_promise(a), "");
    ASSERT_EQ(a.count, b.count);
    for (std::uint64_t row = 0; row < a.count; ++row) {
      ASSERT_EQ(vector_at(a, "position", row), vector_at(b, "position", row)) << row;
      for (const char* column : {"element", "atom_name", "residue_name", "chain"})
        ASSERT_EQ(text_at(a, column, row), text_at(b, column, row)) << column << row;
      for (const char* column : {"residue_id", "b_factor", "occupancy", "hetero"})
        ASSERT_EQ(a.find(column)->number(row), b.find(column)->number(row)) << column << row;
    }
    ASSERT_EQ(a.assemblies.size(), 1u);
    EXPECT_EQ(a.assemblies[0].parts[0].transforms, b.assemblies[0].parts[0].transforms);
    for (int k = 0; k < 3; ++k) expect_near(a.box->edges[k], b.box->edges[k], 1e-12, "cell");
    EXPECT_EQ(source->frame_count(), 1u);
    EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
  }
}

class GroFile : public testing::TestWithParam<const char*> {};
TEST_P(GroFile, AgreesWithAse) {
  MOTE_NEED_PACK();
  const std::string name = std::string("md/") + GetParam() + ".gro";
  const auto source = open(pack() / name);
  const Frame frame = source->read(0);
  expect_positions(frame, truth(name), 10, 1e-9);
  expect_cell(frame, truth(name)["cell"], 10);
  EXPECT_EQ(frame.find("velocity") != nullptr, name == "md/md.gro");
  EXPECT_EQ(source->frame_count(), 1u);
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}
INSTANTIATE_TEST_SUITE_P(Pack, GroFile, testing::Values("1vln-triclinic", "md", "ubiquitin"),
                         [](const auto& param) { return "f" + std::string(param.param).substr(0, 4); });

TEST(GroPack, FirstVelocityAndElements) {
  MOTE_NEED_PACK();
  const Frame frame = open(pack() / "md/md.gro")->read(0);
  EXPECT_EQ(vector_at(frame, "velocity", 0), glm::dvec3(-0.4748, -0.0989, -0.1098));
  EXPECT_EQ(text_at(frame, "element", frame.count - 1), "Cl");
  const Frame metal = open(pack() / "md/1vln-triclinic.gro")->read(0);
  std::set<std::string> symbols;
  for (std::uint64_t row = 0; row < metal.count; ++row) symbols.insert(text_at(metal, "element", row));
  EXPECT_THAT(symbols, testing::IsSupersetOf({"C", "N", "O", "S", "Ca", "Mn"}));
  EXPECT_FALSE(symbols.contains("X"));
}

class TrajectoryFile : public testing::TestWithParam<std::pair<const char*, double>> {};
TEST_P(TrajectoryFile, AgreesWithMdAnalysis) {
  MOTE_NEED_PACK();
  const auto [file, scale] = GetParam();
  const json& want = truth(file);
  const auto source = open(pack() / file);
  EXPECT_EQ(source->frame_count(), want["frames"].get<std::uint64_t>());
  const Frame frame = source->read(0);
  expect_positions(frame, want, scale, 5e-6);
  const json& cell = want["box_A_deg"];
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(glm::length(frame.box->edges[k]) * scale, cell[static_cast<std::size_t>(k)].get<double>(),
                1e-5);
  const Frame last = source->read(source->frame_count() - 1);
  expect_near(vector_at(last, "position", 0) * scale, vec(want["last_frame_first_atom"]), 5e-6, "last frame");
  EXPECT_EQ(frame.time.value_or(0.0), want["time0_ps"].get<double>());
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}
INSTANTIATE_TEST_SUITE_P(Pack, TrajectoryFile,
                         testing::Values(std::pair("md/md.xtc", 10.0), std::pair("md/water.trr", 10.0),
                                         std::pair("md/water.dcd", 1.0)),
                         [](const auto& param) { return "f" + std::to_string(param.index); });

// The same 100 frames in four formats: within 2e-6 A (text has six decimals, the others floats).
TEST(WaterPack, EveryFormatGivesTheSamePositions) {
  MOTE_NEED_PACK();
  const auto text = open(pack() / "md/water.xyz");
  ASSERT_EQ(text->frame_count(), 100u);
  for (const auto& [file, unit] :
       {std::pair("md/water.dcd", "A"), std::pair("md/water.trr", "nm"), std::pair("md/water.nc", "A")}) {
    SCOPED_TRACE(file);
    const auto source = open(pack() / file);
    ASSERT_EQ(source->frame_count(), 100u);
    double worst = 0;
    for (std::uint64_t f = 0; f < 100; ++f) {
      const Frame want = text->read(f), frame = source->read(f);
      ASSERT_EQ(frame.count, 297u);
      EXPECT_EQ(frame.find("position")->unit, unit);
      const double scale = frame.find("position")->unit == "nm" ? 10 : 1;
      for (std::uint64_t row = 0; row < 297; ++row)
        for (std::uint32_t k = 0; k < 3; ++k)
          worst = std::max(worst, std::abs(frame.find("position")->number(row, k) * scale -
                                           want.find("position")->number(row, k)));
    }
    EXPECT_LT(worst, 2e-6);
    EXPECT_GT(worst, 0.0); // not the same file by accident
  }
}

TEST(WaterPack, NetcdfColumnsAndBox) {
  MOTE_NEED_PACK();
  const Frame frame = open(pack() / "md/water.nc")->read(99);
  expect_near(frame.box->edges[0] + frame.box->edges[1] + frame.box->edges[2], glm::dvec3(15), 1e-12, "box");
  ASSERT_NE(frame.find("type"), nullptr);
  EXPECT_EQ(frame.find("type")->number(0), 2); // the atoms follow each other as 2 1 1
  EXPECT_EQ(frame.find("type")->number(1), 1);
}

TEST(DcdPack, TriclinicCellOfNamd) {
  MOTE_NEED_PACK();
  const auto source = open(pack() / "md/triclinic-namd.dcd");
  const Frame frame = source->read(0);
  EXPECT_EQ(source->frame_count(), 1u);
  EXPECT_EQ(frame.count, 9999u);
  const glm::dmat3& e = frame.box->edges;
  EXPECT_NEAR(glm::length(e[0]), 85.43998, 1e-4); // doubles of the file at bytes 280, 296, 320
  EXPECT_NEAR(glm::length(e[1]), 89.44272, 1e-4);
  EXPECT_NEAR(glm::length(e[2]), 85.43998, 1e-4);
  EXPECT_NEAR(glm::dot(e[0], e[1]) / (glm::length(e[0]) * glm::length(e[1])), 0.3140, 1e-3);
  EXPECT_NEAR(glm::dot(e[1], e[2]) / (glm::length(e[1]) * glm::length(e[2])), 0.4187, 1e-3);
  EXPECT_NEAR(vector_at(frame, "position", 0).x, -4.4253044, 1e-5);
}

TEST(GsdPack, AgreesWithGsd) {
  MOTE_NEED_PACK();
  const json& want = truth("md/LJsampletraj.gsd");
  const auto source = open(pack() / "md/LJsampletraj.gsd");
  EXPECT_EQ(source->frame_count(), want["frames"].get<std::uint64_t>());
  bool found = false; // the reference does not say which of its frames it is
  for (std::uint64_t f = 0; f < 4; ++f) {
    const Frame frame = source->read(f);
    ASSERT_EQ(frame.count, want["count"].get<std::uint64_t>());
    EXPECT_NEAR(frame.box->edges[0].x, want["box"][0].get<double>(), 1e-12);
    EXPECT_EQ(text_at(frame, "type", 0), "A");
    if (glm::length(vector_at(frame, "position", 0) - vec(want["first"])) > 1e-12) continue;
    found = true;
    expect_positions(frame, want, 1, 1e-6);
  }
  EXPECT_TRUE(found);
}

// By content alone: the name is taken away.
TEST(Recognition, EveryFileOfThePackHasItsFormat) {
  MOTE_NEED_PACK();
  const std::map<std::string, std::string> formats{{".pdb", "pdb"},
                                                   {".cif", "mmcif"},
                                                   {".gro", "gro"},
                                                   {".xtc", "xtc"},
                                                   {".trr", "trr"},
                                                   {".dcd", "dcd"},
                                                   {".gsd", "gsd"},
                                                   {".nc", "netcdf"},
                                                   {".xyz", "xyz"},
                                                   {".body", "lammps-data"},
                                                   {".lmp", "lammps-data"},
                                                   {".dump", "lammps-dump"},
                                                   {".lammpstrj", "lammps-dump"}};
  std::size_t seen = 0;
  for (const char* folder : {"md", "protein"})
    for (const auto& entry : std::filesystem::directory_iterator(pack() / folder)) {
      const auto format = formats.find(entry.path().extension().string());
      if (format == formats.end()) continue;
      EXPECT_EQ(open_bytes(Bytes::load(entry.path()), "")->format(), format->second) << entry.path();
      ++seen;
    }
  EXPECT_GE(seen, 30u);
}

TEST(LammpsDataPack, AgreesWithAse) {
  MOTE_NEED_PACK();
  const json& want = truth("md/solvated.lmp");
  const auto source = open(pack() / "md/solvated.lmp");
  const Frame frame = source->read(0);
  expect_positions(frame, want, 1, 1e-9);
  expect_cell(frame, want["cell"], 1);
  expect_near(frame.box->origin, {-0.103, -0.066, -0.885501}, 1e-12, "origin");
  EXPECT_EQ(frame.bonds.rows.size(), 6248u);
  EXPECT_EQ(text_at(frame, "element", 0), "Zn");
  EXPECT_EQ(text_at(frame, "element", 12), "C"); // label C1, whatever its odd mass
  EXPECT_EQ(frame.find("mass")->number(0), 65.408997);
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings()); // the title names the style
}

TEST(LammpsDataPack, BodiesAndVelocities) {
  MOTE_NEED_PACK();
  const Frame frame = open(pack() / "md/data.body")->read(0);
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, 100u);
  EXPECT_EQ(vector_at(frame, "position", 1), glm::dvec3(-12.4258, -15.5322, 0));
  EXPECT_EQ(frame.find("mass")->number(1), 4);
  EXPECT_EQ(vector_at(frame, "image", 3), glm::dvec3(0, 1, -2));
  EXPECT_EQ(vector_at(frame, "velocity", 2), glm::dvec3(1.45001590497, 3.69994688556, 1.47487980361));
}

} // namespace
} // namespace mote::data::test
