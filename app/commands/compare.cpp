// SPDX-License-Identifier: MIT
// mote compare: how far a picture is from another one, or from the reference of a scene.
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#include "app/library/provenance.hpp"
#include "app/library/reference_picture.hpp"
#include "core/compare/compare.hpp"
#include "core/compare/limits.hpp"
#include "core/compare/report.hpp"
#include "core/image/exr.hpp"
#include "core/image/npy.hpp"
#include "core/image/png.hpp"
#include "core/overlay/annotate.hpp"
#include "core/reference/reference.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

using compare::CompareInput;

struct CompareArguments {
  std::vector<std::string> pictures{};
  std::string reference{}, limits{}, difference{};
  std::vector<std::string> settings{};
  bool json{};
};

// What a picture says about its camera; empty: nothing.
std::string camera_of(const std::vector<std::pair<std::string, std::string>>& texts) {
  for (const auto& [key, value] : texts)
    if (key == "Camera") return value;
  return {};
}

CompareInput from_png(const std::string& path) {
  const PngPicture png = read_png(path);
  CompareInput out;
  out.width = png.width;
  out.height = png.height;
  out.camera = camera_of(png.text);
  out.color = png.rgba8.empty() ? compare::color_from_rgba16(png.rgba16) : compare::color_from_rgba8(png.rgba8);
  return out;
}

CompareInput from_exr(const std::string& path) {
  const ExrPicture exr = read_exr(path);
  CompareInput out;
  out.width = exr.width;
  out.height = exr.height;
  out.encoding = compare::Encoding::Linear;
  out.camera = camera_of(exr.attributes);
  auto plane = [&](const char* name) { return exr.find(name); };
  const std::size_t pixels = std::size_t{exr.width} * exr.height;
  if (const ExrChannel *r = plane("R"), *g = plane("G"), *b = plane("B"); r && g && b) {
    const ExrChannel* a = plane("A");
    for (std::size_t i = 0; i < pixels; ++i) out.color.emplace_back(r->floats[i], g->floats[i], b->floats[i], a ? a->floats[i] : 1.0f);
  }
  if (const ExrChannel* z = plane("Z")) out.depth.assign(z->floats.begin(), z->floats.end());
  if (const ExrChannel* id = plane("id")) out.id = id->uints;
  if (const ExrChannel *x = plane("normal.X"), *y = plane("normal.Y"), *z = plane("normal.Z"); x && y && z)
    for (std::size_t i = 0; i < pixels; ++i) out.normal.emplace_back(x->floats[i], y->floats[i], z->floats[i]);
  return out;
}

CompareInput from_npy(const std::string& path) {
  const NpyArray array = read_npy(path);
  CompareInput out;
  const bool flat = array.shape.size() == 2;
  const bool vectors = array.shape.size() == 3 && array.shape[2] == 3;
  if (flat || vectors) {
    out.height = static_cast<std::uint32_t>(array.shape[0]);
    out.width = static_cast<std::uint32_t>(array.shape[1]);
  }
  if (flat && array.type == "<u4") {
    out.id = array.values<std::uint32_t>();
  } else if (flat && array.type == "<f4") {
    const std::vector<float> depth = array.values<float>();
    out.depth.assign(depth.begin(), depth.end());
  } else if (flat && array.type == "<f8") {
    out.depth = array.values<double>();
  } else if (vectors && array.type == "<f4") {
    const std::vector<float> n = array.values<float>();
    for (std::size_t i = 0; i + 2 < n.size(); i += 3) out.normal.emplace_back(n[i], n[i + 1], n[i + 2]);
  } else {
    fail(Exit::BadInput, code::compare_input, {path}, fmt::format("an array of type {} with {} dimensions is no AOV", array.type, array.shape.size()),
         {"depth is float [h, w], id uint32 [h, w], normal float32 [h, w, 3]"});
  }
  return out;
}

void check_picture(const std::string& path) {
  if (path == "-" || file_kind(path) == FileKind::Unknown)
    fail(Exit::Usage, code::output_ending, {"command line"}, fmt::format("'{}' is no picture", path), {"Endings: .png, .exr, .npy"});
}

CompareInput read_picture(const std::string& path) {
  const FileKind kind = file_kind(path);
  CompareInput out = kind == FileKind::Png ? from_png(path) : kind == FileKind::Exr ? from_exr(path) : from_npy(path);
  out.name = path;
  return out;
}

// The reference of the scene, of the size of `like` and with what `like` has.
CompareInput reference_like(const CompareInput& like, const CompareArguments& a) {
  JobRequest request;
  request.words = {a.reference};
  request.settings = a.settings;
  request.size = {like.width, like.height};
  Diagnostics diagnostics;
  const Job job = load_job(request, diagnostics);
  print_and_stop_on_errors(diagnostics);
  ReferenceOptions options;
  options.normals = !like.normal.empty();
  options.colors = !like.color.empty();
  options.two_surfaces = !has_front_surfaces_only(job.graph);
  ReferencePicture traced = render_reference(job.scene, job.view(), options);
  CompareInput out;
  out.name = "the reference of " + a.reference;
  out.width = like.width;
  out.height = like.height;
  out.encoding = compare::Encoding::Linear;
  out.camera = camera_text(job.scene.camera);
  out.depth = std::move(traced.depth);
  out.id = std::move(traced.id);
  out.ambiguous = traced.layers_ambiguous.empty() ? std::move(traced.ambiguous) : std::move(traced.layers_ambiguous);
  out.projected_radius = std::move(traced.projected_radius);
  for (const glm::dvec3& n : traced.normal) out.normal.emplace_back(n);
  if (!job.scene.annotations.empty() && !traced.color.empty()) { // the picture has them as well
    const std::vector<float> depth(traced.depth.begin(), traced.depth.end());
    overlay::lay_over_linear(overlay::draw_annotations(job.scene, job.view(), depth), traced.color);
  }
  for (const glm::dvec4& c : traced.color) out.color.emplace_back(c);
  return out;
}

void save_difference(const std::string& path, const CompareInput& x, const CompareInput& y) {
  const std::vector<std::uint8_t> rgba = compare::difference_picture(x, y);
  const Uninterrupted guard;
  write_png(path, x.width, x.height, std::span<const std::uint8_t>(rgba));
}

Exit run(const CompareArguments& a) {
  const std::size_t wanted = a.reference.empty() ? 2 : 1;
  if (a.pictures.size() != wanted)
    fail(Exit::Usage, code::command_line, {}, fmt::format("compare takes {}, not {} pictures", wanted == 2 ? "two pictures" : "one picture and --reference", a.pictures.size()),
         {"mote compare A B, or mote compare A --reference SCENE"});
  if (!a.difference.empty() && file_kind(a.difference) != FileKind::Png)
    fail(Exit::Usage, code::output_ending, {"--difference"}, fmt::format("'{}' is no .png", a.difference));
  for (const std::string& path : a.pictures) check_picture(path);
  Diagnostics problems;
  const compare::Limits limits = compare::parse_limits(a.limits, problems);
  if (problems.has_errors()) {
    print(problems);
    return Exit::Usage;
  }
  const CompareInput x = read_picture(a.pictures[0]);
  const CompareInput y = a.reference.empty() ? read_picture(a.pictures[1]) : reference_like(x, a);
  const compare::CompareResult result = compare::compare(x, y);
  const compare::Verdict verdict = compare::judge(result, limits, problems);
  print(problems);
  if (problems.has_errors()) return Exit::Usage;
  fmt::print("{}", a.json ? compare::report_json(result, verdict) + "\n" : compare::report_text(result, verdict));
  if (!a.difference.empty()) save_difference(a.difference, x, y);
  return verdict.equal ? Exit::Done : Exit::Failed;
}

std::string limits_help() {
  std::string names;
  for (const compare::Measure& measure : compare::measures()) names += (names.empty() ? "" : ", ") + std::string(measure.name);
  return "largest values that count as equal, like id=0,rms=1; measures: " + names;
}

} // namespace

void add_compare(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("compare", "measure how two pictures differ; exit status 0: equal within the limits, 1: not");
  auto a = std::make_shared<CompareArguments>();
  command->add_option("PICTURE", a->pictures, "two pictures (.png, .exr, .npy), or one with --reference")->required();
  command->add_option("--reference", a->reference, "compare with the double-precision reference of this scene")->type_name("SCENE");
  command->add_option("--set", a->settings, "change a value of that scene")->allow_extra_args(false)->type_name("PATH=VALUE");
  command->add_option("--limits", a->limits, limits_help())->type_name("NAME=NUMBER,...");
  command->add_option("--difference", a->difference, "a picture of the differences")->type_name("FILE.png");
  command->add_flag("--json", a->json, "as JSON");
  command->callback([a, &exit] { exit = run(*a); });
}

} // namespace mote::app
