// SPDX-License-Identifier: MIT
// The order of transparent particles is made again only where something changed that it depends on.
#include "harness.hpp"

#include "passes/particles/ordered_store.hpp"

namespace mote::test {
namespace {

using passes::Opacity;
using passes::Order;

class OrderedStoreTest : public GpuTest {
protected:
  OrderedStoreTest() : scene_(scene_of(cloud(300, 5, 0.2, 0.6))) {
    scene_.batches[0].alpha = 0.5;
    view_ = look(scene_, {3, 4, 20}, {0, 0, 0}, {64, 36});
  }
  bool update() { return store_.update(scene_, view_, selection_, order_); }
  // Made again once, and then not any more.
  void expect_once(const char* what) {
    EXPECT_TRUE(update()) << what;
    EXPECT_FALSE(update()) << what;
  }

  Scene scene_;
  View view_;
  passes::Selection selection_{{}, Opacity::Transparent};
  Order order_{Order::BackToFront};
  passes::OrderedStore store_{device()};
};

TEST_F(OrderedStoreTest, SortsOnlyWhereSomethingMoved) {
  expect_once("the first frame");
  const std::vector<std::uint32_t> before = store_.particles().order;
  scene_ = Scene(scene_);
  EXPECT_FALSE(update()) << "an equal scene is the same";
  scene_.background = {0, 0, 0, 1};
  scene_.lights[0].intensity = 0.1;
  EXPECT_FALSE(update()) << "neither background nor lights are in the order";
  view_ = look(scene_, {-3, 4, -20}, {0, 0, 0}, {64, 36});
  expect_once("the camera");
  EXPECT_NE(store_.particles().order, before);
  scene_.batches[0].instances[0].world_from_data[3][0] = 1.0;
  expect_once("an instance");
  scene_.batches[0].alpha = 0.25;
  expect_once("opacity, which lies in the rows");
  scene_.batches[0].material.diffuse = 0.5;
  expect_once("a material");
  order_ = Order::FrontToBack;
  expect_once("the order");
  selection_.opacity = Opacity::All;
  EXPECT_FALSE(update()) << "another selection of the same particles";
  scene_.batches[0].chunks = std::make_shared<ChunkSet>(*scene_.batches[0].chunks);
  expect_once("the data: the next frame of a series");
}

} // namespace
} // namespace mote::test
