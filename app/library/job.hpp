// SPDX-License-Identifier: MIT
// From the words of a user (files, a scene, a generated name; settings; a size) to what a frame needs:
// the scene, the view of it and the graph. Shared by all commands and the library. Reads files, touches
// no device but to measure particles of types from files. Says what the scene asks for and this version does not draw.
#pragma once

#include "app/library/device.hpp"
#include "app/library/graphs.hpp"
#include "core/scene/realize.hpp"
#include "core/scene/scene_source.hpp"

namespace mote::app {

struct JobRequest {
  std::vector<std::string> words{};      // one scene, one generated name, or data files
  std::vector<std::string> settings{};   // "path=value": of the scene or of the graph
  std::vector<std::string> types{};      // folders of particle types, besides those that the scene names
  DeviceOptions device{};                // that measures their particles
  std::optional<std::string> graph{};    // --graph; else the scene's, else "default"
  std::optional<std::int64_t> frame{};   // --frame; else the scene's
  std::optional<std::string> frames{};   // --frames: many pictures
  Size2d size{1280, 720};
  bool transparent{};                    // background of alpha 0
  std::vector<Aov> aovs{};
  bool every_aov{};                      // as in GraphRequest
  std::vector<rg::LocatedString> dumps{};
  bool linear{}, deep{};                 // as in GraphRequest
};

struct Job {
  SceneDesc desc{};
  std::shared_ptr<SceneSource> source{}; // the files, still open
  std::vector<std::uint64_t> frames{};   // that are asked for; empty: one picture
  std::optional<std::uint64_t> frame{};  // that `scene` shows; nothing: the first, alone
  Scene scene{};                         // with `frames`: empty until load_frame()
  bool transparent{};
  GraphRequest graph{};
  Size2d size{};
  Diagnostics left_out{};                // broken types from files, whose data sets are not in the scene; errors
  [[nodiscard]] View view() const { return view_of(scene.camera); }
  [[nodiscard]] View view_of(const Camera& camera) const { return make_view(camera, size, scene.bounds.diagonal()); }
};

// With errors in `diagnostics` the job must not be run. Where no graph is named and a particle is transparent, the graph
// is "transparent".
Job load_job(const JobRequest& request, Diagnostics& diagnostics);
// What the scene asks for and the graph does not draw (A020).
void warn_of_graph(const Job& job, const ReadyGraph& graph, Diagnostics& diagnostics);
// Frame `index` of the series into job.scene. With errors the scene must not be drawn.
void load_frame(Job& job, std::uint64_t index, Diagnostics& diagnostics);
// Overrides of the scene alone, for describe() and parse_scene().
std::vector<std::string> scene_settings(const JobRequest& request);
// The particles of a generated scene or of files; the scene's own description otherwise. Throws as describe() does.
SceneDesc describe_job(const JobRequest& request, Diagnostics& diagnostics, GraphRequest& graph);

// The exit status that errors call for: Usage where all of them come from the command line, else BadInput.
Exit exit_of(const Diagnostics& diagnostics);

} // namespace mote::app
