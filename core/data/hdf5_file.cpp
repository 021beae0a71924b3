// SPDX-License-Identifier: MIT
#include "core/data/hdf5_file.hpp"

#include "core/data/codes.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/fields.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace mote::data {
namespace {

// Closes an HDF5 object of any kind.
struct Handle {
  hid_t id{-1};
  herr_t (*close)(hid_t){};
  Handle(hid_t i, herr_t (*c)(hid_t)) : id(i), close(c) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id >= 0) close(id);
  }
  explicit operator bool() const { return id >= 0; }
};

std::vector<std::uint64_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank <= 0) return {};
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

constexpr std::uint64_t longest_text = 1 << 16;

std::vector<std::string> texts_of(hid_t attribute) {
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const hssize_t points = H5Sget_simple_extent_npoints(space.id);
  if (H5Tget_class(type.id) != H5T_STRING || points < 1 || points > 64) return {};
  const auto count = static_cast<std::size_t>(points);
  std::vector<std::string> out;
  if (H5Tis_variable_str(type.id) > 0) {
    std::vector<char*> words(count, nullptr);
    const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory.id, H5T_VARIABLE);
    H5Tset_cset(memory.id, H5Tget_cset(type.id));
    if (H5Aread(attribute, memory.id, words.data()) < 0) return {};
    for (char* word : words) out.emplace_back(word ? std::string(word).substr(0, longest_text) : std::string{});
    H5Dvlen_reclaim(memory.id, space.id, H5P_DEFAULT, words.data());
    return out;
  }
  const std::size_t size = H5Tget_size(type.id);
  if (size == 0 || size > longest_text) return {};
  std::string all(size * count, '\0');
  if (H5Aread(attribute, type.id, all.data()) < 0) return {};
  for (std::size_t i = 0; i < count; ++i) {
    std::string word = all.substr(i * size, size);
    word.resize(std::min(word.find('\0'), word.size()));
    out.push_back(std::move(word));
  }
  return out;
}

} // namespace

void Hdf5File::refuse(std::string_view code, const std::string& text, std::vector<std::string> hints) const {
  fail(Exit::BadInput, code, {name()}, text, std::move(hints));
}

Hdf5File::Hdf5File(std::shared_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  std::error_code error;
  const bool plain = !bytes_->compressed() && std::filesystem::file_size(name(), error) == bytes_->view().size();
  if (!plain) { // packed, piped or in memory: an image
    H5Pset_fapl_core(access.id, 1 << 20, 0);
    H5Pset_file_image(access.id, const_cast<char*>(bytes_->view().data()), bytes_->view().size());
  }
  file_ = H5Fopen(plain ? name().c_str() : "image", H5F_ACC_RDONLY, access.id);
  if (file_ < 0) refuse(molecule_code::compressed, "the HDF5 library cannot open the file: it is damaged or cut off");
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

bool Hdf5File::has(const std::string& path) const {
  for (std::size_t at = path.find('/', 1);; at = path.find('/', at + 1)) { // each part: the library asks for that
    const std::string part = path.substr(0, at);
    if (part != "/" && H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (at == std::string::npos) break;
  }
  return path == "/" || H5Oexists_by_name(file_, path.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5File::is_group(const std::string& path) const {
  const Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose);
  return static_cast<bool>(group);
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Handle open(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (!open || H5Gget_info(open.id, &info) < 0) return {};
  std::vector<std::string> names;
  for (hsize_t i = 0; i < std::min<hsize_t>(info.nlinks, 4096); ++i) {
    const ssize_t length = H5Lget_name_by_idx(open.id, ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
    if (length <= 0 || length > 4096) continue;
    std::string word(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(open.id, ".", H5_INDEX_NAME, H5_ITER_INC, i, word.data(), word.size(), H5P_DEFAULT);
    word.pop_back();
    names.push_back(std::move(word));
  }
  return names;
}

std::vector<std::uint64_t> Hdf5File::shape(const std::string& dataset) const {
  const Handle open(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!open) return {};
  const Handle space(H5Dget_space(open.id), H5Sclose);
  return shape_of(space.id);
}

Hdf5File::Type Hdf5File::type(const std::string& dataset) const {
  const Handle open(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!open) return Type::Other;
  const Handle type(H5Dget_type(open.id), H5Tclose);
  switch (H5Tget_class(type.id)) {
  case H5T_FLOAT: return Type::Real;
  case H5T_INTEGER:
  case H5T_ENUM: return Type::Whole;
  case H5T_STRING: return Type::Text;
  default: return Type::Other;
  }
}

// A count may lie: more numbers than the file can hold are refused before memory is taken for them. Packed chunks, and those
// that were never written, are at most a thousand times as large as the file (deflate packs 1032 to 1).
void Hdf5File::check_size(const std::string& dataset, std::int64_t open, std::uint64_t count) const {
  const Handle type(H5Dget_type(open), H5Tclose), made(H5Dget_create_plist(open), H5Pclose);
  const std::uint64_t ratio = H5Pget_layout(made.id) == H5D_CHUNKED ? 1032 : 1, most = times(bytes_->view().size(), ratio);
  if (times(count, std::max<std::size_t>(1, H5Tget_size(type.id))) > most)
    refuse(molecule_code::count, fmt::format("the dataset '{}' claims {} values, more than a file of {} bytes can hold", dataset, count, bytes_->view().size()));
}

template <class T> std::vector<T> Hdf5File::values(const std::string& dataset, std::optional<std::uint64_t> first, std::int64_t memory_type) const {
  const Handle open(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!open) refuse(molecule_code::compressed, fmt::format("the dataset '{}' cannot be opened", dataset));
  const Handle space(H5Dget_space(open.id), H5Sclose);
  const std::vector<std::uint64_t> all = shape_of(space.id);
  std::uint64_t count = 1;
  for (std::size_t k = first ? 1 : 0; k < all.size(); ++k) count = times(count, all[k]);
  check_size(dataset, open.id, first && !all.empty() ? times(count, all[0]) : count);
  need_memory(times(count, sizeof(T)), {name()}, fmt::format("the dataset '{}'", dataset));
  std::vector<T> out(count);
  if (count == 0) return out;
  std::vector<hsize_t> start(all.size()), length(all.begin(), all.end());
  if (first) {
    start[0] = *first;
    length[0] = 1;
    H5Sselect_hyperslab(space.id, H5S_SELECT_SET, start.data(), nullptr, length.data(), nullptr);
  }
  const hsize_t flat = count;
  const Handle memory(H5Screate_simple(1, &flat, nullptr), H5Sclose);
  if (H5Dread(open.id, memory_type, memory.id, all.empty() ? H5S_ALL : space.id, H5P_DEFAULT, out.data()) < 0)
    refuse(molecule_code::compressed, fmt::format("the dataset '{}' cannot be read: it is damaged, or packed in a way that the library does not know", dataset));
  return out;
}

std::vector<double> Hdf5File::reals(const std::string& dataset, std::optional<std::uint64_t> first) const {
  return values<double>(dataset, first, H5T_NATIVE_DOUBLE);
}
std::vector<std::int64_t> Hdf5File::wholes(const std::string& dataset, std::optional<std::uint64_t> first) const {
  return values<std::int64_t>(dataset, first, H5T_NATIVE_INT64);
}

Column Hdf5File::column(const std::string& name, std::uint32_t components, const std::string& dataset, std::optional<std::uint64_t> first) const {
  if (type(dataset) == Type::Whole) return {name, components, wholes(dataset, first), {}};
  return {name, components, reals(dataset, first), {}};
}

std::vector<double> Hdf5File::attribute_numbers(const std::string& path, const std::string& name) const {
  if (H5Aexists_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return {};
  const Handle attribute(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute.id), H5Sclose), type(H5Aget_type(attribute.id), H5Tclose);
  const hssize_t points = H5Sget_simple_extent_npoints(space.id);
  const H5T_class_t kind = H5Tget_class(type.id);
  if (points < 1 || points > 4096 || (kind != H5T_FLOAT && kind != H5T_INTEGER)) return {};
  std::vector<double> out(static_cast<std::size_t>(points));
  return H5Aread(attribute.id, H5T_NATIVE_DOUBLE, out.data()) < 0 ? std::vector<double>{} : out;
}

std::vector<std::string> Hdf5File::attribute_texts(const std::string& path, const std::string& name) const {
  if (H5Aexists_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return {};
  const Handle attribute(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute ? texts_of(attribute.id) : std::vector<std::string>{};
}

} // namespace mote::data
