// SPDX-License-Identifier: MIT
// A color config with lookup tables of every kind, written into a folder: what studios' configs hold
// and the shipped one does not. Each view is one path through the GLSL writer. Shared by the CPU and
// the GPU tests of core/color.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mote::test {

inline const std::vector<std::string>& lut_views() {
  static const std::vector<std::string> views{"Curve",       "Three curves", "Long curve", "Cube",
                                              "Tetrahedral", "Nearest",      "Chain",      "Log",
                                              "Splines",     "Steep"};
  return views;
}

inline void write_spi1d(const std::filesystem::path& file, int size, int channels, double from, double to) {
  std::ofstream out(file);
  out << fmt::format("Version 1\nFrom {} {}\nLength {}\nComponents {}\n{{\n", from, to, size, channels);
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < channels; ++k)
      out << fmt::format(" {:.9f}", std::pow(i / (size - 1.0), 1.0 / (2.0 + 0.3 * k)));
    out << '\n';
  }
  out << "}\n";
}

inline std::vector<double> twisted(double r, double g, double b) {
  return {0.8 * r + 0.2 * g * g, 0.7 * g + 0.3 * std::sqrt(b * r), 0.9 * b + 0.1 * std::sin(3 * r)};
}

inline void write_cube(const std::filesystem::path& file, int size) { // red fastest
  std::ofstream out(file);
  out << fmt::format("LUT_3D_SIZE {}\nDOMAIN_MIN 0 0 0\nDOMAIN_MAX 1 1 1\n", size);
  for (int i = 0; i < size * size * size; ++i) {
    const auto v =
        twisted(i % size / (size - 1.0), i / size % size / (size - 1.0), i / size / size / (size - 1.0));
    out << fmt::format("{:.9f} {:.9f} {:.9f}\n", v[0], v[1], v[2]);
  }
}

inline void write_spi3d(const std::filesystem::path& file, int size) {
  std::ofstream out(file);
  out << fmt::format("SPILUT 1.0\n3 3\n{0} {0} {0}\n", size);
  for (int r = 0; r < size; ++r)
    for (int g = 0; g < size; ++g)
      for (int b = 0; b < size; ++b) {
        const auto v = twisted(r / (size - 1.0), g / (size - 1.0), b / (size - 1.0));
        out << fmt::format("{} {} {} {:.9f} {:.9f} {:.9f}\n", r, g, b, v[0], v[1], v[2]);
      }
}

// Writes config.ocio and its tables; returns the config's path.
inline std::string write_lut_config(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "luts");
  write_spi1d(folder / "luts/curve.spi1d", 256, 1, -0.1, 4.0);
  write_spi1d(folder / "luts/three.spi1d", 300, 3, 0.0, 8.0);
  write_spi1d(folder / "luts/long.spi1d", 10000, 1, 0.0, 16.0);
  write_cube(folder / "luts/cube.cube", 17);
  write_spi3d(folder / "luts/cube.spi3d", 9);
  std::ofstream out(folder / "config.ocio");
  out << R"(ocio_profile_version: 2.1
environment: {}
search_path: luts
roles: {default: Linear Rec.709, scene_linear: Linear Rec.709}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  Test:
)";
  for (const std::string& view : lut_views())
    out << fmt::format("    - !<View> {{name: {0}, colorspace: {0}}}\n", view);
  out << R"(colorspaces:
  - !<ColorSpace> {name: Linear Rec.709, isdata: false}
)";
  const std::string shaper = "!<AllocationTransform> {allocation: lg2, vars: [-8, 6]}";
  const std::vector<std::vector<std::string>> steps{
      {"!<FileTransform> {src: curve.spi1d, interpolation: linear}"},
      {"!<FileTransform> {src: three.spi1d, interpolation: linear}"},
      {"!<FileTransform> {src: long.spi1d, interpolation: linear}"},
      {"!<FileTransform> {src: cube.cube, interpolation: linear}"},
      {shaper, "!<FileTransform> {src: cube.spi3d, interpolation: tetrahedral}"},
      {"!<FileTransform> {src: cube.spi3d, interpolation: nearest}"},
      {"!<FileTransform> {src: curve.spi1d, interpolation: linear}",
       "!<FileTransform> {src: cube.cube, interpolation: tetrahedral}",
       "!<MatrixTransform> {matrix: [0.9, 0.1, 0, 0, 0.05, 0.9, 0.05, 0, 0, 0.1, 0.9, 0, 0, 0, 0, 1]}",
       "!<FileTransform> {src: three.spi1d, interpolation: linear}",
       "!<FileTransform> {src: cube.spi3d, interpolation: linear}"},
      {"!<LogCameraTransform> {base: 2, log_side_slope: 0.06, log_side_offset: 0.55, lin_side_break: 0.008}",
       "!<ExponentTransform> {value: [1.1, 1.2, 1.3, 1]}", "!<ExponentTransform> {value: 0.9}",
       "!<CDLTransform> {slope: [1.1, 1, 0.9], power: [1.05, 1, 0.98], sat: 0.8}"},
      {"!<MatrixTransform> {matrix: [0.9, 0.1, 0, 0, 0.05, 0.9, 0.05, 0, 0, 0.1, 0.9, 0, 0, 0, 0, 1]}",
       "!<GradingRGBCurveTransform> {style: linear, red: {control_points: [-7, -6, 0, 0.3, 6, 7]}, "
       "green: {control_points: [-7, -7, 0, 0, 6, 6]}, blue: {control_points: [-7, -5, 0, -0.2, 6, 4]}}",
       "!<ExponentTransform> {value: [0.45, 0.4, 0.5, 1], style: mirror}"},
      {"!<GradingRGBCurveTransform> {style: log, master: {control_points: [-1, 0, 1.0615, 0, 1.062, 1, 3, "
       "1]}}"}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    out << fmt::format(
        "  - !<ColorSpace>\n    name: {}\n    from_scene_reference: !<GroupTransform>\n      children:\n",
        lut_views()[i]);
    for (const std::string& step : steps[i]) out << "        - " << step << '\n';
  }
  return (folder / "config.ocio").string();
}

} // namespace mote::test
