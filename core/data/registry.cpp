// SPDX-License-Identifier: MIT
#include "core/data/registry.hpp"

#include "core/data/codes.hpp"
#include "core/data/text.hpp"

#include <algorithm>
#include <array>

// One line for each format.
#define MOTE_READERS(X)                                                                                      \
  X(lammps_dump)                                                                                             \
  X(xyz)                                                                                                     \
  X(npy)                                                                                                     \
  X(vtk)                                                                                                     \
  X(vtk_xml)                                                                                                 \
  X(bgeo)                                                                                                    \
  X(ovf)                                                                                                     \
  X(npz)                                                                                                     \
  X(ply)                                                                                                     \
  X(obj)                                                                                                     \
  X(off)                                                                                                     \
  X(stl)                                                                                                     \
  X(raw)                                                                                                     \
  X(pdb)                                                                                                     \
  X(mmcif)                                                                                                   \
  X(gro)                                                                                                     \
  X(xtc)                                                                                                     \
  X(trr)                                                                                                     \
  X(dcd)                                                                                                     \
  X(gsd)                                                                                                     \
  X(netcdf)                                                                                                  \
  X(lammps_data)                                                                                             \
  X(hdf5)                                                                                                    \
  X(csv)

namespace mote::data {

#define MOTE_DECLARE(name) Reader name##_reader();
MOTE_READERS(MOTE_DECLARE)
#undef MOTE_DECLARE

namespace {

const auto& readers() {
#define MOTE_CALL(name) name##_reader(),
  static const std::array list{MOTE_READERS(MOTE_CALL)};
#undef MOTE_CALL
  return list;
}

bool has_extension(const Format& format, std::string_view extension) {
  Words words(format.extensions);
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    if (word == extension) return true;
  return false;
}

std::string extension_of(std::filesystem::path file) {
  const std::string last = lower(file.extension().string());
  if (last == ".gz" || last == ".xz" || last == ".zst") file = file.stem();
  std::string extension = lower(file.extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

} // namespace

std::span<const Format> formats() {
  static const auto list = [] {
    std::vector<Format> out;
    for (const Reader& reader : readers()) out.push_back(reader.format);
    return out;
  }();
  return list;
}

std::unique_ptr<Source> open_bytes(std::shared_ptr<Bytes> bytes, std::string_view extension) {
  Probe probe{bytes->view().substr(0, 1 << 16), extension};
  if (probe.head.starts_with("\xef\xbb\xbf")) probe.head.remove_prefix(3);
  if (trim(probe.head).empty() && bytes->view().size() <= (1 << 16))
    fail(Exit::BadInput, code::empty, {bytes->name()}, "the file holds nothing but white space");
  const Reader* best = nullptr;
  int best_rank = 0;
  for (const Reader& reader : readers()) {
    const Sureness sure = reader.probe(probe);
    const bool named = has_extension(reader.format, extension);
    if (sure == Sureness::No || (sure == Sureness::ByName && !named)) continue;
    const int rank = 2 * static_cast<int>(sure) + (named ? 1 : 0);
    if (rank > best_rank) {
      best_rank = rank;
      best = &reader;
    }
  }
  if (best) return best->make(std::move(bytes));
  std::vector<std::string> known;
  for (const Format& format : formats()) known.emplace_back(format.name);
  const std::string_view first = probe.head.substr(0, std::min(probe.head.find('\n'), probe.head.size()));
  fail(Exit::BadInput, code::unknown_format, {bytes->name()},
       "no reader recognizes the content, which begins with " + shown(trim(first)),
       {"formats: " + list_of(known), "numbers without a heading are described by a small TOML file with mote_raw = 1 (docs/formats.md)"});
}

std::unique_ptr<Source> open(const std::filesystem::path& file) {
  return open_bytes(Bytes::load(file), extension_of(file));
}

} // namespace mote::data
