// SPDX-License-Identifier: MIT
#include "core/data/netcdf.hpp"

#include "core/data/codes_molecular.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::data {
namespace {

constexpr std::uint32_t tag_dimension = 10, tag_variable = 11, tag_attribute = 12;

double number_of(NcType type, const char* from) {
  switch (type) {
  case NcType::Byte: return load_number<std::int8_t>(from, Order::Big);
  case NcType::Short: return load_number<std::int16_t>(from, Order::Big);
  case NcType::Int: return load_number<std::int32_t>(from, Order::Big);
  case NcType::Float: return static_cast<double>(load_number<float>(from, Order::Big));
  case NcType::Double: return load_number<double>(from, Order::Big);
  case NcType::UShort: return load_number<std::uint16_t>(from, Order::Big);
  case NcType::UInt: return load_number<std::uint32_t>(from, Order::Big);
  case NcType::Int64: return static_cast<double>(load_number<std::int64_t>(from, Order::Big));
  case NcType::UInt64: return static_cast<double>(load_number<std::uint64_t>(from, Order::Big));
  case NcType::None:
  case NcType::Char:
  case NcType::UByte: break;
  }
  return load_number<std::uint8_t>(from, Order::Big);
}

class HeaderReader {
public:
  explicit HeaderReader(const Bytes& bytes) : in_(bytes, Order::Big) {}

  NcHeader read() {
    const std::string_view magic = in_.take(4, "the header");
    version_ = static_cast<std::uint8_t>(magic[3]);
    if (magic.substr(0, 3) != "CDF" || (version_ != 1 && version_ != 2 && version_ != 5))
      in_.refuse_at(0, molecule_code::structure,
                    "a classic NetCDF file begins with 'CDF' and the version 1, 2 or 5");
    const std::uint64_t stated = size("the number of records");
    header_.stated_records = version_ != 5 && stated == 0xffffffff ? ~std::uint64_t{0} : stated;
    for (std::uint64_t left = list(tag_dimension, "dimensions"); left > 0; --left) {
      std::string label = name();
      header_.dimensions.push_back({std::move(label), size("a dimension")});
    }
    header_.attributes = attributes();
    for (std::uint64_t left = list(tag_variable, "variables"); left > 0; --left) variable();
    lay_out();
    return std::move(header_);
  }

private:
  std::uint64_t size(std::string_view what) {
    return version_ == 5 ? in_.number<std::uint64_t>(what) : in_.number<std::uint32_t>(what);
  }
  // The number of entries of a list; an absent list is two zeros. Every entry takes 8 bytes at least.
  std::uint64_t list(std::uint32_t tag, std::string_view what) {
    const std::uint64_t at = in_.at();
    const auto found = in_.number<std::uint32_t>("the header");
    const std::uint64_t count = size("the header");
    if (found != tag && (found != 0 || count != 0))
      in_.refuse_at(at, molecule_code::structure,
                    fmt::format("the list of {} begins with tag {}, not {}", what, found, tag));
    if (count > in_.left() / 8)
      in_.refuse_at(at, molecule_code::count, fmt::format("the header cannot hold {} {}", count, what));
    return count;
  }
  std::string_view padded(std::uint64_t length, std::string_view what) {
    const std::string_view content = in_.take(length, what);
    in_.skip((4 - length % 4) % 4, what);
    return content;
  }
  std::string name() { return std::string(padded(size("a name"), "a name")); }
  NcType type() {
    const std::uint64_t at = in_.at();
    const auto number = in_.number<std::uint32_t>("a type");
    if (number < 1 || number > 11)
      in_.refuse_at(at, molecule_code::structure, fmt::format("there is no type {}", number));
    return static_cast<NcType>(number);
  }
  std::vector<NcAttribute> attributes() {
    std::vector<NcAttribute> out;
    for (std::uint64_t left = list(tag_attribute, "attributes"); left > 0; --left) {
      NcAttribute attribute{name(), type(), {}};
      const std::uint64_t at = in_.at();
      std::uint64_t length = 0;
      if (!multiply(size("an attribute"), width_of(attribute.type), length))
        in_.refuse_at(at, molecule_code::count,
                      fmt::format("the length of attribute {} is impossible", shown(attribute.name)));
      attribute.raw = padded(length, "an attribute");
      out.push_back(std::move(attribute));
    }
    return out;
  }

  void variable() {
    NcVariable out;
    const std::uint64_t start = in_.at();
    out.name = name();
    const std::uint64_t rank = size("a variable");
    if (rank > in_.left() / 4)
      in_.refuse_at(start, molecule_code::count, fmt::format("a variable cannot have {} dimensions", rank));
    out.values = 1;
    for (std::uint64_t k = 0; k < rank; ++k) {
      const std::uint64_t id = size("a variable");
      if (id >= header_.dimensions.size())
        in_.refuse_at(start, molecule_code::structure,
                      fmt::format("variable {} has dimension {}, but there are {}", shown(out.name), id,
                                  header_.dimensions.size()));
      out.dimensions.push_back(static_cast<std::uint32_t>(id));
      const std::uint64_t length = header_.dimensions[id].length;
      if (length == 0 && k == 0)
        out.record = true;
      else if (!multiply(out.values, length, out.values))
        in_.refuse_at(start, molecule_code::count,
                      fmt::format("variable {} has an impossible size", shown(out.name)));
    }
    out.attributes = attributes();
    out.type = type();
    (void)size("a variable"); // vsize: redundant, and wrong for large variables
    out.at =
        version_ == 1 ? in_.number<std::uint32_t>("a variable") : in_.number<std::uint64_t>("a variable");
    std::uint64_t bytes = 0;
    if (!multiply(out.values, width_of(out.type), bytes) || bytes > std::uint64_t{1} << 62 ||
        out.at > std::uint64_t{1} << 62)
      in_.refuse_at(start, molecule_code::count,
                    fmt::format("variable {} has an impossible size", shown(out.name)));
    if (!out.record && (out.at > in_.size() || bytes > in_.size() - out.at))
      in_.refuse_at(start, code::ends_early,
                    fmt::format("the file ends within variable {}", shown(out.name)));
    header_.variables.push_back(std::move(out));
  }

  // Record size: every record variable padded to four bytes, but a single one is not padded.
  void lay_out() {
    std::uint64_t members = 0, first = ~std::uint64_t{0}, last_end = 0;
    for (const NcVariable& v : header_.variables) members += v.record;
    for (const NcVariable& v : header_.variables) {
      if (!v.record) continue;
      const std::uint64_t bytes = v.values * width_of(v.type);
      const std::uint64_t padded_bytes = members == 1 ? bytes : (bytes + 3) / 4 * 4;
      if (__builtin_add_overflow(header_.record_size, padded_bytes, &header_.record_size))
        in_.refuse_at(4, molecule_code::count, "the size of a record is impossible");
      first = std::min(first, v.at);
      last_end = std::max(last_end, v.at + bytes);
    }
    if (members == 0 || header_.record_size == 0) return;
    header_.records_at = first;
    if (last_end - first > header_.record_size)
      in_.refuse_at(4, molecule_code::structure, "the variables of a record overlap the next record");
    // the padding behind the last record may be missing
    const std::uint64_t slack = header_.record_size - (last_end - first);
    const std::uint64_t there = in_.size() > first ? in_.size() - first : 0;
    header_.records =
        there / header_.record_size + (there % header_.record_size + slack >= header_.record_size ? 1 : 0);
    header_.records = std::min(header_.records, header_.stated_records);
  }

  ByteReader in_;
  std::uint8_t version_{};
  NcHeader header_{};
};

std::string text_of(const std::vector<NcAttribute>& attributes, std::string_view name) {
  for (const NcAttribute& a : attributes)
    if (a.name == name && a.type == NcType::Char)
      return std::string(trim(a.raw.substr(0, std::min(a.raw.find('\0'), a.raw.size()))));
  return {};
}

} // namespace

std::uint64_t width_of(NcType type) {
  constexpr std::array<std::uint8_t, 12> widths{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return widths[static_cast<std::size_t>(type)];
}

std::string NcVariable::text(std::string_view attribute) const { return text_of(attributes, attribute); }

std::optional<double> NcVariable::number(std::string_view attribute) const {
  for (const NcAttribute& a : attributes)
    if (a.name == attribute && a.type != NcType::Char && a.raw.size() >= width_of(a.type))
      return number_of(a.type, a.raw.data());
  return std::nullopt;
}

const NcVariable* NcHeader::find(std::string_view name) const {
  const auto found =
      std::find_if(variables.begin(), variables.end(), [&](const NcVariable& v) { return v.name == name; });
  return found == variables.end() ? nullptr : &*found;
}

std::string NcHeader::text(std::string_view attribute) const { return text_of(attributes, attribute); }

NcHeader read_netcdf_header(const Bytes& bytes) { return HeaderReader(bytes).read(); }

double netcdf_number(const Bytes& bytes, const NcHeader& header, const NcVariable& variable,
                     std::uint64_t record, std::uint64_t index) {
  const std::uint64_t at =
      variable.at + (variable.record ? record * header.record_size : 0) + index * width_of(variable.type);
  return number_of(variable.type, bytes.view().data() + at);
}

std::vector<double> netcdf_reals(const Bytes& bytes, const NcHeader& header, const NcVariable& variable,
                                 std::uint64_t record, double scale) {
  std::vector<double> out(variable.values);
  const char* from = bytes.view().data() + variable.at + (variable.record ? record * header.record_size : 0);
  if (variable.type == NcType::Float)
    load_reals<float>(from, Order::Big, out, scale);
  else if (variable.type == NcType::Double)
    load_reals<double>(from, Order::Big, out, scale);
  else
    for (std::uint64_t i = 0; i < out.size(); ++i)
      out[i] = number_of(variable.type, from + i * width_of(variable.type)) * scale;
  return out;
}

} // namespace mote::data
