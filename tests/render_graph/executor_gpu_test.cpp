// SPDX-License-Identifier: MIT
#include "gpu_kinds.hpp"

#include <fmt/format.h>

namespace mote::rg::test {
namespace {

using gpu::TextureFormat;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

class ExecutorTest : public GpuTest {};

TEST_F(ExecutorTest, ClearsAndReadsBack) {
  auto executor = make(basics(), "output = 'a.color'\n" + pass("a", "fill"));
  EXPECT_FALSE(executor->output()) << "nothing is there before the first frame";
  executor->execute({}, {4, 3});
  EXPECT_EQ(executor->output().size(), (gpu::Extent3d{4, 3, 1}));
  EXPECT_THAT(read<float>(executor->output()), testing::AllOf(testing::SizeIs(12), Each(5.0f)));
  EXPECT_FALSE(executor->texture("a.depth"));
}

TEST_F(ExecutorTest, APassReadsWhatAnotherWrote) {
  auto executor = make(basics(), "output = 'b.color'\n" + pass("a", "fill") + pass("b", "add", "source = 'a.color'"));
  executor->execute({}, {4, 3});
  EXPECT_THAT(read<float>(executor->output()), Each(6.0f));
}

TEST_F(ExecutorTest, SharedMemoryIsNotMixedUp) {
  std::string graph = "output = 'p9.color'\n" + pass("p0", "fill");
  for (int i = 1; i < 10; ++i) graph += pass(fmt::format("p{}", i), "add", fmt::format("source = 'p{}.color'", i - 1));
  auto executor = make(basics(), graph);
  std::uint32_t memories = 0;
  for (const PlannedTexture& t : executor->plan().textures) memories = std::max(memories, t.physical + 1);
  EXPECT_EQ(memories, 2u) << "ten textures take turns in two";
  for (int frame = 0; frame < 3; ++frame) executor->execute({}, {16, 16});
  EXPECT_THAT(read<float>(executor->output()), Each(14.0f));
}

TEST_F(ExecutorTest, DrawingOverKeepsTheRestAndRootsAreCopied) {
  auto executor = make(basics(), "output = 'b.color'\n" + pass("a", "fill") + pass("b", "paint", "color = 'a.color'"), {.roots = {{"a.color", {"--dump"}}}});
  executor->execute({}, {3, 1});
  EXPECT_THAT(read<float>(executor->output()), ElementsAre(100, 5, 5));
  EXPECT_THAT(read<float>(executor->texture("a.color")), ElementsAre(5, 5, 5));
}

TEST_F(ExecutorTest, AnIdlePassLetsItsSourceThrough) {
  auto executor = make(basics(), "output = 'b.color'\n" + pass("a", "fill") + pass("b", "paint", "color = 'a.color'"));
  FrameInput idle;
  const int flag = 1;
  idle.set(&flag);
  executor->execute(idle, {3, 1});
  EXPECT_THAT(read<float>(executor->output()), Each(5.0f));
  EXPECT_EQ(executor->last_choice().skipped[1], "told so");
  EXPECT_EQ(executor->timings(true)[1].skipped, "told so");
  executor->execute({}, {3, 1});
  EXPECT_THAT(read<float>(executor->output()), ElementsAre(100, 5, 5));
}

TEST_F(ExecutorTest, AnotherSizeMakesOnlyWhatDependsOnIt) {
  Registry r = basics();
  std::vector<std::uint64_t> generations;
  Functions watch = add_one();
  watch.record = [&, record = watch.record](PassContext& c) {
    generations.push_back(c.generation());
    record(c);
  };
  add(r, "watch", watch);
  auto executor = make(r, "output = 'b.color'\n" + pass("f", "fill") + "outputs = { color = { size = [2, 2] } }\n" + pass("a", "fill") + pass("b", "watch", "source = 'a.color'"),
                       {.roots = {{"f.color", {"--dump"}}}});
  executor->execute({}, {4, 3});
  const gpu::Texture before = executor->output(), fixed = executor->texture("f.color");
  executor->execute({}, {4, 3});
  EXPECT_EQ(executor->output(), before);
  executor->execute({}, {5, 7});
  EXPECT_EQ(executor->output().size(), (gpu::Extent3d{5, 7, 1}));
  EXPECT_EQ(executor->texture("f.color"), fixed) << "a fixed size stays";
  EXPECT_THAT(read<float>(executor->output()), testing::AllOf(testing::SizeIs(35), Each(6.0f)));
  ASSERT_EQ(generations.size(), 3u);
  EXPECT_EQ(generations[0], generations[1]);
  EXPECT_NE(generations[1], generations[2]);
}

TEST_F(ExecutorTest, TimesEveryPass) {
  auto executor = make(basics(), "output = 'b.color'\n" + pass("a", "fill") + pass("b", "add", "source = 'a.color'"));
  EXPECT_TRUE(executor->timings().empty());
  executor->execute({}, {64, 64});
  EXPECT_TRUE(executor->timings().empty()) << "nothing is waited for";
  const auto& timings = executor->timings(true);
  ASSERT_EQ(timings.size(), 2u);
  EXPECT_EQ(timings[0].name, "a");
  EXPECT_EQ(timings[1].name, "b");
  EXPECT_GT(timings[1].cpu_ms, 0.0);
  EXPECT_EQ(timings[1].gpu_ms.has_value(), has(device_.features(), gpu::Feature::TimestampQuery));
  EXPECT_GE(timings[1].gpu_ms.value_or(0), 0.0);
  for (int frame = 0; frame < 5; ++frame) executor->execute({}, {64, 64});
  EXPECT_EQ(executor->timings().size(), 2u) << "older frames come by themselves";
}

// ---- buffers and compute -----------------------------------------------------------------------
TEST_F(ExecutorTest, ComputePassesShareABuffer) {
  Registry r;
  add(r, "count", compute_kind({.name = "list", .access = Access::StorageWrite, .makes = BufferSpec{.record_bytes = 4, .count = 5}}, "data[i] = i;", 5));
  add(r, "twice", compute_kind({.name = "list", .access = Access::StorageReadWrite, .buffer = true}, "data[i] *= 2;", 5));
  auto executor = make(r, "output = 'b.list'\n" + pass("a", "count") + pass("b", "twice", "list = 'a.list'"), {.roots = {{"a.list", {"--dump"}}}});
  executor->execute({}, {1, 1});
  EXPECT_THAT(read<std::uint32_t>(executor->buffer("b.list")), ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(read<std::uint32_t>(executor->buffer("a.list")), ElementsAre(0, 1, 2, 3, 4)) << "copied before it was changed";
}

TEST_F(ExecutorTest, StateLastsUntilItIsReset) {
  Registry r;
  add(r, "sum", compute_kind({.name = "total", .access = Access::StorageReadWrite, .makes = BufferSpec{.record_bytes = 4, .count = 1, .per_pixel = true}, .state = true}, "data[i] += 1;", 4));
  auto executor = make(r, "output = 'a.total'\n" + pass("a", "sum"));
  auto total = [&] { return read<std::uint32_t>(executor->buffer("a.total"))[0]; };
  for (int frame = 0; frame < 3; ++frame) executor->execute({}, {2, 2});
  EXPECT_EQ(total(), 3u);
  executor->execute({}, {2, 2}, {.camera_cut = true});
  EXPECT_EQ(total(), 1u);
  executor->execute({}, {2, 2});
  EXPECT_EQ(total(), 2u);
  executor->execute({}, {4, 2});
  EXPECT_EQ(total(), 1u) << "another size is another beginning";
  executor->reset_state();
  executor->execute({}, {4, 2});
  EXPECT_EQ(total(), 1u);
}

TEST_F(ExecutorTest, StateOfAttachmentsAndStorageTexturesStartsAtZero) {
  Registry r;
  std::vector<bool> fresh;
  auto draw = std::make_shared<FullScreen>();
  Functions sum;
  sum.declare = [](auto& slots, Params&) {
    slots.push_back({.name = "sum", .access = Access::ColorReadWrite, .makes = texture(TextureFormat::R32Float), .state = true});
    slots.push_back({.name = "seen", .access = Access::StorageReadWrite, .makes = texture(TextureFormat::R32Float), .state = true});
  };
  sum.prepare = [draw](PassContext& c) {
    const gpu::BlendState plus{.color = {.src = gpu::BlendFactor::One, .dst = gpu::BlendFactor::One}, .alpha = {}};
    *draw = FullScreen(c.device(), "layout(location=0) out float color;\nvoid main() { color = 1.0; }", {.format = c.format("sum"), .blend = plus});
  };
  sum.record = [&, draw](PassContext& c) {
    fresh.push_back(c.fresh("sum"));
    draw->draw(c);
  };
  sum.clear = [](auto, auto&) { return gpu::Color{77, 0, 0, 0}; }; // not for state
  add(r, "sum", sum);
  auto executor = make(r, "output = 'a.sum'\n" + pass("a", "sum"), {.roots = {{"a.seen", {"--dump"}}}});
  for (int frame = 0; frame < 3; ++frame) executor->execute({}, {2, 2});
  EXPECT_THAT(read<float>(executor->output()), Each(3.0f));
  EXPECT_THAT(read<float>(executor->texture("a.seen")), Each(0.0f));
  EXPECT_THAT(fresh, ElementsAre(true, false, false));
  executor->execute({}, {2, 2}, {.camera_cut = true});
  EXPECT_THAT(read<float>(executor->output()), Each(1.0f));
}

// ---- depth, optional slots, own passes ----------------------------------------------------------
TEST_F(ExecutorTest, DepthIsTestedAndSampledInOnePass) {
  Registry r;
  add(r, "depth", {.declare = [](auto& slots, Params&) { slots.push_back({.name = "depth", .access = Access::DepthWrite, .makes = texture(TextureFormat::Depth32Float)}); },
                   .clear = [](auto, auto&) { return gpu::Color{0.25, 0, 0, 0}; }});
  auto draw = std::make_shared<FullScreen>();
  Functions f;
  f.declare = [](auto& slots, Params&) {
    slots.push_back(color_out());
    slots.push_back({.name = "depth", .access = Access::DepthRead});
  };
  f.prepare = [draw](PassContext& c) {
    *draw = FullScreen(c.device(), "layout(set=0, binding=0) uniform texture2D source; layout(location=0) out float color;\nvoid main() { color = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r; }",
                       {.format = c.format("color")}, {{.binding = 0, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture, .sample_type = gpu::SampleType::Depth}},
                       gpu::DepthState{.format = c.format("depth"), .write = false, .compare = gpu::CompareFunction::Greater});
  };
  f.record = [draw](PassContext& c) {
    const gpu::TextureView depth = c.texture("depth");
    draw->draw(c, {{.binding = 0, .texture = &depth}});
  };
  add(r, "look", f);
  auto executor = make(r, "output = 'b.color'\n" + pass("a", "depth") + pass("b", "look", "depth = 'a.depth'"), {.roots = {{"a.depth", {"--dump"}}}});
  executor->execute({}, {4, 4});
  EXPECT_THAT(read<float>(executor->output()), Each(0.25f));
  EXPECT_THAT(read<float>(executor->texture("a.depth")), Each(0.25f));
}

TEST_F(ExecutorTest, OptionalOutputsAndInputsThatGoMissing) {
  Registry r = basics();
  Functions idle_fill = fill();
  idle_fill.idle = [](const FrameInput& frame) { return frame.find<int>() ? std::string("told so") : std::string(); };
  add(r, "maybe", idle_fill);
  std::vector<std::string> log;
  Functions f;
  f.declare = [](auto& slots, Params&) {
    slots.push_back({.name = "hint", .access = Access::Sampled, .optional = true});
    slots.push_back({.name = "extra", .access = Access::Sampled, .optional = true});
    slots.push_back(color_out());
    Slot id = color_out("id", TextureFormat::R32Uint);
    id.optional = true;
    slots.push_back(id);
  };
  f.record = [&](PassContext& c) {
    log.push_back(fmt::format("hint {} extra {} id {} colors {} gen {}", c.connected("hint"), c.connected("extra"), c.connected("id"), c.color_slots().size(), c.generation()));
    EXPECT_EQ(static_cast<bool>(c.texture("hint")), c.connected("hint"));
    EXPECT_THROW((void)c.texture("hnt"), std::logic_error);
    EXPECT_THROW((void)c.encoder(), std::logic_error) << "a drawing pass has the render pass";
  };
  f.clear = [](std::string_view slot, auto&) { return slot == "id" ? gpu::Color{4294967295.0, 0, 0, 0} : gpu::Color{2, 0, 0, 0}; };
  add(r, "user", f);
  const std::string graph = "output = 'b.color'\n" + pass("a", "maybe") + pass("b", "user", "hint = 'a.color'");
  auto plain = make(r, graph);
  FrameInput idle;
  const int flag = 1;
  idle.set(&flag);
  plain->execute({}, {2, 2});
  plain->execute(idle, {2, 2});
  auto with = make(r, graph, {.roots = {{"b.id", {"--aov"}}}});
  with->execute({}, {2, 2});
  EXPECT_THAT(log, ElementsAre("hint true extra false id false colors 1 gen 1", "hint false extra false id false colors 1 gen 2", "hint true extra false id true colors 2 gen 1"));
  EXPECT_THAT(read<std::uint32_t>(with->texture("b.id")), Each(0xFFFFFFFFu));
  EXPECT_THAT(read<float>(with->output()), Each(2.0f));
}

TEST_F(ExecutorTest, APassMayOpenItsLayersItself) {
  Registry r;
  Functions f;
  f.opens = true;
  f.declare = [](auto& slots, Params&) {
    TextureSpec spec = texture(TextureFormat::R32Float);
    spec.layers = 3;
    slots.push_back({.name = "color", .access = Access::ColorWrite, .makes = spec});
  };
  f.record = [](PassContext& c) {
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
      const gpu::TextureView view = c.whole_texture("color").create_view({.label = "layer", .dimension = gpu::TextureViewDimension::D2, .base_array_layer = layer, .array_layer_count = 1});
      const gpu::ColorAttachment color{.view = &view, .clear = {static_cast<double>(layer), 0, 0, 0}};
      c.encoder().begin_render_pass({.label = "layer", .colors = std::span(&color, 1)}).end();
    }
  };
  add(r, "layers", f);
  auto executor = make(r, "output = 'a.color'\n" + pass("a", "layers"));
  executor->execute({}, {1, 1});
  EXPECT_THAT(read<float>(executor->output()), ElementsAre(0, 1, 2));
}

// ---- what can go wrong ---------------------------------------------------------------------------
TEST_F(ExecutorTest, ASizeThatTheDeviceDoesNotAllow) {
  auto executor = make(basics(), "name = 'big'\noutput = 'a.color'\n" + pass("a", "fill"));
  const std::uint32_t side = device_.limits().max_texture_dimension_2d + 1;
  try {
    executor->execute({}, {side, 1});
    FAIL() << "it was allowed";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit(), Exit::Failed);
    EXPECT_THAT(failure.what(), HasSubstr(fmt::format("g.toml:4:1: error G070: the width of 'a.color' is {} for a view of {}x1, but the device allows {}.", side, side, side - 1)));
  }
  executor->execute({}, {2, 2});
  EXPECT_THAT(read<float>(executor->output()), Each(5.0f)) << "the next size is fine again";
}

TEST_F(ExecutorTest, AFailingPassSubmitsNothingAndTheNextFrameIsFine) {
  Registry r = basics();
  Functions f = fill();
  f.record = [](PassContext& c) {
    if (c.frame().find<int>()) fail(Exit::Failed, "X001", SourceLoc{}, "the pass gives up.");
  };
  add(r, "fragile", f);
  auto executor = make(r, "output = 'a.color'\n" + pass("a", "fragile"));
  FrameInput bad;
  const int flag = 1;
  bad.set(&flag);
  EXPECT_THROW(executor->execute(bad, {2, 2}), Failure);
  executor->execute({}, {2, 2});
  EXPECT_THAT(read<float>(executor->output()), Each(5.0f));
}

class SmallMemoryTest : public GpuTest {
protected:
  SmallMemoryTest() { memory_budget_ = 8 << 20; }
};
TEST_F(SmallMemoryTest, NoMemoryNamesTheTextureAndItsPlace) {
  auto executor = make(basics(), "name = 'big'\noutput = 'a.color'\n" + pass("a", "fill"));
  executor->execute({}, {16, 16});
  try {
    executor->execute({}, {4096, 4096});
    FAIL() << "64 MiB fitted into 8";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit(), Exit::Failed);
    EXPECT_THAT(failure.what(), testing::AllOf(HasSubstr("g.toml:4:1: error G071: 'a.color' cannot be made for a view of 4096x4096"), HasSubstr("the whole graph takes 64 MiB at this size.")));
  }
  executor->execute({}, {16, 16}); // as before: what was given up is made again
  EXPECT_THAT(read<float>(executor->output()), testing::AllOf(testing::SizeIs(256), Each(5.0f)));
}

} // namespace
} // namespace mote::rg::test
