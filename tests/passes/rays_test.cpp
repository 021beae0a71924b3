// SPDX-License-Identifier: MIT
// Every particle type's shader ray by ray against its double-precision twin: random particles from inside to a million sizes away,
// ordinary shapes and needles. What is compared is the intersection alone, for the record as stored: no placement, no
// projection. Shapes are at most four times longer than thick, needles 1e5 times. MOTE_MEASURE=1 prints the figures
// (docs/accuracy.md).
#include "core/gpu/shader_compiler.hpp"
#include "core/reference/shapes.hpp"
#include "harness.hpp"
#include "shaders/embedded.hpp"
#include "tests/reference/random_shapes.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

namespace mote::test {
namespace {

const char* const kernel = R"(#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "particles/interface.glsl"
struct In { vec4 record[4]; vec4 direction; };
struct Out { vec4 hit, n_in, n_out; };
layout(std430, set = 0, binding = 1) readonly buffer Ins { In ins[]; };
layout(std430, set = 0, binding = 2) buffer Outs { Out outs[]; };
void main() {
  In from = ins[gl_GlobalInvocationID.x];
  vec4 record[record_vec4s], payload[payload_vec4s];
  for (int i = 0; i < record_vec4s; ++i) record[i] = from.record[i];
#ifdef NEAR_EYE
  vec4 near[4] = vec4[4](record[0], vec4(0.0), vec4(0.0), record[1]);
  pack(place_near(record, Placement(mat3(1.0), vec3(0.0), 1.0), near), payload);
  Ray ray = Ray(vec3(0.0), from.direction.xyz, vec3(0.0));
#else
  pack(place(record, Placement(mat3(1.0), vec3(0.0), 1.0)), payload);
  Ray ray = Ray(vec3(0.0), from.direction.xyz);
#endif
  Particle p = unpack(payload);
  Interval hit;
  bool met = drawable(p) && intersect(ray, p, hit);
  outs[gl_GlobalInvocationID.x] = Out(vec4(met ? 1.0 : 0.0, hit.t_in, hit.t_out, 0.0), vec4(outward_normal(ray, p, hit, false), 0.0),
                                      vec4(outward_normal(ray, p, hit, true), 0.0));
}
)";

struct In {
  Record record{};
  glm::vec4 direction{0};
};
struct Out {
  glm::vec4 hit{0}, n_in{0}, n_out{0};
};

double angle(const glm::dvec3& a, const glm::dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }
double percentile(std::vector<double>& values, double p) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
}

struct Errors {
  std::vector<double> depth{}, by_size{}, normal{}; // of depth: relative, and in bounding radii
  std::size_t hits{}, wrong{}, ambiguous{};
};

class Rays : public GpuTest {
protected:
  bool open{};     // cylinders without end discs
  bool near_eye{}; // the variant that draws what is near the eye

  std::vector<Out> cast(const std::string& type, const std::vector<In>& ins) {
    const auto text = [](const std::string& path) -> std::string {
      if (const char* folder = std::getenv("MOTE_SHADERS")) {
        std::ifstream file(std::string(folder) + "/" + path);
        return (std::ostringstream() << file.rdbuf()).str();
      }
      return std::string(shaders::text(path));
    };
    const gpu::CompiledShader compiled = gpu::compile_glsl(gpu::ShaderStage::Compute, {"rays.comp", kernel}, near_eye ? std::vector<gpu::ShaderDefine>{{"NEAR_EYE", "1"}} : std::vector<gpu::ShaderDefine>{}, [&](const std::string& name, const std::string&) {
      return std::optional(gpu::GlslSource{name, text(name == "type.glsl" ? "particles/" + type + "/type.glsl" : name)});
    });
    for (const gpu::ShaderMessage& message : compiled.messages) ADD_FAILURE() << to_string(message);
    if (!compiled) return {};
    const gpu::ShaderModule module = device().create_shader_module({.label = "rays", .spirv = compiled.spirv});
    const gpu::BindGroupLayoutEntry entries[] = {{.binding = 1, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::ReadOnlyStorageBuffer},
                                                 {.binding = 2, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::StorageBuffer}};
    const gpu::BindGroupLayout group_layout = device().create_bind_group_layout({.label = "rays", .entries = entries});
    const gpu::BindGroupLayout* layouts[] = {&group_layout};
    const gpu::PipelineLayout layout = device().create_pipeline_layout({.bind_group_layouts = layouts});
    const gpu::ComputePipeline pipeline = device().create_compute_pipeline({.label = "rays", .layout = &layout, .compute = {.module = &module}});
    const gpu::Buffer in = device().create_buffer({.label = "in", .size = ins.size() * sizeof(In), .usage = gpu::BufferUsage::Storage, .contents = std::as_bytes(std::span(ins))});
    const gpu::Buffer out = device().create_buffer({.label = "out", .size = ins.size() * sizeof(Out), .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopySrc | gpu::BufferUsage::CopyDst});
    const gpu::BindGroupEntry bindings[] = {{.binding = 1, .buffer = {.buffer = &in}}, {.binding = 2, .buffer = {.buffer = &out}}};
    const gpu::BindGroup group = device().create_bind_group({.label = "rays", .layout = &group_layout, .entries = bindings});
    gpu::CommandEncoder encoder = device().create_command_encoder("rays");
    gpu::ComputePass pass = encoder.begin_compute_pass({.label = "rays"});
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group);
    pass.dispatch(static_cast<std::uint32_t>(ins.size() / 64));
    pass.end();
    device().queue().submit(encoder.finish());
    std::vector<Out> outs(ins.size());
    const auto bytes = device().read_buffer(out);
    std::memcpy(outs.data(), bytes.data(), bytes.size());
    return outs;
  }

  // Rays from the eye (the origin) through the box around a particle that lies `distance` sizes away.
  [[nodiscard]] std::vector<In> aimed(const std::string& type, double distance, bool needle, std::size_t count) const {
    Dice dice;
    dice.random.seed(5);
    std::vector<In> ins(count);
    for (In& in : ins) {
      Case c = random_case(type, dice, false, needle, 0.25);
      if (open) c.record[2].y = 1.0f;
      const double z = std::max(distance, 0.05) * c.size();
      glm::dvec3 target = c.axes * (c.extents * glm::dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)));
      const glm::dvec3 d(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), 1.0);
      if (distance < 1.0) target = -c.axes * (0.4 * c.extents * glm::dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)));
      c.record[0] = glm::vec4(glm::vec3(distance < 1.0 ? target : d * z - target), c.record[0].w);
      in = {c.record, glm::vec4(glm::vec3(d), 0.0f)};
    }
    return ins;
  }

  Errors measure(const std::string& type, double distance, bool needle) {
    const std::vector<In> ins = aimed(type, distance, needle, 64 * 128);
    const std::vector<Out> outs = cast(type, ins);
    const reference::Shape& shape = *reference::find_shape(type);
    Errors e;
    for (std::size_t i = 0; i < outs.size(); ++i) {
      const glm::dvec3 d(ins[i].direction);
      const reference::Particle p{glm::dvec3(ins[i].record[0]), double(ins[i].record[0].w), ins[i].record};
      const auto exact = shape.intersect(p, {glm::dvec3(0), d});
      bool sure = true; // 1e-3 pixels aside the same is met, where the particle is 10 pixels wide or the focal length 1000
      const double aside_by = 1e-3 / std::max(1000.0, 10.0 * distance);
      for (const glm::dvec3& aside : {glm::dvec3(aside_by, 0, 0), glm::dvec3(-aside_by, 0, 0), glm::dvec3(0, aside_by, 0), glm::dvec3(0, -aside_by, 0)})
        sure = sure && shape.intersect(p, {glm::dvec3(0), d + aside}).has_value() == exact.has_value();
      e.ambiguous += !sure;
      if (!sure) continue;
      if ((outs[i].hit.x > 0.0f) != exact.has_value()) {
        if (e.wrong++ == 0)
          fmt::print("{} distance {} needle {}: ray {} {} {} center {} {} {}\n", type, distance, needle, d.x, d.y, d.z, p.center.x, p.center.y, p.center.z);
        continue;
      }
      if (!exact) continue;
      ++e.hits;
      for (const bool exit : {false, true}) {
        const double t = exit ? exact->t_out : exact->t_in;
        if (t <= 0.0) continue;
        const double off = std::abs(double(exit ? outs[i].hit.z : outs[i].hit.y) - t);
        const bool inner = exit ? exact->inner_out : exact->inner_in; // no surface, so no normal
        if (!(near_eye && inner)) e.depth.push_back(off / t);
        e.by_size.push_back(off / p.radius);
        const glm::dvec3 n = shape.normal(p, {glm::dvec3(0), d}, exit);
        const double error = angle(glm::dvec3(exit ? outs[i].n_out : outs[i].n_in), n);
        if (!inner && std::abs(glm::dot(n, glm::normalize(d))) > 0.14) e.normal.push_back(error); // a sphere's rays to 0.99 radii
        break;
      }
    }
    return e;
  }

  struct Bar {
    double normal{5e-7};   // 99th percentile to 1e4 sizes
    double distant{5e-7};  // to 1e6; the issue's bar is 2e-5
    double needle{};       // of needles
    double depth{2.5e-7};
  };
  void check_type(const std::string& type, const Bar& bar) {
    for (const bool needle : {false, true})
      for (const double distance : {0.0, 2.0, 1e2, 1e4, 1e6}) {
        if (needle && (distance > 2.0 || type == "sphere")) continue; // thinner than the band of ambiguous rays
        Errors e = measure(type, distance, needle);
        const double half = percentile(e.depth, 0.5), most = percentile(e.depth, 0.99), inside = percentile(e.by_size, 0.99);
        const double normal_half = percentile(e.normal, 0.5), normal = percentile(e.normal, 0.99);
        if (std::getenv("MOTE_MEASURE"))
          fmt::print("| {}{} | {:g} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", type, needle ? ", needles" : "", distance, e.hits, e.ambiguous, e.wrong, half,
                     most, normal_half, normal, inside);
        EXPECT_EQ(e.wrong, 0u) << type << " " << distance << " needle " << needle;
        EXPECT_GT(e.hits, 2000u) << type << " " << distance << " needle " << needle;
        EXPECT_LE(normal, needle ? bar.needle : distance > 1e4 ? bar.distant : bar.normal) << type << " " << distance << " needle " << needle;
        // From inside, the surface may be as near as one likes: there the bar counts in sizes.
        EXPECT_LE(distance < 1.0 ? inside : most, bar.depth) << type << " " << distance << " needle " << needle;
      }
  }
};

// What is drawn near the eye has depths to their own precision: from inside, where they are small against the particle, too.
TEST_F(Rays, NearTheEye) {
  near_eye = true;
  for (const std::string type : {"capsule", "polyline", "cylinder", "cone", "arrow"})
    for (const double distance : {0.0, 2.0, 30.0}) {
      Errors e = measure(type, distance, false);
      const double half = percentile(e.depth, 0.5), most = percentile(e.depth, 0.99);
      if (std::getenv("MOTE_MEASURE")) fmt::print("| {}, near | {:g} | {} | {:.1e} | {:.1e} | {:.1e} |\n", type, distance, e.hits, half, most, percentile(e.depth, 1.0));
      EXPECT_EQ(e.wrong, 0u) << type << " " << distance;
      EXPECT_GT(e.hits, 2000u) << type << " " << distance;
      EXPECT_LE(half, 4e-8) << type << " " << distance;
      EXPECT_LE(most, 1e-7) << type << " " << distance;
    }
}

TEST_F(Rays, Sphere) { check_type("sphere", {.distant = 2e-5}); }
TEST_F(Rays, Capsule) { check_type("capsule", {.needle = 1e-3}); }
TEST_F(Rays, Polyline) { check_type("polyline", {.needle = 1.2e-3}); }
TEST_F(Rays, Cylinder) { check_type("cylinder", {.needle = 1e-3}); }
TEST_F(Rays, OpenCylinder) {
  open = true;
  check_type("cylinder", {.needle = 1e-3});
}
TEST_F(Rays, Cone) { check_type("cone", {.needle = 1e-3}); }
TEST_F(Rays, Arrow) { check_type("arrow", {.needle = 1e-3}); }
TEST_F(Rays, Ellipsoid) { check_type("ellipsoid", {.needle = 1e-5}); }
TEST_F(Rays, Box) { check_type("box", {.needle = 1e-6}); }
TEST_F(Rays, Superquadric) { check_type("superquadric", {.normal = 3e-6, .distant = 3e-6, .needle = 2e-2, .depth = 5e-7}); }

} // namespace
} // namespace mote::test
