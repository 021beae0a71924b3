// SPDX-License-Identifier: MIT
#include "app/charts/stacks.hpp"

#include "app/charts/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

namespace mote::app {
namespace {

const glm::dvec3 white(1.0);

Stack sorted(Stack stack) { // nearest first
  std::sort(stack.begin(), stack.end(), [](const Layer1& a, const Layer1& b) { return a.z < b.z; });
  return stack;
}
glm::dvec3 over(const Layer1& l, const glm::dvec3& behind) { return l.color * l.alpha + behind * (1.0 - l.alpha); }
double rounded(double v) { return std::round(v * 255.0) / 255.0; }
glm::dvec3 rounded(const glm::dvec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

std::vector<Stack> make_stacks(std::size_t layers, double alpha) {
  Random random(5);
  std::vector<Stack> out(400);
  for (Stack& stack : out)
    for (std::size_t i = 0; i < layers; ++i) {
      const double hue = 6.0 * random.uniform();
      auto ramp = [](double h) { return std::clamp(std::abs(std::fmod(h + 6.0, 6.0) - 3.0) - 1.0, 0.0, 1.0); };
      stack.push_back({{ramp(hue), ramp(hue + 4.0), ramp(hue + 2.0)}, alpha, random.uniform(5.0, 50.0)});
    }
  return out;
}

} // namespace

glm::dvec3 blend_exact(const Stack& stack) {
  const Stack s = sorted(stack);
  glm::dvec3 color = white;
  for (auto it = s.rbegin(); it != s.rend(); ++it) color = over(*it, color);
  return color;
}

glm::dvec3 blend_unsorted(const Stack& stack) {
  glm::dvec3 color = white;
  for (const Layer1& l : stack) color = over(l, color);
  return color;
}

glm::dvec3 blend_weighted(const Stack& stack) {
  glm::dvec3 sum(0);
  double weights = 0.0, through = 1.0;
  for (const Layer1& l : stack) {
    const double w = l.alpha * std::clamp(10.0 / (1e-5 + std::pow(l.z / 5.0, 2.0) + std::pow(l.z / 200.0, 6.0)), 1e-2, 3e3);
    sum += l.color * l.alpha * w;
    weights += l.alpha * w;
    through *= 1.0 - l.alpha;
  }
  return sum / std::max(weights, 1e-12) * (1.0 - through) + white * through;
}

glm::dvec3 blend_stochastic(const Stack& stack, int samples, std::uint64_t seed) {
  Random random(seed);
  const Stack s = sorted(stack);
  glm::dvec3 sum(0);
  for (int k = 0; k < samples; ++k) {
    glm::dvec3 seen = white;
    for (const Layer1& l : s)
      if (random.uniform() < l.alpha) {
        seen = l.color;
        break;
      }
    sum += seen;
  }
  return sum / static_cast<double>(samples);
}

glm::dvec3 blend_first(const Stack& stack, std::size_t k, bool tail) {
  const Stack s = sorted(stack);
  glm::dvec3 behind = white;
  if (tail && s.size() > k) {
    glm::dvec3 mean(0);
    double through = 1.0;
    for (std::size_t i = k; i < s.size(); ++i) {
      mean += s[i].color / static_cast<double>(s.size() - k);
      through *= 1.0 - s[i].alpha;
    }
    behind = mean * (1.0 - through) + white * through;
  }
  for (std::size_t i = std::min(k, s.size()); i-- > 0;) behind = over(s[i], behind);
  return behind;
}

glm::dvec3 blend_adaptive(const Stack& stack, std::size_t k) {
  struct Node {
    glm::dvec3 color; // times alpha
    double through, z;
  };
  std::vector<Node> nodes;
  for (const Layer1& l : stack) {
    const Node node{l.color * l.alpha, 1.0 - l.alpha, l.z};
    nodes.insert(std::upper_bound(nodes.begin(), nodes.end(), node, [](const Node& a, const Node& b) { return a.z < b.z; }), node);
    if (nodes.size() <= k) continue;
    Node& kept = nodes[k - 1];
    kept.color += kept.through * nodes[k].color;
    kept.through *= nodes[k].through;
    nodes.pop_back();
  }
  glm::dvec3 color = white;
  for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) color = it->color + color * it->through;
  return color;
}

// What is before depth x blocks at least what the two other places of the three that have the same moments as the layers block
// before it, and a part of x's own weight. Bias and that part: the paper's (5e-7, 0.25); depths by their logarithm, -1..1.
glm::dvec3 blend_moments(const Stack& stack) {
  constexpr double bias = 5e-7, own_part = 0.25, nearest = 5.0, farthest = 50.0;
  const auto place = [&](const Layer1& l) { return 2.0 * std::log(l.z / nearest) / std::log(farthest / nearest) - 1.0; };
  double moments[5] = {};
  for (const Layer1& l : stack) {
    const double absorbance = -std::log1p(-std::min(l.alpha, 0.9999)), x = place(l);
    for (double power = 1.0; double& m : moments) {
      m += absorbance * power;
      power *= x;
    }
  }
  const double total = moments[0];
  const double mean[5] = {1, 0, 0.375, 0, 0.375};
  for (int k = 0; k < 5; ++k) moments[k] = (1.0 - bias) * moments[k] / total + bias * mean[k];
  const double* m = moments;
  const glm::dmat3 hankel = glm::inverse(glm::dmat3(m[0], m[1], m[2], m[1], m[2], m[3], m[2], m[3], m[4]));
  glm::dvec3 sum(0);
  double weights = 0.0;
  for (const Layer1& l : stack) {
    const double x = place(l);
    const glm::dvec3 q = hankel * glm::dvec3(1, x, x * x); // the other two places: roots of q.x + q.y t + q.z t^2
    const double half = -0.5 * q.y / q.z, spread = std::sqrt(std::max(half * half - q.x / q.z, 0.0));
    const double a = half - spread, b = half + spread;
    const auto weight = [&](double at, double one, double two) { return (m[2] - m[1] * (one + two) + one * two) / ((at - one) * (at - two)); };
    const double before = (a < x ? weight(a, x, b) : 0.0) + (b < x ? weight(b, x, a) : 0.0) + own_part * weight(x, a, b);
    const double seen = l.alpha * std::exp(-total * std::clamp(std::isfinite(before) ? before : 0.0, 0.0, 1.0));
    sum += seen * l.color;
    weights += seen;
  }
  const double through = std::exp(-total);
  return sum / std::max(weights, 1e-12) * (1.0 - through) + white * through;
}

glm::dvec3 blend_8bit(const Stack& stack, bool back_to_front) {
  const Stack s = sorted(stack);
  if (back_to_front) {
    glm::dvec3 color = white;
    for (auto it = s.rbegin(); it != s.rend(); ++it) color = rounded(over(*it, color));
    return color;
  }
  glm::dvec3 color(0);
  double covered = 0.0;
  for (const Layer1& l : s) {
    color = rounded(color + l.color * l.alpha * (1.0 - covered));
    covered = rounded(covered + l.alpha * (1.0 - covered));
  }
  return color + white * (1.0 - covered);
}

chart::Panel stack_panel() {
  struct Way {
    std::string name;
    bool baseline;
    std::function<glm::dvec3(const Stack&)> blend;
  };
  std::uint64_t seed = 1;
  const std::vector<Way> ways{{"every layer sorted, double", false, blend_exact},
                              {"sorted, 8 bits, back to front", false, [](const Stack& s) { return blend_8bit(s, true); }},
                              {"sorted, 8 bits, front to back", true, [](const Stack& s) { return blend_8bit(s, false); }},
                              {"first 4 layers", true, [](const Stack& s) { return blend_first(s, 4, false); }},
                              {"first 4 layers, mean of the rest", false, [](const Stack& s) { return blend_first(s, 4, true); }},
                              {"4 nodes, merged", false, [](const Stack& s) { return blend_adaptive(s, 4); }},
                              {"8 nodes, merged", false, [](const Stack& s) { return blend_adaptive(s, 8); }},
                              {"weighted sums", true, blend_weighted},
                              {"four moments", true, blend_moments},
                              {"stochastic, 8 samples", true, [&](const Stack& s) { return blend_stochastic(s, 8, ++seed); }},
                              {"stochastic, 64 samples", false, [&](const Stack& s) { return blend_stochastic(s, 64, ++seed); }},
                              {"as they come", true, blend_unsorted}};
  struct Kind {
    std::size_t layers;
    double alpha;
  };
  chart::Panel panel{"Stacks of layers, blended on the processor", {"time a stack", "ns", true}, {"color error, RMS", "steps of 255", true}, true, {}};
  for (const Way& way : ways) {
    chart::Series series{way.name, way.baseline, {}};
    for (const Kind kind : {Kind{4, 0.5}, Kind{16, 0.1}, Kind{16, 0.5}, Kind{64, 0.3}}) {
      const std::vector<Stack> stacks = make_stacks(kind.layers, kind.alpha);
      std::vector<glm::dvec3> blended(stacks.size());
      double ns = INFINITY, squares = 0.0;
      for (int k = 0; k < 3; ++k) {
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t i = 0; i < stacks.size(); ++i) blended[i] = way.blend(stacks[i]);
        ns = std::min(ns, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / static_cast<double>(stacks.size()));
      }
      for (std::size_t i = 0; i < stacks.size(); ++i) {
        const glm::dvec3 d = (blended[i] - blend_exact(stacks[i])) * 255.0;
        squares += glm::dot(d, d) / 3.0;
      }
      series.points.push_back({fmt::format("{} layers of {:g}", kind.layers, kind.alpha), ns, std::sqrt(squares / static_cast<double>(stacks.size()))});
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

} // namespace mote::app
