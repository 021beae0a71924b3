// SPDX-License-Identifier: MIT
// Puts a frame of the window together: the scene's picture stretched over the target, flat pictures (legends, texts) over that
// at their places, and whatever draws behind them (panels). The target is a picture of a swapchain, or any texture that can
// be rendered to. Knows nothing of scenes.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/math/camera.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace mote::window {

// RGBA8, straight alpha, as displayed; (x, y) is where its top left pixel comes on the target.
struct FlatPicture {
  Size2d size{};
  std::int32_t x{}, y{};
  std::vector<std::uint8_t> rgba{};
};
// The part of a picture that is not empty; 0x0 when all of it is.
FlatPicture cropped(const FlatPicture& picture);

class Presenter {
public:
  explicit Presenter(gpu::Device device);

  // A flat picture by name, drawn with every frame from now on, in the order of names; an empty one is taken away.
  void set(const std::string& name, const FlatPicture& picture);

  // Records, submits and returns; `further` draws into the same pass afterwards.
  gpu::Submission compose(const gpu::Texture& target, const gpu::Texture& picture, const std::function<void(gpu::RenderPass&)>& further = {});

private:
  struct Sprite {
    gpu::Texture texture{};
    gpu::BindGroup group{};
    std::int32_t x{}, y{};
    Size2d size{};
  };
  struct Pipelines { // of one format of targets
    gpu::RenderPipeline exact{}, stretched{}, sprite{};
  };
  const Pipelines& pipelines(gpu::TextureFormat format);
  gpu::BindGroup group_of(const gpu::Texture& texture);
  static void push(gpu::RenderPass& pass, float x, float y, float across, float down);

  gpu::Device device_;
  gpu::Sampler sampler_{};
  gpu::BindGroupLayout layout_{};
  gpu::PipelineLayout pipeline_layout_{};
  std::map<gpu::TextureFormat, Pipelines> pipelines_{};
  std::map<std::string, Sprite> sprites_{};
  gpu::Texture shown_{}; // that shown_group_ is of
  gpu::BindGroup shown_group_{};
};

} // namespace mote::window
