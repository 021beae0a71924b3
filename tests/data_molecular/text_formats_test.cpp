// SPDX-License-Identifier: MIT
// PDB, mmCIF, GRO and LAMMPS data: every column of a small file, value by value.
#include "core/data/cif.hpp"
#include "core/data/lammps_styles.hpp"
#include "core/data/molecule.hpp"
#include "tests/data_molecular/support.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace mote::data::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using Pair = std::pair<std::string, std::string>;
using RowPair = std::array<std::uint32_t, 2>;

TEST(Pdb, AtomsOfAModel) {
  const auto source = open_text(molecule_file("two_models.pdb"));
  EXPECT_EQ(source->format(), "pdb");
  const Frame frame = source->read(0);
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, 4u);
  EXPECT_EQ(vector_at(frame, "position", 1), glm::dvec3(-1, -2, -3.5));
  EXPECT_EQ(frame.find("position")->unit, "A");
  for (const auto& [row, symbol] :
       {std::pair(0, "C"), std::pair(1, "H"), std::pair(2, "Ca"), std::pair(3, "O")})
    EXPECT_EQ(text_at(frame, "element", static_cast<std::uint64_t>(row)),
              symbol); // rows 1 and 3 by the name's columns
  EXPECT_EQ(text_at(frame, "atom_name", 1), "HG11");
  EXPECT_EQ(text_at(frame, "residue_name", 1), "VAL");
  EXPECT_EQ(text_at(frame, "chain", 2), "B");
  EXPECT_EQ(text_at(frame, "altloc", 0), "A");
  EXPECT_EQ(text_at(frame, "altloc", 1), "");
  EXPECT_EQ(text_at(frame, "insertion_code", 0), "A");
  EXPECT_EQ(frame.find("residue_id")->number(3), 4);
  EXPECT_EQ(frame.find("id")->number(3), 4);
  EXPECT_EQ(frame.find("hetero")->number(1), 0);
  EXPECT_EQ(frame.find("hetero")->number(2), 1);
  EXPECT_EQ(frame.find("occupancy")->number(0), 0.6);
  EXPECT_EQ(frame.find("occupancy")->number(3), 1.0); // missing
  EXPECT_EQ(frame.find("b_factor")->number(0), 11.5);
}

TEST(Pdb, AnisotropyBoxBondsAndProperties) {
  const Frame frame = open_text(molecule_file("two_models.pdb"))->read(0);
  const Column& u = *frame.find("anisou");
  EXPECT_EQ(u.components, 6u);
  EXPECT_DOUBLE_EQ(u.number(0, 0), 0.01);
  EXPECT_DOUBLE_EQ(u.number(0, 4), -0.002); // U13
  EXPECT_TRUE(std::isnan(u.number(3, 0)));
  ASSERT_TRUE(frame.box);
  EXPECT_NEAR(frame.box->edges[1].x, -10, 1e-12); // 20 cos 120
  EXPECT_THAT(frame.bonds.rows,
              ElementsAre(RowPair{0, 1}, RowPair{0, 2}, RowPair{2, 3})); // behind the last model
  EXPECT_THAT(frame.properties, Contains(Pair("identifier", "9XYZ")));
  EXPECT_THAT(frame.properties, Contains(Pair("model", "1")));
}

TEST(Pdb, ModelsAreFrames) {
  const auto source = open_text(molecule_file("two_models.pdb"));
  const Frame second = source->read(1);
  EXPECT_EQ(source->frame_count(), 2u);
  EXPECT_EQ(vector_at(second, "position", 3), glm::dvec3(7.125, 8, 9));
  EXPECT_EQ(second.find("anisou"), nullptr);
  EXPECT_TRUE(second.box);
  EXPECT_EQ(second.bonds.rows.size(), 3u);
  EXPECT_EQ(second.assemblies.size(), 1u);
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}

TEST(Pdb, StructuresBehindEachOtherAreFrames) {
  const std::string one = "CRYST1    1.000    2.000    3.000  90.00  90.00  90.00 P 1           1\n"
                          "ATOM      1  N   ALA A   1       1.000   2.000   3.000\nEND\n";
  const auto source = open_text(one + "\n" + changed(one, "3.000  90", "4.000  90"));
  EXPECT_EQ(source->frame_count(), 2u);
  EXPECT_EQ(source->read(0).box->edges[2].z, 3);
  EXPECT_EQ(source->read(1).box->edges[2].z, 4);
}

TEST(Pdb, NumbersTooWideForTheirColumns) {
  const std::string row = "ATOM  99999  N   ALA A9999       1.000   2.000   3.000\n";
  const Frame frame = read_text(row + changed(changed(row, "99999", "A0000"), "9999", "A000") +
                                changed(changed(row, "99999", "*****"), "9999", "****") + "END\n");
  EXPECT_EQ(frame.find("id")->number(1), 100000);
  EXPECT_EQ(frame.find("id")->number(2), 100001);
  EXPECT_EQ(frame.find("residue_id")->number(1), 10000);
  EXPECT_EQ(frame.find("residue_id")->number(2), 10000);
}

TEST(Pdb, BondsToAtomsThatAreNotThereAreAWarning) {
  const auto source =
      open_text(changed(molecule_file("two_models.pdb"), "CONECT    1    2    3", "CONECT    1    2   33"));
  EXPECT_EQ(source->read(0).bonds.rows.size(), 3u); // 3 1 is there too
  EXPECT_TRUE(source->warnings().has("D047"));
}

TEST(Pdb, AnisotropyOfAnotherAtomIsAWarning) {
  const auto source = open_text(changed(molecule_file("two_models.pdb"), "ANISOU    1", "ANISOU    7"));
  EXPECT_EQ(source->read(0).find("anisou"), nullptr);
  EXPECT_TRUE(source->warnings().has("D052"));
}

TEST(ElementOfAtomName, ColumnsOfAPdbName) {
  EXPECT_EQ(element_of_pdb_name(" CA ", "ALA"), "C");
  EXPECT_EQ(element_of_pdb_name("CA  ", "CA"), "Ca");
  EXPECT_EQ(element_of_pdb_name("1HB ", "ALA"), "H");
  EXPECT_EQ(element_of_pdb_name("HG11", "VAL"), "H");
  EXPECT_EQ(element_of_pdb_name("FE  ", "HEM"), "Fe");
  EXPECT_EQ(element_of_pdb_name(" Q  ", "XXX"), "X");
}

TEST(ElementOfAtomName, NamesWithoutColumns) {
  EXPECT_EQ(element_of_name("CA", "ALA"), "C");
  EXPECT_EQ(element_of_name("CA", "CA"), "Ca");
  EXPECT_EQ(element_of_name("NA", "NA+"), "Na");
  EXPECT_EQ(element_of_name("NA", "HEM"), "N");
  EXPECT_EQ(element_of_name("OW", "SOL"), "O");
  EXPECT_EQ(element_of_name("FE2", "HEM"), "Fe");
  EXPECT_EQ(element_of_name("2HB", "ALA"), "H");
}

TEST(Mmcif, AtomsOfAModel) {
  const auto source = open_text(molecule_file("two_models.cif"));
  EXPECT_EQ(source->format(), "mmcif");
  EXPECT_EQ(source->frame_count(), 2u);
  const Frame frame = source->read(0);
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, 2u);
  EXPECT_EQ(vector_at(frame, "position", 1), glm::dvec3(4, 5, 6)); // 6.000(12)
  EXPECT_EQ(text_at(frame, "element", 1), "Fe");
  EXPECT_EQ(text_at(frame, "atom_name", 1), "FE'");
  EXPECT_EQ(text_at(frame, "chain", 1), "X");
  EXPECT_EQ(text_at(frame, "chain_label", 1), "B");
  EXPECT_EQ(text_at(frame, "altloc", 0), "A");
  EXPECT_EQ(text_at(frame, "altloc", 1), "");
  EXPECT_EQ(frame.find("residue_id")->number(0), 101);
  EXPECT_EQ(frame.find("b_factor")->number(1), 0); // ?
  EXPECT_EQ(frame.find("hetero")->number(1), 1);
  EXPECT_DOUBLE_EQ(frame.find("anisou")->number(1, 4), -0.002);
  EXPECT_TRUE(std::isnan(frame.find("anisou")->number(0, 4)));
  EXPECT_NEAR(frame.box->edges[1].x, -10, 1e-12);
  EXPECT_THAT(frame.properties, Contains(Pair("title", "Two models,\ntwo lines")));
  EXPECT_THAT(frame.properties, Contains(Pair("space_group", "P 1")));
  EXPECT_EQ(vector_at(source->read(1), "position", 0), glm::dvec3(1.125, 2, 3));
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}

TEST(Mmcif, ModelsMayBeMixed) {
  std::string text = molecule_file("two_models.cif");
  text = changed(text, "1.00 ? 102 X 1", "1.00 ? 102 X 3");
  const auto source = open_text(changed(text, "0.60 11.50 101 X 2", "0.60 11.50 101 X 1"));
  EXPECT_EQ(source->frame_count(), 3u); // 1, 3, 2 in the order of their first atoms
  EXPECT_EQ(source->read(0).count, 2u);
  EXPECT_EQ(source->read(2).count, 1u);
}

TEST(Mmcif, OneAtomWithoutALoop) {
  const Frame frame = read_text(
      "data_x\n_atom_site.id 7\n_atom_site.type_symbol ZN\n_atom_site.Cartn_x 1\n_atom_site.Cartn_y 2\n"
      "_atom_site.Cartn_z 3\n");
  ASSERT_EQ(frame.count, 1u);
  EXPECT_EQ(vector_at(frame, "position", 0), glm::dvec3(1, 2, 3));
  EXPECT_EQ(text_at(frame, "element", 0), "Zn");
}

TEST(Cif, WordsAndQuotes) {
  const std::string name = "f";
  CifScanner scanner(name, "data_x _a 'it''s' # no\n;field\n; \"a b\" '?' ? LOOP_ _b");
  EXPECT_EQ(scanner.next().kind, CifToken::Kind::Data);
  EXPECT_EQ(scanner.next().kind, CifToken::Kind::Tag);
  EXPECT_EQ(scanner.next().text, "it''s");
  EXPECT_EQ(scanner.next().text, "field");
  EXPECT_EQ(scanner.next().text, "a b");
  EXPECT_FALSE(scanner.next().missing());
  EXPECT_TRUE(scanner.next().missing());
  EXPECT_EQ(scanner.next().kind, CifToken::Kind::Loop);
  const CifToken last = scanner.next();
  EXPECT_EQ(last.line, 3u);
  EXPECT_EQ(last.column, 21u);
  EXPECT_TRUE(scanner.touches_end());
  EXPECT_EQ(scanner.next().kind, CifToken::Kind::End);
}

TEST(Gro, TwoFramesOfDifferentPrecision) {
  const auto source = open_text(molecule_file("two_frames.gro"));
  EXPECT_EQ(source->format(), "gro");
  const Frame second = source->read(1);
  EXPECT_EQ(source->frame_count(), 2u);
  const Frame first = source->read(0);
  EXPECT_EQ(broken_promise(first), "");
  EXPECT_EQ(vector_at(first, "position", 2), glm::dvec3(10.32345, 1.23456, 2.34567));
  EXPECT_EQ(vector_at(first, "velocity", 1), glm::dvec3(0.11, -0.21, 0.31));
  EXPECT_EQ(first.find("velocity")->unit, "nm/ps");
  EXPECT_EQ(text_at(first, "element", 1), "H");
  EXPECT_EQ(text_at(first, "element", 2), "Na");
  EXPECT_EQ(first.find("residue_id")->number(2), 99999);
  EXPECT_EQ(first.time, 1.5);
  EXPECT_EQ(first.step, 3);
  EXPECT_EQ(first.box->edges[1], glm::dvec3(0.5, 2, 0)); // v2x = sixth number
  EXPECT_EQ(first.box->edges[2], glm::dvec3(0.25, 0.125, 3));
  EXPECT_EQ(second.count, 2u);
  EXPECT_EQ(vector_at(second, "position", 1), glm::dvec3(0.223, 1.234, -2.345));
  EXPECT_EQ(text_at(second, "element", 1), "Fe");
  EXPECT_EQ(second.find("velocity"), nullptr);
  EXPECT_TRUE(source->warnings().empty());
}

TEST(Gro, ABlankTitle) {
  const std::string frame =
      "\n1\n    1SOL     OW    1   0.123   1.234   2.345\n   1.00000   2.00000   3.00000\n";
  const auto source = open_text(frame + frame, "gro");
  EXPECT_EQ(source->frame_count(), 2u);
  EXPECT_EQ(vector_at(source->read(1), "position", 0), glm::dvec3(0.123, 1.234, 2.345));
}

// Atoms are read in blocks by all cores: the same columns, words in the order of their first appearance, the first flaw.
TEST(Gro, ManyAtoms) {
  std::string file = "many\n20000\n";
  for (int i = 0; i < 20000; ++i)
    file += fmt::format("{:5d}{:<5}{:>5}{:5d}{:8.3f}{:8.3f}{:8.3f}\n", i % 100000, i < 15000 ? "SOL" : "NA", i < 15000 ? (i % 3 ? "HW1" : "OW") : "NA", (i + 1) % 100000, i * 0.001, 1.0, 2.0);
  file += "  30.0 30.0 30.0\n";
  const Frame frame = open_text(file, "gro")->read(0);
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, 20000u);
  EXPECT_EQ(vector_at(frame, "position", 12345), glm::dvec3(12.345, 1, 2));
  EXPECT_EQ(frame.find("residue_id")->number(19999), 19999);
  EXPECT_EQ(text_at(frame, "element", 15000), "Na");
  EXPECT_EQ(std::get<TextColumn>(frame.find("atom_name")->values).dictionary, (std::vector<std::string>{"OW", "HW1", "NA"}));
  for (const std::size_t row : {18000u, 9000u}) file[11 + 45 * row + 30] = 'x'; // heads of "many\n20000\n", lines of 45
  const Diagnostic d = failure_of_text(file, "gro");
  EXPECT_EQ(d.code, "D012");
  EXPECT_EQ(d.loc.line, 9003u);
}

TEST(LammpsData, EverySectionThatIsRead) {
  const auto source = open_text(molecule_file("full.data"));
  EXPECT_EQ(source->format(), "lammps-data");
  const Frame frame = source->read(0);
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, 4u);
  EXPECT_EQ(vector_at(frame, "position", 0), glm::dvec3(1.5, 0.25, 0.5));
  EXPECT_EQ(vector_at(frame, "image", 3), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(frame.find("id")->number(0), 2);
  EXPECT_EQ(frame.find("molecule")->number(3), 2);
  EXPECT_EQ(frame.find("charge")->number(1), -0.82);
  EXPECT_EQ(frame.find("mass")->number(1), 15.9994);
  EXPECT_EQ(text_at(frame, "element", 0), "H");                        // by mass: HW is no symbol
  EXPECT_EQ(vector_at(frame, "velocity", 0), glm::dvec3(1, 1.1, 1.2)); // by id
  EXPECT_EQ(vector_at(frame, "velocity", 3), glm::dvec3(0.4, 0.5, 0.6));
  EXPECT_THAT(frame.bonds.rows, ElementsAre(RowPair{0, 1}, RowPair{1, 2}));
  EXPECT_THAT(frame.bonds.types, ElementsAre(1, 1));
  EXPECT_EQ(frame.box->origin, glm::dvec3(-1, 0, 0));
  EXPECT_EQ(frame.box->edges[1], glm::dvec3(1.5, 20, 0));
  EXPECT_EQ(frame.box->edges[2], glm::dvec3(0, -2.5, 30));
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}

TEST(LammpsData, EllipsoidsAndTypeLabels) {
  const Frame frame = read_text(
      "t\n\n2 atoms\n1 ellipsoids\n2 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtom Type "
      "Labels\n\n1 C\n2 Big\n\n"
      "Atoms # ellipsoid\n\n1 Big 1 2.5 0 0 0\n2 C 0 1.5 1 1 1\n\nEllipsoids\n\n1 2 4 6 0.5 0.5 0.5 0.5\n");
  EXPECT_EQ(vector_at(frame, "shape", 0), glm::dvec3(1, 2, 3)); // half axes
  EXPECT_EQ(vector_at(frame, "shape", 1), glm::dvec3(0));
  EXPECT_EQ(frame.find("orientation")->number(0, 3), 0.5);
  EXPECT_EQ(frame.find("orientation")->number(1, 0), 1);
  EXPECT_EQ(text_at(frame, "type", 0), "Big");
}

TEST(LammpsData, AGuessedStyleIsAWarning) {
  const auto source = open_text(changed(molecule_file("full.data"), "Atoms # full", "Atoms"));
  EXPECT_EQ(source->read(0).find("charge")->number(1), -0.82);
  ASSERT_TRUE(source->warnings().has("D048"));
  EXPECT_THAT(source->warnings().list()[0].text, testing::HasSubstr("'full'"));
}

TEST(LammpsStyles, GuessesByTheFirstRow) {
  auto guess = [](std::vector<std::string_view> words, bool bonded, std::uint64_t types) {
    const LammpsStyle* style = guess_lammps_style(words, bonded, types);
    return style ? style->name : "none";
  };
  EXPECT_EQ(guess({"1", "1", "0", "0", "0"}, false, 1), "atomic");
  EXPECT_EQ(guess({"1", "1", "-0.5", "0", "0", "0"}, false, 2), "charge");
  EXPECT_EQ(guess({"1", "9", "2", "0", "0", "0"}, false, 2), "molecular");
  EXPECT_EQ(guess({"1", "1", "1.5", "2.0", "0", "0", "0"}, false, 2), "sphere");
  EXPECT_EQ(guess({"1", "1", "1", "2.0", "0", "0", "0", "0", "0", "0"}, false, 2), "full");
  EXPECT_EQ(guess({"1", "1", "1", "2.0"}, false, 2), "none");
}

TEST(CellBox, EdgesFromLengthsAndAngles) {
  const auto box = cell_box({2, 3, 4}, {80, 100, 70});
  ASSERT_TRUE(box);
  const glm::dmat3& e = box->edges;
  const double degree = std::acos(-1.0) / 180;
  EXPECT_NEAR(glm::length(e[1]), 3, 1e-14);
  EXPECT_NEAR(glm::length(e[2]), 4, 1e-14);
  EXPECT_NEAR(glm::dot(e[1], e[2]) / 12, std::cos(80 * degree), 1e-14);
  EXPECT_NEAR(glm::dot(e[0], e[2]) / 8, std::cos(100 * degree), 1e-14);
  EXPECT_NEAR(glm::dot(e[0], e[1]) / 6, std::cos(70 * degree), 1e-14);
  EXPECT_FALSE(cell_box({1, 1, 1}, {10, 10, 170}));
  EXPECT_FALSE(cell_box({1, 0, 1}, {90, 90, 90}));
}

} // namespace
} // namespace mote::data::test
