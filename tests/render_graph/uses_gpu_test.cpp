// SPDX-License-Identifier: MIT
// Declared against observed: a pass that touches what it did not declare is found before anything is
// submitted; what it declares and never uses is a note.
#include "gpu_kinds.hpp"

namespace mote::rg::test {
namespace {

using testing::Each;
using testing::HasSubstr;

class UsesTest : public GpuTest {};

// A pass that samples what it was not given: the view comes from another pass by the back door.
struct BackDoor {
  std::shared_ptr<gpu::TextureView> view = std::make_shared<gpu::TextureView>();
  Registry registry(bool open) const {
    Registry r = basics();
    Functions giver = fill();
    giver.record = [view = view](PassContext& c) { *view = c.texture("color"); };
    add(r, "giver", giver);
    Functions thief = add_one();
    thief.record = [view = view, open, record = thief.record, draw = std::make_shared<FullScreen>()](PassContext& c) {
      if (!open) return record(c);
      if (!draw->pipeline)
        *draw = FullScreen(c.device(), "layout(set=0, binding=0) uniform texture2D source; layout(location=0) out float color;\nvoid main() { color = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r; }",
                           {.format = c.format("color")}, {texture_entry});
      draw->draw(c, {{.binding = 0, .texture = view.get()}});
    };
    add(r, "thief", thief);
    return r;
  }
};
const std::string back_door_graph = "name = 'door'\noutput = 'c.color'\n" + pass("a", "giver") + pass("b", "fill") + pass("c", "thief", "source = 'b.color'") +
                                    pass("d", "add", "source = 'a.color'");

TEST_F(UsesTest, WhatAPassDidNotDeclareIsFoundBeforeAnythingIsSubmitted) {
  const CompileOptions keep_a{.roots = {{"d.color", {"--dump"}}}};
  auto good = make(BackDoor().registry(false), back_door_graph, keep_a);
  good->execute({}, {2, 2});
  EXPECT_THAT(read<float>(good->output()), Each(6.0f));
  EXPECT_THAT(to_string(good->unused_slots()), testing::IsEmpty());
  auto bad = make(BackDoor().registry(true), back_door_graph, keep_a);
  try {
    bad->execute({}, {2, 2});
    FAIL() << "nobody noticed";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit(), Exit::Failed);
    EXPECT_THAT(failure.what(), HasSubstr("door: error G072: pass 'c' (kind 'thief') used the texture 'a.color' as Sampled, which it did not declare."));
    EXPECT_THAT(failure.what(), HasSubstr("it declared of it: (none)"));
  }
}

TEST_F(UsesTest, TheCheckCanBeSwitchedOff) {
  Diagnostics found;
  const GraphDesc desc = parse_graph("schema = 1\n" + back_door_graph, "g.toml", found);
  CompileResult result = compile(desc, BackDoor().registry(true), {.roots = {{"d.color", {"--dump"}}}}, found);
  ASSERT_TRUE(result.plan);
  Executor executor(device_, *result.plan, result.passes, {.check_uses = false});
  executor.execute({}, {2, 2});
  EXPECT_THAT(to_string(executor.unused_slots()), testing::IsEmpty());
  EXPECT_THAT(read<float>(executor.output()), Each(5.0f));
}

// Writing through a read-only declaration.
TEST_F(UsesTest, AWriteToWhatIsDeclaredAsReadIsFound) {
  Registry r;
  const ResourceSpec four = BufferSpec{.record_bytes = 4, .count = 4};
  add(r, "make", compute_kind({.name = "data", .access = Access::StorageWrite, .makes = four}, "data[i] = i;", 4));
  const auto reader = [&](const std::string& name, bool writes) {
    Functions f;
    f.declare = [](auto& slots, Params&) {
      slots.push_back({.name = "data", .access = Access::StorageRead, .buffer = true});
      slots.push_back(color_out());
    };
    f.update = [writes](PassContext& c) {
      if (writes) c.encoder().clear_buffer(c.buffer("data"));
    };
    add(r, name, f);
  };
  reader("looks", false);
  reader("clears", true);
  auto unused = make(r, "output = 'b.color'\n" + pass("a", "make") + pass("b", "looks", "data = 'a.data'"));
  unused->execute({}, {2, 2});
  EXPECT_THAT(to_string(unused->unused_slots()), testing::AllOf(HasSubstr("note G073: pass 'b' (kind 'looks') declares the slot 'data' as storage read, but has not used it in any frame."),
                                                              testing::Not(HasSubstr("'color'"))));
  auto wrong = make(r, "output = 'b.color'\n" + pass("a", "make") + pass("b", "clears", "data = 'a.data'"));
  try {
    wrong->execute({}, {2, 2});
    FAIL() << "nobody noticed";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("G072: pass 'b' (kind 'clears') used the buffer 'a.data' as CopyDst, which it did not declare."));
    EXPECT_THAT(failure.what(), HasSubstr("it declared of it: slot 'data' as storage read"));
  }
}

} // namespace
} // namespace mote::rg::test
