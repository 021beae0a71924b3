// SPDX-License-Identifier: MIT
// Kinds for the tests of the graph model: slots and parameters like those of real passes, nothing to
// draw. The GPU tests have kinds of their own.
#pragma once

#include "render_graph/compile.hpp"

#include <functional>
#include <string>
#include <vector>

namespace mote::rg::test {

class FakePass : public Pass {
public:
  using Declare = std::function<void(std::vector<Slot>&, Params&)>;
  explicit FakePass(Declare declare) : declare_(std::move(declare)) {}
  void declare(std::vector<Slot>& slots, Params& params) override { declare_(slots, params); }
  void prepare(PassContext&) override { throw std::logic_error("a fake pass is never prepared"); }
  void record(PassContext&) override { throw std::logic_error("a fake pass is never recorded"); }

private:
  Declare declare_;
};

inline void add_kind(Registry& registry, const std::string& name, const std::string& summary, FakePass::Declare declare) {
  registry.add({name, summary, [declare = std::move(declare)]() -> std::unique_ptr<Pass> { return std::make_unique<FakePass>(declare); }});
}

inline TextureSpec texture(gpu::TextureFormat format, SizeSpec size = {}) { return {.format = format, .size = std::move(size)}; }
inline SizeSpec fixed(std::uint32_t width, std::uint32_t height) { return {.kind = SizeSpec::Kind::Fixed, .width = width, .height = height}; }
inline SizeSpec like(std::string what) { return {.kind = SizeSpec::Kind::Like, .like = std::move(what)}; }

inline Registry fake_registry() {
  using gpu::TextureFormat;
  Registry r;
  add_kind(r, "shadow_map", "depth from a light", [](auto& slots, Params& params) {
    slots.push_back({.name = "depth", .access = Access::DepthWrite, .summary = "depth seen from the light", .makes = texture(TextureFormat::Depth32Float, fixed(1024, 1024))});
    params.draw();
    params.string("light", "sun", "name of the light");
    params.number("depth_bias", 1.5, {.min = 0}, "offset along the ray");
  });
  add_kind(r, "opaque_impostors", "opaque particles", [](auto& slots, Params& params) {
    slots.push_back({.name = "shadow", .access = Access::Sampled, .summary = "a shadow map", .optional = true});
    slots.push_back({.name = "color", .access = Access::ColorWrite, .summary = "linear color", .makes = texture(TextureFormat::RGBA16Float)});
    slots.push_back({.name = "depth", .access = Access::DepthWrite, .summary = "reverse-Z depth", .makes = texture(TextureFormat::Depth32Float)});
    slots.push_back({.name = "aov_depth", .access = Access::ColorWrite, .summary = "distance", .makes = texture(TextureFormat::R32Float), .optional = true});
    slots.push_back({.name = "aov_id", .access = Access::ColorWrite, .summary = "particle", .makes = texture(TextureFormat::R32Uint), .optional = true});
    slots.push_back({.name = "aov_normal", .access = Access::ColorWrite, .summary = "normal", .makes = texture(TextureFormat::RGBA32Float), .optional = true});
    params.draw();
    params.color("clear", {0, 0, 0, 0}, "background");
  });
  add_kind(r, "sorted_glyphs", "transparent particles", [](auto& slots, Params& params) {
    slots.push_back({.name = "color", .access = Access::ColorReadWrite, .summary = "what is drawn over"});
    slots.push_back({.name = "depth", .access = Access::DepthRead, .summary = "opaque depth"});
    slots.push_back({.name = "shadow", .access = Access::Sampled, .summary = "a shadow map", .optional = true});
    params.draw();
    params.word("sort", "back_to_front", {"back_to_front", "none"}, "order of drawing");
    if (params.has("samples")) {
      Params samples = params.table("samples", "how often a pixel is looked at");
      samples.integer("n", 16, {.min = 1, .max = 64});
      samples.word("pattern", "grid", {"grid", "halton"});
    }
  });
  add_kind(r, "ocio_tonemap", "display transform", [](auto& slots, Params& params) {
    slots.push_back({.name = "color", .access = Access::Sampled, .summary = "linear color"});
    slots.push_back({.name = "color", .access = Access::ColorWrite, .summary = "display color", .makes = texture(TextureFormat::RGBA8Unorm), .covers = true});
    params.number("exposure", 0.0, {.min = -20, .max = 20}, "stops");
    params.string("display", "sRGB", "display of the color configuration");
    params.string("view", "Un-tone-mapped", "view transform");
  });
  add_kind(r, "blur", "smooths a texture", [](auto& slots, Params& params) {
    slots.push_back({.name = "source", .access = Access::Sampled, .summary = "what is smoothed"});
    slots.push_back({.name = "color", .access = Access::ColorWrite, .summary = "the smooth one", .makes = texture(TextureFormat::Undefined, like("source")), .covers = true});
    params.integer("radius", 4, {.min = 1, .max = 64}, "pixels");
    params.require("radius");
  });
  add_kind(r, "paint", "draws over a texture, or starts one", [](auto& slots, Params& params) {
    slots.push_back({.name = "color", .access = Access::ColorReadWrite, .summary = "the canvas", .makes = texture(TextureFormat::RGBA16Float)});
    slots.push_back({.name = "mask", .access = Access::Sampled, .summary = "where", .optional = true});
    params.color("ink", {1, 1, 1, 1});
  });
  add_kind(r, "accumulate", "averages over frames", [](auto& slots, Params&) {
    slots.push_back({.name = "source", .access = Access::Sampled, .summary = "this frame"});
    slots.push_back({.name = "sum", .access = Access::ColorReadWrite, .summary = "all frames", .makes = texture(TextureFormat::RGBA32Float), .state = true});
  });
  add_kind(r, "sort_keys", "sorts on the device", [](auto& slots, Params&) {
    slots.push_back({.name = "keys", .access = Access::StorageWrite, .summary = "sorted keys", .makes = BufferSpec{.record_bytes = 8, .count = 1000}});
    slots.push_back({.name = "scratch", .access = Access::StorageReadWrite, .summary = "histogram", .makes = BufferSpec{.record_bytes = 4, .count = 256}});
    slots.push_back({.name = "args", .access = Access::StorageWrite, .summary = "draw arguments", .makes = BufferSpec{.record_bytes = 16, .count = 1}});
  });
  add_kind(r, "draw_keys", "draws what is sorted", [](auto& slots, Params&) {
    slots.push_back({.name = "keys", .access = Access::StorageRead, .summary = "sorted keys", .buffer = true});
    slots.push_back({.name = "args", .access = Access::Indirect, .summary = "draw arguments", .buffer = true});
    slots.push_back({.name = "color", .access = Access::ColorWrite, .summary = "linear color", .makes = texture(TextureFormat::RGBA16Float)});
  });
  return r;
}

inline CompileResult compile_text(const std::string& toml, const CompileOptions& options = {}, const std::vector<std::string>& settings = {}) {
  Diagnostics found;
  GraphDesc desc = parse_graph(toml, "g.toml", found);
  for (const std::string& setting : settings) apply_setting(desc, setting, found);
  return compile(desc, fake_registry(), options, found);
}

} // namespace mote::rg::test
