// SPDX-License-Identifier: MIT
#include "passes/file_pass/pass_file.hpp"

#include "core/color/parse_color.hpp"
#include "core/color/srgb.hpp"
#include "core/gpu/format.hpp"
#include "render_graph/graph_desc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace mote::passes {
namespace {

const std::vector<std::string> input_types{"texture2d", "utexture2d", "itexture2d", "texture2darray", "utexture2darray", "texture3d"};
const std::vector<std::string> param_types{"float", "int", "bool", "vec2", "vec3", "vec4", "color"};

std::size_t components(const std::string& type) {
  return type == "vec2" ? 2u : type == "vec3" ? 3u : type == "vec4" ? 4u : 1u;
}

class Reader {
public:
  explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void error(const SourceLoc& loc, std::string text, std::vector<std::string> hints = {}) {
    diagnostics_.error("P011", loc, std::move(text), std::move(hints));
  }
  const rg::Table* table(const rg::Entry& entry) {
    const auto* found = std::get_if<rg::Table>(&entry.value.data);
    if (!found) error(entry.value.loc, fmt::format("'{}' is {}, but must be a table.", entry.key, rg::type_name(entry.value)));
    return found;
  }
  std::string text(const rg::Entry& entry) {
    if (const auto* found = std::get_if<std::string>(&entry.value.data)) return *found;
    error(entry.value.loc, fmt::format("'{}' is {}, but must be a string.", entry.key, rg::type_name(entry.value)));
    return {};
  }
  double number(const rg::Entry& entry, double fallback) {
    if (const auto* d = std::get_if<double>(&entry.value.data); d && std::isfinite(*d)) return *d;
    if (const auto* i = std::get_if<std::int64_t>(&entry.value.data)) return static_cast<double>(*i);
    error(entry.value.loc, fmt::format("'{}' is {}, but must be a number.", entry.key, rg::to_text(entry.value)));
    return fallback;
  }
  void unknown(const rg::Entry& entry, const std::vector<std::string>& keys, std::string_view of) {
    error(entry.key_loc, fmt::format("'{}' is no key of {}.", entry.key, of), {"keys: " + list_of(keys) + ".", did_you_mean(entry.key, keys)});
  }
  bool one_of(const rg::Entry& entry, const std::string& word, const std::vector<std::string>& words) {
    if (std::find(words.begin(), words.end(), word) != words.end()) return true;
    error(entry.value.loc, fmt::format("'{}' is no {}.", word, entry.key), {fmt::format("{}s: {}.", entry.key, list_of(words)), did_you_mean(word, words)});
    return false;
  }
  bool name(const rg::Entry& entry) {
    if (rg::valid_name(entry.key)) return true;
    error(entry.key_loc, fmt::format("'{}' is no name.", entry.key), {"names: a-z, 0-9 and _, beginning with a letter."});
    return false;
  }

  void input(const rg::Entry& entry, PassFile& out) {
    FileInput input{.name = entry.key};
    if (!name(entry)) return;
    if (const auto* type = std::get_if<std::string>(&entry.value.data)) {
      input.type = *type;
      if (std::find(input_types.begin(), input_types.end(), *type) == input_types.end())
        return error(entry.value.loc, fmt::format("'{}' is no type of an input.", *type), {"types: " + list_of(input_types) + ".", did_you_mean(*type, input_types)});
    } else if (const rg::Table* fields = table(entry)) {
      for (const rg::Entry& field : *fields)
        if (field.key == "type") {
          const std::string word = text(field);
          if (one_of(field, word, input_types)) input.type = word;
        } else if (field.key == "summary") input.summary = text(field);
        else unknown(field, {"type", "summary"}, "an input");
    }
    out.inputs.push_back(std::move(input));
  }

  void output(const rg::Entry& entry, PassFile& out) {
    FileOutput output{.name = entry.key};
    const rg::Table* fields = name(entry) ? table(entry) : nullptr;
    if (!fields) return;
    for (const rg::Entry& field : *fields)
      if (field.key == "format") {
        const std::string format = text(field);
        output.format = gpu::parse_format(format).value_or(gpu::TextureFormat::Undefined);
        if (output.format == gpu::TextureFormat::Undefined || output.format == gpu::TextureFormat::Depth32Float)
          error(field.value.loc, fmt::format("'{}' is no format of an output.", format), {"formats: rgba8unorm, rgba16float, rgba32float, r32float, r32uint, ..."});
      } else if (field.key == "size") {
        output.size = number(field, 1.0);
        if (!(output.size > 0.0 && output.size <= 16.0)) error(field.value.loc, "'size' is a factor of the view, above 0 and at most 16.");
      } else if (field.key == "summary") output.summary = text(field);
      else unknown(field, {"format", "size", "summary"}, "an output");
    if (!rg::find(*fields, "format")) error(entry.key_loc, fmt::format("the output '{}' lacks its format.", entry.key));
    if (output.format == gpu::TextureFormat::Undefined) output.format = gpu::TextureFormat::RGBA16Float; // so that the rest can be checked
    out.outputs.push_back(std::move(output));
  }

  void param(const rg::Entry& entry, PassFile& out) {
    FileParam param{.name = entry.key};
    const rg::Table* fields = name(entry) ? table(entry) : nullptr;
    if (!fields) return;
    const rg::Entry* type = rg::find(*fields, "type");
    if (!type) return error(entry.key_loc, fmt::format("the parameter '{}' lacks its type.", entry.key), {"types: " + list_of(param_types) + "."});
    param.type = text(*type);
    if (!one_of(*type, param.type, param_types)) return;
    for (const rg::Entry& field : *fields)
      if (field.key == "default") fallback(field, param);
      else if (field.key == "min") param.range.min = number(field, 0.0);
      else if (field.key == "max") param.range.max = number(field, 0.0);
      else if (field.key == "summary") param.summary = text(field);
      else if (field.key != "type") unknown(field, {"type", "default", "min", "max", "summary"}, "a parameter");
    out.params.push_back(std::move(param));
  }

  void fallback(const rg::Entry& field, FileParam& param) {
    if (param.type == "color") {
      const std::string color = text(field);
      try {
        parse_color(color, field.value.loc);
        param.color = color;
      } catch (const Failure&) {
        error(field.value.loc, fmt::format("'{}' is no color.", color));
      }
    } else if (param.type == "bool") {
      const bool* flag = std::get_if<bool>(&field.value.data);
      if (flag) param.fallback[0] = *flag ? 1.0 : 0.0;
      else error(field.value.loc, "the default of a bool is true or false.");
    } else if (components(param.type) == 1) {
      param.fallback[0] = number(field, 0.0);
    } else {
      const auto* array = std::get_if<rg::Array>(&field.value.data);
      if (!array || array->size() != components(param.type))
        return error(field.value.loc, fmt::format("the default of a {} is an array of {} numbers.", param.type, components(param.type)));
      for (std::size_t i = 0; i < array->size(); ++i) param.fallback[i] = number({field.key, field.key_loc, (*array)[i]}, 0.0);
    }
  }

private:
  Diagnostics& diagnostics_;
};

gpu::FormatKind kind_of(gpu::TextureFormat format) { return gpu::format_info(format).kind; }

// Layout words of storage images.
std::string image_words(gpu::TextureFormat format) {
  using enum gpu::TextureFormat;
  switch (format) {
  case R8Unorm: return "r8";
  case RGBA8Unorm: return "rgba8";
  case RGBA16Unorm: return "rgba16";
  case R16Float: return "r16f";
  case R32Float: return "r32f";
  case RG32Float: return "rg32f";
  case RGBA32Float: return "rgba32f";
  case R32Uint: return "r32ui";
  case RG32Uint: return "rg32ui";
  case RGBA32Uint: return "rgba32ui";
  case R32Sint: return "r32i";
  default: return "rgba16f";
  }
}
char prefix_of(gpu::TextureFormat format) {
  const gpu::FormatKind kind = kind_of(format);
  return kind == gpu::FormatKind::Uint ? 'u' : kind == gpu::FormatKind::Sint ? 'i' : ' ';
}
std::string texture_of(std::string type) { // texture2d -> texture2D, texture2darray -> texture2DArray
  const auto at = type.find('d', 6);
  type[at] = 'D';
  if (const auto array = type.find("array"); array != std::string::npos) type[array] = 'A';
  return type;
}

} // namespace

PassFile parse_pass_file(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  PassFile out{.file = file};
  Reader reader(diagnostics);
  const rg::Table top = rg::parse_toml_text(text, file, diagnostics);
  const std::vector<std::string> keys{"schema", "summary", "inputs", "outputs", "params"};
  for (const rg::Entry& entry : top) {
    const rg::Table* fields = entry.key == "inputs" || entry.key == "outputs" || entry.key == "params" ? reader.table(entry) : nullptr;
    if (entry.key == "schema") {
      const auto* schema = std::get_if<std::int64_t>(&entry.value.data);
      if (!schema || *schema != 1) reader.error(entry.value.loc, fmt::format("'schema' is {}, but this program reads schema 1.", rg::to_text(entry.value)));
    } else if (entry.key == "summary") out.summary = reader.text(entry);
    else if (std::find(keys.begin(), keys.end(), entry.key) == keys.end()) reader.unknown(entry, keys, "a pass file");
    for (const rg::Entry& field : fields ? *fields : rg::Table{}) {
      if (entry.key == "inputs") reader.input(field, out);
      if (entry.key == "outputs") reader.output(field, out);
      if (entry.key == "params") reader.param(field, out);
    }
  }
  if (out.outputs.empty() && !diagnostics.has_errors()) reader.error({file, 1, 1}, "the pass has no outputs.");
  return out;
}

std::vector<ParamValue> read_values(const PassFile& file, rg::Params& params) {
  std::vector<ParamValue> values;
  for (const FileParam& p : file.params) {
    ParamValue value;
    std::array<double, 4> n = p.fallback;
    if (p.type == "float") n[0] = params.number(p.name, n[0], p.range, p.summary);
    if (p.type == "int") value.whole = static_cast<std::int32_t>(params.integer(p.name, static_cast<std::int64_t>(n[0]), p.range, p.summary));
    if (p.type == "bool") value.whole = params.boolean(p.name, n[0] != 0.0, p.summary) ? 1 : 0;
    if (p.type == "color") {
      const ParsedColor c = parse_color(p.color);
      const gpu::Color written = params.color(p.name, {c.rgb[0], c.rgb[1], c.rgb[2], c.alpha}, p.summary);
      n = {srgb_decode(written.r), srgb_decode(written.g), srgb_decode(written.b), written.a};
    }
    if (p.type == "vec2") { const auto v = params.vec<2>(p.name, {n[0], n[1]}, p.summary); n = {v[0], v[1], 0, 0}; }
    if (p.type == "vec3") { const auto v = params.vec<3>(p.name, {n[0], n[1], n[2]}, p.summary); n = {v[0], v[1], v[2], 0}; }
    if (p.type == "vec4") n = params.vec<4>(p.name, n, p.summary);
    for (std::size_t i = 0; i < 4; ++i) value.numbers[i] = static_cast<float>(n[i]);
    values.push_back(value);
  }
  return values;
}

std::vector<std::byte> uniform_bytes(const PassFile& file, const std::vector<ParamValue>& values, float view_width, float view_height) {
  std::vector<std::byte> out((values.size() + 1) * 16);
  const std::array<float, 2> view{view_width, view_height};
  std::memcpy(out.data(), view.data(), sizeof view);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool whole = file.params[i].type == "int" || file.params[i].type == "bool";
    if (whole) std::memcpy(out.data() + 16 * (i + 1), &values[i].whole, 4);
    else std::memcpy(out.data() + 16 * (i + 1), values[i].numbers.data(), 16);
  }
  return out;
}

std::string pass_preamble(const PassFile& file, bool compute) {
  std::string out = "#version 460\n#extension GL_GOOGLE_include_directive : require\n#extension GL_EXT_samplerless_texture_functions : require\n";
  std::size_t binding = 0;
  for (const FileInput& input : file.inputs)
    out += fmt::format("layout(set = 0, binding = {}) uniform {} {};\n", binding++, texture_of(input.type), input.name);
  std::size_t location = 0;
  for (const FileOutput& output : file.outputs) {
    const char prefix = prefix_of(output.format);
    if (compute)
      out += fmt::format("layout(set = 0, binding = {}, {}) uniform writeonly {}image2D o_{};\n", binding++, image_words(output.format), prefix, output.name);
    else
      out += fmt::format("layout(location = {}) out {}vec4 o_{};\n", location++, prefix, output.name);
  }
  out += fmt::format("layout(std140, set = 0, binding = {}) uniform Parameters {{\n  vec2 view_size;\n", binding);
  for (std::size_t i = 0; i < file.params.size(); ++i) {
    const std::string& type = file.params[i].type;
    out += fmt::format("  layout(offset = {}) {} {};\n", 16 * (i + 1), type == "color" ? "vec4" : type == "bool" ? "bool" : type, file.params[i].name);
  }
  return out + "};\n#line 1\n";
}

} // namespace mote::passes
