// SPDX-License-Identifier: MIT
// Topic `mesh`: exact spheres against tessellated ones of several levels. mote has no pass for meshes; the triangles are drawn here,
// by a vertex stage that places one unit mesh at each sphere, with color, id and depth. Times of the mesh are those of that
// draw; times of the impostors include mote's display pass.
#include "app/charts/icosphere.hpp"
#include "app/charts/mesh_drawing.hpp"
#include "app/charts/scene_topic.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

constexpr std::uint64_t most_triangles = 6'000'000;

// Centers in view space and radii, and the id of each.
struct Spheres {
  std::vector<glm::vec4> placed{};
  std::vector<std::uint32_t> ids{};
};
Spheres place(const Scene& scene, const View& view) {
  Spheres out;
  for (const Batch& batch : scene.batches)
    for (std::size_t k = 0; k < batch.instances.size(); ++k) {
      const glm::dmat4& m = batch.instances[k].world_from_data;
      const double scale = similarity_scale(m).value_or(1.0);
      for (std::uint64_t record = 0; record < batch.chunks->record_count(); ++record) {
        const float r = batch.chunks->records[record * batch.chunks->vec4s_per_record].w;
        if (!(r > 0.0f) || batch.chunks->rows[record] == no_row) continue;
        out.placed.emplace_back(glm::vec3(view.to_view(glm::dvec3(m * glm::dvec4(batch.chunks->center(record), 1.0)))), static_cast<float>(r * scale));
        out.ids.push_back(static_cast<std::uint32_t>(batch.id_base + k * batch.row_count + batch.chunks->rows[record]));
      }
    }
  return out;
}

} // namespace

chart::Chart chart_mesh(TopicContext& context) {
  SceneTopic topic(context);
  chart::Chart c{.topic = "mesh", .title = "Exact spheres against triangles"};
  chart::Panel panel{"Pixels that show another particle than the reference", {"time a frame", "ms", true}, {"wrong pixels", "", true}, true, {}};
  ReferenceOptions options;
  options.normals = options.colors = false;
  const compare::CompareInput reference = input_of(render_reference(topic.job.scene, topic.view(), options));
  auto wrong = [&](const compare::CompareInput& drawn) { return static_cast<double>(compare::compare(drawn, reference).id->all()); };
  for (const passes::Expansion expansion : {passes::Expansion::Vertex, passes::Expansion::Compute}) {
    const Method method{.expansion = expansion};
    try {
      const double pixels = wrong(input_of(topic.picture(method, true), true));
      panel.series.push_back({fmt::format("impostors, {}", passes::to_string(expansion)), false, {{"", topic.milliseconds(method), pixels}}});
    } catch (const Failure& failure) {
      c.notes.push_back(failure.diagnostic().text);
    }
  }
  const Spheres spheres = place(topic.job.scene, topic.view());
  chart::Series meshes{"triangles, levels of an icosphere", true, {}};
  for (int level = 0; level <= 4; ++level) {
    const Icosphere mesh = icosphere(level);
    const std::uint64_t triangles = spheres.placed.size() * mesh.triangles.size() / 3;
    if (triangles > most_triangles) {
      c.notes.push_back(fmt::format("Level {} is left out: {} triangles.", level, triangles));
      break;
    }
    const DrawnMesh drawn = draw_meshes(context.device, spheres.placed, mesh, topic.view());
    compare::CompareInput input;
    input.width = drawn.size.width;
    input.height = drawn.size.height;
    for (const std::uint32_t index : drawn.index) input.id.push_back(index == compare::no_id ? index : spheres.ids[index]);
    compare::CompareInput ids_only = input;
    meshes.points.push_back({fmt::format("{} triangles", mesh.triangles.size() / 3), drawn.milliseconds, wrong(ids_only)});
    context.say(fmt::format("level {}", level));
  }
  panel.series.push_back(std::move(meshes));
  c.panels.push_back(std::move(panel));
  c.panels.push_back(sagitta_panel());
  c.notes.push_back(topic.text() + "; mote has no pass for meshes: triangles are drawn for this chart only, without the display pass.");
  return c;
}

} // namespace mote::app
