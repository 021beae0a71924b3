// SPDX-License-Identifier: MIT
// What other systems do to a file, for every reader: mixed line ends, another locale, names that are no UTF-8, a pipe,
// counts of 2^63. The particles stay the same, or the file is refused in words.
#include "core/data/source.hpp"
#include "tests/data/support.hpp"
#include "tests/fuzz/inputs.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace mote::fuzz {
namespace {

namespace fs = std::filesystem;

const auto& all_inputs() {
  static const auto inputs = inputs_by_format(40000);
  return inputs;
}

// Frame 0 as numbers that can be compared: count, then every number of every column (NaN as a word of its own).
std::vector<double> content_of(const data::Frame& frame) {
  std::vector<double> out{static_cast<double>(frame.count)};
  for (const data::Column& column : frame.columns) {
    if (std::holds_alternative<data::TextColumn>(column.values)) {
      for (std::uint64_t i = 0; i < frame.count; ++i) out.push_back(static_cast<double>(std::get<data::TextColumn>(column.values).at(i).size()));
      continue;
    }
    for (std::uint64_t i = 0; i < frame.count; ++i)
      for (std::uint32_t k = 0; k < column.components; ++k) {
        const double value = column.number(i, k);
        out.push_back(std::isnan(value) ? -987654321.0 : value);
      }
  }
  return out;
}
// Nothing where the file is refused.
std::vector<double> read(const std::string& content, const std::string& extension) {
  try {
    return content_of(data::open_bytes(data::Bytes::from_memory("input", content), extension)->read(0));
  } catch (const Failure&) {
    return {};
  }
}

bool is_text(std::string_view content) {
  return std::all_of(content.begin(), content.end(), [](char c) { return (c >= ' ' && c != 127) || c == '\n' || c == '\t' || c == '\r'; });
}
// Every other line ends as on Windows.
std::string with_mixed_ends(std::string_view content) {
  std::string out;
  bool odd = false;
  for (const char c : content) {
    if (c == '\r') continue;
    if (c == '\n' && (odd = !odd)) out += '\r';
    out += c;
  }
  return out;
}

// A decimal comma and dots between thousands everywhere that asks the locale.
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};
class GermanLocale {
public:
  GermanLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new German))) { (void)std::setlocale(LC_ALL, "de_DE.UTF-8"); }
  ~GermanLocale() {
    std::locale::global(before_);
    (void)std::setlocale(LC_ALL, "C");
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;

private:
  std::locale before_;
};

class OddInput : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    const auto found = all_inputs().find(GetParam());
    ASSERT_NE(found, all_inputs().end());
    inputs_ = found->second;
  }
  std::vector<Input> inputs_;
};

TEST_P(OddInput, MixedLineEnds) {
  for (const Input& input : inputs_) {
    if (!is_text(input.content)) continue;
    EXPECT_EQ(read(with_mixed_ends(input.content), input.extension), read(input.content, input.extension)) << input.name;
  }
}

TEST_P(OddInput, TheLocaleDoesNotMatter) {
  for (const Input& input : inputs_) {
    const std::vector<double> before = read(input.content, input.extension);
    const GermanLocale german;
    EXPECT_EQ(read(input.content, input.extension), before) << input.name;
  }
}

TEST_P(OddInput, NamesNeedNotBeUtf8AndPipesAreRead) {
  const fs::path folder = fs::temp_directory_path() / ("mote_odd_" + GetParam() + std::to_string(::getpid()));
  fs::create_directories(folder);
  fs::copy_file("four.raw", folder / "four.raw", fs::copy_options::overwrite_existing); // what the heading of raw numbers names
  int read_files = 0;
  for (const Input& input : inputs_) {
    const std::vector<double> wanted = read(input.content, input.extension);
    if (wanted.empty()) continue;
    const fs::path odd = folder / ("b\xe4r \xff." + input.extension), pipe = folder / ("pipe." + input.extension);
    std::ofstream(odd, std::ios::binary) << input.content;
    ++read_files;
    EXPECT_EQ(content_of(data::open(odd)->read(0)), wanted) << input.name;
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << input.content; });
    EXPECT_EQ(content_of(data::open(pipe)->read(0)), wanted) << input.name;
    writer.join();
    fs::remove(pipe);
  }
  EXPECT_GE(read_files, 1);
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Readers, OddInput, testing::ValuesIn(reader_names()), [](const auto& tested) { return word_of(tested.param); });

// 2^63 particles and one more than a signed number holds, in the words of each format that states a count.
TEST(Counts, TwoToThe63IsRefused) {
  (void)all_inputs(); // four.raw is found beside it
  const std::string huge = "9223372036854775808";
  const std::pair<const char*, std::string> files[] = {
      {"xyz", huge + "\n\nO 0 0 0\n"},
      {"dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + huge + "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z\n1 1 0 0 0\n"},
      {"data", "title\n\n" + huge + " atoms\n1 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms # atomic\n\n1 1 0 0 0\n"},
      {"gro", "title\n" + huge + "\n    1SOL     OW    1   0.000   0.000   0.000\n   1.0 1.0 1.0\n"},
      {"ply", "ply\nformat ascii 1.0\nelement vertex " + huge + "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"},
      {"off", "OFF\n" + huge + " 0 0\n0 0 0\n"},
      {"vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS " + huge + " float\n0 0 0\n"},
      {"vti", "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 " + huge + " 0 0 0 0\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 " +
                  huge + " 0 0 0 0\"></Piece></ImageData></VTKFile>\n"},
      {"omf", "# OOMMF OVF 2.0\n# Segment count: 1\n# Begin: Segment\n# Begin: Header\n# meshtype: rectangular\n# valuedim: 3\n# xnodes: " + huge +
                  "\n# ynodes: 1\n# znodes: 1\n# xbase: 0\n# ybase: 0\n# zbase: 0\n# xstepsize: 1\n# ystepsize: 1\n# zstepsize: 1\n# End: Header\n# Begin: Data Text\n0 0 0\n# End: Data Text\n# End: Segment\n"},
      {"toml", "mote_raw = 1\n[[file]]\npath = \"four.raw\"\nkind = \"binary\"\ncount = 9223372036854775807\nlayout = [\"position f4 3\"]\n"},
      {"vtp", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece NumberOfPoints=\"" + huge +
                  "\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points></Piece></PolyData></VTKFile>\n"},
  };
  for (const auto& [extension, content] : files) {
    const Diagnostic d = data::test::failure_of_text(content, extension);
    EXPECT_NE(d.code, "none") << extension;
    EXPECT_NE(d.code, "D005") << extension << " was not even recognized";
    EXPECT_GT(d.text.size(), 10u) << extension;
  }
  // .npy: a header of that many rows
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + huge + ", 3), }";
  header.resize(118, ' ');
  header.back() = '\n';
  const Diagnostic d = data::test::failure_of_text(std::string("\x93NUMPY\x01\x00v\x00", 10) + header + "0123456789ab", "npy");
  EXPECT_NE(d.code, "none");
  EXPECT_NE(d.code, "D005");
}

} // namespace
} // namespace mote::fuzz
