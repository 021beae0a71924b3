// SPDX-License-Identifier: MIT
#include "passes/particles/user_type.hpp"

#include "passes/particles/particle_type.hpp"
#include "shaders/embedded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <map>

namespace mote::passes {
namespace {

constexpr std::uint32_t most_tried = 1024, rays_each = 64;
constexpr std::size_t most_types = 200;
constexpr std::size_t records_at_once = 1u << 20;

struct Known {
  UserType type{};
  std::string cache_directory{};
  std::map<std::string, std::vector<std::uint32_t>> spirv{}; // by key
};
std::deque<Known>& known_types() {
  static std::deque<Known> types;
  return types;
}
Known* find_known(std::string_view key) {
  for (Known& known : known_types())
    if (known.type.key == key) return &known;
  return nullptr;
}

// struct Shape and what makes one of the record's numbers.
std::string shape_text(const UserType& type) {
  std::string fields, values;
  std::size_t lengths = 0, others = 0;
  for (const UserAttribute& a : type.attributes) {
    fields += fmt::format("real {}; ", a.name);
    values += (values.empty() ? "" : ", ") + (a.length ? fmt::format("lengths[{}]", lengths++) : fmt::format("numbers[{}]", others++));
  }
  if (type.attributes.empty()) fields = "real none_; ", values = "real(0.0)";
  return fmt::format("struct Shape {{ {}}};\nShape shape_from(real3 lengths, real2 numbers) {{ return Shape({}); }}\n", fields, values);
}

std::vector<MadeText> texts_of(const UserType& type) {
  return {{"type.glsl", "#include \"particles/user/type.glsl\"\n"}, {"user_shape.glsl", shape_text(type), type.shader() + " (struct Shape)"}, {"user_type.glsl", type.glsl, type.shader()}};
}

// A key without its type, "affine/near/ordered/transparent.frag/mode2", as what shaders/CMakeLists.txt makes of its like.
struct Variant {
  std::string stage{};
  std::vector<gpu::ShaderDefine> defines{};
};
Variant variant_of(std::string key) {
  Variant out;
  const auto take = [&](std::string_view word, std::initializer_list<gpu::ShaderDefine> defines) {
    if (!key.starts_with(word)) return;
    key.erase(0, word.size());
    out.defines.insert(out.defines.end(), defines);
  };
  take("affine/", {{"AFFINE", "1"}});
  take("near/", {{"NEAR_EYE", "1"}});
  take("ordered/", {{"ORDERED", "1"}});
  if (key == "shadow/mask.frag") return {"shadow/mask_ids.frag", {}};
  const std::size_t end = key.find('/');
  const std::string file = key.substr(0, end), rest = end == std::string::npos ? "" : key.substr(end + 1);
  if (file == "tiles") { // place/8/int64
    const std::size_t first = rest.find('/'), second = rest.find('/', first + 1);
    const std::string lanes = rest.substr(first + 1, second - first - 1), words = rest.substr(second + 1);
    return {"particles/tiles/" + rest.substr(0, first) + ".comp", {{"TILES", "1"}, {"LANES", lanes}, {words == "int64" ? "INT64" : "INT32", "1"}}};
  }
  out.stage = (file.ends_with(".frag") ? "particles/phase/" : "particles/expand/") + file;
  if (rest.starts_with("aov")) out.defines.push_back({"AOV", rest.substr(3)});
  if (rest.starts_with("mode")) out.defines.insert(out.defines.end(), {{"MODE", rest.substr(4)}, {"ORDERED", "1"}});
  if (rest == "edges") out.defines.push_back({"EDGES", "1"});
  if (rest == "ids") out.defines.push_back({"SHADOW_IDS", "1"});
  return out;
}

// Does the type's text compile, alone and with what draws it (whose names it may have taken)? The compiler's first complaint has
// its line.
bool compiles(const UserType& type, const std::string& cache_directory, Diagnostics& diagnostics) {
  const std::array<std::pair<const char*, std::vector<gpu::ShaderDefine>>, 4> stages{{{"particles/user/measure.comp", {}}, {"particles/expand/vertex.vert", {}},
      {"particles/phase/opaque.frag", {{"AOV", "7"}}}, {"particles/tiles/cast.comp", {{"TILES", "1"}, {"LANES", "8"}, {"INT32", "1"}}}}};
  for (const char* function : {"bound", "hit", "surface", "inside"}) {
    const std::string name(function);
    if (type.glsl.find(name + "(") != std::string::npos || type.glsl.find(name + " (") != std::string::npos) continue;
    diagnostics.error("P022", {type.shader()}, fmt::format("the particle type '{}' has no function '{}'", type.name, name), {"type.glsl gives bound, hit, surface and inside"});
    return false;
  }
  try {
    for (const auto& [stage, defines] : stages) (void)compile_shader(stage, texts_of(type), cache_directory, defines);
    return true;
  } catch (const Failure& failure) {
    const Diagnostic& d = failure.diagnostic();
    const SourceLoc loc = d.loc.file == type.shader() ? d.loc : SourceLoc{type.shader()};
    diagnostics.error("P022", loc, fmt::format("the particle type '{}' does not compile", type.name), d.hints);
    return false;
  }
}

std::vector<std::byte> run(gpu::Device& device, const UserType& type, const std::string& path, std::span<const std::byte> given, std::size_t made,
                           std::array<std::uint32_t, 3> push) {
  const Known* known = find_known(type.key);
  const std::vector<std::uint32_t> spirv = compile_shader(path, texts_of(type), known ? known->cache_directory : "");
  const std::array places{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::ReadOnlyStorageBuffer},
                          gpu::BindGroupLayoutEntry{.binding = 1, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::StorageBuffer}};
  const gpu::BindGroupLayout group_layout = device.create_bind_group_layout({.label = path, .entries = places});
  const std::array layouts{&group_layout};
  const gpu::PipelineLayout layout = device.create_pipeline_layout({.label = path, .bind_group_layouts = layouts, .push_constant_size = sizeof push});
  const gpu::ShaderModule module = device.create_shader_module({.label = path, .spirv = spirv});
  const gpu::ComputePipeline pipeline = device.create_compute_pipeline({.label = path, .layout = &layout, .compute = {.module = &module}});
  const gpu::Buffer in = device.create_buffer({.label = "given", .size = given.size(), .usage = gpu::BufferUsage::Storage, .contents = given});
  const gpu::Buffer out = device.create_buffer({.label = "found", .size = made, .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopySrc});
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&in}}, gpu::BindGroupEntry{.binding = 1, .buffer = {&out}}};
  const gpu::BindGroup group = device.create_bind_group({.label = path, .layout = &group_layout, .entries = entries});
  gpu::CommandEncoder encoder = device.create_command_encoder(path);
  gpu::ComputePass pass = encoder.begin_compute_pass({.label = path});
  pass.set_pipeline(pipeline);
  pass.set_bind_group(0, group);
  pass.set_push_constants(0, std::as_bytes(std::span(push)));
  pass.dispatch((push[0] + 63) / 64);
  pass.end();
  device.queue().submit(encoder.finish());
  return device.read_buffer(out);
}

} // namespace

bool take_type(UserType& type, const std::string& cache_directory, Diagnostics& diagnostics) {
  const auto same_attribute = [](const UserAttribute& a, const UserAttribute& b) { return a.name == b.name && a.length == b.length; };
  std::size_t namesakes = 0;
  for (const Known& known : known_types()) {
    namesakes += known.type.name == type.name;
    if (known.type.name != type.name || known.type.glsl != type.glsl || !std::equal(known.type.attributes.begin(), known.type.attributes.end(), type.attributes.begin(), type.attributes.end(), same_attribute)) continue;
    type.key = known.type.key;
    return true;
  }
  type.key = namesakes == 0 ? type.name : fmt::format("{}#{}", type.name, namesakes + 1);
  if (!compiles(type, cache_directory, diagnostics)) return false;
  if (known_types().size() >= most_types) {
    diagnostics.error("P022", type.loc, fmt::format("more than {} particle types from files", most_types));
    return false;
  }
  known_types().push_back({type, cache_directory, {}});
  known_types().back().type.measure = nullptr;
  const ParticleType& like = *find_particle_type("superquadric"); // the same record, the same abilities
  add_particle_type({type.key, type.summary, user_record_vec4s, like.vec4s_per_payload, false, like.expansions, like.phases});
  return true;
}

std::span<const std::uint32_t> particle_spirv(const std::string& key) {
  if (const auto shipped = shaders::spirv(key); !shipped.empty()) return shipped;
  const std::size_t end = key.find('/');
  Known* known = find_known(key.substr(0, end));
  if (!known || end == std::string::npos) return {};
  std::vector<std::uint32_t>& words = known->spirv[key];
  if (words.empty()) {
    const Variant variant = variant_of(key.substr(end + 1));
    words = compile_shader(variant.stage, texts_of(known->type), known->cache_directory, variant.defines);
  }
  return words;
}

std::vector<MadeText> type_texts(const std::string& type) {
  if (const Known* known = find_known(type)) return texts_of(known->type);
  return {{"type.glsl", std::string(shaders::text(fmt::format("particles/{}/type.glsl", type)))}};
}

std::vector<MeasuredParticle> measure(gpu::Device device, const UserType& type, std::span<const glm::vec4> records) {
  constexpr std::size_t each = user_record_vec4s - 1;
  const std::size_t count = records.size() / each;
  const auto stride = static_cast<std::uint32_t>((count + most_tried - 1) / most_tried);
  std::vector<MeasuredParticle> out(count);
  for (std::size_t first = 0; first < count; first += records_at_once) {
    const std::size_t part = std::min(records_at_once, count - first);
    const std::vector<std::byte> bytes = run(device, type, "particles/user/measure.comp", std::as_bytes(records.subspan(first * each, part * each)), part * 2 * sizeof(glm::vec4),
                                             {static_cast<std::uint32_t>(part), stride, rays_each});
    std::vector<glm::vec4> found(part * 2);
    std::memcpy(found.data(), bytes.data(), std::min(bytes.size(), found.size() * sizeof(glm::vec4)));
    const auto whole = [](float x) { return static_cast<std::uint32_t>(x); };
    for (std::size_t i = 0; i < part; ++i)
      out[first + i] = {glm::vec3(found[2 * i]), whole(found[2 * i].w), whole(found[2 * i + 1].x), whole(found[2 * i + 1].y), whole(found[2 * i + 1].z)};
  }
  return out;
}

std::vector<TwinHit> cast_in_double(gpu::Device device, const UserType& type, std::span<const TwinRay> rays) {
  static_assert(sizeof(TwinRay) == 11 * sizeof(double));
  if (rays.empty()) return {};
  const std::vector<std::byte> bytes = run(device, type, "particles/user/cast.comp", std::as_bytes(rays), rays.size() * 9 * sizeof(double), {static_cast<std::uint32_t>(rays.size()), 1, 0});
  std::vector<double> found(rays.size() * 9);
  std::memcpy(found.data(), bytes.data(), std::min(bytes.size(), found.size() * sizeof(double)));
  std::vector<TwinHit> out(rays.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double* f = &found[9 * i];
    out[i] = {f[0] != 0.0, f[1], f[2], glm::normalize(glm::dvec3(f[3], f[4], f[5])), glm::normalize(glm::dvec3(f[6], f[7], f[8]))};
  }
  return out;
}

} // namespace mote::passes
