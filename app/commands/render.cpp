// SPDX-License-Identifier: MIT
// mote render: one picture or one for each of many frames, their AOVs and whatever else of the graph is asked for,
// into files; or a movie.
#include "app/codes.hpp"
#include "app/commands/command.hpp"
#include "app/library/annotated.hpp"
#include "app/library/movie.hpp"
#include "app/library/panels.hpp"
#include "app/library/provenance.hpp"
#include "app/library/reference_picture.hpp"
#include "app/library/sequence.hpp"
#include "app/library/smoothing.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <future>

namespace mote::app {
namespace {

struct RenderArguments {
  SceneArguments scene{};
  DeviceArguments device{};
  std::string output{};
  std::vector<std::string> aovs{}, dumps{};
  bool reference{}, transparent{}, skip_existing{}, stats{};
  std::string frames{}, shard{};
  std::optional<std::int64_t> frame{};
  double rate{25.0}; // frames a second of a movie
  int bits{8};
  std::uint32_t panel{};
  Smoothing smoothing{};
};

// What goes where.
struct Outputs {
  std::string picture{};
  std::vector<std::pair<Aov, std::string>> aovs{};
  std::vector<std::pair<std::string, std::string>> dumps{};
  bool movie{};
};

void check_ending(const std::string& option, const std::string& path, std::initializer_list<FileKind> kinds, std::string_view endings) {
  if (std::find(kinds.begin(), kinds.end(), file_kind(path)) == kinds.end())
    fail(Exit::Usage, code::output_ending, {option}, fmt::format("'{}' ends in nothing that can be written here", path),
         {fmt::format("Endings: {}", endings)});
}

Aov parse_aov(const std::string& name) {
  const auto found = std::find(aov_names.begin(), aov_names.end(), name);
  if (found != aov_names.end()) return static_cast<Aov>(found - aov_names.begin());
  const std::vector<std::string> names(aov_names.begin(), aov_names.end());
  fail(Exit::Usage, code::aov_request, {"--aov"}, fmt::format("there is no AOV '{}'", name),
       {did_you_mean(name, names), fmt::format("AOVs: {}", list_of(names))});
}

Outputs parse_outputs(const RenderArguments& a) {
  Outputs out;
  out.picture = a.output;
  if (a.output.empty() && a.aovs.empty() && a.dumps.empty()) out.picture = "mote.png";
  out.movie = is_movie(out.picture);
  if (!out.picture.empty() && !out.movie)
    check_ending("-o", out.picture, {FileKind::Png, FileKind::Exr}, ".png, .exr, - for a PNG on standard output, or .mp4, .mkv, .mov, .webm, .avi, .gif for a movie");
  for (const std::string& request : a.aovs) {
    const auto [name, file] = split_request("--aov", request);
    if (file != "-") check_ending("--aov", file, {FileKind::Npy}, ".npy");
    out.aovs.emplace_back(parse_aov(name), file);
  }
  for (const std::string& request : a.dumps) {
    const auto [source, file] = split_request("--dump", request);
    check_ending("--dump", file, {FileKind::Npy, FileKind::Exr}, ".npy, .exr");
    out.dumps.emplace_back(source, file);
  }
  std::size_t to_stdout = out.picture == "-" ? 1 : 0;
  for (const auto& [aov, file] : out.aovs) to_stdout += file == "-";
  if (to_stdout > 1) fail(Exit::Usage, code::twice_to_stdout, {}, "only one output can go to standard output");
  return out;
}

// Names with numbers and --frames go together.
void check_numbers(const RenderArguments& a, const Outputs& out) {
  const bool many = !a.frames.empty();
  auto check = [&](const std::string& file) {
    if (!many || file.empty()) return;
    if (file == "-") fail(Exit::Usage, code::numbered_output, {"--frames"}, "many pictures do not go to standard output");
    (void)numbered(file, 0);
  };
  if (!out.movie) check(out.picture);
  for (const auto& [aov, file] : out.aovs) check(file);
  for (const auto& [source, file] : out.dumps) check(file);
  if (many && a.frame) fail(Exit::Usage, code::command_line, {"--frame"}, "--frame names one frame and --frames many: only one of them can be given");
  if (!many && !a.shard.empty()) fail(Exit::Usage, code::shard, {"--shard"}, "--shard shares out --frames, which is missing");
  if (!out.movie) return;
  if (!many) fail(Exit::Usage, code::command_line, {"-o"}, fmt::format("'{}' is a movie: --frames says of what", out.picture), {"--frames : is all of them"});
  if (!a.shard.empty() || a.skip_existing || a.reference || a.bits != 8)
    fail(Exit::Usage, code::command_line, {"-o"}, "a movie is made in one go: no --shard, --skip-existing, --reference or --bits 16");
}

JobRequest request_of(const RenderArguments& a, const Outputs& outputs) {
  JobRequest request = job_request(a.scene);
  request.device = a.device.device;
  request.frame = a.frame;
  if (!a.frames.empty()) request.frames = a.frames;
  request.transparent = a.transparent;
  request.linear = request.every_aov = file_kind(outputs.picture) == FileKind::Exr;
  request.deep = a.bits == 16 && file_kind(outputs.picture) == FileKind::Png;
  for (const auto& [aov, file] : outputs.aovs)
    if (std::find(request.aovs.begin(), request.aovs.end(), aov) == request.aovs.end()) request.aovs.push_back(aov);
  for (const auto& [source, file] : outputs.dumps) request.dumps.push_back({source, {"--dump"}});
  return request;
}

// A command line that makes one of the pictures again.
std::string command_of(const RenderArguments& a, const Job& job) {
  std::string text = "mote render";
  auto add = [&](const std::string& word) { text += " " + quoted(word); };
  auto option = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    add(name);
    add(value);
  };
  for (const std::string& word : a.scene.words) add(word);
  if (job.frame) option("--frame", fmt::format("{}", *job.frame));
  for (const std::string& setting : a.scene.settings) option("--set", setting);
  for (const std::string& type : a.scene.types) option("--type", type);
  option("--graph", a.scene.graph);
  option("--size", fmt::format("{}x{}", job.size.width, job.size.height));
  if (a.scene.expansion != "auto") option("--expansion", a.scene.expansion);
  option("--ocio", a.device.display.config);
  option("--display", a.device.display.display);
  option("--view", a.device.display.view);
  if (a.device.display.exact) add("--exact");
  if (a.smoothing.samples) option("--samples", fmt::format("{}", a.smoothing.samples));
  if (a.smoothing.edges != "auto") option("--edges", a.smoothing.edges);
  // A series is judged by its first frame; this one alone might be drawn otherwise.
  const bool smooth = !job.graph.opaque_settings.empty();
  if (!a.smoothing.asked() && !a.reference && smooth && !takes_edges(job.graph, job.scene)) option("--edges", "analytic");
  if (a.transparent) add("--transparent");
  if (a.reference) add("--reference");
  if (a.bits != 8) option("--bits", fmt::format("{}", a.bits));
  return text;
}

// The files of one picture.
Outputs outputs_of(const Outputs& all, std::optional<std::uint64_t> number) {
  if (!number) return all;
  Outputs out = all;
  if (!out.picture.empty() && !out.movie) out.picture = numbered(out.picture, *number);
  for (auto& [aov, file] : out.aovs) file = numbered(file, *number);
  for (auto& [source, file] : out.dumps) file = numbered(file, *number);
  return out;
}

bool all_complete(const Outputs& out, Size2d size) {
  if (!out.dumps.empty()) return false; // their sizes are not known here
  bool any = !out.picture.empty();
  if (any && !is_complete(out.picture, size)) return false;
  for (const auto& [aov, file] : out.aovs) {
    if (!is_complete(file, size)) return false;
    any = true;
  }
  return any;
}

// "frame 3 of 10" on a terminal; nothing elsewhere.
class Progress {
public:
  explicit Progress(std::size_t total) : total_(total), shown_(total > 1 && ::isatty(2) == 1) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void at(std::size_t done, std::uint64_t frame) {
    if (!shown_) return;
    fmt::print(stderr, "\r\x1b[K{} of {} pictures, frame {}", done, total_, frame);
    std::fflush(stderr);
  }
  void clear() const {
    if (shown_) fmt::print(stderr, "\r\x1b[K");
  }

private:
  std::size_t total_;
  bool shown_;
};

// What draws the frames of a job, one after the other: a device with its graph, or the reference.
class Drawing {
public:
  Drawing(const RenderArguments& a, Job& job) : a_(a), job_(job) {
    // The device and the color config are opened while the files are read: they do not depend on each other.
    if (!a.reference) opening_ = std::async(std::launch::async, [&a] { return std::make_unique<DrawingDevice>(a.device.device); });
    loading_ = std::async(std::launch::async, [&a] { return ColorConfig::load(a.device.display.config); });
  }
  void set_graph(ReadyGraph graph) {
    shown_ = graph.shown;
    graph_ = std::move(graph);
  }

  DrawnPicture draw() {
    if (!config_) config_.emplace(loading_.get());
    if (a_.reference) return annotated(draw_reference(job_, *config_, a_.device.display));
    if (!renderer_) {
      device_ = opening_.get();
      renderer_ = std::make_unique<FrameRenderer>(*device_, std::move(*graph_), *config_, a_.device.display, parse_expansion(a_.scene.expansion),
                                                  static_cast<double>(std::max<std::size_t>(1, job_.frames.size())));
    }
    renderer_->set_scene(job_.scene);
    if (a_.stats) renderer_->count_work();
    const std::size_t panels = panel_count(*renderer_, job_.view(), a_.panel);
    if (panels > 1 && !a_.dumps.empty())
      fail(Exit::Usage, code::panel, {"--dump"}, fmt::format("the picture is drawn in {} panels, and a dump holds one frame", panels),
           {fmt::format("draw at most {} pixels a side, or leave --panel out", default_panel)});
    DrawnPicture picture = draw_picture(*renderer_, job_.view(), a_.panel);
    const auto& said = renderer_->report().list(); // of all pictures so far
    for (; reported_ < said.size(); ++reported_) fmt::print(stderr, "{}\n", to_string(said[reported_]));
    if (a_.stats) print_counts(panels);
    return annotated(std::move(picture));
  }
  // How far a baked view transform is from the exact one is measured when it is made; say so, once.
  void tell() {
    if (renderer_ && !told_ && renderer_->display_text().find("baked") != std::string::npos) fmt::print(stderr, "mote: {}\n", renderer_->display_text());
    told_ = true;
  }
  [[nodiscard]] Provenance provenance() const {
    const std::string drawn_by = renderer_ ? device_->info().name : "double-precision reference";
    return provenance_of(job_, version_text(), command_of(a_, job_), drawn_by, renderer_ ? renderer_->display_text() : a_.device.display.view);
  }
  void dump(const Outputs& outputs) {
    const Uninterrupted guard;
    for (const auto& [source, file] : outputs.dumps) renderer_->dump(source, file);
  }

private:
  void print_counts(std::size_t panels) {
    if (panels > 1) fmt::print(stderr, "of the last of {} panels:\n", panels);
    for (const rg::PassTiming& pass : renderer_->timings())
      if (pass.counts) fmt::print(stderr, "{}\n{}", pass.name, counts_text(*pass.counts, "  "));
  }
  DrawnPicture annotated(DrawnPicture picture) {
    if (job_.scene.annotations.empty()) return picture;
    if (!display_) display_.emplace(display_of(*config_, a_.device.display, shown_));
    annotate(picture, job_, *display_);
    return picture;
  }

  const RenderArguments& a_;
  Job& job_;
  std::future<std::unique_ptr<DrawingDevice>> opening_{};
  std::future<ColorConfig> loading_{};
  std::optional<ReadyGraph> graph_{};
  PassDisplay shown_{};
  std::optional<ColorConfig> config_{};
  std::optional<DisplayTransform> display_{};
  std::unique_ptr<DrawingDevice> device_{};
  std::unique_ptr<FrameRenderer> renderer_{};
  bool told_{};
  std::size_t reported_{};
};

void save(const RenderArguments& a, const Outputs& outputs, const DrawnPicture& picture, Provenance provenance) {
  const Uninterrupted guard;
  SaveOptions options{.bits = static_cast<unsigned>(a.bits), .keep_alpha = a.transparent, .provenance = std::move(provenance)};
  if (!outputs.picture.empty() && !outputs.movie) save_picture(outputs.picture, picture, options);
  for (const auto& [aov, file] : outputs.aovs) {
    if (aov == Aov::Depth) save_depth(file, picture);
    if (aov == Aov::Id) save_id(file, picture);
    if (aov == Aov::Normal) save_normal(file, picture);
  }
  if (a.output.empty() && !outputs.picture.empty()) fmt::print(stderr, "mote: the picture is in {}\n", outputs.picture);
}

void draw_one(const RenderArguments& a, const Outputs& outputs, Drawing& drawing, Movie* movie) {
  const DrawnPicture picture = drawing.draw();
  drawing.tell();
  save(a, outputs, picture, drawing.provenance());
  if (movie) movie->add(picture.rgba8);
  drawing.dump(outputs);
}

void draw_many(const RenderArguments& a, const Outputs& outputs, Job& job, Drawing& drawing) {
  const Shard shard = a.shard.empty() ? Shard{} : parse_shard(a.shard);
  const std::vector<std::uint64_t> frames = part_of(job.frames, shard);
  std::optional<Movie> movie;
  if (outputs.movie) movie.emplace(outputs.picture, job.size, a.rate);
  Progress progress(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Outputs mine = outputs_of(outputs, frames[i]);
    if (a.skip_existing && all_complete(mine, job.size)) continue;
    progress.at(i, frames[i]);
    Diagnostics diagnostics;
    load_frame(job, frames[i], diagnostics);
    if (!diagnostics.empty()) progress.clear();
    print_and_stop_on_errors(diagnostics);
    draw_one(a, mine, drawing, movie ? &*movie : nullptr);
  }
  if (!movie) return;
  const Uninterrupted guard;
  movie->finish();
}

// Analytic edges where they cost little. A series is judged by its first frame, whoever
// draws which of its frames.
void smooth(const RenderArguments& a, Job& job) {
  bool automatic = !a.smoothing.asked() && a.panel == 0 && std::max(job.size.width, job.size.height) <= default_panel && takes_edges(job.graph, {});
  if (automatic && !job.frames.empty()) {
    Diagnostics said_later;
    load_frame(job, job.frames.front(), said_later);
  }
  automatic = automatic && takes_edges(job.graph, job.scene);
  request_smoothing(job.graph, a.smoothing, automatic);
}

Exit run(const RenderArguments& a) {
  const Outputs outputs = parse_outputs(a);
  if (a.panel != 0 && a.panel < 16)
    fail(Exit::Usage, code::panel, {"--panel"}, fmt::format("'{}' is too small for a panel: at least 16 pixels a side", a.panel));
  check_numbers(a, outputs);
  if (!a.shard.empty()) (void)parse_shard(a.shard);
  const JobRequest request = request_of(a, outputs);
  (void)parse_expansion(a.scene.expansion);
  if (a.reference && !outputs.dumps.empty())
    fail(Exit::Usage, code::command_line, {"--dump"}, "the reference has no passes: --dump does not go with --reference");

  Job job;
  Drawing drawing(a, job);
  Diagnostics diagnostics;
  job = load_job(request, diagnostics);
  if (!a.reference && !diagnostics.has_errors()) smooth(a, job);
  if (!a.reference && !diagnostics.has_errors())
    if (std::optional<ReadyGraph> graph = ready_graph(job.graph, diagnostics)) {
      warn_of_graph(job, *graph, diagnostics);
      drawing.set_graph(std::move(*graph));
    }
  print(job.left_out);
  print_and_stop_on_errors(diagnostics);
  if (job.frames.empty()) draw_one(a, outputs, drawing, nullptr);
  else draw_many(a, outputs, job, drawing);
  return exit_of(job.left_out);
}

} // namespace

void add_render(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("render", "draw a picture into a file");
  auto a = std::make_shared<RenderArguments>();
  add_scene_arguments(*command, a->scene);
  add_device_arguments(*command, a->device);
  command->add_option("-o,--output", a->output, "picture: .png, .exr (scene-linear, with depth, id and normal), - for a PNG on standard output; out_%04d.png for many, .mp4 and the like for a movie")
      ->type_name("FILE");
  command->add_option("--aov", a->aovs, "depth, id or normal at the pixel centers, into a .npy")->allow_extra_args(false)->type_name("NAME=FILE");
  command->add_option("--dump", a->dumps, "any source of the graph, into a .npy or .exr")->allow_extra_args(false)->type_name("PASS.SLOT=FILE");
  command->add_option("--frame", a->frame, "frame of a series, from 0; -1 is the last")->type_name("N");
  command->add_option("--frames", a->frames, "a picture of each: 0:100:10 (the end is not included), : for all, or several with commas")->type_name("A:B:STEP");
  command->add_option("--shard", a->shard, "draw only part K of N of the frames, for arrays of jobs")->type_name("K/N");
  command->add_flag("--skip-existing", a->skip_existing, "leave frames out whose files are there and complete");
  command->add_option("--rate", a->rate, "frames a second of a movie, 25 if not given")->check(CLI::Range(0.01, 1000.0))->type_name("N");
  command->add_flag("--reference", a->reference, "draw with the double-precision reference instead of a device");
  command->add_flag("--transparent", a->transparent, "a background of alpha 0");
  command->add_option("--samples", a->smoothing.samples, "samples a pixel, averaged in linear light: 1, 4, 9, 16, ...")->check(CLI::Range(1, 1024))->type_name("N");
  command->add_option("--edges", a->smoothing.edges, "analytic: outlines from closed forms; sampled: as the samples see them; auto: analytic where that is cheap")
      ->check(CLI::IsMember({"auto", "analytic", "sampled"}))->excludes("--samples")->type_name("WORD");
  command->add_flag("--stats", a->stats, "on stderr: vertices, primitives, fragments and the components they get, of each pass");
  command->add_option("--panel", a->panel, "draw in panels of at most N pixels a side (4096 where nothing is said), without seams")->type_name("N");
  command->add_option("--bits", a->bits, "bits per channel of a PNG: 8 or 16")->check(CLI::IsMember({8, 16}))->type_name("N");
  command->callback([a, &exit] { exit = run(*a); });
}

} // namespace mote::app
