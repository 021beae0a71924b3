// SPDX-License-Identifier: MIT
// What a reference picture holds: simple scenes with known answers, ambiguity, errors.
#include "core/base/diagnostic.hpp"
#include "core/reference/reference.hpp"
#include "scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace mote {
namespace {

using namespace mote::test;
using ::testing::HasSubstr;

constexpr Size2d odd{33, 33};
constexpr std::size_t middle = 16 * 33 + 16;

View ahead(double near_cut = 0.0, double far_cut = 0.0) { // along +y from (0, -5, 0)
  View view = look({0, -5, 0}, {0, 0, 0}, odd);
  view.near_cut = near_cut;
  view.far_cut = far_cut;
  return view;
}

Failure failure_of(const Scene& scene, const ReferenceOptions& options = {}) {
  try {
    (void)render_reference(scene, ahead(), options);
  } catch (const Failure& failure) {
    return failure;
  }
  ADD_FAILURE() << "nothing failed";
  return {Exit::Done, {}};
}

TEST(ReferencePicture, OneSphereInTheMiddle) {
  const ReferencePicture p = render_reference(scene_of({{{0, 0, 0}, 1.0}}), ahead());
  EXPECT_EQ(p.id[middle], 0u);
  EXPECT_NEAR(p.depth[middle], 4.0, 1e-14);
  EXPECT_NEAR(glm::distance(p.normal[middle], glm::dvec3(0, -1, 0)), 0.0, 1e-14);
  EXPECT_EQ(p.ambiguous[middle], 0);
  EXPECT_EQ(p.id[0], reference_no_id);
  EXPECT_TRUE(std::isinf(p.depth[0]) && p.depth[0] > 0);
  EXPECT_EQ(p.normal[0], glm::dvec3(0));
  EXPECT_FLOAT_EQ(p.projected_radius[middle], static_cast<float>(ahead().focal / 5.0));
  EXPECT_EQ(p.projected_radius[0], 0.0f);
  EXPECT_EQ(p.color[0], glm::dvec4(1));
}

TEST(ReferencePicture, CutSphereShowsItsInside) {
  const Scene scene = scene_of({{{0, 0, 0}, 1.0}});
  const ReferencePicture cut = render_reference(scene, ahead(4.5));
  EXPECT_NEAR(cut.depth[middle], 6.0, 1e-14);
  EXPECT_NEAR(glm::distance(cut.normal[middle], glm::dvec3(0, -1, 0)), 0.0, 1e-14) << "turned to the eye";
  EXPECT_EQ(render_reference(scene, ahead(6.5)).id[middle], reference_no_id);
  EXPECT_EQ(render_reference(scene, ahead(0, 3.9)).id[middle], reference_no_id);
  EXPECT_EQ(render_reference(scene, ahead(4.5, 5.9)).id[middle], reference_no_id)
      << "entry and exit both cut away";
}

TEST(ReferencePicture, BehindTheEyeNothingShows) {
  const ReferencePicture p = render_reference(scene_of({{{0, -9, 0}, 1.0}}), ahead());
  EXPECT_EQ(std::count(p.id.begin(), p.id.end(), reference_no_id), 33 * 33);
}

TEST(ReferencePicture, EmptyScenes) {
  Scene scene;
  scene.background = {0.1, 0.2, 0.3, 0.5};
  const ReferencePicture p = render_reference(scene, ahead());
  ASSERT_EQ(p.id.size(), 33u * 33u);
  EXPECT_EQ(p.id[middle], reference_no_id);
  EXPECT_EQ(p.color[middle], scene.background);
  EXPECT_EQ(p.ambiguous[middle], 0);
  EXPECT_EQ(render_reference(scene_of({}), ahead()).id[middle], reference_no_id);
  Scene unused = scene_of({{{0, 0, 0}, 0.0}});
  EXPECT_EQ(render_reference(unused, ahead()).id[middle], reference_no_id) << "radius 0 draws as nothing";
}

TEST(ReferencePicture, TransparentParticlesAreLeftOutAndCounted) {
  Scene scene = scene_of({{{0, -2, 0}, 0.5}, {{0, 0, 0}, 1.0}});
  auto chunks = std::make_shared<ChunkSet>(*scene.batches[0].chunks);
  chunks->colors.assign(chunks->record_count(), 0xFFFFFFFFu);
  chunks->colors[0] = 0x80FFFFFFu;
  scene.batches[0].chunks = chunks;
  const ReferencePicture p = render_reference(scene, ahead());
  EXPECT_EQ(p.id[middle], 1u);
  EXPECT_EQ(p.transparent, 1u);
  scene.batches[0].alpha = 0.5;
  const ReferencePicture none = render_reference(scene, ahead());
  EXPECT_EQ(none.id[middle], reference_no_id);
  EXPECT_EQ(none.transparent, 2u);
}

TEST(ReferencePicture, IdsCountInstancesAndBase) {
  Scene scene = scene_of({{{5, 0, 0}, 0.1}, {{0, 0, 0}, 1.0}},
                         {glm::translate(glm::dmat4(1), glm::dvec3(20, 0, 0)), glm::dmat4(1)});
  scene.batches[0].id_base = 100;
  scene.batches[0].row_count = 7; // skipped rows keep their numbers
  EXPECT_EQ(render_reference(scene, ahead()).id[middle], 100u + 7u + 1u);
  scene.batches[0].instances[1].world_from_data = glm::scale(glm::dmat4(1), glm::dvec3(2));
  const View parallel = look_parallel({0, -5, 0}, {0, 0, 0}, odd, 11.0);
  EXPECT_FLOAT_EQ(render_reference(scene, parallel).projected_radius[middle], 6.0f)
      << "3 px a unit, radius 2";
}

TEST(ReferencePicture, TiesGoToTheLowestIdAndAreAmbiguous) {
  const Scene scene = scene_of({{{0, 0, 0}, 1.0}}, {glm::dmat4(1), glm::dmat4(1), glm::dmat4(1)});
  const ReferencePicture p = render_reference(scene, ahead());
  EXPECT_EQ(p.id[middle], 0u);
  EXPECT_EQ(p.ambiguous[middle], 1);
}

TEST(ReferencePicture, SurfacesWithinFourUlpAreAmbiguous) {
  const double ulp = 0x1p-21; // of a float32 in [4, 8)
  for (const auto& [gap, expected] : {std::pair{3.0, 1}, std::pair{6.0, 0}}) {
    Scene scene = scene_of({{{0, 0, 0}, 1.0}});
    Scene other = scene_of({{{0, gap * ulp, 0}, 1.0}});
    scene.batches.push_back(other.batches[0]);
    scene.batches[1].id_base = 1;
    View view = ahead();
    view.focal *= 1e4; // slopes do not matter within 1e-3 px
    EXPECT_EQ(render_reference(scene, view).ambiguous[middle], expected) << gap;
  }
}

TEST(ReferencePicture, CutsThroughASurfaceAreAmbiguous) {
  const Scene scene = scene_of({{{0, 0, 0}, 1.0}});
  EXPECT_EQ(render_reference(scene, ahead(4.0)).ambiguous[middle], 1);
  EXPECT_EQ(render_reference(scene, ahead(4.0 + 1e-5)).ambiguous[middle], 0);
  EXPECT_EQ(render_reference(scene, ahead(0, 4.0)).ambiguous[middle], 1);
  EXPECT_EQ(render_reference(scene, ahead(0, 4.0 - 1e-5)).ambiguous[middle], 0);
  EXPECT_EQ(render_reference(scene, ahead(0, 4.0 + 9e-7)).ambiguous[middle], 1) << "2 ulp beyond the surface";
  EXPECT_EQ(render_reference(scene, ahead(6.0)).ambiguous[middle], 1);
  const Scene touching = scene_of({{{0, -4, 0}, 1.0}}); // the eye is on its surface
  EXPECT_EQ(render_reference(touching, ahead()).ambiguous[middle], 1);
}

// Where the near cut crosses a surface the id stays and the depth jumps from the outside to the inside.
TEST(ReferencePicture, TheRimOfACutIsAmbiguous) {
  const Scene scene = scene_of({{{0, 0, 0}, 1.0}});
  View view = look_parallel({0, -5, 0}, {0, 0, 0}, odd, 0.33); // 100 px a unit
  view.near_cut = 4.5;
  const double rim = std::sqrt(0.75) * view.focal;
  for (const auto& [inside, expected] : {std::pair{-3e-3, 0}, {-0.5e-3, 1}, {0.5e-3, 1}, {3e-3, 0}}) {
    view.sample_offset = {0.5 + rim - inside, 0.5};
    const ReferencePicture p = render_reference(scene, view);
    EXPECT_EQ(p.ambiguous[middle], expected) << inside;
    EXPECT_EQ(p.id[middle], 0u);
    EXPECT_NEAR(p.depth[middle], inside > 0 ? 5.5 : 4.5, 1e-3);
  }
}

// The flag of the joint walk equals what four more pictures say.
TEST(ReferencePicture, AmbiguityEqualsShiftedPictures) {
  const Scene scene = scene_of(random_balls(4000, 20.0, 0.3, 0.8));
  std::ptrdiff_t found = 0;
  for (View view :
       {look({50, -20, 30}, {0, 0, 0}, {200, 150}), look_parallel({50, -20, 30}, {0, 0, 0}, {200, 150}, 40),
        look({0, 0, 0}, {0, 1, 0}, {200, 150}, 90)}) {
    const ReferencePicture p = render_reference(scene, view);
    std::vector<std::uint8_t> expected(p.id.size());
    for (const glm::dvec2& shift :
         {glm::dvec2(1e-3, 0), glm::dvec2(-1e-3, 0), glm::dvec2(0, 1e-3), glm::dvec2(0, -1e-3)}) {
      View moved = view;
      moved.sample_offset += shift;
      const ReferencePicture q = render_reference(scene, moved);
      for (std::size_t i = 0; i < expected.size(); ++i)
        if (q.id[i] != p.id[i]) expected[i] = 1;
    }
    found += std::count(expected.begin(), expected.end(), 1);
    EXPECT_EQ(std::mismatch(expected.begin(), expected.end(), p.ambiguous.begin()).first, expected.end());
  }
  EXPECT_GT(found, 40);
}

TEST(ReferencePicture, OptionsLeaveArraysOut) {
  ReferenceOptions options;
  options.ids = options.ambiguity = options.normals = options.colors = false;
  const ReferencePicture p = render_reference(scene_of({{{0, 0, 0}, 1.0}}), ahead(), options);
  EXPECT_TRUE(p.id.empty() && p.ambiguous.empty() && p.normal.empty() && p.projected_radius.empty() &&
              p.color.empty());
  EXPECT_NEAR(p.depth[middle], 4.0, 1e-14);
}

TEST(ReferencePicture, UnknownTypeIsRefused) {
  Scene scene = scene_of({{{0, 0, 0}, 1.0}});
  scene.batches[0].type = "spere";
  const Failure failure = failure_of(scene);
  EXPECT_EQ(failure.diagnostic().code, "R001");
  EXPECT_EQ(failure.exit(), Exit::BadInput);
  EXPECT_THAT(failure.what(), HasSubstr("'spere'"));
  EXPECT_THAT(failure.what(), HasSubstr("Did you mean 'sphere'?"));
}

TEST(ReferencePicture, SingularInstanceIsRefused) {
  const Failure failure =
      failure_of(scene_of({{{0, 0, 0}, 1.0}}, {glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0))}));
  EXPECT_EQ(failure.diagnostic().code, "R002");
  EXPECT_THAT(failure.what(), HasSubstr("instance 0"));
}

TEST(ReferencePicture, TooManyParticlesForIds) {
  Scene scene = scene_of({{{0, 0, 0}, 1.0}});
  scene.batches[0].id_base = 0xFFFFFFFDull; // ids below 2^32 - 2
  EXPECT_EQ(render_reference(scene, ahead()).id[middle], 0xFFFFFFFDu);
  scene.batches[0].id_base += 1;
  const Failure failure = failure_of(scene);
  EXPECT_EQ(failure.diagnostic().code, "R003");
  EXPECT_THAT(failure.what(), HasSubstr("4294967295"));
  ReferenceOptions options;
  options.ids = false;
  EXPECT_NEAR(render_reference(scene, ahead(), options).depth[middle], 4.0, 1e-14);
}

} // namespace
} // namespace mote
