// SPDX-License-Identifier: MIT
#include "core/scene/realize.hpp"

#include "core/data/series.hpp"
#include "core/scene/bond_sticks.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/drawable.hpp"
#include "core/scene/expression.hpp"
#include "core/scene/instances.hpp"
#include "core/scene/particle_values.hpp"
#include "core/scene/scene_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mote {
namespace {

constexpr std::uint64_t most_rows = 0xFFFFFFFEu;

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::shared_ptr<const data::Frame> generated_frame(const GeneratedName& name) {
  GeneratedParticles made = generate(name);
  auto frame = std::make_shared<data::Frame>();
  frame->count = name.count;
  frame->columns.push_back({"position", 3, std::move(made.positions), ""});
  frame->columns.push_back({"radius", 1, std::move(made.radii), ""});
  if (!made.ends.empty()) frame->columns.push_back({"end", 3, std::move(made.ends), ""});
  return frame;
}

// Radii by the scene's rule; none where neither it nor the file says any and a type other than sphere has its own default.
std::vector<double> radii_of(const FrameContext& context, const DataDesc& desc, GlyphMaker make, Diagnostics& diagnostics) {
  if (make && desc.radius.rule == RadiusRule::Auto && !context.frame.find("radius")) return {};
  if (desc.style == MoleculeStyle::Licorice && desc.radius_by_style)
    return std::vector<double>(context.frame.count, desc.bond_radius.value_or(usual_bond_radius(context.frame, desc.style)));
  std::vector<double> radii = particle_radii(context, desc.radius, diagnostics);
  if (desc.style == MoleculeStyle::BallAndStick && desc.radius_by_style)
    for (double& r : radii) r *= ball_of_atom;
  return radii;
}

// The largest reach of a particle from its row's position.
double largest_reach(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics) {
  const GlyphMaker make = maker_of(desc);
  const std::vector<double> radii = radii_of(context, desc, make, diagnostics);
  double reach = 0.0;
  if (!make) {
    for (const double r : radii)
      if (r <= largest_coordinate) reach = std::max(reach, r);
    return reach;
  }
  const Glyphs glyphs = make(context, desc, radii, diagnostics);
  const data::Column& position = *context.frame.find("position");
  for (std::uint64_t row = 0; row < glyphs.bounds.size(); ++row) {
    const glm::dvec3 p(position.number(row, 0), position.number(row, 1), position.number(row, 2));
    const double r = glm::length(glyphs.centers[row] - p) + glyphs.bounds[row];
    if (glyphs.verdicts[row] == Verdict::Draw && r <= largest_coordinate) reach = std::max(reach, r);
  }
  return reach;
}

// One batch for each group of rows that has copies of its own; one where nothing is copied.
std::vector<Batch> make_batches(const DataDesc& desc, const FrameContext& context, Annotations& annotations, SceneSource::Preparing& preparing,
                                Diagnostics& diagnostics) {
  const auto start = std::chrono::steady_clock::now();
  const data::Frame& frame = context.frame;
  if (frame.count > most_rows) {
    diagnostics.error(code::too_many_particles, context.contents,
                      fmt::format("the file has {} particles; a data set can have {}", frame.count, most_rows));
    return {};
  }
  const GlyphMaker make = maker_of(desc);
  std::vector<double> radii = radii_of(context, desc, make, diagnostics);
  ParticleColors colors = particle_colors(context, desc.color, desc.generated.has_value(), diagnostics);
  apply_opacity(context, desc.opacity, colors, diagnostics);
  const std::vector<Copies> groups = copies_of(frame, desc.assembly, context.name, diagnostics);
  const std::vector<glm::dmat4> replicas = replicas_of(desc, frame, context.name, diagnostics);
  std::optional<Glyphs> glyphs;
  if (make && !diagnostics.has_errors()) glyphs = make(context, desc, radii, diagnostics);
  if ((!make && radii.size() != frame.count) || diagnostics.has_errors()) return {};
  const std::string type = glyphs ? glyphs->type : desc.type;
  const std::vector<std::uint32_t> atom_colors = desc.style == MoleculeStyle::None ? std::vector<std::uint32_t>() : colors.packed;
  const Drawable drawable = glyphs ? choose(context, std::move(*glyphs), radii, std::move(colors.packed), diagnostics)
                                   : choose(context, std::move(radii), std::move(colors.packed), diagnostics);
  if (!context.rows.empty() && drawable.rows.empty() && frame.count > 0)
    diagnostics.warning(code::selection_empty, desc.select->loc, fmt::format("the selection '{}' leaves none of {} particles", desc.select->value, frame.count));
  if (colors.key && std::find(annotations.keys.begin(), annotations.keys.end(), *colors.key) == annotations.keys.end())
    annotations.keys.push_back(std::move(*colors.key));
  std::vector<Batch> batches;
  preparing.values += ms_since(start);
  const auto add = [&](const std::string& shape, const Drawable& drawn, const Copies& group, std::uint64_t rows) {
    const auto begin = std::chrono::steady_clock::now();
    std::shared_ptr<const ChunkSet> chunks = chunks_of(drawn);
    preparing.chunks += ms_since(begin);
    batches.push_back({.name = context.name, .type = shape, .chunks = std::move(chunks), .instances = instances_of(desc, replicas, group.transforms),
                       .material = desc.material, .color = colors.constant, .alpha = desc.alpha, .density = desc.density, .row_count = rows,
                       .group = static_cast<std::uint32_t>(&group - groups.data())});
  };
  for (const Copies& group : groups) add(type, group.rows.empty() ? drawable : subset(drawable, group.rows), group, frame.count);
  if (desc.style != MoleculeStyle::BallAndStick && desc.style != MoleculeStyle::Licorice) return batches;
  const data::Bonds bonds = drawn_bonds(context, desc, diagnostics);
  const double radius = desc.bond_radius.value_or(usual_bond_radius(frame, desc.style));
  const bool open = desc.alpha < 1.0 || desc.opacity.rule != AlphaRule::Constant; // no discs inside of what one looks through
  for (const Copies& group : groups)
    if (const Drawable sticks = bond_sticks(frame, bonds, group.rows, atom_colors, radius, open); !sticks.rows.empty())
      add("cylinder", sticks, group, bonds.rows.size());
  return batches;
}

void annotate(const DataDesc& desc, const data::Frame& frame, Annotations& annotations, Diagnostics& diagnostics) {
  const data::Column* position = frame.find("position");
  if (annotations.length_unit.empty() && position) annotations.length_unit = position->unit;
  if (annotations.time.empty() && frame.time) {
    std::string unit;
    for (const auto& [name, value] : frame.properties)
      if (name == "time_unit") unit = " " + value;
    annotations.time = fmt::format("t = {:.6g}{}", *frame.time, unit);
  } else if (annotations.time.empty() && frame.step) {
    annotations.time = fmt::format("step {}", *frame.step);
  }
  if (!desc.cell.drawn) return;
  if (!frame.box) {
    diagnostics.error(code::no_cell, desc.loc, fmt::format("{} has no cell to draw", desc.file.value.string()));
    return;
  }
  annotations.cells.push_back(*cell_of(desc, frame));
}

class Realizer {
public:
  Realizer(const SceneDesc& desc, SceneSource& source, std::optional<std::uint64_t> index, Diagnostics& diagnostics)
      : desc_(desc), source_(source), index_(index), diagnostics_(diagnostics) {
    Annotations& a = scene_.annotations;
    a.place = desc.legend.place;
    a.size = desc.legend.size;
    a.length_unit = desc.legend.unit.value_or("");
  }

  Scene run(Size2d size) {
    scene_.background = desc_.background;
    scene_.ambient = desc_.ambient;
    scene_.lights = desc_.lights;
    for (std::size_t i = 0; i < desc_.data.size(); ++i) add(i);
    Annotations& a = scene_.annotations;
    if (!desc_.legend.shown) a.keys.clear();
    // Bar and time go with a legend, the time with series only; either is there when it is asked for.
    a.scale_bar = desc_.legend.scale_bar.value_or(!a.keys.empty());
    if (!desc_.legend.time.value_or(index_ && !a.keys.empty())) a.time.clear();
    scene_.camera = complete_camera(desc_.camera, scene_.bounds, size);
    if (const std::string problem = check(scene_.camera); !problem.empty() && !diagnostics_.has_errors())
      diagnostics_.error(code::scene_camera, desc_.camera.loc, "the camera cannot see: " + problem);
    return std::move(scene_);
  }

private:
  FrameContext context(std::size_t i, const data::Frame& frame) {
    const DataDesc& data = desc_.data[i];
    FrameContext out{.frame = frame};
    out.name = data.generated ? desc_.name : data.file.value.string();
    out.contents.file = out.name;
    out.folder = desc_.folder;
    if (!data.generated) out.rows = source_.selected(i, frame, diagnostics_);
    else if (data.select) out.rows = select_rows(data.select->value, frame, data.select->loc, diagnostics_);
    out.series = index_ ? source_.series(i, diagnostics_) : nullptr;
    return out;
  }

  void add(std::size_t i) {
    const DataDesc& data = desc_.data[i];
    const std::shared_ptr<const data::Frame> frame = data.generated ? generated_frame(*data.generated) : source_.frame(i, index_, diagnostics_);
    if (!frame) return;
    FrameContext context = this->context(i, *frame);
    if (data.select && context.rows.empty() && diagnostics_.has_errors()) return;
    annotate(data, *frame, scene_.annotations, diagnostics_);
    const bool over_series = context.series != nullptr;
    if (over_series) {
      add_series_bounds(i);
      if (const auto& reach = source_.reach(i)) context.usual_radius = reach->radius;
    }
    for (Batch& batch : make_batches(data, context, scene_.annotations, source_.preparing, diagnostics_)) {
      batch.id_base = scene_.particle_count();
      batch.data = static_cast<std::uint32_t>(i);
      if (!over_series)
        for (const Instance& instance : batch.instances) scene_.bounds.add(world_bounds(*batch.chunks, instance.world_from_data));
      scene_.batches.push_back(std::move(batch));
    }
  }

  // The box of a whole series, the same in all its pictures: centers of some frames, radii and copies of frame 0.
  void add_series_bounds(std::size_t i) {
    const DataDesc& data = desc_.data[i];
    std::optional<SceneSource::Reach>& reach = source_.reach(i);
    const Bounds centers = source_.series_centers(i, diagnostics_);
    if (!reach) {
      const auto first = source_.frame(i, 0, diagnostics_);
      if (!first) return;
      const FrameContext context = this->context(i, *first);
      reach.emplace();
      Diagnostics ignored; // what is wrong is told for the frame that is drawn
      reach->radius = largest_reach(context, data, ignored);
      for (const Copies& copies : copies_of(*first, data.assembly, context.name, ignored))
        for (const Instance& instance : instances_of(data, replicas_of(data, *first, context.name, ignored), copies.transforms))
          reach->transforms.push_back(instance.world_from_data);
    }
    Bounds grown;
    if (!centers.empty()) {
      grown.add(centers.min, reach->radius);
      grown.add(centers.max, reach->radius);
    }
    for (const glm::dmat4& m : reach->transforms) scene_.bounds.add(moved(grown, m));
  }

  const SceneDesc& desc_;
  SceneSource& source_;
  std::optional<std::uint64_t> index_;
  Diagnostics& diagnostics_;
  Scene scene_{};
};

} // namespace

Scene realize(const SceneDesc& desc, Size2d size, SceneSource& source, std::optional<std::uint64_t> index, Diagnostics& diagnostics) {
  return Realizer(desc, source, index, diagnostics).run(size);
}

Scene realize(const SceneDesc& desc, Size2d size, Diagnostics& diagnostics) {
  SceneSource source(desc);
  std::optional<std::uint64_t> index;
  if (desc.frame) {
    const std::uint64_t count = source.frame_count(diagnostics);
    if (count == 0) return {};
    try {
      index = data::frame_index(desc.frame->value, count, desc.frame->loc);
    } catch (const Failure& failure) {
      diagnostics.add(failure.diagnostic());
      return {};
    }
  }
  return realize(desc, size, source, index, diagnostics);
}

} // namespace mote
