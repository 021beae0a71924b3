// SPDX-License-Identifier: MIT
// PLY, ascii and binary of both byte orders: the vertices and all their properties (nx ny nz = normal,
// red green blue = color). Faces and other elements are stepped over: they must be whole, too.
#include "core/data/codes_fields.hpp"
#include "core/data/registry.hpp"
#include "core/data/scan.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace mote::data {
namespace {

constexpr std::array<std::pair<std::string_view, Scalar>, 16> type_words{{
    {"char", Scalar::Int8},
    {"uchar", Scalar::UInt8},
    {"short", Scalar::Int16},
    {"ushort", Scalar::UInt16},
    {"int", Scalar::Int32},
    {"uint", Scalar::UInt32},
    {"float", Scalar::Float32},
    {"double", Scalar::Float64},
    {"int8", Scalar::Int8},
    {"uint8", Scalar::UInt8},
    {"int16", Scalar::Int16},
    {"uint16", Scalar::UInt16},
    {"int32", Scalar::Int32},
    {"uint32", Scalar::UInt32},
    {"float32", Scalar::Float32},
    {"float64", Scalar::Float64},
}};

struct Property {
  std::string name{};
  Scalar type{};
  std::optional<Scalar> length{}; // of a list: the type of its length
};

struct Element {
  std::string name{};
  std::uint64_t count{};
  std::vector<Property> properties{};
  [[nodiscard]] bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const Property& p) { return p.length.has_value(); });
  }
};

class Ply {
public:
  Ply(Bytes& bytes, Diagnostics& warnings)
      : file_(bytes.name()), scan_(file_, bytes.view()), warnings_(warnings) {}

  Frame read() {
    read_header();
    const auto vertex =
        std::find_if(elements_.begin(), elements_.end(), [](const Element& e) { return e.name == "vertex"; });
    if (vertex == elements_.end()) scan_.refuse(field_code::part, "the file has no element 'vertex'");
    std::vector<Column> arrays;
    std::uint64_t others = 0;
    for (const Element& element : elements_) {
      scan_.binary = !ascii_;
      if (&element == &*vertex)
        arrays = read_vertices(element);
      else
        skip(element), ++others;
    }
    if (others > 0)
      warnings_.note(field_code::left_out, {file_},
                     fmt::format("{} elements other than vertices are left out", others));
    for (Column& column : arrays)
      if (column.name.size() == 2 && column.name[0] == 'n' && column.name[1] >= 'x' && column.name[1] <= 'z')
        column.name.insert(1, "ormal_");
    Frame frame;
    assemble(frame, std::move(arrays), {}, {file_});
    return frame;
  }

private:
  void read_header() {
    (void)scan_.line();
    bool format = false;
    for (;;) {
      if (scan_.left() == 0) scan_.refuse(code::ends_early, "the file ends early: 'end_header' is missing");
      const std::string_view line = scan_.line();
      Words words(line);
      const std::string_view word = words.next();
      if (word == "end_header") break;
      if (word == "format")
        format = read_format(words.next());
      else if (word == "element")
        begin_element(words);
      else if (word == "property")
        add_property(words);
      else if (!word.empty() && word != "comment" && word != "obj_info")
        scan_.refuse(code::heading, fmt::format("{} is no part of a PLY header", shown(word)));
    }
    if (!format) scan_.refuse(field_code::part, "the header has no line 'format'");
  }
  bool read_format(std::string_view word) {
    if (word != "ascii" && word != "binary_little_endian" && word != "binary_big_endian")
      scan_.refuse(field_code::variant, fmt::format("the format {} is unknown", shown(word)),
                   {"known: ascii, binary_little_endian, binary_big_endian"});
    ascii_ = word == "ascii";
    order_ = word == "binary_big_endian" ? Order::Big : Order::Little;
    return true;
  }
  void begin_element(Words& words) {
    Element element;
    element.name = words.next();
    const std::string_view number = words.next();
    if (!parse_count(number, element.count))
      scan_.refuse(code::heading,
                   fmt::format("the number of {} is not a count: {}", shown(element.name), shown(number)));
    elements_.push_back(std::move(element));
    if (elements_.size() > max_fields) scan_.refuse(code::heading, "the header has too many elements");
  }
  Scalar type_of(std::string_view word) const {
    for (const auto& [name, type] : type_words)
      if (name == word) return type;
    std::vector<std::string> known;
    for (const auto& [name, type] : type_words) known.emplace_back(name);
    scan_.refuse(field_code::variant, fmt::format("values of type {} cannot be read", shown(word)),
                 {did_you_mean(word, known), "readable: " + list_of(known)});
  }
  void add_property(Words& words) {
    if (elements_.empty()) scan_.refuse(code::heading, "a property stands before the first element");
    Property property;
    std::string_view word = words.next();
    if (word == "list") {
      property.length = type_of(words.next());
      if (is_real(*property.length)) scan_.refuse(code::heading, "the length of a list is a whole number");
      word = words.next();
    }
    property.type = type_of(word);
    property.name = words.next();
    auto& properties = elements_.back().properties;
    for (const Property& other : properties)
      if (other.name == property.name)
        scan_.refuse(field_code::part, fmt::format("the property {} is there twice", shown(property.name)));
    properties.push_back(std::move(property));
    if (properties.size() > max_fields)
      scan_.refuse(code::many_columns, "the header has too many properties");
  }

  std::vector<Column> read_vertices(const Element& element) {
    if (element.has_lists()) scan_.refuse(field_code::variant, "vertices with lists cannot be read");
    std::vector<Column> out;
    if (ascii_) return read_ascii(element);
    std::uint64_t stride = 0;
    for (const Property& property : element.properties) stride += size_of(property.type);
    const std::string_view bytes =
        scan_.take(times(element.count, stride), fmt::format("the {} vertices", element.count));
    std::uint64_t offset = 0;
    for (const Property& property : element.properties) {
      out.push_back(unpack(property.name, bytes.substr(element.count ? offset : 0),
                           {property.type, order_, element.count, 1, stride}));
      offset += size_of(property.type);
    }
    return out;
  }
  std::vector<Column> read_ascii(const Element& element) {
    const std::uint64_t values = times(element.count, element.properties.size());
    if (values > scan_.left() / 2 + 1)
      scan_.refuse(code::ends_early,
                   fmt::format("the file ends early: {} vertices are announced, but {} bytes are left",
                               element.count, scan_.left()));
    std::vector<Column> out;
    for (const Property& property : element.properties) {
      out.push_back({property.name, 1, {}, {}});
      if (is_real(property.type))
        out.back().values = std::vector<double>(element.count);
      else
        out.back().values = std::vector<std::int64_t>(element.count);
    }
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (Column& column : out) {
        if (auto* reals = std::get_if<std::vector<double>>(&column.values))
          (*reals)[row] = scan_.real("a value of a vertex");
        else
          std::get<std::vector<std::int64_t>>(column.values)[row] = scan_.integer("a value of a vertex");
      }
    return out;
  }

  void skip(const Element& element) {
    const std::string what = fmt::format("the element {}", shown(element.name));
    if (element.properties.empty()) return;
    if (!ascii_ && !element.has_lists()) {
      std::uint64_t stride = 0;
      for (const Property& property : element.properties) stride += size_of(property.type);
      (void)scan_.take(times(element.count, stride), what);
      return;
    }
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (const Property& property : element.properties) {
        const std::uint64_t values = property.length ? list_length(*property.length, what) : 1;
        if (!ascii_)
          (void)scan_.take(times(values, size_of(property.type)), what);
        else
          for (std::uint64_t i = 0; i < values; ++i) (void)scan_.real(what);
      }
  }
  std::uint64_t list_length(Scalar type, std::string_view what) {
    if (ascii_) return scan_.count("the length of a list");
    const Column length = unpack("length", scan_.take(size_of(type), what), {type, order_, 1, 1, 0});
    const double value = length.number(0);
    if (value < 0 || value > 1e18)
      scan_.refuse(code::heading, fmt::format("the length of a list is '{}'", value));
    return static_cast<std::uint64_t>(value);
  }

  std::string file_;
  Scan scan_;
  Diagnostics& warnings_;
  bool ascii_{true};
  Order order_{Order::Little};
  std::vector<Element> elements_{};
};

Frame parse_ply(Bytes& bytes, Diagnostics& warnings) {
  if (bytes.view().substr(0, 256).find("format ascii") != std::string_view::npos)
    check_last_line(bytes, warnings);
  return Ply(bytes, warnings).read();
}

Sureness probe_ply(const Probe& probe) {
  return probe.head.starts_with("ply\n") || probe.head.starts_with("ply\r\n") ? Sureness::Certain
                                                                              : Sureness::No;
}

} // namespace

Reader ply_reader();
Reader ply_reader() {
  return {{"ply", "PLY, ascii and binary: vertices and their properties", "ply"},
          probe_ply,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("ply", std::move(bytes), parse_ply); }};
}

} // namespace mote::data
