// SPDX-License-Identifier: MIT
#include "core/scene/scene_file.hpp"

#include "core/data/series.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <iterator>

namespace mote {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

constexpr std::int64_t schema_version = 1;
const SourceLoc command_line{"command line"};

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    fail(Exit::BadInput, code::scene_unreadable, {file.string()}, "is a folder, not a scene file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    const std::string why = std::filesystem::exists(file, error) ? "may not be read" : "does not exist";
    fail(Exit::BadInput, code::scene_unreadable, {file.string()}, fmt::format("the scene file {}", why));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

// "0.25px" -> 0.25
std::optional<Located<double>> read_tolerance(TableReader& top) {
  const Node* node = top.find("tolerance");
  const auto text = top.text("tolerance");
  if (!text) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  const bool number = error == std::errc{} && std::string_view(end, text->data() + text->size()) == "px";
  if (!number || !(value > 0.0 && value <= 1e6)) {
    top.diagnostics().error(code::scene_out_of_range, node->loc,
                            fmt::format("tolerance is '{}'; it takes a number of pixels above 0 like \"0.25px\"", *text));
    return std::nullopt;
  }
  return Located<double>{value, node->loc};
}

void check_schema(const Node& root, TableReader& top, const std::string& file) {
  if (root.find("pass"))
    fail(Exit::BadInput, code::scene_is_graph, root.find("pass")->loc, "this is a render graph (it has [[pass]]), not a scene",
         {fmt::format("Use it with a scene or data: mote render DATA --graph {}", file)});
  const Node* node = top.find("schema");
  if (!node) {
    top.diagnostics().error(code::scene_schema, {file}, "schema is missing", {"Write schema = 1 at the top of the file"});
    return;
  }
  const auto schema = top.integer("schema");
  if (schema && *schema != schema_version)
    top.diagnostics().error(code::scene_schema, node->loc,
                            fmt::format("the scene is of schema {}; this version reads schema {}", *schema, schema_version));
}

glm::dvec3 read_ambient(TableReader& top, bool inherited_linear) {
  const Node* node = top.table("ambient");
  if (!node) return glm::dvec3(0.2);
  TableReader reader(*node, "ambient", scene_parser::reader_codes, top.diagnostics());
  const bool linear = scene_parser::read_color_space(reader, inherited_linear);
  const auto color = scene_parser::read_color(reader, "color", linear);
  const double intensity = reader.number("intensity", config::not_negative).value_or(0.2);
  reader.finish();
  return color ? glm::dvec3(*color) * intensity : glm::dvec3(intensity);
}

// What a scene without [[light]] has, as a table of the file would say it, so that --set finds it by its name.
void add_default_light(Node& root) {
  if (root.find("light")) return;
  root.set("light", config::array_node({config::table_node({{"name", config::text_node("headlight")},
                                                            {"kind", config::text_node("headlight")},
                                                            {"intensity", config::number_node(0.8)}})}));
}

// A camera that is wrong whatever the data is found here; one that is completed from the data is checked later.
void check_early(const CameraDesc& c, Diagnostics& diagnostics) {
  if (!c.eye || !c.target) return;
  Camera camera{c.projection, *c.eye, *c.target, c.up.value_or(glm::dvec3(0, 0, 1))};
  camera.near = c.near;
  camera.far = c.far;
  if (!c.up) return; // the default up is chosen to fit
  if (const std::string problem = check(camera); !problem.empty())
    diagnostics.error(code::scene_camera, c.loc, "the camera cannot see: " + problem);
}

SceneDesc read_tree(const Node& root, const std::string& name, const std::filesystem::path& folder, bool needs_schema,
                    Diagnostics& diagnostics) {
  using namespace scene_parser;
  TableReader top(root, "", reader_codes, diagnostics);
  if (needs_schema) check_schema(root, top, name);
  SceneDesc scene;
  scene.name = name;
  scene.folder = folder;
  if (const auto graph = top.text("graph")) scene.graph = Located<std::string>{*graph, top.find("graph")->loc};
  const bool linear = read_color_space(top, false);
  scene.background = read_color(top, "background", linear, true).value_or(glm::dvec4(1));
  scene.tolerance = read_tolerance(top);
  if (const Node* camera = top.table("camera")) {
    scene.camera = read_camera(*camera, diagnostics);
    check_early(scene.camera, diagnostics);
  }
  scene.ambient = read_ambient(top, linear);
  scene.lights = read_lights(top.tables("light"), linear, diagnostics);
  if (const auto frame = top.integer("frame")) scene.frame = Located<std::int64_t>{*frame, top.find("frame")->loc};
  scene.legend = read_legend(top);
  scene.types = read_types(top, folder);
  const std::vector<const Node*> data = top.tables("data");
  for (std::size_t i = 0; i < data.size(); ++i) scene.data.push_back(read_data(*data[i], i, folder, linear, scene.types, diagnostics));
  if (!top.find("data")) diagnostics.error(code::scene_missing_key, {name}, "the scene has no [[data]]: there is nothing to draw");
  top.finish();
  diagnostics.sort_by_place();
  return scene;
}

constexpr std::string_view added_type = "particle_types+=";

void apply_overrides(Node& root, std::span<const std::string> overrides) {
  add_default_light(root);
  for (const std::string& assignment : overrides) {
    if (assignment.starts_with(added_type)) {
      Node* list = root.find("particle_types");
      if (!list) list = &root.set("particle_types", config::array_node({}, {"--type"}));
      list->items.push_back(config::text_node(assignment.substr(added_type.size()), {"--type"}));
      continue;
    }
    if (!assignment.starts_with("style=")) {
      config::apply_override(root, assignment, code::set_path);
      continue;
    }
    const Node* data = root.find("data"); // of every data set
    for (std::size_t i = 0; data && data->kind == Kind::Array && i < data->items.size(); ++i)
      config::apply_override(root, fmt::format("data[{}].{}", i, assignment), code::set_path);
  }
}

Node vec_node(const glm::dvec3& v) {
  return config::array_node({config::number_node(v.x), config::number_node(v.y), config::number_node(v.z)});
}

} // namespace

bool is_scene_path(const std::filesystem::path& path) {
  if (path.extension() != ".toml") return false;
  std::string head(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return !head.starts_with("mote_raw") && head.find("\nmote_raw") == std::string::npos;
}

SceneDesc parse_scene(std::string_view text, const std::string& file, const std::filesystem::path& folder,
                      std::span<const std::string> overrides, Diagnostics& diagnostics) {
  Node root = config::parse(text, file, code::scene_syntax);
  apply_overrides(root, overrides);
  SceneDesc scene = read_tree(root, file, folder, true, diagnostics);
  for (DataDesc& data : scene.data) { // a generated scene that was saved
    const std::string name = data.file.value.filename().string();
    std::error_code error;
    if (!is_generated_name(name) || std::filesystem::exists(data.file.value, error)) continue;
    data.generated = parse_generated_name(name);
    data.file.value.clear();
  }
  return scene;
}

SceneDesc read_scene(const std::filesystem::path& file, std::span<const std::string> overrides, Diagnostics& diagnostics) {
  return parse_scene(read_text(file), file.string(), file.parent_path(), overrides, diagnostics);
}

SceneDesc scene_of_files(std::span<const std::string> files, std::span<const std::string> overrides, Diagnostics& diagnostics) {
  Node root, list = config::array_node({}, command_line);
  std::string name;
  for (const std::string& file : files) {
    // The place is the file itself: messages about it read "spheres.npy: error ...".
    Node* last = list.items.empty() ? nullptr : &list.items.back();
    const bool moves = last && data::is_trajectory_name(file) && !data::is_trajectory_name(last->find("file")->text);
    if (!moves) { // a data set of its own
      list.items.push_back(config::table_node({{"file", config::text_node(file, {file})}}, {file}));
    } else if (Node* trajectory = last->find("trajectory")) {
      trajectory->items.push_back(config::text_node(file, {file}));
    } else {
      last->set("trajectory", config::array_node({config::text_node(file, {file})}, {file}));
    }
    name += (name.empty() ? "" : " ") + file;
  }
  root.set("data", std::move(list));
  apply_overrides(root, overrides);
  return read_tree(root, name, {}, false, diagnostics);
}

SceneDesc scene_by_name(std::string_view name, std::span<const std::string> overrides, Diagnostics& diagnostics) {
  const GeneratedName generated = parse_generated_name(name);
  const Camera camera = generated_camera(generated);
  Node root;
  Node data = config::table_node({{"file", config::text_node(name)}, {"type", config::text_node(particle_type_of(generated.kind))}});
  if (particle_type_of(generated.kind) != "sphere") data.set("end", config::text_node("end"));
  root.set("data", config::array_node({std::move(data)}));
  Node& table = root.set("camera", config::table_node({{"eye", vec_node(camera.eye)},
                                                       {"target", vec_node(camera.target)},
                                                       {"up", vec_node(camera.up)},
                                                       {"fov_y", config::number_node(camera.fov_y)}}));
  if (camera.near) table.set("near", config::number_node(*camera.near));
  apply_overrides(root, overrides);
  SceneDesc scene = read_tree(root, std::string(name), {}, false, diagnostics);
  if (!scene.data.empty() && scene.data[0].file.value == std::filesystem::path(name)) {
    scene.data[0].generated = generated;
    scene.data[0].file = {};
  }
  return scene;
}

SceneDesc describe(std::span<const std::string> words, std::span<const std::string> overrides, Diagnostics& diagnostics) {
  for (const std::string& word : words) {
    const bool alone = is_generated_name(word) || is_scene_path(word);
    if (alone && words.size() > 1)
      fail(Exit::Usage, code::scene_is_graph, {}, fmt::format("'{}' is a whole scene and cannot be combined with other files", word),
           {"Name one scene, or particle files, or one generated scene"});
  }
  if (words.size() == 1 && is_generated_name(words[0]) && !std::filesystem::exists(words[0]))
    return scene_by_name(words[0], overrides, diagnostics);
  if (words.size() == 1 && is_scene_path(words[0])) return read_scene(words[0], overrides, diagnostics);
  return scene_of_files(words, overrides, diagnostics);
}

} // namespace mote
