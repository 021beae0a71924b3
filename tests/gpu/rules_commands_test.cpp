// SPDX-License-Identifier: MIT
// Rules for passes, draws and copies.
#include "tests/gpu/rules.hpp"

namespace mote::gpu {
namespace {

const TextureUsage drawn = TextureUsage::RenderAttachment | TextureUsage::CopySrc;

// A pass of one color and one depth attachment.
struct PassCase {
  TextureFacts color{"color", {64, 32, 1}, TextureFormat::RGBA16Float, drawn, TextureDimension::D2, 1, 1};
  TextureFacts second{"ids", {64, 32, 1}, TextureFormat::R32Uint, drawn, TextureDimension::D2, 1, 1};
  TextureFacts depth{"depth", {64, 32, 1}, TextureFormat::Depth32Float, drawn, TextureDimension::D2, 1, 1};
  RenderPassFacts pass{};
  PassCase() {
    pass.colors = {{"colors[0]", {"color", &color, TextureViewDimension::D2, {}}}, {"colors[1]", {"ids", &second, TextureViewDimension::D2, {}}}};
    pass.resolves.resize(2);
    pass.depth = AttachmentFacts{"depth", {"depth", &depth, TextureViewDimension::D2, {}}};
  }
  void broken(std::string_view code, std::string_view words) {
    expect_broken(code, words, [&] { check_render_pass(pass); });
  }
};

TEST(PassRules, good) {
  const PassFacts facts = check_render_pass(PassCase().pass);
  EXPECT_EQ(facts.size, (Extent3d{64, 32, 1}));
  EXPECT_THAT(facts.targets, testing::ElementsAre(TextureFormat::RGBA16Float, TextureFormat::R32Uint));
  EXPECT_EQ(facts.depth, TextureFormat::Depth32Float);
}
TEST(PassRules, attachments) {
  {
    PassCase c;
    c.color.usage = TextureUsage::Sampled;
    c.broken("V-TEX-009", "As colors[0], [Texture \"color\"] needs usage RenderAttachment; it has Sampled");
  }
  {
    PassCase c;
    c.color.mips = 3;
    c.pass.colors[0].view.range.mips = 2;
    c.broken("V-PASS-003", "2 mip levels");
  }
  {
    PassCase c;
    c.color.format = TextureFormat::Depth32Float;
    c.broken("V-PASS-004", "colors[0] is [TextureView \"color\"] with format depth32float");
  }
  {
    PassCase c;
    c.second.size.width = 65;
    c.broken("V-PASS-006", "colors[1] ([TextureView \"ids\"]) is 65x32 with 1 samples; colors[0] ([TextureView \"color\"]) is 64x32");
  }
  {
    PassCase c;
    c.depth.samples = 4;
    c.broken("V-PASS-006", "depth ([TextureView \"depth\"]) is 64x32 with 4 samples");
  }
  {
    PassCase c;
    c.pass.colors[1].view.texture = &c.color;
    c.broken("V-PASS-009", "colors[0] and colors[1] are the same subresource of [Texture \"color\"]");
  }
  expect_broken("V-PASS-005", "neither", [] { check_render_pass({}); });
}
TEST(PassRules, depth_and_resolve) {
  PassCase c;
  c.pass.depth_read_only = true;
  c.pass.depth_load = LoadOp::Clear;
  c.broken("V-PASS-007", "read-only");
  c.pass.depth_load = LoadOp::Load;
  expect_kept([&] { check_render_pass(c.pass); });
  c.pass.resolves[0] = c.pass.colors[1];
  c.broken("V-PASS-008", "cannot be resolved to [TextureView \"ids\"] (r32uint, 1 samples, 64x32)");
}

TEST(DrawRules, pipeline_in_pass) {
  const PassFacts pass{{64, 32, 1}, {TextureFormat::RGBA16Float}, TextureFormat::Depth32Float, true, 1};
  PipelineFacts p;
  p.label = "opaque";
  p.targets = {TextureFormat::RGBA16Float};
  p.depth = TextureFormat::Depth32Float;
  const auto check = [&] { check_pipeline_in_pass(pass, p); };
  expect_kept(check);
  p.depth_write = true;
  expect_broken("V-PASS-013", "[RenderPipeline \"opaque\"] writes depth", check);
  p.samples = 4;
  expect_broken("V-PASS-012", "is 4; that of the pass is 1", check);
  p.depth = TextureFormat::Undefined;
  expect_broken("V-PASS-011", "is undefined; that of the pass is depth32float", check);
  p.targets[0] = TextureFormat::RGBA8Unorm;
  expect_broken("V-PASS-010", "targets[0] of [RenderPipeline \"opaque\"] is rgba8unorm; colors[0] of the pass is rgba16float", check);
  p.targets.clear();
  expect_broken("V-PASS-010", "has 0 color targets; the pass has 1 color attachments", check);
}
TEST(DrawRules, vertex_range) {
  PipelineFacts p;
  p.vertex_strides = {12};
  p.vertex_steps = {VertexStepMode::Vertex};
  expect_kept([&] { check_vertex_range(p, 0, 36, 0, 3, VertexStepMode::Vertex); });
  expect_kept([&] { check_vertex_range(p, 0, 36, 0, 300, VertexStepMode::Instance); });
  expect_broken("V-DRAW-012", "Vertices [1, 4) are drawn; vertex buffer 0 holds 3", [&] { check_vertex_range(p, 0, 36, 1, 3, VertexStepMode::Vertex); });
}

TEST(CopyRules, ranges) {
  const BufferFacts b{"b", 100, BufferUsage::CopySrc};
  EXPECT_EQ(check_range("it", b, 40, 0, 4), 60u);
  expect_broken("V-BUF-006", "offset 2 and size 0 must be multiples of 4", [&] { check_range("it", b, 2, 0, 4); });
  expect_broken("V-BUF-007", "bytes [96, 104) are not inside [Buffer \"b\"], which has 100 bytes", [&] { check_range("it", b, 96, 8, 4); });
  expect_broken("V-BUF-007", "", [&] { check_range("it", b, 8, ~std::uint64_t{0} - 7, 4); }); // must not wrap around
}
TEST(CopyRules, textures) {
  TextureFacts t{"t", {16, 8, 4}, TextureFormat::R32Float, drawn, TextureDimension::D3, 2, 1};
  expect_kept([&] { check_texture_copy("it", t, 1, {0, 0, 1}, {8, 4, 1}); });
  expect_broken("V-COPY-004", "mip level 2 is not inside [Texture \"t\"], which has 2", [&] { check_texture_copy("it", t, 2, {}, {1, 1, 1}); });
  expect_broken("V-COPY-005", "(0, 0, 2) of 8x4x1 is not inside mip level 1 of [Texture \"t\"], which is 8x4x2",
                [&] { check_texture_copy("it", t, 1, {0, 0, 2}, {8, 4, 1}); });
  t.samples = 4;
  expect_broken("V-COPY-003", "4 samples", [&] { check_texture_copy("it", t, 0, {}, {1, 1, 1}); });
  const TextureFacts other{"u", {16, 8, 4}, TextureFormat::R32Uint, drawn, TextureDimension::D3, 2, 1};
  expect_broken("V-COPY-002", "[Texture \"t\"] has format r32float; the destination [Texture \"u\"] has r32uint", [&] { check_texture_pair(t, other); });
}
TEST(CopyRules, pictures_in_buffers) {
  const BufferFacts b{"b", 1000, BufferUsage::CopySrc};
  const auto check = [&](std::uint64_t offset, std::uint32_t row, std::uint32_t rows, Extent3d size) {
    return check_buffer_copy("it", b, offset, row, rows, TextureFormat::RGBA8Unorm, size);
  };
  EXPECT_EQ(check(0, 0, 0, {10, 5, 5}).bytes, 1000u);
  EXPECT_EQ(check(0, 48, 6, {10, 5, 2}).bytes, 48u * 6 + 48 * 4 + 40);
  expect_broken("V-COPY-006", "rows of 36 bytes", [&] { check(0, 36, 0, {10, 5, 1}); });
  expect_broken("V-COPY-006", "rows of 42 bytes", [&] { check(0, 42, 0, {10, 5, 1}); });
  expect_broken("V-COPY-006", "images of 4 rows", [&] { check(0, 0, 4, {10, 5, 1}); });
  expect_broken("V-COPY-007", "offset 6, which is no multiple of a texel (4 bytes)", [&] { check(6, 0, 0, {1, 1, 1}); });
  expect_broken("V-BUF-007", "[4, 1004)", [&] { check(4, 0, 0, {10, 5, 5}); });
  EXPECT_EQ(check(0, 0, 0, {0, 5, 1}).bytes, 0u);
}

} // namespace
} // namespace mote::gpu
