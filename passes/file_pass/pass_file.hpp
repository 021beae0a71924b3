// SPDX-License-Identifier: MIT
// What a `pass.toml` says: the typed inputs, outputs and parameters of a pass that is written as one
// GLSL file beside it. Pure: text in, values and located messages out. file_pass.cpp makes a pass of it;
// docs/graph-file.md has the words.
//
//   schema = 1
//   summary = "dark lines where particles meet"
//   [inputs]
//   color = "texture2d"                   # utexture2d, itexture2d, texture2darray, utexture2darray, texture3d
//   id = { type = "utexture2d", summary = "particle ids" }
//   [outputs]
//   color = { format = "rgba16float" }    # as large as the view, unless size = 0.5 says a factor
//   [params]
//   width = { type = "float", default = 1.0, min = 0.0, max = 8.0, summary = "pixels" }
//   ink = { type = "color", default = "#000000" }      # float, int, bool, vec2, vec3, vec4, color
#pragma once

#include "core/gpu/types.hpp"
#include "render_graph/params.hpp"
#include "render_graph/slots.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mote::passes {

struct FileInput {
  std::string name{}, summary{};
  std::string type{"texture2d"}; // of GLSL
};
struct FileOutput {
  std::string name{}, summary{};
  gpu::TextureFormat format{};
  double size{1.0}; // factor of the view
};
struct FileParam {
  std::string name{}, type{}, summary{};
  std::array<double, 4> fallback{};
  std::string color{"#000000"}; // the default of a color
  rg::Range range{};
};
struct PassFile {
  std::string file{}, summary{};
  std::vector<FileInput> inputs{};
  std::vector<FileOutput> outputs{};
  std::vector<FileParam> params{};
};

// Problems go to `diagnostics` (P011, and G001 for what is no TOML); what could be understood is returned.
PassFile parse_pass_file(std::string_view text, const std::string& file, Diagnostics& diagnostics);

// The values of the pass's parameters, from the graph file; 16 bytes each, in order, as pass_preamble() declares them.
struct ParamValue {
  std::array<float, 4> numbers{};
  std::int32_t whole{}; // int, bool
};
std::vector<ParamValue> read_values(const PassFile& file, rg::Params& params);
std::vector<std::byte> uniform_bytes(const PassFile& file, const std::vector<ParamValue>& values, float view_width, float view_height);

// GLSL that comes before the shader's text: #version, inputs under their names, outputs as o_<name>, parameters under
// their names, vec2 view_size. Group 0: inputs, then (compute) output images, then the uniform block.
std::string pass_preamble(const PassFile& file, bool compute);

} // namespace mote::passes
