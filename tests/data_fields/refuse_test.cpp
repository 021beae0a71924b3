// SPDX-License-Identifier: MIT
// Broken VTK XML, bgeo, npz and packed files: one thing is wrong in each, the code and the words say what.
#include "core/data/codes_fields.hpp"
#include "tests/data_fields/support.hpp"

#include <set>

namespace mote::data::testing {
namespace {

std::string four(std::string_view name) { return content_of(small_file(name)); }

TEST(RefuseVtkXml, StructureAndAttributes) {
  const std::string good = four("four_ascii.vtu");
  expect_refused("a.vtu", changed(good, "</Points>", "</Pionts>"), "D061", "the XML is malformed");
  expect_refused("a.vtu", changed(good, "</VTKFile>", ""), "D006", "</VTKFile> is missing");
  expect_refused("a.vtu", changed(good, "type=\"UnstructuredGrid\"", "type=\"PUnstructuredGrid\""), "D065",
                 "this file only names others");
  expect_refused("a.vtu", changed(good, "NumberOfPoints=\"4\"", "NumberOfPionts=\"4\""), "D062",
                 "Piece has no attribute NumberOfPoints");
  expect_refused("a.vtu", changed(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"four\""), "D062", "'four'");
  expect_refused("a.vtu", changed(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"3\""), "D064",
                 "more than 3 numbers");
  expect_refused("a.vtu", changed(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"18446744073709551615\""),
                 "D006", "numbers");
  expect_refused("a.vtu", changed(good, "Float64\" Name=\"density", "Float65\" Name=\"density"), "D065",
                 "'Float65'");
  expect_refused("a.vtu", changed(good, "LittleEndian", "MiddleEndian"), "D062", "'MiddleEndian'");
  expect_refused("a.vtu", changed(good, "UInt32", "UInt16"), "D062", "'UInt16'");
  expect_refused("a.vtu",
                 changed(good, "format=\"ascii\">\n          1 2.5", "format=\"text\">\n          1 2.5"),
                 "D062", "'text'");
  expect_refused("a.vtu", changed(good, " 1 2.5", " 1 2.5x"), "D012", "'2.5x'");
  expect_refused("a.vtu",
                 changed(good, "<Points>", "<Dots>").replace(good.find("</Points>") - 2, 9, "</Dots>  "),
                 "D062", "has no Points");
}

TEST(RefuseVtkXml, PlacesAreLinesOfTheFile) {
  const Outcome outcome = outcome_of("a.vtu", changed(four("four_ascii.vtu"), " 1 2.5", " 1 2.5x"));
  EXPECT_THAT(outcome.text, ::testing::StartsWith("a.vtu:12:13: error D012"));
}

TEST(RefuseVtkXml, EncodedArrays) {
  const std::string inlined = four("four_inline.vtu");
  const std::size_t begin = inlined.find("format=\"binary\">\n          ") + 27;
  std::string text = inlined;
  text[begin + 7] = '*';
  expect_refused("a.vtu", text, "D063", "'density' is no base64 text here");
  text = inlined;
  text[begin] = 'C'; // another length
  expect_refused("a.vtu", text, "D064", "bytes, but 32 are needed");
  const std::string raw = four("four_raw.vtu");
  expect_refused("a.vtu", changed(raw, "offset=\"0\"", "offset=\"99999\""), "D006", "99999");
  expect_refused("a.vtu", changed(raw, "offset=\"0\"", "offset=\"-1\""), "D062", "'-1'");
  expect_refused("a.vtu", changed(raw, "encoding=\"raw\"", "encoding=\"row\""), "D062", "'row'");
  expect_refused("a.vtu", changed(raw, "\n   _", "\n   x_"), "D062", "does not begin with '_'");
}

TEST(RefuseVtkXml, CompressedBlocks) {
  const std::string good = four("four_raw_zlib.vtu");
  const std::size_t begin = good.find("\n   _") + 5;
  std::string text = good;
  text[begin + 32 + 4] ^= 1; // inside the first block: header is 3 + 1 words of 8 bytes
  expect_refused("a.vtu", text, "D060", "block 0 of the array 'density' is damaged");
  text = good;
  text[begin] = 2; // two blocks of the stated size are more than there should be
  expect_refused("a.vtu", text, "D064", "'density'");
  text = good;
  text[begin + 31] = 0x7f; // a packed size of 2^62 and more
  expect_refused("a.vtu", text, "D006", "ends early");
  expect_refused("a.vtu", changed(good, "vtkZLibDataCompressor", "vtkBestDataCompressor"), "D065",
                 "'vtkBestDataCompressor'");
}

TEST(RefuseBgeo, CountsAndTypes) {
  const std::string good = four("four.bgeo");
  std::string text = good;
  text[8] = 6;
  expect_refused("a.bgeo", text, "D065", "the version is '6'");
  text = good;
  text[9] = '\x7f'; // points
  expect_refused("a.bgeo", text, "D006", "points");
  text = good;
  text[25] = '\x7f'; // attributes
  expect_refused("a.bgeo", text, "D006", "attributes are announced");
  text = good;
  text[good.find("id") + 2] = '\x7f'; // components
  expect_refused("a.bgeo", text, "D008", "'id'");
  text = good;
  text[good.find("id") + 7] = 3; // type
  expect_refused("a.bgeo", text, "D065", "the type '3'");
  expect_refused("a.bgeo", "\x7fNSJb and more", "D065", "binary-JSON");
}

TEST(RefuseNpz, ArchiveAndArrays) {
  const std::string good = four("four.npz"), packed = four("four_deflated.npz");
  std::string text = good;
  text[text.find("NUMPY") + 128] ^= 1; // a value: only the check sum tells
  expect_refused("a.npz", text, "D060", "check sum");
  text = packed;
  text[60] ^= 0x55;
  EXPECT_EQ(outcome_of("a.npz", text).code, "D060");
  text = good;
  text[good.rfind("PK\1\2") + 10] = 12; // bzip2
  expect_refused("a.npz", text, "D065", "method '12'");
  text = good;
  text[good.rfind("PK\1\2") + 8] = 1;
  expect_refused("a.npz", text, "D065", "encrypted");
  text = good;
  text[good.rfind("PK\1\2") + 24] = 99; // unpacked size
  expect_refused("a.npz", text, "D060", "impossible");
  text = good;
  for (std::size_t at = text.find("pos.npy"); at != std::string::npos; at = text.find("pos.npy"))
    text.replace(at, 3, "abc");
  expect_refused("a.npz", text, "D013",
                 "no array gives the position"); // two of shape (4, 3), neither is named so
}

TEST(RefusePacked, XzAndZstd) {
  for (const std::string name : {"four_ascii.ply.xz", "four_ascii.ply.zst"}) {
    const std::string good = four(name);
    expect_refused(name, good.substr(0, good.size() - 5), "D060", "cut off");
    std::string text = good;
    text[good.size() / 2] ^= 0x10;
    expect_refused(name, text, "D060", "damaged");
  }
}

TEST(RefusePacked, TwoStreamsBehindOneAnother) {
  for (const std::string name : {"four_ascii.ply.xz", "four_ascii.ply.zst"}) {
    const auto one = Bytes::from_memory(name, four(name)),
               two = Bytes::from_memory(name, four(name) + four(name));
    EXPECT_EQ(two->view(), std::string(one->view()) + std::string(one->view()));
    EXPECT_TRUE(two->compressed());
  }
}

TEST(RefusePacked, LimitOfMemory) {
  for (const std::string name : {"four_ascii.ply.xz", "four_ascii.ply.zst"}) {
    try {
      (void)Bytes::from_memory(name, four(name), 100);
      ADD_FAILURE() << name;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "D004");
    }
  }
}

TEST(Codes, AreDifferentAndSaid) {
  std::set<std::string_view> seen;
  for (const CodeLine& line : code_table) EXPECT_TRUE(seen.insert(line.code).second) << line.code;
  for (const CodeLine& line : field_code_table) {
    EXPECT_TRUE(seen.insert(line.code).second) << line.code;
    EXPECT_FALSE(line.line.empty());
  }
}

} // namespace
} // namespace mote::data::testing
