// SPDX-License-Identifier: MIT
#include "render_graph/executor.hpp"

#include "render_graph/successors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace mote::rg {

// What one pass sees. Lives as long as the executor; the recording members are set around the calls.
class Executor::Context final : public PassContext {
public:
  Context(Executor& executor, std::size_t pass) : executor_(executor), pass_(pass), planned_(executor.plan_.passes[pass]) {
    for (const Use& use : planned_.uses)
      if (is_color(use.access)) color_slots_.push_back(use.slot);
  }

  [[nodiscard]] gpu::Device device() const override { return executor_.device_; }
  [[nodiscard]] ViewSize view_size() const override { return executor_.resources_.view_size(); }
  [[nodiscard]] bool connected(std::string_view slot) const override {
    const auto use = find(slot, false);
    return use && present(*use);
  }
  [[nodiscard]] gpu::TextureView texture(std::string_view slot) const override {
    const auto use = find(slot, false);
    return use && present(*use) ? executor_.resources_.view(pass_, *use) : gpu::TextureView{};
  }
  [[nodiscard]] gpu::Texture whole_texture(std::string_view slot) const override {
    const auto use = find(slot, false);
    return use && present(*use) && !at(*use).buffer ? executor_.resources_.texture(at(*use).resource) : gpu::Texture{};
  }
  [[nodiscard]] gpu::TextureFormat format(std::string_view slot) const override {
    const auto use = find(slot, true);
    return use && !at(*use).buffer ? executor_.plan_.textures[at(*use).resource].spec.format : gpu::TextureFormat::Undefined;
  }
  [[nodiscard]] gpu::Buffer buffer(std::string_view slot) const override {
    const auto use = find(slot, false);
    return use && present(*use) && at(*use).buffer ? executor_.resources_.buffer(at(*use).resource) : gpu::Buffer{};
  }
  [[nodiscard]] const std::vector<std::string>& color_slots() const override { return color_slots_; }
  [[nodiscard]] std::uint64_t generation() const override { return generation_; }
  [[nodiscard]] bool fresh(std::string_view slot) const override {
    const auto use = find(slot, true);
    return !use || starts_afresh(*use);
  }
  [[nodiscard]] const FrameInput& frame() const override { return checked(frame_, "the frame"); }
  [[nodiscard]] gpu::RenderPass& render_pass() override { return checked(render_pass_, "a render pass"); }
  [[nodiscard]] gpu::CommandEncoder& encoder() override { return checked(encoder_, "the encoder"); }

  [[nodiscard]] gpu::RenderPass begin_attachments(bool loaded) override { return executor_.open(pass_, frame(), encoder(), loaded); }
  void mark(std::string_view stage) override { executor_.profiler_.mark(encoder(), stage); }
  [[nodiscard]] std::optional<Successor> successor(std::string_view slot) override {
    const auto use = successor_use(executor_.plan_, pass_, slot);
    if (!use || !executor_.choice_.skipped[pass_ + 1].empty()) return std::nullopt;
    Context& next = *executor_.contexts_[pass_ + 1];
    next.set(&frame(), &encoder(), nullptr);
    const PixelMap* map = executor_.passes_[pass_ + 1]->pixel_map(next);
    next.set(nullptr, nullptr, nullptr);
    if (!map) return std::nullopt;
    return Successor{map, executor_.resources_.texture(next.at(*use).resource)};
  }
  void take_over(std::string_view slot) override {
    if (successor_use(executor_.plan_, pass_, slot)) executor_.taken_over_[pass_ + 1] = planned_.name;
  }
  [[nodiscard]] bool only_sampled_by(std::string_view slot, std::string_view kind) const override {
    return rg::only_sampled_by(executor_.plan_, pass_, slot, kind);
  }
  [[nodiscard]] bool kept(std::string_view slot) const override {
    const auto use = find(slot, true);
    return use && at(*use).store == gpu::StoreOp::Store;
  }

  // Does this use hold nothing of before: made here, its source missing, or state that was reset?
  [[nodiscard]] bool starts_afresh(std::size_t use) const {
    if (at(use).state) return executor_.resources_.fresh(at(use));
    return at(use).source.empty() || missing(use);
  }
  void set(const FrameInput* frame, gpu::CommandEncoder* encoder, gpu::RenderPass* render_pass) {
    frame_ = frame;
    encoder_ = encoder;
    render_pass_ = render_pass;
  }
  void made_anew() { ++generation_; }

private:
  [[nodiscard]] const Use& at(std::size_t use) const { return planned_.uses[use]; }
  [[nodiscard]] bool missing(std::size_t use) const { return !executor_.choice_.missing.empty() && executor_.choice_.missing[pass_][use]; }
  [[nodiscard]] bool present(std::size_t use) const { return writes(at(use).access) || !missing(use); }
  // The use of a slot; nothing if it is left out. One that was never declared is the pass's bug.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view slot, bool output_first) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < planned_.uses.size(); ++i) {
      if (at(i).slot != slot) continue;
      const bool preferred = output_first ? writes(at(i).access) : reads(at(i).access);
      if (!found || preferred) found = i;
    }
    const auto& left_out = planned_.left_out;
    if (!found && std::find(left_out.begin(), left_out.end(), slot) == left_out.end())
      throw std::logic_error(fmt::format("pass '{}' (kind '{}') asks for the slot '{}', which it did not declare", planned_.name, planned_.kind, slot));
    return found;
  }
  template <class T> T& checked(T* value, std::string_view what) const {
    if (!value) throw std::logic_error(fmt::format("pass '{}' (kind '{}') asks for {}, which is not there now", planned_.name, planned_.kind, what));
    return *value;
  }

  Executor& executor_;
  std::size_t pass_;
  const PlannedPass& planned_;
  std::vector<std::string> color_slots_{};
  std::uint64_t generation_{};
  const FrameInput* frame_{};
  gpu::CommandEncoder* encoder_{};
  gpu::RenderPass* render_pass_{};
};

namespace {
std::vector<std::string> pass_names(const Plan& plan) {
  std::vector<std::string> out;
  for (const PlannedPass& pass : plan.passes) out.push_back(pass.name);
  return out;
}
} // namespace

bool ExecutorOptions::validation_asked() {
  const char* variable = std::getenv("MOTE_VALIDATION");
  return variable != nullptr && std::string_view(variable) == "1";
}

Executor::Executor(gpu::Device device, Plan plan, std::vector<std::shared_ptr<Pass>> passes, const ExecutorOptions& options)
    : device_(std::move(device)), plan_(std::move(plan)), passes_(std::move(passes)), resources_(device_, plan_), profiler_(device_, pass_names(plan_)) {
  if (passes_.size() != plan_.passes.size()) throw std::logic_error("an executor needs one pass object per planned pass");
  for (std::size_t i = 0; i < passes_.size(); ++i) contexts_.push_back(std::make_unique<Context>(*this, i));
  if (options.check_uses) check_.emplace(plan_);
}
Executor::~Executor() = default;

void Executor::prepare(const FrameInput& frame, ViewSize view) {
  if (resources_.realize(view))
    for (auto& context : contexts_) context->made_anew();
  for (std::size_t i = 0; !prepared_ && i < passes_.size(); ++i) {
    contexts_[i]->set(&frame, nullptr, nullptr);
    passes_[i]->prepare(*contexts_[i]);
    contexts_[i]->set(nullptr, nullptr, nullptr);
  }
  prepared_ = true;
}

void Executor::reset_state() { resources_.reset_state(); }

void Executor::report(Diagnostics& out) {
  for (std::size_t i = 0; i < passes_.size(); ++i)
    if (i < choice_.skipped.size() && choice_.skipped[i].empty()) passes_[i]->report(out);
}

void Executor::choose(const FrameInput& frame) {
  std::vector<std::string> reasons;
  for (const auto& pass : passes_) reasons.push_back(pass->idle_reason(frame));
  FrameChoice next = choose_passes(plan_, reasons);
  for (std::size_t i = 0; i < passes_.size(); ++i)
    if (!choice_.missing.empty() && next.missing[i] != choice_.missing[i]) contexts_[i]->made_anew();
  choice_ = std::move(next);
}

gpu::Submission Executor::execute(const FrameInput& frame, ViewSize view, const ExecuteOptions& options) {
  prepare(frame, view);
  if (options.camera_cut) resources_.reset_state();
  choose(frame);
  taken_over_.assign(passes_.size(), {});
  profiler_.begin_frame();
  gpu::CommandEncoder encoder = device_.create_command_encoder(plan_.name);
  resources_.zero_fresh_state(encoder);
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    const std::string why = !taken_over_[i].empty() ? fmt::format("'{}' did its work", taken_over_[i]) : choice_.skipped[i];
    if (why.empty()) record_pass(i, frame, encoder);
    else profiler_.skip_pass(i, why);
    record_copies(i, encoder);
  }
  profiler_.end_frame(encoder);
  const gpu::Submission submission = device_.queue().submit(encoder.finish());
  profiler_.submitted(submission);
  resources_.state_written();
  return submission;
}

void Executor::record_pass(std::size_t i, const FrameInput& frame, gpu::CommandEncoder& encoder) {
  profiler_.begin_pass(encoder, i);
  encoder.push_debug_group(plan_.passes[i].name);
  const auto& uses = plan_.passes[i].uses;
  const bool draws = !passes_[i]->opens_attachments() && std::any_of(uses.begin(), uses.end(), [](const Use& use) { return is_attachment(use.access); });
  const std::size_t first_scope = gpu::scope_count(encoder);
  contexts_[i]->set(&frame, &encoder, nullptr);
  if (draws) {
    passes_[i]->update(*contexts_[i]);
    open_and_record(i, frame, encoder);
  } else {
    passes_[i]->record(*contexts_[i]);
  }
  contexts_[i]->set(nullptr, nullptr, nullptr);
  if (check_) check_uses(i, encoder, first_scope);
  encoder.pop_debug_group();
  profiler_.end_pass(encoder);
}

void Executor::check_uses(std::size_t i, const gpu::CommandEncoder& encoder, std::size_t first_scope) {
  std::vector<SeenUse> seen;
  for (const gpu::Observed& observed : gpu::observe(encoder, first_scope))
    if (const auto physical = resources_.find(observed.buffer, observed.native)) seen.push_back({observed.buffer, *physical, observed.use});
  check_->recorded(i, seen, i + 1 < taken_over_.size() && taken_over_[i + 1] == plan_.passes[i].name);
}

gpu::RenderPass Executor::open(std::size_t i, const FrameInput& frame, gpu::CommandEncoder& encoder, bool loaded) {
  Context& context = *contexts_[i];
  const auto& uses = plan_.passes[i].uses;
  std::vector<gpu::ColorAttachment> colors;
  std::optional<gpu::DepthAttachment> depth;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const Use& use = uses[u];
    if (!is_attachment(use.access)) continue;
    const bool clear = use.load == gpu::LoadOp::Load && writes(use.access) && context.starts_afresh(u); // reset state, or an idle source
    const gpu::LoadOp load = loaded ? gpu::LoadOp::Load : clear ? gpu::LoadOp::Clear : use.load;
    gpu::Color value{0, 0, 0, 0};
    if (load == gpu::LoadOp::Clear && !use.state) value = passes_[i]->clear_value(use.slot, frame);
    const gpu::TextureView& view = resources_.view(i, u);
    if (is_color(use.access)) colors.push_back({.view = &view, .load = load, .store = use.store, .clear = value});
    else depth = gpu::DepthAttachment{.view = &view, .load = load, .store = use.store, .clear = static_cast<float>(value.r), .read_only = use.access == Access::DepthRead};
  }
  return encoder.begin_render_pass({.label = plan_.passes[i].name, .colors = colors, .depth = depth});
}

void Executor::open_and_record(std::size_t i, const FrameInput& frame, gpu::CommandEncoder& encoder) {
  gpu::RenderPass render_pass = open(i, frame, encoder, false);
  contexts_[i]->set(&frame, nullptr, &render_pass); // the encoder is locked meanwhile
  passes_[i]->record(*contexts_[i]);
  render_pass.end();
}

void Executor::record_copies(std::size_t after, gpu::CommandEncoder& encoder) {
  for (const Copy& copy : plan_.copies) {
    if (copy.after != after) continue;
    if (copy.buffer) {
      const gpu::Buffer &from = resources_.buffer(copy.from), &to = resources_.buffer(copy.to);
      encoder.copy_buffer_to_buffer(from, 0, to, 0, to.size());
      continue;
    }
    const gpu::Texture &from = resources_.texture(copy.from), &to = resources_.texture(copy.to);
    const gpu::Extent3d base = to.size();
    for (std::uint32_t level = 0; level < to.mip_level_count(); ++level) {
      gpu::Extent3d size{std::max(base.width >> level, 1u), std::max(base.height >> level, 1u), base.depth_or_layers};
      if (to.dimension() == gpu::TextureDimension::D3) size.depth_or_layers = std::max(base.depth_or_layers >> level, 1u);
      encoder.copy_texture_to_texture({.texture = &from, .mip_level = level}, {.texture = &to, .mip_level = level}, size);
    }
  }
}

gpu::Texture Executor::texture(std::string_view source) const {
  for (const Root& root : plan_.roots)
    if (root.source == source && !root.buffer && view_size().width != 0) return resources_.texture(root.resource);
  return {};
}
gpu::Buffer Executor::buffer(std::string_view source) const {
  for (const Root& root : plan_.roots)
    if (root.source == source && root.buffer && view_size().width != 0) return resources_.buffer(root.resource);
  return {};
}
gpu::Texture Executor::output() const { return texture(plan_.roots.front().source); }

} // namespace mote::rg
