// SPDX-License-Identifier: MIT
#include "core/scene/generated.hpp"

#include "core/base/parallel.hpp"
#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mote {

const std::array<std::array<double, 3>, 8> generated_palette{{{0.90, 0.30, 0.25},
                                                              {0.25, 0.55, 0.90},
                                                              {0.30, 0.70, 0.35},
                                                              {0.95, 0.75, 0.20},
                                                              {0.60, 0.40, 0.80},
                                                              {0.20, 0.70, 0.75},
                                                              {0.85, 0.50, 0.70},
                                                              {0.55, 0.55, 0.55}}};

namespace {

constexpr double half = 50.0;         // of the cube's edge
constexpr double margin = 4.0;        // `fit` leaves room for the largest radius
constexpr std::uint64_t most = 100'000'000;
const std::vector<std::string> cameras{"fit", "fill", "inside"};
const std::vector<std::string> kinds{"spheres", "crystal", "slab", "dust", "sticks", "arrows"}; // order of GeneratedKind
constexpr double dust_depth = 0.65;   // areas of all dust over that of a face: 1 - e^-0.65 = 48 % is covered
constexpr double pi = 3.14159265358979323846;

// splitmix64's mixing function (Steele, Lea, Flood 2014) of one counter value.
std::uint64_t splitmix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// A number in [0,1) with 24 bits that depends on seed and index alone.
double uniform(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(splitmix(index + seed * 0x100000001u) >> 40) / 16777216.0;
}

std::vector<std::string_view> fields_of(std::string_view name) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0;;) {
    const std::size_t colon = name.find(':', at);
    fields.push_back(name.substr(at, colon - at));
    if (colon == std::string_view::npos) return fields;
    at = colon + 1;
  }
}

[[noreturn]] void refuse(std::string_view name, std::string text) {
  fail(Exit::Usage, code::generated_name, {}, fmt::format("generated scene '{}': {}", name, text),
       {"A name is spheres|crystal|slab|dust|sticks|arrows:N:fit|fill|inside[:seed=S][:frame=K], for example spheres:1e5:fill"});
}

std::uint64_t parse_count(std::string_view name, std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value != std::floor(value))
    refuse(name, fmt::format("'{}' is not a number of particles", word));
  if (!(value >= 1 && value <= static_cast<double>(most)))
    refuse(name, fmt::format("'{}' particles cannot be made; 1 to 1e8 can", word));
  return static_cast<std::uint64_t>(value);
}

template <class Integer> Integer parse_option(std::string_view name, std::string_view option, std::string_view word) {
  Integer value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    refuse(name, fmt::format("'{}' is not a whole number for {}", word, option));
  return value;
}

void apply_option(std::string_view name, std::string_view field, GeneratedName& out) {
  const std::size_t equals = field.find('=');
  const std::string_view option = field.substr(0, equals);
  const std::string_view word = equals == std::string_view::npos ? std::string_view{} : field.substr(equals + 1);
  if (option == "seed") out.seed = parse_option<std::uint64_t>(name, option, word);
  else if (option == "frame") out.frame = parse_option<std::int64_t>(name, option, word);
  else refuse(name, fmt::format("option '{}' is unknown; there are seed=S and frame=K", field));
}

} // namespace

bool is_generated_name(std::string_view name) {
  const std::string_view kind = name.substr(0, name.find(':'));
  return name.find(':') != std::string_view::npos && std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

GeneratedName parse_generated_name(std::string_view name) {
  const std::vector<std::string_view> fields = fields_of(name);
  const auto kind = std::find(kinds.begin(), kinds.end(), fields[0]);
  if (kind == kinds.end()) refuse(name, fmt::format("'{}' is unknown; there are {}", fields[0], list_of(kinds)));
  if (fields.size() < 2) refuse(name, "the number of particles is missing");
  GeneratedName out;
  out.kind = static_cast<GeneratedKind>(kind - kinds.begin());
  if (particle_type_of(out.kind) != "sphere") out.seed = 2;
  out.count = parse_count(name, fields[1]);
  std::size_t next = 2;
  if (fields.size() > next && fields[next].find('=') == std::string_view::npos) {
    const std::string word(fields[next++]);
    const auto found = std::find(cameras.begin(), cameras.end(), word);
    if (found == cameras.end())
      refuse(name, fmt::format("camera '{}' is unknown; there are {}. {}", word, list_of(cameras), did_you_mean(word, cameras)));
    out.camera = static_cast<GeneratedCamera>(found - cameras.begin());
  }
  for (; next < fields.size(); ++next) apply_option(name, fields[next], out);
  return out;
}

std::string_view particle_type_of(GeneratedKind kind) {
  return kind == GeneratedKind::Sticks ? "cylinder" : kind == GeneratedKind::Arrows ? "arrow" : "sphere";
}

GeneratedParticles generate_spheres(std::uint64_t count, std::uint64_t seed) {
  GeneratedParticles out;
  const double spacing = 2 * half / std::pow(static_cast<double>(count), 1.0 / 3.0);
  out.radii.assign(count, double{static_cast<float>(0.4 * spacing)});
  out.positions.resize(3 * count);
  parallel_parts(3 * count, thread_count(count, 65536), [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i)
      out.positions[i] = double{static_cast<float>((uniform(seed, i) * 2 - 1) * half)};
  });
  return out;
}

namespace {

// Touching spheres on a lattice of `across` sites along x and y; z in layers centered on 0.
GeneratedParticles lattice(std::uint64_t count, std::uint64_t across) {
  GeneratedParticles out;
  const double spacing = 2 * half / static_cast<double>(across);
  const std::uint64_t layer = across * across, layers = (count + layer - 1) / layer;
  out.radii.assign(count, double{static_cast<float>(0.5 * spacing)});
  out.positions.resize(3 * count);
  auto place = [&](std::uint64_t site, std::uint64_t of) {
    return double{static_cast<float>((static_cast<double>(site) - 0.5 * static_cast<double>(of - 1)) * spacing)};
  };
  for (std::uint64_t i = 0; i < count; ++i) {
    out.positions[3 * i] = place(i % across, across);
    out.positions[3 * i + 1] = place(i / across % across, across);
    out.positions[3 * i + 2] = place(i / layer, layers);
  }
  return out;
}

// Segments with uniform centers and directions, as long as the spacing; the ends are rounded to float32.
GeneratedParticles segments(std::uint64_t count, std::uint64_t seed, double thickness) {
  GeneratedParticles out;
  const double spacing = 2 * half / std::pow(static_cast<double>(count), 1.0 / 3.0);
  out.radii.assign(count, double{static_cast<float>(thickness * spacing)});
  out.positions.resize(3 * count);
  out.ends.resize(3 * count);
  parallel_parts(count, thread_count(count, 65536), [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) {
      const auto u = [&](std::uint64_t k) { return uniform(seed, 5 * i + k); };
      const double z = u(3) * 2 - 1, angle = u(4) * 2 * pi, s = std::sqrt(1 - z * z);
      const std::array<double, 3> way{s * std::cos(angle), s * std::sin(angle), z};
      for (std::uint64_t k = 0; k < 3; ++k) {
        const double center = (u(k) * 2 - 1) * half, reach = way[k] * 0.5 * spacing;
        out.positions[3 * i + k] = double{static_cast<float>(center - reach)};
        out.ends[3 * i + k] = double{static_cast<float>(center + reach)};
      }
    }
  });
  return out;
}

// The least n with n^power >= count.
std::uint64_t root(double count, double power) { return static_cast<std::uint64_t>(std::ceil(std::pow(count, 1.0 / power) - 1e-9)); }

} // namespace

GeneratedParticles generate(const GeneratedName& name) {
  const auto count = static_cast<double>(name.count);
  switch (name.kind) {
  case GeneratedKind::Crystal: return lattice(name.count, root(count, 3));
  case GeneratedKind::Slab: return lattice(name.count, root(std::ceil(count / 4), 2));
  case GeneratedKind::Sticks: return segments(name.count, name.seed, 0.1);
  case GeneratedKind::Arrows: return segments(name.count, name.seed, 0.05);
  case GeneratedKind::Spheres:
  case GeneratedKind::Dust: break;
  }
  GeneratedParticles out = generate_spheres(name.count, name.seed);
  if (name.kind == GeneratedKind::Dust) out.radii.assign(name.count, double{static_cast<float>(2 * half * std::sqrt(dust_depth / (pi * count)))});
  return out;
}

Camera turned(const Camera& camera, double degrees) {
  const glm::dvec3 axis = glm::normalize(camera.up);
  const double angle = glm::radians(degrees);
  const glm::dvec3 v = camera.eye - camera.target; // Rodrigues' rotation
  Camera out = camera;
  out.eye = camera.target + v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
            axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
  return out;
}

namespace {

// The least distance of the eye along w at which the whole cube, widened by the margin, is as high as the image.
double fit_distance(const glm::dvec3& w, const glm::dvec3& up, double fov_y) {
  const glm::dvec3 r = glm::normalize(glm::cross(up, w));
  const glm::dvec3 u = glm::cross(w, r);
  const double t = std::tan(glm::radians(fov_y / 2));
  double distance = 0.0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1) * (half + margin);
    distance = std::max(distance, glm::dot(corner, w) + std::abs(glm::dot(corner, u)) / t);
  }
  return distance;
}

} // namespace

Camera generated_camera(const GeneratedName& name) {
  Camera camera;
  camera.up = {0, 1, 0};
  camera.fov_y = 30.0;
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.25, 0.15, 1.0)); // from the center to the eye
  switch (name.camera) {
  case GeneratedCamera::Fit: camera.eye = w * fit_distance(w, camera.up, camera.fov_y); break;
  case GeneratedCamera::Fill: camera.eye = w * 135.0; break;
  case GeneratedCamera::Inside:
    camera.eye = w * 20.0;
    camera.near = 1.0;
    break;
  }
  return turned(camera, degrees_per_frame * static_cast<double>(name.frame));
}

} // namespace mote
