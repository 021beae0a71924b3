// SPDX-License-Identifier: MIT
// Format: numpy.lib.format (NEP 1): magic, version, length of a header that is a Python literal
// {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }, padded so that data begin at 64 n.
#include "core/image/npy.hpp"

#include "core/base/atomic_file.hpp"
#include "core/base/diagnostic.hpp"
#include "core/image/read_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>

namespace mote {

namespace {
static_assert(std::endian::native == std::endian::little);
constexpr std::string_view magic{"\x93NUMPY", 6};

// Bytes of one value of a plain type name ("<f4", "|u1", "|b1"), 0 for structured and other ones.
std::size_t value_size(std::string_view type) {
  if (type.size() < 3 || std::string_view("<>|=").find(type[0]) == std::string_view::npos ||
      std::string_view("fiubc").find(type[1]) == std::string_view::npos)
    return 0;
  std::size_t size = 0;
  const auto [end, error] = std::from_chars(type.data() + 2, type.data() + type.size(), size);
  return error == std::errc{} && end == type.data() + type.size() && size <= 16 ? size : 0;
}

std::optional<std::size_t> product(std::span<const std::size_t> shape, std::size_t unit) {
  std::size_t total = unit;
  for (const std::size_t n : shape)
    if (__builtin_mul_overflow(total, n, &total)) return std::nullopt;
  return total;
}

[[noreturn]] void broken(const std::string& path, const std::string& why) {
  fail(Exit::BadInput, "I007", {path}, why);
}

// What follows 'key': in the header, or nothing.
std::string_view after_key(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(fmt::format("'{}'", key));
  if (at == std::string_view::npos) return {};
  header = header.substr(at + key.size() + 2);
  const std::size_t start = header.find_first_not_of(" :");
  return start == std::string_view::npos ? std::string_view{} : header.substr(start);
}

std::vector<std::size_t> parse_shape(const std::string& path, std::string_view text) {
  const std::size_t end = text.find(')');
  if (text.empty() || text[0] != '(' || end == std::string_view::npos)
    broken(path, "the header has no 'shape'");
  std::vector<std::size_t> shape;
  for (std::size_t i = 1; i < end;) {
    if (text[i] == ' ' || text[i] == ',') {
      ++i;
      continue;
    }
    std::size_t n = 0;
    const auto [stop, error] = std::from_chars(text.data() + i, text.data() + end, n);
    if (error != std::errc{})
      broken(path, fmt::format("the shape '{}' is no list of lengths", text.substr(0, end + 1)));
    shape.push_back(n);
    i = static_cast<std::size_t>(stop - text.data());
  }
  return shape;
}

// Fortran order -> C order.
std::vector<std::byte> transposed(std::span<const std::byte> in, const std::vector<std::size_t>& shape,
                                  std::size_t unit) {
  std::vector<std::byte> out(in.size());
  std::vector<std::size_t> index(shape.size());
  for (std::size_t at = 0; at < in.size(); at += unit) {
    std::size_t place = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) place = place * shape[k] + index[k];
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(at), unit,
                out.begin() + static_cast<std::ptrdiff_t>(place * unit));
    for (std::size_t k = 0; k < shape.size() && ++index[k] == shape[k]; ++k) index[k] = 0;
  }
  return out;
}

void swap_order(NpyArray& array, std::size_t unit) {
  if (array.type[0] == '>') {
    const std::size_t part = array.type[1] == 'c' ? unit / 2 : unit;
    for (std::size_t at = 0; at + part <= array.bytes.size(); at += part)
      std::reverse(array.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                   array.bytes.begin() + static_cast<std::ptrdiff_t>(at + part));
  }
  array.type[0] = unit == 1 ? '|' : '<';
}
} // namespace

void write_npy(const std::string& path, std::string_view type, std::span<const std::size_t> shape,
               std::span<const std::byte> bytes) {
  std::string lengths;
  for (const std::size_t n : shape) lengths += fmt::format("{}, ", n);
  if (shape.size() > 1) lengths.resize(lengths.size() - 2);
  if (product(shape, value_size(type)) != bytes.size() || value_size(type) == 0)
    fail(Exit::Failed, "I008", {path},
         fmt::format("{} bytes are no array of the type '{}' and the shape ({})", bytes.size(), type,
                     lengths));
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, lengths);
  header.append((64 - (10 + header.size() + 1) % 64) % 64, ' ');
  header += '\n';
  std::string head(magic);
  head += {'\1', '\0', static_cast<char>(header.size() & 255), static_cast<char>(header.size() >> 8)};
  AtomicFile file(path);
  file.write(head + header);
  file.write(bytes);
  file.commit();
}

std::size_t NpyArray::size() const { return product(shape, 1).value_or(0); }

NpyArray read_npy(const std::string& path) {
  const std::vector<std::byte> file = read_whole_file(path);
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (text.substr(0, 6) != magic || text.size() < 12)
    broken(path, "the file does not begin as a NumPy array does");
  auto byte_at = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(text[i])); };
  const std::size_t version = byte_at(6), length_bytes = version == 1 ? 2 : 4;
  if (version < 1 || version > 3)
    broken(path, fmt::format("version '{}' of the format is unknown; 1, 2 and 3 are known", version));
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) length |= byte_at(8 + i) << (8 * i);
  const std::size_t start = 8 + length_bytes + length;
  if (start > text.size()) broken(path, "the file ends within its header");
  const std::string_view header = text.substr(8 + length_bytes, length);

  NpyArray array;
  const std::string_view descr = after_key(header, "descr"), order = after_key(header, "fortran_order");
  if (descr.size() > 1 && descr[0] == '\'') array.type = descr.substr(1, descr.find('\'', 1) - 1);
  const std::size_t unit = value_size(array.type);
  if (unit == 0)
    broken(path, fmt::format("the type '{}' is no plain number", descr.substr(0, descr.find(", 'fort"))));
  array.shape = parse_shape(path, after_key(header, "shape"));
  const auto needed = product(array.shape, unit);
  if (!needed || *needed != text.size() - start)
    broken(path, fmt::format("the header promises {} bytes of values, {} follow",
                             needed ? fmt::format("{}", *needed) : "too many", text.size() - start));
  const auto values = std::span(file).subspan(start);
  if (order.substr(0, 4) == "True")
    array.bytes = transposed(values, array.shape, unit);
  else
    array.bytes.assign(values.begin(), values.end());
  swap_order(array, unit);
  return array;
}

} // namespace mote
