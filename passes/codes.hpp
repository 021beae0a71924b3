// SPDX-License-Identifier: MIT
// The diagnostics of the built-in passes, one line each. docs/errors.md lists them with all others.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace mote::passes {

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 21> pass_codes{{
    {"G031", "error: a draw list names a particle type that does not exist"},
    {"P001", "failed: a particle type cannot be drawn by the expansion that was asked for, or the device cannot"},
    {"P002", "failed: a shader that is made at run time does not compile"},
    {"P003", "failed: a scene has more lights than a frame can hold"},
    {"P004", "failed: a scene has more transparent particles than one order can hold on the device"},
    {"P005", "warning: the lists of exact transparency were too small for a row of pixels"},
    {"P006", "error: parameters of a pass that do not go together"},
    {"P007", "error: a number of samples that the pattern cannot make"},
    {"P010", "error: the shader of a pass from a file, or its pass.toml, cannot be read"},
    {"P011", "error: a pass.toml says something that it cannot"},
    {"P012", "error: a pass.toml was changed in a way that only counts when the graph is read again"},
    {"P013", "error: the shader of a pass from a file uses what its pass.toml does not declare"},
    {"P014", "error: what is connected to a pass from a file has other texels than its pass.toml declares"},
    {"P015", "error: a shadow map is for a light that the scene does not have"},
    {"P016", "failed: a scene has more different materials than shading with shadow maps can tell apart"},
    {"P017", "error: a shadow map is for a light that one map cannot hold"},
    {"P018", "error: a shadow map of casters meets a data set that is scaled unevenly and has neither spheres nor ellipsoids; one of depths holds it"},
    {"P020", "warning: the device lacks what tiles need, so auto draws without them"},
    {"P021", "failed: analytic edges are asked of a particle type whose outlines are sampled only"},
    {"P022", "error: a particle type from a folder does not compile; the rest is drawn and the exit status is 3"},
    {"P023", "failed: a step for teaching that a particle type does not have"},
}};

} // namespace mote::passes
