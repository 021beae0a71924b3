// SPDX-License-Identifier: MIT
// The format table and the names of enumerations.
#include "core/gpu/format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mote::gpu {
namespace {

TEST(Format, names_and_formats_go_both_ways) {
  const auto names = format_names();
  EXPECT_EQ(names.size(), format_count - 1);
  for (const std::string& name : names) {
    const auto format = parse_format(name);
    ASSERT_TRUE(format) << name;
    EXPECT_EQ(to_string(*format), name);
    EXPECT_EQ(format_info(*format).format, *format);
  }
  EXPECT_FALSE(parse_format("undefined"));
  EXPECT_FALSE(parse_format("rgba16f"));
}

TEST(Format, bytes) {
  const std::pair<TextureFormat, int> sizes[] = {{TextureFormat::R8Unorm, 1},    {TextureFormat::RGBA8Unorm, 4},   {TextureFormat::RGBA16Unorm, 8},
                                                 {TextureFormat::R16Float, 2},   {TextureFormat::RGBA16Float, 8},  {TextureFormat::RG32Float, 8},
                                                 {TextureFormat::RGBA32Uint, 16}, {TextureFormat::Depth32Float, 4}};
  for (const auto& [format, bytes] : sizes) EXPECT_EQ(format_info(format).bytes, bytes) << to_string(format);
}

TEST(Format, values_out_of_range_are_undefined) {
  EXPECT_EQ(format_info(static_cast<TextureFormat>(200)).format, TextureFormat::Undefined);
  EXPECT_EQ(to_string(static_cast<Topology>(99)), "(out of range)");
}

TEST(Format, mip_levels) {
  EXPECT_EQ(mip_extent({13, 7, 5}, TextureDimension::D2, 1), (Extent3d{6, 3, 5}));
  EXPECT_EQ(mip_extent({13, 7, 5}, TextureDimension::D3, 2), (Extent3d{3, 1, 1}));
  EXPECT_EQ(mip_extent({13, 7, 5}, TextureDimension::D2, 40), (Extent3d{1, 1, 5}));
  EXPECT_EQ(max_mip_levels({256, 16, 1}, TextureDimension::D2), 9u);
  EXPECT_EQ(max_mip_levels({4, 4, 64}, TextureDimension::D3), 7u);
  EXPECT_EQ(max_mip_levels({4, 4, 64}, TextureDimension::D2), 3u);
}

TEST(Types, flags_print_as_their_names) {
  EXPECT_EQ(to_string(BufferUsage::CopySrc | BufferUsage::Storage), "CopySrc|Storage");
  EXPECT_EQ(to_string(Feature::None), "None");
  EXPECT_EQ(to_string(Feature::GeometryShader | Feature::DepthClamp), "GeometryShader|DepthClamp");
  EXPECT_EQ(to_string(ShaderStage::Vertex | ShaderStage::Geometry), "Vertex|Geometry");
  EXPECT_EQ(to_string(TextureViewDimension::D2Array), "2d_array");
  EXPECT_EQ(to_string(BlendFactor::OneMinusSrcAlpha), "one_minus_src_alpha");
  EXPECT_EQ(to_string(CompareFunction::GreaterEqual), "greater_equal");
  EXPECT_EQ(to_string(BindingType::ReadOnlyStorageBuffer), "ReadOnlyStorageBuffer");
}

} // namespace
} // namespace mote::gpu
