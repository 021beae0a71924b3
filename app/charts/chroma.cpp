// SPDX-License-Identifier: MIT
#include "app/charts/chroma.hpp"

#include "app/charts/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::app {
namespace {

constexpr double kr = 0.2126, kb = 0.0722;

double byte(double v) { return std::clamp(std::round(v), 0.0, 255.0); }

// Chroma averaged over blocks and rounded, then read at every pixel.
std::vector<double> through_blocks(const std::vector<double>& chroma, int side, int across, int down, bool linear) {
  const int w = side / across, h = side / down;
  std::vector<double> small(static_cast<std::size_t>(w * h));
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) small[static_cast<std::size_t>(y / down * w + x / across)] += chroma[static_cast<std::size_t>(y * side + x)] / (across * down);
  for (double& v : small) v = byte(v);
  auto at = [&](int x, int y) { return small[static_cast<std::size_t>(std::clamp(y, 0, h - 1) * w + std::clamp(x, 0, w - 1))]; };
  std::vector<double> out;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (!linear) {
        out.push_back(at(x / across, y / down));
        continue;
      }
      const double u = (x + 0.5) / across - 0.5, v = (y + 0.5) / down - 0.5, fx = u - std::floor(u), fy = v - std::floor(v);
      const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
      out.push_back((at(i, j) * (1 - fx) + at(i + 1, j) * fx) * (1 - fy) + (at(i, j + 1) * (1 - fx) + at(i + 1, j + 1) * fx) * fy);
    }
  return out;
}

double rms(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]) / 3.0;
  return std::sqrt(sum / static_cast<double>(a.size()));
}

} // namespace

glm::dvec3 hue_color(double h) {
  const double s = 6.0 * h;
  return glm::clamp(glm::dvec3(std::abs(s - 3.0) - 1.0, 2.0 - std::abs(s - 2.0), 2.0 - std::abs(s - 4.0)), 0.0, 1.0);
}

glm::dvec3 hue_from_table(HueTable kind, int n, double h) {
  auto entry = [&](int j) {
    const double k = ((j % n) + n) % n;
    return hue_color((kind == HueTable::Knots ? k : k + 0.5) / n);
  };
  if (kind == HueTable::Nearest) return entry(static_cast<int>(std::floor(h * n)));
  const double u = kind == HueTable::Knots ? h * n : h * n - 0.5, f = u - std::floor(u);
  const int j = static_cast<int>(std::floor(u));
  return entry(j) * (1.0 - f) + entry(j + 1) * f;
}

std::vector<glm::dvec3> discs(int side) {
  Random random(3);
  struct Disc {
    double x, y, r;
    glm::dvec3 color;
  };
  std::vector<Disc> all;
  for (int i = 0; i < 120; ++i) {
    const double x = random.uniform(0, side), y = random.uniform(0, side), r = random.uniform(4.0, 24.0);
    all.push_back({x, y, r, hue_color(random.uniform()) * 255.0});
  }
  std::vector<glm::dvec3> out;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      glm::dvec3 color(255.0);
      for (const Disc& d : all) { // edges one pixel wide
        const double covered = std::clamp(d.r - std::hypot(x + 0.5 - d.x, y + 0.5 - d.y) + 0.5, 0.0, 1.0);
        color = glm::mix(color, d.color, covered);
      }
      out.push_back({byte(color.r), byte(color.g), byte(color.b)});
    }
  return out;
}

std::vector<glm::dvec3> subsampled(const std::vector<glm::dvec3>& picture, int side, int across, int down, bool linear) {
  std::vector<double> luma, cb, cr;
  for (const glm::dvec3& c : picture) {
    const double y = kr * c.r + (1.0 - kr - kb) * c.g + kb * c.b;
    luma.push_back(byte(y));
    cb.push_back((c.b - y) / (2.0 * (1.0 - kb)) + 127.5);
    cr.push_back((c.r - y) / (2.0 * (1.0 - kr)) + 127.5);
  }
  cb = through_blocks(cb, side, across, down, linear);
  cr = through_blocks(cr, side, across, down, linear);
  std::vector<glm::dvec3> out;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double b = luma[i] + (cb[i] - 127.5) * 2.0 * (1.0 - kb), r = luma[i] + (cr[i] - 127.5) * 2.0 * (1.0 - kr);
    out.push_back({byte(r), byte((luma[i] - kr * r - kb * b) / (1.0 - kr - kb)), byte(b)});
  }
  return out;
}

chart::Panel hue_panel() {
  chart::Panel panel{"Hues from a table", {"size of the table", "bytes", true}, {"largest error", "steps of 255", true}, true, {}};
  struct Way {
    const char* name;
    HueTable kind;
    bool baseline;
  };
  for (const Way& way : {Way{"linear, knots at j / N, around the seam", HueTable::Knots, false}, Way{"linear, knots at (j + 1/2) / N", HueTable::Centers, true}, Way{"nearest", HueTable::Nearest, true}}) {
    chart::Series series{way.name, way.baseline, {}};
    for (const int n : {6, 64, 256, 1024}) {
      double worst = 0.0;
      for (int i = 0; i < 60000; ++i) {
        const double h = i / 60000.0;
        const glm::dvec3 d = glm::abs(hue_from_table(way.kind, n, h) - hue_color(h)) * 255.0;
        worst = std::max({worst, d.r, d.g, d.b});
      }
      series.points.push_back({fmt::format("N = {}", n), 4.0 * n, worst < 1e-9 ? 0.0 : worst});
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

chart::Panel chroma_panel() {
  constexpr int side = 256;
  const std::vector<glm::dvec3> picture = discs(side);
  chart::Panel panel{"A picture of colored discs, chroma for fewer pixels (BT.709, 8 bits)", {"size", "bytes a pixel", false}, {"color error, RMS", "steps of 255", true}, true, {}};
  panel.series.push_back({"RGB", false, {{"8 8 8", 3.0, 0.0}}});
  chart::Series linear{"Y'CbCr, chroma read linearly", false, {}}, blocks{"Y'CbCr, chroma read as blocks", true, {}};
  struct Way {
    const char* name;
    int across, down;
  };
  for (const Way& way : {Way{"4:4:4", 1, 1}, Way{"4:2:2", 2, 1}, Way{"4:2:0", 2, 2}}) {
    const double bytes = 1.0 + 2.0 / (way.across * way.down);
    linear.points.push_back({way.name, bytes, rms(subsampled(picture, side, way.across, way.down, true), picture)});
    blocks.points.push_back({way.name, bytes, rms(subsampled(picture, side, way.across, way.down, false), picture)});
  }
  panel.series.push_back(std::move(linear));
  panel.series.push_back(std::move(blocks));
  return panel;
}

} // namespace mote::app
