// SPDX-License-Identifier: MIT
#include "core/scene/realize.hpp"

#include "core/data/source.hpp"
#include "core/scene/assembly.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/particle_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace mote {
namespace {

constexpr double largest_coordinate = 1e30; // farther out, float32 in view space ends
constexpr std::uint64_t most_rows = 0xFFFFFFFEu;

std::shared_ptr<const data::Frame> generated_frame(const GeneratedName& name) {
  GeneratedSpheres spheres = generate_spheres(name.count, name.seed);
  auto frame = std::make_shared<data::Frame>();
  frame->count = name.count;
  frame->columns.push_back({"position", 3, std::move(spheres.positions), ""});
  frame->columns.push_back({"radius", 1, std::move(spheres.radii), ""});
  return frame;
}

std::shared_ptr<const data::Frame> read_frame(const Located<std::filesystem::path>& file, Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::exists(file.value, error)) {
    diagnostics.error(code::data_file_missing, file.loc, fmt::format("the data file '{}' does not exist", file.value.string()));
    return nullptr;
  }
  try {
    const std::unique_ptr<data::Source> source = data::open(file.value);
    auto frame = std::make_shared<data::Frame>(source->read(0));
    diagnostics.append(source->warnings());
    return frame;
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
    return nullptr;
  }
}

// What can be drawn of a frame: places in `centers` and the rest that belong together.
struct Drawable {
  std::vector<glm::dvec3> centers{};
  std::vector<double> radii{};
  std::vector<std::uint32_t> rows{}, colors{};
};

struct Skipped {
  std::uint64_t position{}, radius{}, zero{}, negative{};
  std::uint64_t negative_row{}; // the first one
  double negative_radius{};
};

enum class Verdict : std::uint8_t { Draw, Skip };
Verdict judge(const glm::dvec3& p, double r, std::uint64_t row, Skipped& skipped) {
  const bool placed = std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate && std::abs(p.z) <= largest_coordinate;
  if (r < 0.0) {
    if (skipped.negative++ == 0) {
      skipped.negative_row = row;
      skipped.negative_radius = r;
    }
  } else if (!placed) {
    ++skipped.position;
  } else if (!(r <= largest_coordinate)) {
    ++skipped.radius;
  } else if (static_cast<float>(r) == 0.0f) {
    ++skipped.zero;
  } else {
    return Verdict::Draw;
  }
  return Verdict::Skip;
}

Drawable choose(const data::Frame& frame, std::vector<double> radii, std::vector<std::uint32_t> colors, Skipped& skipped) {
  const data::Column& position = *frame.find("position");
  Drawable out;
  out.centers.resize(frame.count);
  out.rows.resize(frame.count);
  out.radii = std::move(radii);
  out.colors = std::move(colors);
  std::uint64_t kept = 0;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const glm::dvec3 p(position.number(row, 0), position.number(row, 1), position.number(row, 2));
    if (judge(p, out.radii[row], row, skipped) == Verdict::Skip) continue;
    out.centers[kept] = p;
    out.radii[kept] = out.radii[row];
    out.rows[kept] = static_cast<std::uint32_t>(row);
    if (!out.colors.empty()) out.colors[kept] = out.colors[row];
    ++kept;
  }
  out.centers.resize(kept);
  out.radii.resize(kept);
  out.rows.resize(kept);
  if (!out.colors.empty()) out.colors.resize(kept);
  return out;
}

void report(const Skipped& skipped, std::uint64_t count, const FrameOrigin& origin, Diagnostics& diagnostics) {
  if (skipped.negative) {
    const std::string more = skipped.negative > 1 ? fmt::format(", and {} more are negative", skipped.negative - 1) : "";
    diagnostics.error(code::radius_negative, origin.contents,
                      fmt::format("the radius of particle {} is '{}'{}", skipped.negative_row, skipped.negative_radius, more),
                      {"Particles are counted from 0 in the order of the file"});
  }
  if (skipped.position)
    diagnostics.warning(code::position_not_finite, origin.contents,
                        fmt::format("{} of {} particles have no finite position and are left out", skipped.position, count));
  if (skipped.radius)
    diagnostics.warning(code::radius_not_finite, origin.contents,
                        fmt::format("{} of {} particles have no finite radius and are left out", skipped.radius, count));
  if (skipped.zero)
    diagnostics.warning(code::radius_zero, origin.contents,
                        fmt::format("{} of {} particles have radius 0 and draw as nothing", skipped.zero, count));
}

Bounds world_bounds(const ChunkSet& set, const glm::dmat4& world_from_data) {
  Bounds out;
  if (world_from_data == glm::dmat4(1.0)) return set.bounds;
  for (const Chunk& chunk : set.chunks)
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(i & 1 ? chunk.box_max.x : chunk.box_min.x, i & 2 ? chunk.box_max.y : chunk.box_min.y,
                              i & 4 ? chunk.box_max.z : chunk.box_min.z);
      out.add(glm::dvec3(world_from_data * glm::dvec4(chunk.origin + corner, 1.0)));
    }
  return out;
}

// The particles that `rows` marks (all, when it is empty), in their order.
Drawable subset(const Drawable& all, const std::vector<bool>& rows) {
  Drawable out;
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    if (!rows[all.rows[i]]) continue;
    out.centers.push_back(all.centers[i]);
    out.radii.push_back(all.radii[i]);
    out.rows.push_back(all.rows[i]);
    if (!all.colors.empty()) out.colors.push_back(all.colors[i]);
  }
  return out;
}

std::shared_ptr<const ChunkSet> chunks_of(const Drawable& d) {
  return std::make_shared<ChunkSet>(build_spheres(d.centers, d.radii, d.rows, d.colors));
}

// One batch for each group of rows that has copies of its own; one where nothing is copied.
std::vector<Batch> make_batches(const DataDesc& desc, const data::Frame& frame, const FrameOrigin& origin, Diagnostics& diagnostics) {
  if (frame.count > most_rows) {
    diagnostics.error(code::too_many_particles, origin.contents,
                      fmt::format("the file has {} particles; a data set can have {}", frame.count, most_rows));
    return {};
  }
  std::vector<double> radii = particle_radii(frame, desc.radius, origin, diagnostics);
  ParticleColors colors = particle_colors(frame, desc.color, desc.generated.has_value(), origin, diagnostics);
  const std::vector<Copies> groups = copies_of(frame, desc.assembly, origin.name, diagnostics);
  if (radii.size() != frame.count || diagnostics.has_errors()) return {};
  Skipped skipped;
  const Drawable drawable = choose(frame, std::move(radii), std::move(colors.packed), skipped);
  report(skipped, frame.count, origin, diagnostics);
  std::vector<Batch> batches;
  for (const Copies& group : groups) {
    Batch batch;
    batch.name = origin.name;
    batch.type = desc.type;
    batch.chunks = chunks_of(group.rows.empty() ? drawable : subset(drawable, group.rows));
    for (const glm::dmat4& transform : group.transforms) batch.instances.push_back({desc.transform * transform});
    batch.material = desc.material;
    batch.color = colors.constant;
    batch.alpha = desc.alpha;
    batch.row_count = frame.count;
    batches.push_back(std::move(batch));
  }
  return batches;
}

} // namespace

Scene realize(const SceneDesc& desc, Size2d size, Diagnostics& diagnostics) {
  Scene scene;
  scene.background = desc.background;
  scene.ambient = desc.ambient;
  scene.lights = desc.lights;
  std::map<std::filesystem::path, std::shared_ptr<const data::Frame>> frames; // a file that is shown twice is read once
  for (const DataDesc& data : desc.data) {
    std::shared_ptr<const data::Frame> frame;
    FrameOrigin origin;
    origin.name = data.generated ? desc.name : data.file.value.string();
    origin.contents.file = origin.name;
    if (data.generated) {
      frame = generated_frame(*data.generated);
    } else {
      auto [entry, fresh] = frames.try_emplace(data.file.value);
      if (fresh) entry->second = read_frame(data.file, diagnostics);
      frame = entry->second;
    }
    if (!frame) continue;
    for (Batch& batch : make_batches(data, *frame, origin, diagnostics)) {
      batch.id_base = scene.particle_count();
      for (const Instance& instance : batch.instances) scene.bounds.add(world_bounds(*batch.chunks, instance.world_from_data));
      scene.batches.push_back(std::move(batch));
    }
  }
  scene.camera = complete_camera(desc.camera, scene.bounds, size);
  if (const std::string problem = check(scene.camera); !problem.empty() && !diagnostics.has_errors())
    diagnostics.error(code::scene_camera, desc.camera.loc, "the camera cannot see: " + problem);
  return scene;
}

} // namespace mote
