// SPDX-License-Identifier: MIT
// Houdini's classic .bgeo, version 5 (big endian, often gzipped): points and their attributes. Groups,
// primitives and detail attributes are stepped over or left out. Layout: eight counts, the attributes'
// names, sizes, types and defaults, then for each point x y z w and the attributes, 4 bytes a number.
// The newer binary-JSON .bgeo (Houdini 12 and later) is recognized and refused.
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <array>

namespace mote::data {
namespace {

struct Attribute {
  std::string name{};
  std::uint32_t components{};
  std::int32_t type{}; // 0 float, 1 integer, 4 index into `texts`, 5 vector
  std::vector<std::string> texts{};
  std::uint64_t offset{}; // bytes from the begin of the point
};

std::string read_name(ByteReader& in, std::string_view what) {
  const auto length = in.number<std::uint16_t>(what);
  return std::string(in.take(length, what));
}

Attribute read_attribute(ByteReader& in) {
  Attribute out;
  out.name = read_name(in, "the name of an attribute");
  out.components = in.number<std::uint16_t>("the size of an attribute");
  const std::uint64_t at = in.at();
  out.type = in.number<std::int32_t>("the type of an attribute");
  if (out.components == 0 || out.components > max_fields)
    in.refuse_at(at, code::heading,
                 fmt::format("the attribute {} has '{}' components; 1 to {} are possible", shown(out.name),
                             out.components, max_fields));
  if (out.type == 0 || out.type == 1 || out.type == 5) {
    in.skip(std::uint64_t{4} * out.components, "the default of an attribute");
  } else if (out.type == 4) {
    const auto texts = in.number<std::uint32_t>("the number of texts");
    if (texts > in.left() / 2)
      in.refuse(code::ends_early,
                fmt::format("the file ends early: the attribute {} has {} texts, but {} bytes are left",
                            shown(out.name), texts, in.left()));
    for (std::uint32_t i = 0; i < texts; ++i) out.texts.push_back(read_name(in, "a text of an attribute"));
  } else {
    in.refuse_at(
        at, field_code::variant,
        fmt::format("the attribute {} has the type '{}', which cannot be read", shown(out.name), out.type),
        {"readable: 0 (float), 1 (integer), 4 (text), 5 (vector)"});
  }
  return out;
}

// Indices into the texts; -1 is none.
Column text_column(const Attribute& attribute, std::string_view points, std::uint64_t rows,
                   std::uint64_t stride, const SourceLoc& loc) {
  const Column indices = unpack(attribute.name, points.substr(attribute.offset),
                                {Scalar::Int32, Order::Big, rows, attribute.components, stride});
  TextColumn out;
  out.dictionary = attribute.texts;
  out.dictionary.emplace_back();
  for (std::uint64_t r = 0; r < rows; ++r) {
    const auto index = static_cast<std::int64_t>(indices.number(r));
    if (index < -1 || index >= static_cast<std::int64_t>(attribute.texts.size()))
      fail(Exit::BadInput, field_code::index, loc,
           fmt::format("point {} has text {} of {}, which has {}", r, index, shown(attribute.name),
                       attribute.texts.size()));
    out.codes.push_back(
        static_cast<std::uint32_t>(index < 0 ? attribute.texts.size() : static_cast<std::size_t>(index)));
  }
  return {attribute.name, 1, std::move(out), {}};
}

Frame parse_bgeo(Bytes& bytes, Diagnostics& warnings) {
  ByteReader in(bytes, Order::Big);
  if (bytes.view().starts_with("\x7fNSJb") || bytes.view().starts_with("\x7f"
                                                                       "bJSN"))
    in.refuse_at(0, field_code::variant,
                 "this is the binary-JSON kind of .bgeo (Houdini 12 and later), which cannot be read",
                 {"save it as .bgeo of version 5 ('classic'), .ply or .vtk"});
  in.skip(5, "the magic word");
  const auto version = in.number<std::int32_t>("the version");
  if (version != 5)
    in.refuse_at(5, field_code::variant, fmt::format("the version is '{}'; version 5 can be read", version));
  // points, primitives, point groups, primitive groups, point, vertex, primitive and detail attributes
  std::array<std::uint32_t, 8> counts{};
  for (std::uint32_t& count : counts) count = in.number<std::uint32_t>("the counts");
  const std::uint64_t points = counts[0];
  if (counts[4] > in.left() / 12)
    in.refuse_at(29 - 4, code::ends_early,
                 fmt::format("the file ends early: {} attributes are announced, but {} bytes are left",
                             counts[4], in.left()));
  std::vector<Attribute> attributes;
  std::uint64_t stride = 16;
  for (std::uint32_t i = 0; i < counts[4]; ++i) {
    attributes.push_back(read_attribute(in));
    attributes.back().offset = stride;
    stride += std::uint64_t{4} * attributes.back().components;
  }
  const SourceLoc begin = byte_place(bytes, in.at());
  const std::string_view rows = in.take(times(points, stride), fmt::format("the {} points", points));
  std::vector<Column> arrays{unpack("position", rows, {Scalar::Float32, Order::Big, points, 3, stride})};
  for (const Attribute& attribute : attributes) {
    if (attribute.type == 4)
      arrays.push_back(text_column(attribute, rows, points, stride, begin));
    else
      arrays.push_back(unpack(attribute.name, points ? rows.substr(attribute.offset) : rows,
                              {attribute.type == 1 ? Scalar::Int32 : Scalar::Float32, Order::Big, points,
                               attribute.components, stride}));
    if (attribute.name == "N" && attribute.components == 3) arrays.back().name = "normal";
    if (attribute.name == "Cd" && attribute.components == 3) arrays.back().name = "color";
    if (attribute.name == "pscale" && attribute.components == 1) arrays.back().name = "radius";
  }
  if (counts[1] > 0)
    warnings.note(field_code::left_out, {bytes.name()}, fmt::format("{} primitives are left out", counts[1]));
  if (!bytes.view().ends_with(std::string_view("\x00\xff", 2)))
    warnings.warning(field_code::end_mark, byte_place(bytes, bytes.view().size()),
                     "the points are whole, but the end mark (00 ff) is missing: the file may be cut off");
  Frame frame;
  assemble(frame, std::move(arrays),
           {.quaternion_is_xyzw = true, .shape_is_diameter = false, .units_in_names = false}, {bytes.name()});
  return frame;
}

Sureness probe_bgeo(const Probe& probe) {
  const bool magic = probe.head.starts_with("BgeoV") || probe.head.starts_with("\x7fNSJb") ||
                     probe.head.starts_with("\x7f"
                                            "bJSN");
  return magic ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader bgeo_reader();
Reader bgeo_reader() {
  return {{"bgeo", "Houdini .bgeo version 5: points and their attributes", "bgeo"},
          probe_bgeo,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("bgeo", std::move(bytes), parse_bgeo); }};
}

} // namespace mote::data
