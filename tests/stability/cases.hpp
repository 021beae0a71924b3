// SPDX-License-Identifier: MIT
// The suite of failure cases, FC-01 to FC-61 of the method book (section 9): what breaks, and where mote is held to it. The tests
// here show for each that the naive method fails and that mote's holds; docs/stability.md is made from this table.
#pragma once

#include <array>
#include <string_view>

namespace mote::test {

enum class State {
  Here,    // a test of this suite whose name begins with the case's ("FC01")
  Covered, // held elsewhere: `where` names the test; the naive method is not run
  Pending  // nothing in mote draws it yet: `where` says what is missing
};

struct FailureCase {
  std::string_view title{};
  State state{};
  std::string_view where{};
};

// FC-01 is the first.
inline constexpr std::array<FailureCase, 61> failure_cases{{
    {"distance / radius from 10 to 1e6", State::Here, ""},
    {"grazing rays", State::Here, ""},
    {"the beta trap of the silhouette form", State::Here, ""},
    {"a scene far from the origin", State::Here, ""},
    {"two floats a coordinate, reassociated", State::Here, ""},
    {"the eye just above a giant", State::Here, ""},
    {"the eye inside a sphere", State::Here, ""},
    {"a near plane through a sphere", State::Here, ""},
    {"a sphere partly behind the eye plane", State::Here, ""},
    {"50 degrees off the axis", State::Here, ""},
    {"an interpolated silhouette parameter", State::Covered, "nothing is interpolated: rays start from gl_FragCoord (shaders/common/frame.glsl)"},
    {"point sprites beyond the frustum and beyond the size limit", State::Here, ""},
    {"cylinders, thin and far", State::Here, ""},
    {"a cylinder along its axis", State::Here, ""},
    {"the eye on or in a cylinder", State::Here, ""},
    {"sparkling rims of cylinders", State::Here, ""},
    {"a cone through its apex", State::Here, ""},
    {"needle-thin cones and arrows", State::Here, ""},
    {"coincident ends of capsules", State::Here, ""},
    {"needles and pancakes", State::Here, ""},
    {"radii of zero, negative and not numbers", State::Here, ""},
    {"superquadrics with sharp creases", State::Here, ""},
    {"the orthographic twins", State::Here, ""},
    {"arrows of no and of huge length", State::Here, ""},
    {"a whole scene scaled by 1e-9 and 1e9", State::Here, ""},
    {"the curve where two spheres meet", State::Here, ""},
    {"plates a millionth apart", State::Here, ""},
    {"a sphere against its mesh", State::Pending, "a pass for meshes"},
    {"conservative depth", State::Here, ""},
    {"orthographic depth from far away", State::Here, ""},
    {"mirror spheres that touch", State::Pending, "secondary rays on the device"},
    {"rays at shared edges of triangles", State::Pending, "triangles"},
    {"a ray in a face of a box", State::Covered, "tests/reference/tree_test.cpp"},
    {"trees of few, many and equal boxes", State::Covered, "tests/reference/tree_test.cpp"},
    {"a million coincident centers", State::Covered, "tests/reference/tree_test.cpp"},
    {"two transparent spheres that overlap", State::Here, ""},
    {"64 layers of alpha 0.05", State::Here, ""},
    {"more layers than are kept", State::Here, ""},
    {"a small sphere behind the limb of a large one", State::Here, ""},
    {"an opaque layer in the middle of a stack", State::Here, ""},
    {"absorption along the chord", State::Pending, "the attribute density"},
    {"shadows at the limb, touching spheres", State::Here, ""},
    {"a caster thinner than a texel", State::Covered, "tests/passes/shadow_test.cpp"},
    {"a light inside a sphere", State::Covered, "tests/passes/shadow_test.cpp"},
    {"a light grazing a plane", State::Here, ""},
    {"a small caster between texels", State::Covered, "tests/passes/shadow_test.cpp"},
    {"the union of overlapping spheres, cut", State::Pending, "clip planes"},
    {"a layered depth column that touches", State::Pending, "clip planes"},
    {"the eye in the removed half", State::Pending, "clip planes"},
    {"relief at 5 degrees", State::Pending, "relief"},
    {"layered depth of 8 bits", State::Pending, "clip planes"},
    {"a clip plane on a cap", State::Pending, "clip planes"},
    {"energy of spheres below a pixel", State::Covered, "tests/passes/samples_test.cpp"},
    {"slow motion below a pixel", State::Covered, "tests/passes/samples_test.cpp"},
    {"moire of a Siemens star", State::Pending, "textures on particles"},
    {"the seam of hues, gray and black", State::Here, ""},
    {"levels of detail at their threshold", State::Pending, "levels of detail"},
    {"ten turns of a rigid rotation", State::Pending, "advection"},
    {"a saddle and a wall", State::Pending, "advection"},
    {"a million steps far from the origin", State::Pending, "advection"},
    {"fma fused or not, roots and quotients 2.5 ulp off", State::Here, ""},
}};

} // namespace mote::test
