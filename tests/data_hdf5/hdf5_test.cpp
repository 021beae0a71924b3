// SPDX-License-Identifier: MIT
// HDF5 formats: files that this test writes through the HDF5 library itself, as the formats' documents ask.
#include "core/data/source.hpp"
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <cmath>

namespace mote::data {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A file in the making.
class Maker {
public:
  explicit Maker(const std::filesystem::path& path) : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~Maker() { H5Fclose(file_); }
  Maker(const Maker&) = delete;
  Maker& operator=(const Maker&) = delete;
  void group(const std::string& path) { H5Gclose(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); }
  void reals(const std::string& path, std::vector<hsize_t> shape, const std::vector<double>& values) { put(path, shape, H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, values.data()); }
  void wholes(const std::string& path, std::vector<hsize_t> shape, const std::vector<std::int64_t>& values) { put(path, shape, H5T_STD_U32BE, H5T_NATIVE_INT64, values.data()); }
  void numbers(const std::string& path, const std::string& name, const std::vector<double>& values) {
    const hsize_t count = values.size();
    attribute(path, name, H5Screate_simple(1, &count, nullptr), H5T_NATIVE_DOUBLE, values.data());
  }
  void texts(const std::string& path, const std::string& name, const std::vector<std::string>& words) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 12);
    std::string all;
    for (std::string word : words) {
      word.resize(12);
      all += word;
    }
    const hsize_t count = words.size();
    attribute(path, name, H5Screate_simple(1, &count, nullptr), type, all.data());
    H5Tclose(type);
  }

private:
  void put(const std::string& path, const std::vector<hsize_t>& shape, hid_t type, hid_t memory, const void* values) {
    const hid_t space = shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t set = H5Dcreate2(file_, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(set);
    H5Pclose(links);
    H5Sclose(space);
  }
  void attribute(const std::string& path, const std::string& name, hid_t space, hid_t type, const void* values) {
    const hid_t object = H5Oopen(file_, path.c_str(), H5P_DEFAULT);
    const hid_t made = H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(made, type, values);
    H5Aclose(made);
    H5Sclose(space);
    H5Oclose(object);
  }
  hid_t file_;
};

std::vector<double> numbers(const Frame& frame, const std::string& name) {
  const Column* column = frame.find(name);
  std::vector<double> out;
  for (std::uint64_t i = 0; column && i < column->rows() * column->components; ++i)
    out.push_back(column->number(i / column->components, static_cast<std::uint32_t>(i % column->components)));
  return out;
}

std::filesystem::path h5md(const test::Folder& folder) {
  const auto path = folder / "a.h5";
  Maker m(path);
  m.group("/h5md");
  m.reals("/particles/all/position/value", {2, 2, 3}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  m.wholes("/particles/all/position/step", {2}, {0, 50});
  m.reals("/particles/all/position/time", {2}, {0, 0.5});
  m.wholes("/particles/all/species", {2}, {3, 7});
  m.reals("/particles/all/force/value", {1, 2, 3}, {1, 1, 1, 2, 2, 2}); // written less often
  m.wholes("/particles/all/force/step", {1}, {0});
  m.group("/particles/all/box");
  m.texts("/particles/all/box", "boundary", {"periodic", "none", "periodic"});
  m.reals("/particles/all/box/edges/value", {2, 3}, {4, 5, 6, 7, 8, 9});
  return path;
}

TEST(Hdf5, H5mdTrajectory) {
  const test::Folder folder;
  const auto source = open(h5md(folder));
  EXPECT_EQ(source->format(), "hdf5");
  ASSERT_EQ(source->frame_count(), 2u);
  const Frame last = source->read(1);
  EXPECT_EQ(test::broken_promise(last), "");
  EXPECT_THAT(numbers(last, "position"), ElementsAre(6, 7, 8, 9, 10, 11));
  EXPECT_THAT(numbers(last, "type"), ElementsAre(3, 7));
  EXPECT_THAT(numbers(last, "force"), ElementsAre(1, 1, 1, 2, 2, 2));
  EXPECT_EQ(last.step, 50);
  EXPECT_EQ(last.time, 0.5);
  ASSERT_TRUE(last.box);
  EXPECT_EQ(last.box->edges[2], glm::dvec3(0, 0, 9));
  EXPECT_EQ(last.box->periodic, glm::bvec3(true, false, true));
  EXPECT_EQ(test::failure_of([&] { (void)source->read(2); }).code, "D017");
}

TEST(Hdf5, OutOfMemoryAsOutOfAFile) {
  const test::Folder folder;
  const std::string content = test::content_of(h5md(folder));
  EXPECT_THAT(numbers(test::read_text(content, "h5"), "position"), ElementsAre(0, 1, 2, 3, 4, 5));
}

std::filesystem::path gadget(const test::Folder& folder) {
  const auto path = folder / "snap.hdf5";
  Maker m(path);
  m.group("/Header");
  m.numbers("/Header", "BoxSize", {100});
  m.numbers("/Header", "Time", {0.25});
  m.numbers("/Header", "MassTable", {0, 2.5, 0, 0, 0, 0});
  m.reals("/PartType0/Coordinates", {1, 3}, {1, 2, 3});
  m.reals("/PartType0/Masses", {1}, {0.5});
  m.reals("/PartType0/Density", {1}, {8});
  m.wholes("/PartType0/ParticleIDs", {1}, {11});
  m.reals("/PartType1/Coordinates", {2, 3}, {4, 5, 6, 7, 8, 9});
  m.wholes("/PartType1/ParticleIDs", {2}, {12, 13});
  return path;
}

TEST(Hdf5, GadgetSnapshot) {
  const test::Folder folder;
  const auto path = gadget(folder);
  const Frame frame = open(path)->read(0);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_EQ(frame.count, 3u);
  EXPECT_THAT(numbers(frame, "position"), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(numbers(frame, "mass"), ElementsAre(0.5, 2.5, 2.5));
  EXPECT_THAT(numbers(frame, "id"), ElementsAre(11, 12, 13));
  EXPECT_EQ(frame.find("id")->type(), ColumnType::Int);
  EXPECT_THAT(numbers(frame, "type"), ElementsAre(0, 1, 1));
  EXPECT_TRUE(std::isnan(numbers(frame, "Density").at(2)));
  EXPECT_EQ(frame.time, 0.25);
  EXPECT_EQ(frame.box->edges[1][1], 100.0);
}

std::filesystem::path vtkhdf(const test::Folder& folder) {
  const auto path = folder / "a.vtkhdf";
  Maker m(path);
  m.reals("/VTKHDF/Points", {2, 3}, {1, 2, 3, 4, 5, 6});
  m.reals("/VTKHDF/PointData/Temp", {2}, {7, 8});
  m.reals("/VTKHDF/PointData/V", {2, 3}, {1, 0, 0, 0, 1, 0});
  return path;
}

TEST(Hdf5, VtkHdfPoints) {
  const test::Folder folder;
  const auto path = vtkhdf(folder);
  const Frame frame = open(path)->read(0);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_THAT(numbers(frame, "position"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(frame.columns.size(), 3u);
}

TEST(Hdf5, WhatIsNoneOfThem) {
  const test::Folder folder;
  {
    Maker m(folder / "other.h5");
    m.reals("/data", {3}, {1, 2, 3});
    Maker flat(folder / "flat.h5");
    flat.group("/h5md");
    flat.reals("/particles/a/position", {4, 2}, {1, 2, 3, 4, 5, 6, 7, 8});
  }
  const Diagnostic other = test::failure_of([&] { (void)open(folder / "other.h5"); });
  EXPECT_EQ(other.code, "D042");
  EXPECT_THAT(to_string(other), HasSubstr("H5MD"));
  EXPECT_EQ(test::failure_of([&] { (void)open(folder / "flat.h5"); }).code, "D013");
}

// The files that fuzzing starts from (tests/fuzz/seeds/*.h5) are those of the tests above, made where MOTE_UPDATE_SEEDS is set.
TEST(Hdf5, KeptSeedsAreRead) {
  const std::filesystem::path seeds = std::filesystem::path(MOTE_SOURCE_DIR) / "tests/fuzz/seeds";
  if (std::getenv("MOTE_UPDATE_SEEDS")) {
    const test::Folder folder;
    std::filesystem::copy_file(h5md(folder), seeds / "h5md.h5", std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy_file(gadget(folder), seeds / "gadget.h5", std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy_file(vtkhdf(folder), seeds / "vtkhdf.h5", std::filesystem::copy_options::overwrite_existing);
  }
  for (const auto& [name, count] : {std::pair{"h5md.h5", 2u}, {"gadget.h5", 3u}, {"vtkhdf.h5", 2u}}) EXPECT_EQ(open(seeds / name)->read(0).count, count) << name;
}

TEST(Hdf5, CutOrChangedFilesAreReadOrRefused) {
  const test::Folder folder;
  const std::string content = test::content_of(h5md(folder));
  for (std::size_t length = 8; length < content.size(); length += 37) ASSERT_EQ(test::survives(content.substr(0, length), "h5"), "") << length;
  for (std::size_t at = 8; at < content.size(); at += 11) {
    std::string changed = content;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    ASSERT_EQ(test::survives(changed, "h5"), "") << at;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 600 << 10) << "memory was taken for a count that lies";
}

} // namespace
} // namespace mote::data
