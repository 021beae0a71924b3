// SPDX-License-Identifier: MIT
// Measures how two pictures differ: ids, depths, normals, colors, outlines. `mote compare`, `mote
// chart` and the tests call it with a picture A against B, where B may be the reference. Pure:
// arrays in, numbers out; it reads no file, draws nothing and judges nothing (limits.hpp does).
//
// Pixels that either picture marks ambiguous are left out of every measure but `outline`; without a
// mask all pixels count.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mote::compare {

constexpr std::uint32_t no_id = 0xFFFFFFFFu; // nothing is seen

enum class Encoding : std::uint8_t {
  Srgb,  // display values in [0, 1], as in an 8- or 16-bit file
  Linear // scene-linear Rec.709; encoded with the sRGB curve and clamped before it is compared
};

// Row-major arrays of width * height values, row 0 on top; an empty one means "not there".
struct CompareInput {
  std::string name{"picture"}; // for messages: the file
  std::uint32_t width{}, height{};
  std::vector<double>
      depth{}; // along the view axis; not finite where nothing is. float32 files widen exactly
  std::vector<std::uint32_t> id{};       // no_id where nothing is
  std::vector<glm::vec3> normal{};       // world, any length above 0
  std::vector<glm::vec4> color{};        // straight alpha
  Encoding encoding{Encoding::Srgb};     // of `color`
  std::vector<std::uint8_t> ambiguous{}; // not 0: float32 rounding may decide there
  std::vector<float> projected_radius{}; // pixels; of the particle seen, for the bar on normals
  std::string camera{};                  // as text; empty: not known. Two known ones have to be equal
};

// RGBA values of an integer file as numbers in [0, 1].
std::vector<glm::vec4> color_from_rgba8(std::span<const std::uint8_t> rgba);
std::vector<glm::vec4> color_from_rgba16(std::span<const std::uint16_t> rgba);

struct Spread {
  double median{}, p99{}, max{}; // max is infinite where a value is not a number at all
};

struct IdDifference {
  std::uint64_t compared{}; // unambiguous pixels
  std::uint64_t wrong{};    // both show something, but not the same
  std::uint64_t extra{};    // only A shows something
  std::uint64_t missing{};  // only B does
  [[nodiscard]] std::uint64_t coverage() const { return extra + missing; }
  [[nodiscard]] std::uint64_t all() const { return wrong + coverage(); }
};

struct DepthDifference { // where both show the same particle (without ids: both show something)
  std::uint64_t compared{};
  Spread relative{}; // |a - b| / |b|
  Spread ulp{};      // |a - b| in spacings of float32 at b
};

struct NormalDifference { // rad, where both show the same particle
  std::uint64_t compared{};
  Spread angle{};
  std::optional<std::uint64_t> beyond_bar{}; // pixels above normal_bar(); needs B's projected_radius
};

// Display values (sRGB-encoded) times alpha, so that invisible colors do not count; in 8-bit steps.
// Values that are not finite differ by 255 from everything and count in not_finite.
struct ColorDifference {
  std::uint64_t compared{}, not_finite{};
  double rms{}, max{}; // over r, g, b
  double alpha_max{};
  double de_mean{}, de_p95{}, de_max{}; // CIEDE2000
  double flip_mean{}, flip_max{};       // FLIP (flip.hpp), over all pixels: the eye's blur does not stop at ambiguous ones
};

// How far outlines (and curves where two particles meet) lie apart on average, in pixels: the number of
// pixels that show different things, over the length of B's outlines. The length is pi/4 of the neighboring
// pairs of pixels that show different things in B (the mean over all directions of a line). All pixels count,
// ambiguous ones included. A measure of the whole picture: it does not tell one large error from many small
// ones; p999 does.
struct OutlineDifference {
  std::uint64_t disagreeing{};
  double length{};       // px
  double displacement{}; // px; 0 where nothing disagrees, infinite where something does but B has no outline
  // 99.9th percentile over the elements of both outlines of the distance to the nearest element of the other picture between the
  // same two things; in pixels, so 0 or at least 0.7: a shift below a pixel shows in `displacement`. Infinite beyond 16 px.
  double p999{};
};

struct CompareResult {
  std::uint32_t width{}, height{};
  std::uint64_t pixels{}, ambiguous{};
  std::optional<IdDifference> id{}; // from ids, else from the depths' coverage alone (`wrong` stays 0)
  std::optional<DepthDifference> depth{};
  std::optional<NormalDifference> normal{};
  std::optional<ColorDifference> color{};
  std::optional<OutlineDifference> outline{};
};

// The bar on the angle between normals of a sphere of R pixels projected radius: 1e-6 + 1.5e-4 / R rad (a
// float32 hit relative to the center loses 1.5e-7 of distance / radius; with 1000 px of focal length that
// is 1.5e-4 / R).
double normal_bar(double projected_radius);

// Throws Failure: K004 (sizes differ), K005 (nothing that both have), K007 (array of the wrong length), K008 (cameras differ).
CompareResult compare(const CompareInput& a, const CompareInput& b);

// RGBA8, opaque: red where the two show different things, yellow where they do on an ambiguous pixel;
// elsewhere gray: the largest channel difference times `gain`, or without colors the relative depth error
// from 1e-9 (black) to 1e-3 (white), logarithmic. Same failures as compare().
std::vector<std::uint8_t> difference_picture(const CompareInput& a, const CompareInput& b,
                                             double gain = 16.0);

} // namespace mote::compare
