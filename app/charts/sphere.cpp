// SPDX-License-Identifier: MIT
// Topic `sphere`: what each way of intersecting a ray with a sphere in float32 loses, over distance / radius (kappa), on this
// device. Errors are those of the arithmetic: against extended precision on the same float32 inputs. Rays are uniform over
// the disc that the sphere covers, up to 0.99 of its radius; grazing ones at 1 - 1e-2 ... 1 - 1e-5 of it.
#include "app/charts/errors.hpp"
#include "app/charts/kernel.hpp"
#include "app/charts/random.hpp"
#include "app/charts/topic.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

namespace mote::app {
namespace {

using Wide = glm::vec<3, long double>;

struct Form {
  int number; // FORM of shaders/charts/sphere_forms.glsl
  const char* name;
  bool baseline, wide; // wide: needs double
};
constexpr std::array forms{Form{0, "naive quadratic", true, false},
                           Form{1, "lecture (unit direction)", true, false},
                           Form{2, "citardauq, naive discriminant", true, false},
                           Form{4, "Haines 2019", true, false},
                           Form{5, "perpendicular, local normal", false, false},
                           Form{12, "shifted, unfused", true, false},
                           Form{6, "shifted, fma()", false, false},
                           Form{13, "shifted, split arithmetic (mote)", false, false},
                           Form{8, "silhouette, world normal", true, false},
                           Form{9, "silhouette, local normal", false, false},
                           Form{11, "naive in sums of two floats", true, false},
                           Form{10, "naive in double", true, true}};
constexpr std::array kappas{2.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
constexpr double timed_kappa = 1e3;
constexpr std::uint32_t rays = 20000;

struct Answer {
  Wide normal{0};
  long double t{}; // in units of the direction; 0: a miss
};

// From the perpendicular, made orthogonal a second time: errs by about 1e-19 kappa.
Answer exact(const Wide& m, long double r, const Wide& d) {
  const long double dd = glm::dot(d, d), s = glm::dot(m, d) / dd;
  Wide l = d * s - m;
  const long double rest = glm::dot(l, d) / dd;
  l -= d * rest;
  const long double distance = glm::length(l), square = (r - distance) * (r + distance);
  if (square < 0) return {};
  const long double h = std::sqrt(square / dd);
  return {(l - d * h) / r, s - rest - h};
}

struct Cases {
  std::vector<float> given{};            // four vec4 an item
  std::vector<Answer> by_ray{}, by_q{};  // what the float32 direction hits, and what the exact ray through q does
};

Cases make_cases(double kappa, bool grazing) {
  Cases out;
  Random random(17);
  for (std::uint32_t i = 0; i < rays; ++i) {
    const float r = static_cast<float>(random.uniform(0.5, 1.0));
    const glm::vec3 m(random.direction() * (kappa * static_cast<double>(r)));
    const Wide wide_m(m), to = wide_m / glm::length(wide_m);
    const Wide side = std::abs(to.x) < 0.5L ? Wide(1, 0, 0) : Wide(0, 1, 0);
    const Wide x = glm::normalize(glm::cross(to, side)), y = glm::cross(to, x);
    const double rho = grazing ? 1.0 - std::pow(10.0, -random.uniform(2.0, 5.0)) : 0.99 * std::sqrt(random.uniform());
    const double angle = random.uniform(0.0, 6.283185307179586);
    const glm::vec2 q(static_cast<float>(rho * std::cos(angle)), static_cast<float>(rho * std::sin(angle)));
    const long double r_wide = r, e = glm::length(wide_m), ratio = r_wide / e;
    const Wide p = wide_m - to * (r_wide * ratio) + (x * static_cast<long double>(q.x) + y * static_cast<long double>(q.y)) * (std::sqrt(1 - ratio * ratio) * r_wide);
    const Wide ray = glm::normalize(p);
    const glm::vec3 d(ray), xf(x), yf(y);
    for (const float v : {m.x, m.y, m.z, r, d.x, d.y, d.z, 0.0f, xf.x, xf.y, xf.z, q.x, yf.x, yf.y, yf.z, q.y}) out.given.push_back(v);
    out.by_ray.push_back(exact(wide_m, r_wide, Wide(d)));
    out.by_q.push_back(exact(wide_m, r_wide, ray));
  }
  return out;
}

SphereErrors judge(const Cases& cases, int form, const std::vector<float>& made) {
  const std::vector<Answer>& answers = form == 8 || form == 9 ? cases.by_q : cases.by_ray; // the silhouette's forms are given q
  std::vector<double> normals, ulps;
  std::uint32_t hits = 0, missed = 0;
  for (std::uint32_t i = 0; i < rays; ++i) {
    if (answers[i].t == 0) continue;
    ++hits;
    const float* v = &made[std::size_t{8} * i];
    const Wide n(static_cast<long double>(v[0]) + v[4], static_cast<long double>(v[1]) + v[5], static_cast<long double>(v[2]) + v[6]);
    const long double t = static_cast<long double>(v[3]) + v[7];
    if (!(v[3] != 0.0f && std::isfinite(v[3]) && std::isfinite(v[0]))) {
      ++missed;
      continue;
    }
    normals.push_back(static_cast<double>(std::atan2(glm::length(glm::cross(n, answers[i].normal)), glm::dot(n, answers[i].normal))));
    const float at = static_cast<float>(answers[i].t);
    ulps.push_back(static_cast<double>(std::abs(t - answers[i].t) / static_cast<long double>(std::nextafter(at, INFINITY) - at)));
  }
  if (normals.empty()) return {INFINITY, INFINITY, 100.0};
  return {chart::percentile(normals, 0.99), chart::percentile(ulps, 0.99), 100.0 * missed / std::max(hits, 1u)};
}

chart::Chart empty_chart() {
  const chart::Axis kappa{"kappa = distance / radius", "", true};
  chart::Chart c{.topic = "sphere", .title = "A ray and a sphere in float32"};
  c.panels = {{"Normals: 99 of 100 rays err less", kappa, {"normal error, p99", "rad", true}, false, {}},
              {"Hit distance: 99 of 100 rays err less", kappa, {"error of t, p99", "float32 spacings", true}, false, {}},
              {"Grazing rays that are lost", kappa, {"of the rays that hit", "%", true}, false, {}},
              {"What it costs, at kappa = 1000", {"time a ray", "ns", true}, {"normal error, p99", "rad", true}, true, {}}};
  return c;
}

Kernel kernel_of(DrawingDevice& device, int form) {
  const std::array<gpu::ShaderDefine, 1> defines{{{"FORM", std::to_string(form)}}};
  return Kernel(device, "charts/sphere.comp", defines);
}

} // namespace

SphereErrors sphere_errors(DrawingDevice& device, int form, double kappa, bool grazing) {
  const Cases cases = make_cases(kappa, grazing);
  return judge(cases, form, kernel_of(device, form).run(cases.given, rays, 2));
}

chart::Chart chart_sphere(TopicContext& context) {
  chart::Chart c = empty_chart();
  std::vector<std::pair<Cases, Cases>> cases;
  for (const double kappa : kappas) cases.emplace_back(make_cases(kappa, false), make_cases(kappa, true));
  for (const Form& form : forms) {
    if (form.wide && !gpu::has(context.device.device().features(), gpu::Feature::ShaderFloat64)) {
      c.notes.push_back(fmt::format("'{}' is left out: the device lacks shaderFloat64.", form.name));
      continue;
    }
    Kernel kernel = kernel_of(context.device, form.number);
    std::array<chart::Series, 4> series;
    for (chart::Series& s : series) s = {form.name, form.baseline, {}};
    for (std::size_t k = 0; k < kappas.size(); ++k) {
      const SphereErrors e = judge(cases[k].first, form.number, kernel.run(cases[k].first.given, rays, 2));
      const SphereErrors grazing = judge(cases[k].second, form.number, kernel.run(cases[k].second.given, rays, 2));
      const std::string parameter = fmt::format("kappa = {:g}", kappas[k]);
      series[0].points.push_back({parameter, kappas[k], e.normal});
      series[1].points.push_back({parameter, kappas[k], e.ulps});
      series[2].points.push_back({parameter, kappas[k], grazing.missed});
      if (kappas[k] == timed_kappa) series[3].points.push_back({"", kernel.nanoseconds(cases[k].first.given, rays, 2), e.normal});
    }
    for (std::size_t p = 0; p < series.size(); ++p) c.panels[p].series.push_back(std::move(series[p]));
    context.say(form.name);
  }
  c.notes.push_back(fmt::format("{} rays a point. fma() of this device is {}.", rays, has_fused_fma(context.device) ? "fused" : "not fused: it multiplies and adds"));
  return c;
}

} // namespace mote::app
