// SPDX-License-Identifier: MIT
#include "app/library/pixel_trace.hpp"

#include "app/codes.hpp"
#include "core/color/display_transform.hpp"
#include "core/color/srgb.hpp"
#include "core/math/principal_axes.hpp"
#include "core/reference/shade.hpp"
#include "passes/particles/order.hpp"
#include "passes/particles/steps.hpp"
#include "passes/states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::app {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A parameter that is a word, or its default.
std::string word_of(const rg::PassDesc& pass, std::string_view key, const std::string& fallback) {
  const rg::Entry* entry = rg::find(pass.params, key);
  const auto* text = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
  return text ? *text : fallback;
}

bool compares(gpu::CompareFunction test, double own, double there) {
  switch (test) {
  case gpu::CompareFunction::Never: return false;
  case gpu::CompareFunction::Less: return own < there;
  case gpu::CompareFunction::LessEqual: return own <= there;
  case gpu::CompareFunction::Equal: return own == there;
  case gpu::CompareFunction::Greater: return own > there;
  case gpu::CompareFunction::GreaterEqual: return own >= there;
  case gpu::CompareFunction::NotEqual: return own != there;
  default: return true;
  }
}

// factor * (source or destination), for color (k < 3) and alpha.
double factor(gpu::BlendFactor f, const glm::dvec4& s, const glm::dvec4& d, int k) {
  switch (f) {
  case gpu::BlendFactor::Zero: return 0.0;
  case gpu::BlendFactor::Src: return s[k];
  case gpu::BlendFactor::OneMinusSrc: return 1.0 - s[k];
  case gpu::BlendFactor::SrcAlpha: return s.a;
  case gpu::BlendFactor::OneMinusSrcAlpha: return 1.0 - s.a;
  case gpu::BlendFactor::Dst: return d[k];
  case gpu::BlendFactor::OneMinusDst: return 1.0 - d[k];
  case gpu::BlendFactor::DstAlpha: return d.a;
  case gpu::BlendFactor::OneMinusDstAlpha: return 1.0 - d.a;
  case gpu::BlendFactor::SrcAlphaSaturated: return k == 3 ? 1.0 : std::min(s.a, 1.0 - d.a);
  default: return 1.0;
  }
}
double joined(gpu::BlendOperation operation, double s, double d, double raw_s, double raw_d) {
  switch (operation) {
  case gpu::BlendOperation::Subtract: return s - d;
  case gpu::BlendOperation::ReverseSubtract: return d - s;
  case gpu::BlendOperation::Min: return std::min(raw_s, raw_d);
  case gpu::BlendOperation::Max: return std::max(raw_s, raw_d);
  default: return s + d;
  }
}
glm::dvec4 blended(const std::optional<gpu::BlendState>& state, const glm::dvec4& s, const glm::dvec4& d) {
  if (!state) return s;
  glm::dvec4 out;
  for (int k = 0; k < 4; ++k) {
    const gpu::BlendComponent& c = k < 3 ? state->color : state->alpha;
    out[k] = joined(c.operation, factor(c.src, s, d, k) * s[k], factor(c.dst, s, d, k) * d[k], s[k], d[k]);
  }
  return out;
}
glm::dvec4 over(const glm::dvec3& color, double alpha, const glm::dvec4& behind) { // straight
  const double a = alpha + (1.0 - alpha) * behind.a;
  const glm::dvec3 light = alpha * color + (1.0 - alpha) * behind.a * glm::dvec3(behind);
  return a > 0.0 ? glm::dvec4(light / a, a) : behind;
}

class Following {
public:
  Following(const Job& job, std::uint32_t x, std::uint32_t y)
      : job_(job), view_(job.view()), world_(reference::build_world(job.scene)), tracer_(world_, view_), x_(x), y_(y), sample_(tracer_.sample(x, y, false)),
        color_(job.scene.background) {}

  TracedPass opaque(const rg::PassDesc& pass, const passes::Selection& selection, const passes::DrawStates& states) {
    TracedPass out{.name = pass.name.text, .kind = pass.kind.text};
    const auto blend = passes::unpack_blend(states.blend);
    depth_ = passes::cleared_depth(states) == 0.0 ? infinity : 0.0;
    color_ = job_.scene.background;
    out.states = fmt::format("depth_test {}, depth_write {}, blend {}", gpu::to_string(states.depth_test), states.depth_write, !blend ? "none" : *blend == passes::blend_over() ? "over" : "of its own");
    out.blending = !blend ? "the fragment replaces what is there" : *blend == passes::blend_over() ? "alpha * fragment + (1 - alpha) * what is there" : "source factor * fragment and destination factor * what is there";
    each_particle(selection, [&](const reference::Placed& placed, std::uint32_t record, double alpha) {
      if (!cover(out, placed, record) || !out.particles.back().hit) return;
      const TracedParticle& p = out.particles.back();
      const bool inside = states.cull == passes::Cull::Front || !uncut(p.enters);
      if (states.cull == passes::Cull::Back && inside) return;
      TracedFragment f = fragment(out, placed, record, inside);
      if (!in_view(f.z)) return;
      f.alpha = blend ? alpha : 1.0;
      f.there = depth_;
      f.passes = compares(states.depth_test, f.z, depth_);
      if (f.passes) color_ = blended(blend, glm::dvec4(f.color, f.alpha), color_);
      if (f.passes && states.depth_write) depth_ = f.z;
      f.after = color_;
      out.fragments.push_back(f);
    });
    out.color = color_;
    return out;
  }

  struct Glyphs {
    bool exact{}, two_surfaces{true}, by_file{}, has_depth{};
  };
  TracedPass glyphs(const rg::PassDesc& pass, const passes::Selection& selection, const passes::DrawStates& states, const Glyphs& how) {
    TracedPass out{.name = pass.name.text, .kind = pass.kind.text};
    out.states = fmt::format("depth_test {} against the opaque surface, order {}, surfaces {}", gpu::to_string(states.depth_test),
                             how.exact ? "exact" : how.by_file ? "of the file" : "by |m|^2 - r^2, drawn from the back", how.two_surfaces ? "both" : "front");
    out.blending = "alpha * fragment + (1 - alpha) * what is there; both surfaces of a particle block 1 - sqrt(1 - alpha) each";
    std::vector<std::pair<double, TracedFragment>> found; // by key; larger ones are drawn first
    each_particle(selection, [&](const reference::Placed& placed, std::uint32_t record, double alpha) {
      if (!cover(out, placed, record) || !out.particles.back().hit) return;
      const TracedParticle& p = out.particles.back();
      const double key = how.by_file ? -static_cast<double>(p.id) : view_.projection == Projection::Perspective ? glm::dot(p.eye, p.eye) - p.radius * p.radius : p.eye.z;
      for (const bool exit : {true, false}) {
        const bool inside = states.cull == passes::Cull::Front || !uncut(p.enters);
        if ((exit ? states.cull == passes::Cull::Back : states.cull == passes::Cull::Front) || (!how.two_surfaces && exit != inside)) continue;
        TracedFragment f = fragment(out, placed, record, exit);
        if (!in_view(f.z)) continue;
        f.alpha = how.two_surfaces ? 1.0 - std::sqrt(1.0 - alpha) : alpha;
        f.there = how.has_depth ? depth_ : passes::cleared_depth(states) == 0.0 ? infinity : 0.0;
        f.passes = compares(states.depth_test, f.z, f.there);
        found.emplace_back(how.exact ? f.z : key, f);
      }
    });
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [key, f] : found) {
      f.before = color_;
      if (f.passes) color_ = over(f.color, f.alpha, color_);
      f.after = color_;
      out.fragments.push_back(f);
    }
    out.color = color_;
    return out;
  }

  void set_shadows(bool on) { shadows_ = on; }
  [[nodiscard]] glm::dvec4 color() const { return color_; }
  [[nodiscard]] const View& view() const { return view_; }

private:
  template <class Fn> void each_particle(const passes::Selection& selection, const Fn& fn) const {
    for (std::uint32_t b = 0; b < job_.scene.batches.size(); ++b) {
      const Batch& batch = job_.scene.batches[b];
      if (!selection.draws(batch)) continue;
      for (std::size_t k = 0; k < batch.instances.size(); ++k)
        for (std::uint64_t record = 0; record < batch.chunks->record_count(); ++record) {
          const double alpha = passes::alpha_of(batch, record);
          if (batch.chunks->rows[record] == no_row || !passes::in_selection(selection.opacity, alpha)) continue;
          if (const reference::Placed* placed = find(b, batch.id_base + k * batch.row_count)) fn(*placed, static_cast<std::uint32_t>(record), alpha);
        }
    }
  }
  [[nodiscard]] const reference::Placed* find(std::uint32_t batch, std::uint64_t first_id) const {
    for (const auto* all : {&world_.placed, &world_.transparent_placed})
      for (const reference::Placed& p : *all)
        if (p.batch == batch && p.first_id == first_id) return &p;
    return nullptr;
  }
  [[nodiscard]] bool uncut(double z) const { return z > 0.0 && z >= view_.near_cut; }
  [[nodiscard]] bool in_view(double z) const { return uncut(z) && (view_.far_cut <= 0.0 || z <= view_.far_cut); }

  // Adds the particle if its rectangle covers the pixel.
  bool cover(TracedPass& pass, const reference::Placed& placed, std::uint32_t record) const {
    const ChunkSet& chunks = *placed.tree->chunks;
    const reference::Particle solid = reference::particle(chunks, record);
    TracedParticle p;
    p.object = solid.center;
    p.world = placed.linear * solid.center + placed.translation;
    p.eye = view_.to_view(p.world);
    p.radius = solid.radius * principal_axes(placed.linear).longest();
    rectangle(p);
    const glm::dvec2 at(x_ + view_.sample_offset.x, y_ + view_.sample_offset.y);
    if (!(at.x >= p.lo.x && at.x <= p.hi.x && at.y >= p.lo.y && at.y <= p.hi.y)) return false;
    p.id = placed.first_id + chunks.rows[record];
    p.row = chunks.rows[record];
    p.file = job_.scene.batches[placed.batch].name;
    p.type = job_.scene.batches[placed.batch].type;
    project(p);
    if (const auto inside = placed.tree->shape->intersect(solid, local(placed))) {
      p.hit = true;
      p.enters = inside->t_in;
      p.leaves = inside->t_out;
    }
    pass.particles.push_back(p);
    return true;
  }
  void project(TracedParticle& p) const {
    const glm::dvec2 scale = 2.0 * view_.focal / glm::dvec2(view_.size.width, view_.size.height);
    const bool perspective = view_.projection == Projection::Perspective;
    const double w = perspective ? p.eye.z : 1.0;
    p.clip = {scale.x * p.eye.x, scale.y * p.eye.y, perspective ? view_.depth_near : view_.depth_near / p.eye.z, w};
    p.ndc = glm::dvec3(p.clip) / w;
    p.window = {(p.ndc.x * 0.5 + 0.5) * view_.size.width, (p.ndc.y * 0.5 + 0.5) * view_.size.height, p.ndc.z};
  }
  // Of the ball around the particle: tangents of the cones through the eye.
  void rectangle(TracedParticle& p) const {
    const double z = p.eye.z, r = p.radius;
    p.lo = glm::dvec2(-infinity);
    p.hi = glm::dvec2(infinity);
    for (int k = 0; k < 2; ++k) {
      const double m = p.eye[k];
      if (view_.projection == Projection::Orthographic) {
        p.lo[k] = m - r;
        p.hi[k] = m + r;
      } else if (z > r) {
        const double root = r * std::sqrt(m * m + (z - r) * (z + r)), below = (z - r) * (z + r);
        p.lo[k] = (m * z - root) / below;
        p.hi[k] = (m * z + root) / below;
      } else if (z + r <= 0.0) {
        p.lo[k] = infinity; // wholly behind the eye
      }
    }
    p.lo = p.lo * view_.focal + view_.center();
    p.hi = p.hi * view_.focal + view_.center();
    if (view_.projection == Projection::Orthographic && z + r <= 0.0) p.lo = glm::dvec2(infinity);
  }
  [[nodiscard]] reference::Ray local(const reference::Placed& placed) const {
    return {placed.data_from_world * (view_.eye - placed.translation + sample_.ray.origin), placed.data_from_world * sample_.ray.direction};
  }
  [[nodiscard]] TracedFragment fragment(const TracedPass& pass, const reference::Placed& placed, std::uint32_t record, bool exit) const {
    const TracedParticle& p = pass.particles.back();
    TracedFragment f;
    f.particle = pass.particles.size() - 1;
    f.exit = exit;
    f.z = exit ? p.leaves : p.enters;
    f.depth = std::min(view_.depth_near / f.z, 1.0);
    f.depth32 = std::min(static_cast<float>(view_.depth_near) / static_cast<float>(f.z), 1.0f);
    const glm::dvec3 outward = placed.tree->shape->normal(reference::particle(*placed.tree->chunks, record), local(placed), exit);
    f.normal = glm::normalize(placed.normal_to_world * (exit ? -outward : outward));
    f.color = reference::shade_surface(tracer_, {placed, record, p.id, sample_.ray, f.z, f.normal}, shadows_);
    f.before = color_;
    return f;
  }

  const Job& job_;
  View view_;
  reference::World world_;
  reference::Tracer tracer_;
  std::uint32_t x_, y_;
  reference::Sample sample_;
  glm::dvec4 color_;
  double depth_{infinity}; // of the last opaque pass
  bool shadows_{};
};

[[noreturn]] void cannot(const rg::PassDesc& pass, const std::string& what) {
  fail(Exit::Failed, code::trace_beyond, {}, fmt::format("pass '{}' draws with {}, which trace-pixel does not follow", pass.name.text, what));
}

// What absorbs by the length of the ray's way, or together with its neighbors.
bool absorbs_otherwise(const Scene& scene, const passes::Selection& selection) {
  return std::any_of(scene.batches.begin(), scene.batches.end(), [&](const Batch& b) { return selection.draws(b) && (b.density > 0.0 || (b.type == "polyline" && b.alpha < 1.0)); });
}

void follow(Following& following, const rg::PassDesc& pass, const Scene& scene, PixelTrace& out) {
  Diagnostics ignored; // the graph has been compiled
  rg::Params params(pass.params, pass.draw, pass.name.text, pass.kind.text, pass.loc, ignored);
  if (pass.kind.text == "opaque_impostors") {
    if (!passes::read_steps(params).whole()) cannot(pass, "steps = \"" + word_of(pass, "steps", "depth") + "\"");
    if (rg::find(pass.params, "samples") || word_of(pass, "edges", "sampled") == "analytic")
      out.notes.push_back(fmt::format("pass '{}' smooths outlines; what is followed is the sample at the pixel's center", pass.name.text));
    const passes::Selection selection = passes::read_selection(params, params.has("blend") ? passes::Opacity::All : passes::Opacity::Opaque);
    out.passes.push_back(following.opaque(pass, selection, passes::read_states(params)));
  } else {
    const std::string oit = word_of(pass, "oit", "none");
    if (oit == "weighted") cannot(pass, "oit = \"weighted\"");
    const passes::DrawStates states = passes::read_states(params, {.depth_write = false, .blend = passes::pack(passes::blend_over())});
    if (states.depth_write || params.has("blend")) cannot(pass, "depth_write or a blend of its own");
    const bool has_depth = std::any_of(pass.inputs.begin(), pass.inputs.end(), [](const rg::InputDesc& i) { return i.slot.text == "depth"; });
    const passes::Selection selection = passes::read_selection(params, passes::Opacity::Transparent);
    if (absorbs_otherwise(scene, selection)) cannot(pass, "a density or transparent polylines");
    out.passes.push_back(following.glyphs(pass, selection, states,
                                          {oit == "exact", word_of(pass, "surfaces", "both") == "both", word_of(pass, "order", "back_to_front") == "file", has_depth}));
  }
}

} // namespace

PixelTrace trace_pixel(const Job& job, const ReadyGraph& graph, std::uint32_t x, std::uint32_t y, const ColorConfig& config, const DisplayOptions& display) {
  Diagnostics ignored;
  rg::GraphDesc desc = load_graph(job.graph, ignored);
  for (const std::string& setting : job.graph.settings) rg::apply_setting(desc, setting, ignored);
  Following following(job, x, y);
  PixelTrace out{.x = x, .y = y, .size = job.size, .ray_origin = following.view().ray_origin(x, y), .ray_direction = following.view().ray_direction(x, y)};
  const auto planned = [&](std::string_view kind) {
    return std::any_of(graph.plan.passes.begin(), graph.plan.passes.end(), [&](const rg::PlannedPass& p) { return p.kind == kind; });
  };
  following.set_shadows(planned("shadow_map"));
  for (const rg::PlannedPass& pass : graph.plan.passes) {
    if (pass.kind == "shadow_map" || pass.kind == "ocio_tonemap") continue;
    const auto found = std::find_if(desc.passes.begin(), desc.passes.end(), [&](const rg::PassDesc& p) { return p.name.text == pass.name; });
    if (found != desc.passes.end() && (pass.kind == "opaque_impostors" || pass.kind == "sorted_glyphs")) follow(following, *found, job.scene, out);
    else out.notes.push_back(fmt::format("pass '{}' ({}) is not followed", pass.name, pass.kind));
  }
  out.linear = following.color();
  DisplayRequest request{.display = display.display, .view = display.view, .exposure = display.exposure, .exact = true};
  if (request.display.empty()) request.display = graph.shown.display;
  if (request.view.empty()) request.view = graph.shown.view;
  request.exposure += graph.shown.exposure;
  std::vector<float> pixel(4);
  for (int k = 0; k < 4; ++k) pixel[static_cast<std::size_t>(k)] = static_cast<float>(out.linear[k]);
  const DisplayTransform transform = make_display_transform(config, request);
  transform.apply(pixel);
  for (std::size_t k = 0; k < 4; ++k) out.display[k] = to_8bit(static_cast<double>(pixel[k]));
  out.display_name = fmt::format("{} / {}", transform.display(), transform.view());
  return out;
}

} // namespace mote::app
