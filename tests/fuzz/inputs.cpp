// SPDX-License-Identifier: MIT
#include "tests/fuzz/inputs.hpp"

#include "core/data/registry.hpp"
#include "tests/data_molecular/samples.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace mote::fuzz {
namespace {

namespace fs = std::filesystem;

std::string extension_of(fs::path file) {
  const std::string last = file.extension().string();
  if (last == ".gz" || last == ".xz" || last == ".zst") file = file.stem();
  const std::string extension = file.extension().string();
  return extension.empty() ? extension : extension.substr(1);
}

std::string format_of(const Input& input) {
  try {
    return std::string(data::open_bytes(data::Bytes::from_memory(input.name, input.content), input.extension)->format());
  } catch (const Failure&) {
    return {};
  }
}

} // namespace

std::map<std::string, std::vector<Input>> inputs_by_format(std::size_t most) {
  fs::current_path(fs::path(MOTE_SOURCE_DIR) / "tests/data_fields/files"); // four_raw.toml names its numbers
  std::vector<Input> all;
  for (const char* folder : {"tests/fuzz/seeds", "tests/data/files", "tests/data_fields/files", "tests/data_molecular/files"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(MOTE_SOURCE_DIR) / folder)) {
      if (!entry.is_regular_file() || entry.file_size() > most) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      all.push_back({entry.path().filename().string(), extension_of(entry.path()), std::string(std::istreambuf_iterator<char>(file), {})});
    }
  using namespace data::test;
  for (const std::uint64_t atoms : {3u, 12u}) all.push_back({"made.xtc", "xtc", make_xtc(2, atoms)});
  all.push_back({"long.xtc", "xtc", make_xtc(2, 12, true)});
  for (const bool doubles : {false, true}) all.push_back({"made.trr", "trr", make_trr(2, 3, doubles)});
  for (const auto order : {data::Order::Little, data::Order::Big})
    all.push_back({"made.dcd", "dcd", make_dcd(3, 4, {.order = order, .width = order == data::Order::Big ? 8u : 4u, .free = {1, 3}})});
  for (const std::uint32_t version : {0x10000u, 0x20000u}) all.push_back({"made.gsd", "gsd", make_gsd(2, 3, version)});
  for (const std::uint8_t version : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{5}}) all.push_back({"made.nc", "nc", make_netcdf(2, 3, version)});
  std::sort(all.begin(), all.end(), [](const Input& a, const Input& b) { return a.name != b.name ? a.name < b.name : a.content < b.content; });
  std::map<std::string, std::vector<Input>> out;
  for (Input& input : all)
    if (const std::string format = format_of(input); !format.empty()) out[format].push_back(std::move(input));
  return out;
}

std::vector<std::string> reader_names() {
  std::vector<std::string> out;
  for (const data::Format& format : data::formats())
    if (format.name != "hdf5") out.emplace_back(format.name);
  return out;
}

std::string word_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

} // namespace mote::fuzz
