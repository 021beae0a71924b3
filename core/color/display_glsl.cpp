// SPDX-License-Identifier: MIT
// Writes the pieces of a DisplayTransform as Vulkan GLSL. OCIO 2.1 knows no Vulkan dialect, so its GLSL
// 4.0 text gets two patches: samplers are declared by us, with bindings, and a 1-D lookup becomes one
// in a texture of a single row, so that no device needs 1-D textures. (OCIO's GLSL ES 3.0 text does
// that, too, but returns the first entry for a value at or above the table's end.)
#include "core/color/display_pieces.hpp"

#include <fmt/format.h>

#include <cstring>
#include <sstream>

namespace mote {

namespace {
struct Writer {
  const GlslOptions& options;
  const SourceLoc& loc;
  DisplayGlsl out{};
  std::string body{}; // the calls, in order, on `vec3 c`

  void add_lut(DisplayLut lut);
  void add_arithmetic(const DisplayPiece& piece, std::size_t index);
  void add_ocio_luts(const OCIO::GpuShaderDesc& desc);
  void add_table(const CurveTable& table, std::size_t index);
  void add_functions(double gain);
};

// Texture and sampler are separate objects; the macro joins them where the text samples.
void Writer::add_lut(DisplayLut lut) {
  lut.texture_binding = options.first_binding + 2 * static_cast<std::uint32_t>(out.luts.size());
  lut.sampler_binding = lut.texture_binding + 1;
  const char* dimension = lut.volume ? "3D" : "2D";
  out.text += fmt::format("layout(set = {0}, binding = {1}) uniform texture{2} {3}_texture;\n"
                          "layout(set = {0}, binding = {4}) uniform sampler {3}_sampler;\n"
                          "#define {3} sampler{2}({3}_texture, {3}_sampler)\n",
                          options.set, lut.texture_binding, dimension, lut.name, lut.sampler_binding);
  out.luts.push_back(std::move(lut));
}

std::vector<float> to_rgba(const float* values, std::size_t texels, std::size_t channels) {
  std::vector<float> out(texels * 4, 1.0f);
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[4 * i + k] = values[i * channels + (channels == 3 ? k : 0)];
  return out;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

void Writer::add_ocio_luts(const OCIO::GpuShaderDesc& desc) {
  const char *texture = nullptr, *sampler = nullptr;
  const float* values = nullptr;
  OCIO::Interpolation interpolation{};
  for (unsigned i = 0; i < desc.getNumTextures(); ++i) {
    unsigned width = 0, height = 0;
    OCIO::GpuShaderDesc::TextureType channel{};
#if OCIO_VERSION_HEX >= 0x02030000
    OCIO::GpuShaderDesc::TextureDimensions dimensions{};
    desc.getTexture(i, texture, sampler, width, height, channel, dimensions, interpolation);
#else
    desc.getTexture(i, texture, sampler, width, height, channel, interpolation);
#endif
    desc.getTextureValues(i, values);
    const std::size_t channels = channel == OCIO::GpuShaderDesc::TEXTURE_RED_CHANNEL ? 1 : 3;
    add_lut({.name = sampler,
             .linear = interpolation != OCIO::INTERP_NEAREST,
             .width = width,
             .height = height,
             .data = to_rgba(values, std::size_t{width} * height, channels)});
  }
  for (unsigned i = 0; i < desc.getNum3DTextures(); ++i) {
    unsigned edge = 0;
    desc.get3DTexture(i, texture, sampler, edge, interpolation);
    desc.get3DTextureValues(i, values);
    // a tetrahedral lookup fetches the corners and weighs them itself
    const bool linear = interpolation != OCIO::INTERP_NEAREST && interpolation != OCIO::INTERP_TETRAHEDRAL;
    add_lut({.name = sampler,
             .volume = true,
             .linear = linear,
             .width = edge,
             .height = edge,
             .depth = edge,
             .data = to_rgba(values, std::size_t{edge} * edge * edge, 3)});
  }
}

void Writer::add_arithmetic(const DisplayPiece& piece, std::size_t index) {
  const std::string name = fmt::format("{}_ocio{}", options.function, index);
  OCIO::GpuShaderDescRcPtr desc = OCIO::GpuShaderDesc::CreateShaderDesc();
  desc->setLanguage(OCIO::GPU_LANGUAGE_GLSL_4_0);
  desc->setFunctionName(name.c_str());
  desc->setResourcePrefix((name + "_").c_str());
  piece.processor->getDefaultGPUProcessor()->extractGpuShaderInfo(desc);
  add_ocio_luts(*desc);
  std::string text;
  std::vector<std::string> one_dimensional; // samplers
  std::istringstream lines(desc->getShaderText());
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("const ", 0) == 0) line.erase(0, 6);
    if (line.rfind("uniform ", 0) != 0) {
      text += line + "\n";
      continue;
    }
    if (line.rfind("uniform sampler", 0) != 0)
      fail(Exit::BadInput, "C007", loc,
           fmt::format("the view transform needs a dynamic property: '{}'", line));
    const std::size_t space = line.rfind(' ');
    if (line.rfind("uniform sampler1D", 0) == 0)
      one_dimensional.push_back(line.substr(space + 1, line.find(';') - space - 1));
  }
  for (const std::string& sampler : one_dimensional) {
    out.text += fmt::format("vec4 {0}_at(float x) {{ return texture({0}, vec2(x, 0.5)); }}\n", sampler);
    replace_all(text, fmt::format("texture({}, ", sampler), sampler + "_at(");
  }
  out.text += text;
  body += fmt::format("  c = {}(vec4(c, 1.0)).rgb;\n", name);
}

void Writer::add_table(const CurveTable& table, std::size_t index) {
  const std::string name = fmt::format("{}_table{}", options.function, index);
  add_lut({.name = name + "_cells",
           .format = DisplayLut::Format::RG32Float,
           .width = CurveTable::cells,
           .height = table.rows(),
           .data = table.data()});
  out.text +=
      fmt::format(R"(
float {0}(float x, int row)
{{
  uint bits = floatBitsToUint(min(abs(x) + {1:.9e}, {2:.9e}));
  int cell = int(bits >> {3}u) - {4} + (x < 0.0 ? {5} : 0);
  vec2 entry = texelFetch({0}_cells, ivec2(cell, row), 0).xy;
  return entry.x + entry.y * (float(bits & {6}u) * {7:.9e});
}}
)",
                  name, CurveTable::bias, CurveTable::largest, CurveTable::shift, CurveTable::first_cell,
                  CurveTable::cells_per_sign, (1u << CurveTable::shift) - 1u, 0x1p-17);
  const int step = table.rows() == 1 ? 0 : 1;
  body += fmt::format("  c = vec3({0}(c.r, 0), {0}(c.g, {1}), {0}(c.b, {2}));\n", name, step, 2 * step);
}

void Writer::add_functions(double gain) {
  out.text += fmt::format(R"(
vec4 {0}_without_nan(vec4 v) // by bits: compilers may assume that isnan() is false
{{
  return mix(v, vec4(0.0), greaterThan(floatBitsToUint(v) & 0x7fffffffu, uvec4(0x7f800000u)));
}}

vec4 {0}(vec4 linear, float gain)
{{
  linear = {0}_without_nan(linear);
  vec3 c = clamp(linear.rgb * gain, vec3(-{1:.1f}), vec3({1:.1f}));
{2}  return clamp({0}_without_nan(vec4(c, linear.a)), 0.0, 1.0);
}}

vec4 {0}(vec4 linear)
{{
  return {0}(linear, {3:.9e});
}}
)",
                          options.function, display_limit, body, gain);
}

std::uint64_t fnv1a(std::uint64_t hash, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3ull;
  return hash;
}
} // namespace

DisplayGlsl DisplayTransform::glsl(const GlslOptions& options) const {
  Writer writer{options, inner_->loc};
  with_ocio("C007", inner_->loc,
            fmt::format("OpenColorIO cannot write the view transform '{}' as GLSL", view()), [&] {
              for (std::size_t i = 0; i < inner_->pieces.size(); ++i) {
                const DisplayPiece& piece = inner_->pieces[i];
                if (piece.table)
                  writer.add_table(*piece.table, i);
                else
                  writer.add_arithmetic(piece, i);
              }
            });
  writer.add_functions(gain());
  std::uint64_t hash = fnv1a(0xcbf29ce484222325ull, writer.out.text.data(), writer.out.text.size());
  for (const DisplayLut& lut : writer.out.luts)
    hash = fnv1a(hash, lut.data.data(), lut.data.size() * sizeof(float));
  writer.out.cache_id = fmt::format("{:016x}", hash);
  return std::move(writer.out);
}

} // namespace mote
