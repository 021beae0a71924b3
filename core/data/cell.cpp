// SPDX-License-Identifier: MIT
#include "core/data/cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

Column* find(Frame& frame, std::string_view name) {
  const auto found = std::find_if(frame.columns.begin(), frame.columns.end(), [&](const Column& c) { return c.name == name; });
  return found == frame.columns.end() ? nullptr : &*found;
}

// Takes whole multiples of shorter edges off longer ones until nothing gets shorter.
void reduce(glm::dmat3& e) {
  for (int round = 0; round < 64; ++round) {
    bool shorter = false;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        if (i == k) continue;
        const double n = std::round(glm::dot(e[i], e[k]) / glm::dot(e[k], e[k]));
        const glm::dvec3 less = e[i] - n * e[k];
        if (n == 0.0 || !(glm::dot(less, less) < glm::dot(e[i], e[i]) * (1.0 - 1e-12))) continue;
        e[i] = less;
        shorter = true;
      }
    if (!shorter) return;
  }
}

} // namespace

bool has_volume(const Box& box) {
  const double scale = glm::length(box.edges[0]) * glm::length(box.edges[1]) * glm::length(box.edges[2]);
  return std::isfinite(scale) && std::abs(glm::determinant(box.edges)) > 1e-12 * scale;
}

MinimumImage::MinimumImage(const Box& box) {
  if (!has_volume(box)) return;
  edges_ = box.edges;
  periodic_ = box.periodic;
  if (periodic_.x && periodic_.y && periodic_.z) reduce(edges_);
  inverse_ = glm::inverse(edges_);
}

glm::dvec3 MinimumImage::operator()(const glm::dvec3& d) const {
  if (!(periodic_.x || periodic_.y || periodic_.z)) return d;
  const glm::dvec3 f = inverse_ * d;
  glm::dvec3 best = d;
  for (int k = 0; k < 3; ++k)
    if (periodic_[k]) best -= std::round(f[k]) * edges_[k];
  const glm::dvec3 rounded = best;
  for (int x = -(periodic_.x ? 1 : 0); x <= (periodic_.x ? 1 : 0); ++x)
    for (int y = -(periodic_.y ? 1 : 0); y <= (periodic_.y ? 1 : 0); ++y)
      for (int z = -(periodic_.z ? 1 : 0); z <= (periodic_.z ? 1 : 0); ++z) {
        const glm::dvec3 other = rounded + double(x) * edges_[0] + double(y) * edges_[1] + double(z) * edges_[2];
        if (glm::dot(other, other) < glm::dot(best, best)) best = other;
      }
  return best;
}

std::string wrap(Frame& frame) {
  if (!frame.box) return "there is no cell";
  if (!has_volume(*frame.box)) return "the cell has no volume";
  if (!frame.box->periodic.x && !frame.box->periodic.y && !frame.box->periodic.z) return "the cell is not periodic";
  const Box& box = *frame.box;
  const glm::dmat3 inverse = glm::inverse(box.edges);
  if (Column* image = find(frame, "image"); !image || image->components != 3 || image->type() != ColumnType::Int) {
    std::erase_if(frame.columns, [](const Column& c) { return c.name == "image"; });
    frame.columns.push_back({"image", 3, std::vector<std::int64_t>(3 * frame.count), {}});
  }
  auto& flags = std::get<std::vector<std::int64_t>>(find(frame, "image")->values);
  auto& positions = std::get<std::vector<double>>(find(frame, "position")->values);
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    glm::dvec3 p(positions[3 * row], positions[3 * row + 1], positions[3 * row + 2]);
    const glm::dvec3 f = inverse * (p - box.origin);
    for (int k = 0; k < 3; ++k) {
      const double whole = box.periodic[k] ? std::floor(f[k]) : 0.0;
      if (!(std::abs(whole) < 1e15) || whole == 0.0) continue; // NaN and far beyond stay
      p -= whole * box.edges[k];
      flags[3 * row + static_cast<std::uint64_t>(k)] += static_cast<std::int64_t>(whole);
    }
    for (int k = 0; k < 3; ++k) positions[3 * row + static_cast<std::uint64_t>(k)] = p[k];
  }
  return {};
}

std::string unwrap(Frame& frame) {
  if (!frame.box) return "there is no cell";
  for (const auto& [name, value] : frame.properties)
    if (name == "position_columns" && value.find('u') != std::string::npos) { // xu yu zu: never wrapped
      std::erase_if(frame.columns, [](const Column& c) { return c.name == "image"; });
      return {};
    }
  const Column* image = find(frame, "image");
  if (!image || image->components != 3 || image->type() == ColumnType::Text) return "there are no image flags";
  auto& positions = std::get<std::vector<double>>(find(frame, "position")->values);
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const glm::dvec3 shift = frame.box->edges * glm::dvec3(image->number(row, 0), image->number(row, 1), image->number(row, 2));
    for (int k = 0; k < 3; ++k) positions[3 * row + static_cast<std::uint64_t>(k)] += shift[k];
  }
  std::erase_if(frame.columns, [](const Column& c) { return c.name == "image"; });
  return {};
}

} // namespace mote::data
