// SPDX-License-Identifier: MIT
// mote info: what is in a particle file (or in each data set of a scene): particles, frames, box, columns.
#include "app/commands/command.hpp"
#include "core/data/series.hpp"
#include "core/scene/assembly.hpp"
#include "core/scene/attributes.hpp"
#include "core/scene/scene_source.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>

namespace mote::app {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  std::vector<std::string> words{}, types{};
  std::optional<std::int64_t> frame{};
  bool json{};
};

struct Range {
  double min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
  void add(double value) {
    if (!std::isfinite(value)) return;
    min = std::min(min, value);
    max = std::max(max, value);
  }
  [[nodiscard]] bool empty() const { return !(min <= max); }
};

std::vector<Range> ranges_of(const data::Column& column, std::uint64_t rows) {
  std::vector<Range> ranges(column.components);
  if (column.type() == data::ColumnType::Text) return ranges;
  for (std::uint64_t row = 0; row < rows; ++row)
    for (std::uint32_t k = 0; k < column.components; ++k) ranges[k].add(column.number(row, k));
  return ranges;
}

// A number, an array where there are several components, null where there is no finite value.
Json ends_json(const std::vector<Range>& ranges, double Range::*end) {
  Json values = Json::array();
  for (const Range& range : ranges) values.push_back(range.empty() ? Json(nullptr) : Json(range.*end));
  return values.size() == 1 ? values[0] : values;
}

struct FileInfo {
  std::string name{}, format{};
  std::uint64_t frames{1};
  data::Frame frame{};
  std::uint64_t index{}; // of that frame
  std::uint64_t instances{1}; // copies of the unit in the assembly that is drawn
};

// The most copies that any part of the assembly has: 60 for a capsid of 60 units.
std::uint64_t count_instances(const data::Frame& frame, const std::optional<Located<std::string>>& assembly,
                              const std::string& name, Diagnostics& diagnostics) {
  std::uint64_t most = 1;
  for (const Copies& copies : copies_of(frame, assembly, name, diagnostics)) most = std::max<std::uint64_t>(most, copies.transforms.size());
  return most;
}

FileInfo read_file(const DataDesc& data, std::int64_t frame, Diagnostics& diagnostics) {
  const std::string name = data.file.value.string();
  const std::unique_ptr<data::Source> source = data::open_series(files_of(data));
  FileInfo info{name, std::string(source->format()), 1, {}};
  if (frame != 0) info.index = data::frame_index(frame, source->frame_count(), {"--frame"});
  info.frame = source->read(info.index);
  info.frames = source->frame_count();
  info.instances = count_instances(info.frame, data.assembly, name, diagnostics);
  diagnostics.append(source->warnings());
  return info;
}

FileInfo generated_info(const std::string& name, const GeneratedName& generated) {
  GeneratedParticles made = generate(generated);
  FileInfo info{name, "generated", 1, {}};
  info.frame.count = generated.count;
  info.frame.columns.push_back({"position", 3, std::move(made.positions), ""});
  info.frame.columns.push_back({"radius", 1, std::move(made.radii), ""});
  if (!made.ends.empty()) info.frame.columns.push_back({"end", 3, std::move(made.ends), ""});
  return info;
}

// Of the particles' positions; null for no particles.
Json bounds_json(const data::Frame& frame) {
  const data::Column* position = frame.find("position");
  if (!position) return nullptr;
  const std::vector<Range> ranges = ranges_of(*position, frame.count);
  Json bounds;
  bounds["min"] = ends_json(ranges, &Range::min);
  bounds["max"] = ends_json(ranges, &Range::max);
  return bounds;
}

Json json_of(const FileInfo& info) {
  Json json;
  json["count"] = info.frame.count;
  json["instances"] = info.instances;
  json["frames"] = info.frames;
  json["bounds"] = bounds_json(info.frame);
  json["attributes"] = Json::array();
  for (const data::Column& column : info.frame.columns) {
    const std::vector<Range> ranges = ranges_of(column, info.frame.count);
    Json attribute;
    attribute["name"] = column.name;
    attribute["type"] = data::to_string(column.type());
    attribute["components"] = column.components;
    attribute["min"] = ends_json(ranges, &Range::min);
    attribute["max"] = ends_json(ranges, &Range::max);
    json["attributes"].push_back(std::move(attribute));
  }
  return json;
}

void print_text(const FileInfo& info) {
  const data::Frame& frame = info.frame;
  fmt::print("{}: {}, {} particles, {} {}\n", info.name, info.format, frame.count, info.frames, info.frames == 1 ? "frame" : "frames");
  if (!frame.assemblies.empty()) {
    std::vector<std::string> names;
    for (const data::Assembly& assembly : frame.assemblies) names.push_back(assembly.name);
    fmt::print("  assemblies {}; {} copies in the one that is drawn\n", list_of(names), info.instances);
  }
  if (info.index) fmt::print("  frame {}\n", info.index);
  if (!frame.bonds.rows.empty()) fmt::print("  bonds {}\n", frame.bonds.rows.size());
  if (frame.time) fmt::print("  time {}\n", *frame.time);
  if (frame.step) fmt::print("  step {}\n", *frame.step);
  if (frame.box) {
    const glm::dmat3& e = frame.box->edges;
    fmt::print("  box  [{:g} {:g} {:g}] [{:g} {:g} {:g}] [{:g} {:g} {:g}], periodic {}{}{}\n", e[0].x, e[0].y, e[0].z, e[1].x, e[1].y, e[1].z,
               e[2].x, e[2].y, e[2].z, frame.box->periodic.x ? "x" : "-", frame.box->periodic.y ? "y" : "-", frame.box->periodic.z ? "z" : "-");
  }
  for (const data::Column& column : frame.columns) {
    std::string text;
    if (const auto* words = std::get_if<data::TextColumn>(&column.values)) {
      text = fmt::format("{} words: {}", words->dictionary.size(), list_of(std::span(words->dictionary).first(std::min<std::size_t>(8, words->dictionary.size()))));
    } else {
      for (const Range& range : ranges_of(column, frame.count))
        text += range.empty() ? "(none)  " : fmt::format("{:g} .. {:g}  ", range.min, range.max);
    }
    fmt::print("  {:<16}{:<8}{:>2}  {}{}\n", column.name, data::to_string(column.type()), column.components, text,
               column.unit.empty() ? "" : "[" + column.unit + "]");
  }
}

// What a type from a folder needs, and where the files have it.
void print_type(const UserType& type, const std::vector<FileInfo>& files) {
  fmt::print("type {} in {}: {}\n", type.name, type.folder.string(), type.summary);
  for (const UserAttribute& a : type.attributes) {
    std::string where;
    for (const FileInfo& file : files)
      if (find_attribute(file.frame, a.name)) where += (where.empty() ? "in " : ", ") + file.name;
    if (where.empty()) where = a.otherwise ? "in no file" : "in no file, and without a default: attributes = { " + a.name + " = ... } says it";
    fmt::print("  {:<16}{:<8}{}  {}\n", a.name, a.length ? "length" : "none", a.otherwise ? fmt::format("default {:g}", *a.otherwise) : "", where);
  }
}

// The files that the words name; of a scene those of its data sets.
std::vector<FileInfo> gather(const InfoArguments& a, std::vector<UserType>& kinds, Diagnostics& diagnostics) {
  std::vector<FileInfo> files;
  std::vector<std::string> types;
  for (const std::string& folder : a.types) types.push_back("particle_types+=" + std::filesystem::absolute(folder).lexically_normal().string());
  const SceneDesc desc = describe(a.words, types, diagnostics);
  for (const auto& type : desc.types) kinds.push_back(*type);
  const std::int64_t frame = a.frame ? *a.frame : desc.frame ? desc.frame->value : 0;
  if (diagnostics.has_errors()) return files;
  for (const DataDesc& data : desc.data)
    files.push_back(data.generated ? generated_info(desc.name, *data.generated) : read_file(data, frame, diagnostics));
  return files;
}

void run(const InfoArguments& a) {
  Diagnostics diagnostics;
  std::vector<UserType> kinds;
  const std::vector<FileInfo> files = gather(a, kinds, diagnostics);
  print_and_stop_on_errors(diagnostics);
  if (!a.json) {
    for (const FileInfo& file : files) print_text(file);
    for (const UserType& type : kinds) print_type(type, files);
    return;
  }
  Json all = Json::array();
  for (const FileInfo& file : files) all.push_back(json_of(file));
  fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(2, ' ', false, Json::error_handler_t::replace)); // names need not be UTF-8
}

} // namespace

void add_info(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("info", "what is in a particle file");
  auto a = std::make_shared<InfoArguments>();
  command->add_option("FILE", a->words, "particle files, a scene, or a generated name")->required();
  add_type_option(*command, a->types);
  command->add_option("--frame", a->frame, "frame of a series, from 0; -1 is the last")->type_name("N");
  command->add_flag("--json", a->json, "as JSON; an array when there are several files");
  command->callback([a, &exit] {
    run(*a);
    exit = Exit::Done;
  });
}

} // namespace mote::app
