// SPDX-License-Identifier: MIT
// Broken files: one fault each, its code, place and words.
#include "tests/data_molecular/samples.hpp"
#include "tests/data_molecular/support.hpp"

#include <gmock/gmock.h>

namespace mote::data::test {
namespace {

using testing::HasSubstr;

struct Bad {
  std::string name, content, code, words;
};
std::ostream& operator<<(std::ostream& out, const Bad& bad) { return out << bad.name; }

// `bytes` with `value` written at `at`.
template <class T> std::string with(std::string bytes, std::size_t at, T value, Order order = Order::Big) {
  Maker maker(order);
  maker.put(value);
  return bytes.replace(at, sizeof(T), maker.bytes);
}
std::string pdb(std::string_view from, std::string_view to) {
  return changed(molecule_file("two_models.pdb"), from, to);
}
std::string cif(std::string_view from, std::string_view to) {
  return changed(molecule_file("two_models.cif"), from, to);
}
std::string gro(std::string_view from, std::string_view to) {
  return changed(molecule_file("two_frames.gro"), from, to);
}
std::string data(std::string_view from, std::string_view to) {
  return changed(molecule_file("full.data"), from, to);
}

std::vector<Bad> text_cases() {
  return {
      {"pdb_coordinate", pdb("      1.000   2.000", "      1.0x0   2.000"), "D012",
       "'1.0x0' in columns 31 to 38 is not a number"},
      {"pdb_short", "ATOM      1  N   ALA A   1      11.104   6.134\nEND\n", "D010",
       "46 columns, but the positions reach to column 54"},
      {"pdb_residue", pdb("VAL A   2", "VAL A  x2"), "D012", "residue number is 'x2'"},
      {"pdb_anisou", pdb("    100    200", "    1.0    200"), "D012", "'1.0' in ANISOU is not an integer"},
      {"pdb_cell", pdb("10.000   20.000", "10.0.0   20.000"), "D014", "'10.0.0' in CRYST1"},
      {"pdb_angles", pdb(" 90.00  90.00 120.00", " 10.00  90.00 170.00"), "D014", "form no cell"},
      {"pdb_no_atoms", "HEADER    TEST\nEND\n", "D013", "no ATOM or HETATM"},
      {"pdb_open_model", "MODEL        1\nATOM      1  N   ALA A   1      11.104   6.134   1.000\n", "D006",
       "ENDMDL is missing"},
      {"cif_number", cif("4.000 5.000", "4.000 5.o"), "D012", "Cartn_y is '5.o', not a number"},
      {"cif_missing", cif("4.000 5.000", "4.000 ?"), "D012", "Cartn_y is missing"},
      {"cif_row", cif("102 X 2", "102 X"), "D044",
       "row 4 of the loop _atom_site: it has 15 values for 16 tags"},
      {"cif_no_value", cif("_entry.id TEST", "_entry.id"), "D044", "'_entry.id' has no value"},
      {"cif_stray", cif("_entry.id TEST", "_entry.id TEST stray"), "D044", "'stray' belongs to no tag"},
      {"cif_quote", cif("'P 1'", "'P 1"), "D021", "quote"},
      {"cif_field", cif("two lines\n;", "two lines\n"), "D021", "text field"},
      {"cif_axis", cif("_atom_site.Cartn_z", "_atom_site.Cartn_w"), "D013", "no item Cartn_z"},
      {"cif_no_atoms", "data_x\n_entry.id x\n", "D013", "no category _atom_site"},
      {"cif_small", "data_x\nloop_\n_atom_site_label\n_atom_site_fract_x\nC 0.5\n", "D013",
       "CIF of small molecules"},
      {"cif_cell", cif("_cell.length_b 20", "_cell.length_b x"), "D014", "_cell.length_b is 'x'"},
      {"gro_coordinate", gro("   1.23456   2.34567", "   1.2x456   2.34567"), "D012", "1.2x456"},
      {"gro_box", gro("0.25000   0.12500", "0.25000"), "D014", "8 numbers, but 3 or 9"},
      {"gro_count", gro("\n3\n", "\n4\n"), "D012", "not"},
      {"gro_large", gro("\n3\n", "\n18446744073709551615\n"), "D006", "ends before so many"},
      {"gro_row", gro("1.234  -2.345", "1.2"), "D010", "the line of atom 2"},
      {"data_style", data("Atoms # full", "Atoms # ful"), "D046", "the atom style 'ful' is not read"},
      {"data_fit", data("Atoms # full", "Atoms # atomic"), "D046", "the first row has 10"},
      {"data_twice", data("3 1 2 0.41", "2 1 2 0.41"), "D015", "two atoms have the id 2"},
      {"data_number", data("-0.82 1 0 0.5", "-0.82 1 y 0.5"), "D012", "y"},
      {"data_rows", data("4 atoms", "400000000000 atoms"), "D006",
       "of 400000000000 rows of the section Atoms"},
      {"data_bond", data("2 1 1 3\n", "2 1 1 7\n"), "D047", "atom 7, which is not there"},
      {"data_bonds", data("Bonds\n\n1 1 1 2\n2 1 1 3\n", ""), "D006", "there is no section Bonds"},
      {"data_no_atoms", data("Atoms # full", "Anoms # full"), "D013", "no section Atoms"},
      {"data_box", data("-1.0 9.0 xlo", "-1.0 -9.0 xlo"), "D014", "ends at -9 before it begins at -1"},
      {"data_section", data("Bonds\n", "Masses\n"), "D008", "second section 'Masses'"},
      {"data_mass", data("3 1 2 0.41", "3 1 3 0.41"), "D043", "type '3', which has no mass"},
  };
}

std::vector<Bad> binary_cases() {
  const std::string xtc = make_xtc(2, 12), trr = make_trr(2, 12, false), dcd = make_dcd(2, 12, {});
  const std::string gsd = make_gsd(2, 12, 0x20000), nc = make_netcdf(2, 12, 2);
  const std::size_t second = xtc.size() / 2, entries = gsd.size() - 64 - 32 * 15;
  return {
      {"xtc_magic", with(xtc, second, 1996), "D040", "begins with 1995 or 2023, not with 1996"},
      {"xtc_negative", with(xtc, 4, -1), "D043", "number of atoms is -1"},
      {"xtc_counts", with(xtc, 52, 13), "D043", "12 atoms, but 13 positions"},
      {"xtc_lie", with(with(xtc, 4, 2000000000), 52, 2000000000), "D043",
       "2000000000 atoms cannot be packed in"},
      {"xtc_length", with(xtc, 88, 0x7fffffff), "D006", "the packed positions"},
      {"xtc_length_negative", with(xtc, 88, -5), "D043", "-5"},
      {"xtc_precision", with(xtc, 56, 0.0f), "D041", "precision"},
      {"xtc_index", with(xtc, 84, 73), "D041", "outside its table"},
      {"xtc_small_index", with(xtc, 84, 8), "D041", "outside its table"},
      {"xtc_extent", with(xtc, 72, -100000), "D041", "below the smallest"},
      {"trr_magic", with(trr, 0, 1993) + "\1\2\3\4" + std::string(80, 'x'), "D040", "begins with 1993"},
      {"trr_version", changed(trr, "GMX_trn", "GMX_trm"), "D005", "no reader"},
      {"trr_lengths", with(trr, 24 + 7 * 4, 100), "D043", "do not fit 12 atoms"},
      {"trr_atoms", with(trr, 24 + 10 * 4, 2000000000), "D043", "do not fit 2000000000 atoms"},
      {"trr_negative", with(trr, 24 + 8 * 4, -4), "D043", "-4"},
      {"dcd_velocities", changed(dcd, "CORD", "VELD"), "D042", "velocities"},
      {"dcd_atoms", with(dcd, 92 + 92 + 4, -12, Order::Little), "D043", "number of atoms is -12"},
      {"dcd_lie", with(dcd, 92 + 92 + 4, 2000000000, Order::Little), "D006", "the first frame"},
      {"dcd_record", with(dcd, 92 + 92 + 12 + 56 + 0, 44, Order::Little), "D040",
       "has 44 bytes, but 48 are needed"},
      {"dcd_end", with(dcd, 92 + 92 + 12 + 56 + 4 + 48, 44, Order::Little), "D040",
       "begins with length 48 and ends with 44"},
      {"dcd_fixed", with(dcd, 4 + 36, 13, Order::Little), "D043", "13 atoms are fixed"},
      {"gsd_version", with(gsd, 44, std::uint32_t{0x30000}, Order::Little), "D042", "GSD version 3.0"},
      {"gsd_schema", changed(gsd, "hoomd", "other"), "D042", "'other'"},
      {"gsd_index", with(gsd, 16, ~std::uint64_t{0}, Order::Little), "D043", "cannot have"},
      {"gsd_index_at", with(gsd, 8, ~std::uint64_t{0} - 7, Order::Little), "D006", "the index"},
      {"gsd_names_at",
       with(with(gsd, 24, ~std::uint64_t{0}, Order::Little), 32, std::uint64_t{0}, Order::Little), "D006",
       "the list of names"},
      {"gsd_rows", with(gsd, entries + 8, ~std::uint64_t{0} / 2, Order::Little), "D043", "cannot have"},
      {"gsd_chunk", with(gsd, entries + 16, std::uint64_t{1} << 40, Order::Little), "D006",
       "chunk 'configuration/step'"},
      {"gsd_frame", with(gsd, entries, std::uint64_t{1} << 60, Order::Little), "D043",
       "which the file cannot hold"},
      {"gsd_type", with(gsd, entries + 30, std::uint8_t{77}, Order::Little), "D040", "type 77"},
      {"nc_dimensions", with(nc, 12, 2000000000), "D043", "cannot hold 2000000000 dimensions"},
      {"nc_tag", with(nc, 8, 9), "D040", "begins with tag 9, not 10"},
      {"nc_coordinates", changed(nc, "coordinates", "koordinates"), "D013", "'coordinates'"},
      {"nc_atoms", changed(nc, std::string("atom\0\0\0\x0c", 8), std::string("atom\x7f\xff\xff\xff", 8)),
       "D006", "the first frame"},
  };
}

class BadFile : public testing::TestWithParam<Bad> {};

TEST_P(BadFile, IsRefusedWithCodePlaceAndWords) {
  const Bad& bad = GetParam();
  const Diagnostic found = failure_of([&] {
    const auto source = open_text(bad.content);
    for (std::uint64_t f = 0, count = source->frame_count(); f < count; ++f) (void)source->read(f);
  });
  EXPECT_EQ(found.code, bad.code) << found.text;
  EXPECT_THAT(found.text, HasSubstr(bad.words));
  EXPECT_EQ(found.loc.file, "input");
}

auto name_of = [](const auto& param) { return param.param.name; };
INSTANTIATE_TEST_SUITE_P(Text, BadFile, testing::ValuesIn(text_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Binary, BadFile, testing::ValuesIn(binary_cases()), name_of);

TEST(BadPlaces, LineAndColumnOrByte) {
  const Diagnostic text = failure_of_text(pdb("      1.000   2.000", "      1.0x0   2.000"));
  EXPECT_EQ(to_string(text.loc), "input:14:31");
  const Diagnostic binary =
      failure_of([] { (void)open_text(with(make_xtc(2, 12), make_xtc(1, 12).size(), 7))->read(1); });
  EXPECT_EQ(to_string(binary.loc), fmt::format("input:@{}", make_xtc(1, 12).size()));
}

} // namespace
} // namespace mote::data::test
