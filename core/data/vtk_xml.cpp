// SPDX-License-Identifier: MIT
#include "core/data/vtk_xml.hpp"

#include "core/data/blocks.hpp"
#include "core/data/codes_fields.hpp"
#include "core/data/scan.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace mote::data {
namespace {

constexpr std::array<std::pair<std::string_view, Scalar>, 10> type_words{{
    {"Int8", Scalar::Int8},
    {"UInt8", Scalar::UInt8},
    {"Int16", Scalar::Int16},
    {"UInt16", Scalar::UInt16},
    {"Int32", Scalar::Int32},
    {"UInt32", Scalar::UInt32},
    {"Int64", Scalar::Int64},
    {"UInt64", Scalar::UInt64},
    {"Float32", Scalar::Float32},
    {"Float64", Scalar::Float64},
}};

std::string name_of(pugi::xml_node array) {
  const std::string_view name = array.attribute("Name").value();
  return name.empty() ? "unnamed" : std::string(name);
}

} // namespace

// The encoded bytes of one array: base64 text or raw bytes. `at` is where in the file they begin.
struct VtkXml::Feed {
  std::string_view text{};
  std::uint64_t begin{};
  bool encoded{};
  pugi::xml_node array{};
  const VtkXml* xml{};
  Base64 decoder{text};
  std::size_t used{};

  [[nodiscard]] std::uint64_t left() const { // at most
    return encoded ? (text.size() - std::min(decoder.at(), text.size())) / 4 * 3 + 5 : text.size() - used;
  }
  // Lines are counted from the begin of the file: only for messages.
  [[nodiscard]] std::uint64_t offset() const { return begin + (encoded ? decoder.at() : used); }
  [[nodiscard]] SourceLoc place_of(std::uint64_t at) const {
    if (!encoded) return byte_place(xml->bytes_, at);
    return text_place(xml->bytes_.name(), xml->bytes_.view(), at);
  }
  [[nodiscard]] SourceLoc place() const { return place_of(offset()); }
  void need(std::uint64_t bytes, std::string_view what) const { // D006
    if (bytes > left()) need_bytes(bytes, left(), place(), fmt::format("{} {}", what, shown(name_of(array))));
  }
  [[nodiscard]] std::string read(std::uint64_t bytes) {
    need(bytes, "the array");
    std::string out(bytes, '\0');
    if (!encoded) {
      out.assign(text.substr(used, bytes));
      used += bytes;
    } else if (!decoder.read(out)) {
      if (decoder.at_end())
        fail(Exit::BadInput, code::ends_early, place(),
             fmt::format("the base64 text of the array {} ends early", shown(name_of(array))));
      fail(Exit::BadInput, field_code::base64, place(),
           fmt::format("the array {} is no base64 text here", shown(name_of(array))));
    }
    return out;
  }
};

VtkXml::VtkXml(Bytes& bytes) : bytes_(bytes) {
  cut_appended();
  // Line ends and entities of the texts stay as they are: values are read from the file itself.
  const pugi::xml_parse_result result = document_.load_buffer_inplace(
      xml_.data(), xml_.size(),
      pugi::parse_minimal | pugi::parse_escapes | pugi::parse_wconv_attribute | pugi::parse_cdata,
      pugi::encoding_utf8);
  if (!result) {
    const auto at = static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(result.offset, 0));
    fail(Exit::BadInput, field_code::markup, text_place(bytes.name(), bytes.view(), at),
         fmt::format("the XML is malformed: {}", result.description()));
  }
  root_ = document_.child("VTKFile");
  if (!root_) fail(Exit::BadInput, field_code::part, {bytes.name(), 1, 1}, "the XML has no element VTKFile");
  read_head();
}

// Finds <AppendedData ...>_ and takes what follows out of the XML. The file must end with </VTKFile>.
void VtkXml::cut_appended() {
  const std::string_view all = bytes_.view();
  constexpr std::string_view white = " \t\r\n";
  if (!all.substr(0, all.find_last_not_of(white) + 1).ends_with("</VTKFile>"))
    fail(Exit::BadInput, code::ends_early, byte_place(bytes_, all.size()),
         "the file ends early: </VTKFile> is missing");
  const std::size_t tag = all.find("<AppendedData");
  const std::size_t close = tag == std::string_view::npos ? tag : all.find('>', tag);
  if (close == std::string_view::npos) {
    xml_ = std::string(all);
    return;
  }
  const std::size_t mark = all.find('_', close);
  const std::size_t end = all.rfind("</AppendedData");
  if (mark == std::string_view::npos || end == std::string_view::npos || mark > end ||
      all.substr(close + 1, mark - close - 1).find_first_not_of(white) != std::string_view::npos)
    fail(Exit::BadInput, field_code::part, text_place(bytes_.name(), all, close),
         "AppendedData does not begin with '_' or is not closed");
  xml_ = std::string(all.substr(0, close + 1)) + "</AppendedData></VTKFile>";
  appended_at_ = mark + 1;
  appended_ = all.substr(mark + 1, end - mark - 1);
}

void VtkXml::read_head() {
  const std::string_view order = root_.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    refuse(root_, field_code::part, fmt::format("the byte_order {} is unknown", shown(order)),
           {"known: LittleEndian, BigEndian"});
  order_ = order == "BigEndian" ? Order::Big : Order::Little;
  const std::string_view header = root_.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64")
    refuse(root_, field_code::part, fmt::format("the header_type {} is unknown", shown(header)),
           {"known: UInt32, UInt64"});
  header_size_ = header == "UInt64" ? 8 : 4;
  const std::string_view compressor = root_.attribute("compressor").value();
  constexpr std::array<std::string_view, 4> known{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor",
                                                  "vtkLZMADataCompressor"};
  const auto found = std::find(known.begin(), known.end(), compressor);
  if (found == known.end())
    refuse(root_, field_code::variant, fmt::format("the compressor {} is unknown", shown(compressor)),
           {"known: vtkZLibDataCompressor, vtkLZ4DataCompressor, vtkLZMADataCompressor"});
  compressor_ = static_cast<Compressor>(found - known.begin());
  const pugi::xml_node appended = root_.child("AppendedData");
  if (!appended) return;
  const std::string_view encoding = appended.attribute("encoding").as_string("base64");
  if (encoding != "raw" && encoding != "base64")
    refuse(appended, field_code::part, fmt::format("the encoding {} is unknown", shown(encoding)),
           {"known: raw, base64"});
  appended_base64_ = encoding == "base64";
}

SourceLoc VtkXml::place(pugi::xml_node node) const {
  const std::ptrdiff_t at = node.offset_debug();
  return text_place(bytes_.name(), bytes_.view(), at < 0 ? 0 : static_cast<std::uint64_t>(at));
}

void VtkXml::refuse(pugi::xml_node node, std::string_view code, std::string text,
                    std::vector<std::string> hints) const {
  fail(Exit::BadInput, code, place(node), std::move(text), std::move(hints));
}

std::uint64_t VtkXml::count(pugi::xml_node node, const char* attribute) const {
  const pugi::xml_attribute found = node.attribute(attribute);
  std::uint64_t value = 0;
  if (!found) refuse(node, field_code::part, fmt::format("{} has no attribute {}", node.name(), attribute));
  if (!parse_count(trim(found.value()), value))
    refuse(node, field_code::part, fmt::format("{} {} is not a count", attribute, shown(found.value())));
  return value;
}

std::vector<double> VtkXml::numbers(pugi::xml_node node, const char* attribute, std::size_t count) const {
  std::string text = node.attribute(attribute).value();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  std::vector<double> out;
  Words words(text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    double value = 0;
    if (!parse_real(word, value))
      refuse(node, field_code::part,
             fmt::format("{} of {} is not a number: {}", attribute, node.name(), shown(word)));
    out.push_back(value);
  }
  if (out.size() != count)
    refuse(node, field_code::part,
           fmt::format("{} of {} has {} numbers instead of {}", attribute, node.name(), out.size(), count));
  return out;
}

VtkXml::Feed VtkXml::feed_of(pugi::xml_node array) const {
  Feed feed;
  feed.array = array;
  feed.xml = this;
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "appended") {
    const std::uint64_t offset = count(array, "offset");
    if (offset > appended_.size())
      refuse(array, code::ends_early,
             fmt::format("the array {} begins at byte {} of the appended data, which have {}",
                         shown(name_of(array)), offset, appended_.size()));
    feed.text = appended_.substr(offset);
    feed.begin = appended_at_ + offset;
    feed.encoded = appended_base64_;
  } else {
    for (const pugi::xml_node child : array.children()) {
      if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
      feed.begin = static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(child.offset_debug(), 0));
      const std::string_view all = bytes_.view();
      const std::size_t stop = all.find(child.type() == pugi::node_cdata ? "]]>" : "<", feed.begin);
      feed.text = all.substr(feed.begin, std::min(stop, all.size()) - feed.begin);
      if (feed.text.find_first_not_of(" \t\r\n") != std::string_view::npos) break;
    }
    feed.encoded = true;
  }
  feed.decoder = Base64(feed.text);
  return feed;
}

std::uint64_t VtkXml::header_word(Feed& feed) const {
  const std::string raw = feed.read(header_size_);
  return header_size_ == 8 ? load_number<std::uint64_t>(raw.data(), order_)
                           : load_number<std::uint32_t>(raw.data(), order_);
}

// `exact`: the length must be `wanted`; otherwise it is not known and `wanted` is ignored.
std::string VtkXml::whole(Feed& feed, std::uint64_t wanted, bool exact) const {
  const std::uint64_t length = header_word(feed);
  if (exact && length != wanted)
    refuse(feed.array, field_code::length,
           fmt::format("the array {} has {} bytes, but {} are needed", shown(name_of(feed.array)), length,
                       wanted));
  return feed.read(length);
}

// [blocks][bytes of a block][bytes of the last one, 0 = a whole one][packed bytes of each] blocks
std::string VtkXml::blocks(Feed& feed, std::uint64_t wanted, bool exact) const {
  const std::string name = shown(name_of(feed.array));
  const std::uint64_t count = header_word(feed), size = header_word(feed), last = header_word(feed);
  const std::uint64_t total = count == 0 ? 0 : plus(times(count - 1, size), last ? last : size);
  if (exact && total != wanted)
    refuse(feed.array, field_code::length,
           fmt::format("the array {} has {} bytes, but {} are needed", name, total, wanted));
  feed.need(times(count, header_size_), "the block table of");
  std::vector<std::uint64_t> packed(count);
  std::uint64_t sum = 0;
  for (std::uint64_t& bytes : packed) sum = plus(sum, bytes = header_word(feed));
  feed.need(sum, "the array");
  if (last > size ||
      total / 2000 > sum + 1000) // zlib packs at most 1032 : 1, LZ4 255 : 1, LZMA about 7000 : 1
    if (compressor_ != Compressor::Lzma || last > size || total / 10000 > sum + 1000)
      refuse(feed.array, field_code::packed,
             fmt::format("the block sizes of the array {} are impossible", name));
  need_memory(total, place(feed.array), fmt::format("the values of the array {}", name));
  std::string out(total, '\0');
  for (std::uint64_t b = 0; b < count; ++b) {
    const std::uint64_t at = feed.offset();
    const std::string block = feed.read(packed[b]);
    const std::span<char> to(out.data() + b * size, b + 1 == count && last ? last : size);
    const bool good = compressor_ == Compressor::Zlib  ? unpack_zlib(block, to)
                      : compressor_ == Compressor::Lz4 ? unpack_lz4(block, to)
                                                       : unpack_lzma(block, to);
    if (!good)
      fail(Exit::BadInput, field_code::packed, feed.place_of(at),
           fmt::format("block {} of the array {} is damaged", b, name));
  }
  return out;
}

Column VtkXml::ascii(pugi::xml_node array, const std::string& name, std::uint64_t rows,
                     std::uint32_t components, bool real) const {
  const Feed feed = feed_of(array);
  Scan scan(bytes_.name(), bytes_.view().substr(0, feed.begin + feed.text.size()));
  scan.go_to(feed.begin);
  Column out = scan.numbers(name, rows, components, !real);
  if (!scan.word().empty())
    scan.refuse(field_code::length,
                fmt::format("the array {} has more than {} numbers", shown(name), times(rows, components)));
  return out;
}

// Texts are bytes, each text ended by a zero; ascii writes the bytes as numbers.
Column VtkXml::texts(pugi::xml_node array, const std::string& name, std::uint64_t rows) const {
  Feed feed = feed_of(array);
  std::string bytes;
  if (array.attribute("format").as_string("ascii") == std::string_view("ascii")) {
    std::string flat(feed.text);
    std::replace(flat.begin(), flat.end(), '\n', ' ');
    Words words(flat);
    std::int64_t value = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      if (!parse_integer(word, value) || value < -128 || value > 255)
        refuse(array, code::not_a_value,
               fmt::format("a byte of the texts {} is not a number: {}", shown(name), shown(word)));
      bytes += static_cast<char>(value);
    }
  } else {
    bytes = compressor_ == Compressor::None ? whole(feed, 0, false) : blocks(feed, 0, false);
  }
  if (static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\0')) != rows)
    refuse(array, field_code::length,
           fmt::format("the array {} has {} texts, but {} are needed", shown(name),
                       std::count(bytes.begin(), bytes.end(), '\0'), rows));
  TextColumn column;
  std::vector<std::string> values;
  for (std::size_t at = 0; at < bytes.size(); at += values.back().size() + 1) {
    if (values.size() == rows) break;
    values.emplace_back(bytes.c_str() + at);
  }
  column.dictionary = values;
  std::sort(column.dictionary.begin(), column.dictionary.end());
  column.dictionary.erase(std::unique(column.dictionary.begin(), column.dictionary.end()),
                          column.dictionary.end());
  for (const std::string& value : values)
    column.codes.push_back(static_cast<std::uint32_t>(
        std::lower_bound(column.dictionary.begin(), column.dictionary.end(), value) -
        column.dictionary.begin()));
  return {name, 1, std::move(column), {}};
}

Column VtkXml::read(pugi::xml_node array, std::uint64_t rows) const {
  const std::string name = name_of(array);
  const std::string_view type = array.attribute("type").value();
  if (type == "String") return texts(array, name, rows);
  std::optional<Scalar> scalar;
  for (const auto& [word, known] : type_words)
    if (word == type) scalar = known;
  if (!scalar)
    refuse(array, field_code::variant, fmt::format("values of type {} cannot be read", shown(type)),
           {"readable: Int8 ... UInt64, Float32, Float64, String"});
  std::uint64_t components = 1;
  if (array.attribute("NumberOfComponents")) components = count(array, "NumberOfComponents");
  if (components == 0 || components > max_fields)
    refuse(array, field_code::part,
           fmt::format("'{}' components are not possible; 1 to {} are", components, max_fields));
  const auto width = static_cast<std::uint32_t>(components);
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "ascii") return ascii(array, name, rows, width, is_real(*scalar));
  if (format != "binary" && format != "appended")
    refuse(array, field_code::part, fmt::format("the format {} is unknown", shown(format)),
           {"known: ascii, binary, appended"});
  Feed feed = feed_of(array);
  const std::uint64_t wanted = times(times(rows, components), size_of(*scalar));
  if (rows == 0 && feed.text.empty()) return unpack(name, "", {*scalar, order_, 0, width, 0});
  const std::string bytes =
      compressor_ == Compressor::None ? whole(feed, wanted, true) : blocks(feed, wanted, true);
  return unpack(name, bytes, {*scalar, order_, rows, width, 0});
}

} // namespace mote::data
