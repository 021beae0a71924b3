// SPDX-License-Identifier: MIT
#include "app/window/presenter.hpp"

#include "passes/full_screen.hpp"

#include <algorithm>
#include <array>

namespace mote::window {
namespace {

// As in shaders/window/picture.frag.
constexpr std::uint32_t exact_mode = 0, stretched_mode = 1, sprite_mode = 2;

} // namespace

FlatPicture cropped(const FlatPicture& p) {
  std::uint32_t left = p.size.width, right = 0, top = p.size.height, bottom = 0;
  for (std::uint32_t y = 0; y < p.size.height; ++y)
    for (std::uint32_t x = 0; x < p.size.width; ++x) {
      if (p.rgba[(std::size_t{y} * p.size.width + x) * 4 + 3] == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = std::max(bottom, y + 1);
    }
  FlatPicture out;
  if (left >= right) return out;
  out.size = {right - left, bottom - top};
  out.x = p.x + static_cast<std::int32_t>(left);
  out.y = p.y + static_cast<std::int32_t>(top);
  for (std::uint32_t y = top; y < bottom; ++y) {
    const auto row = p.rgba.begin() + static_cast<std::ptrdiff_t>((std::size_t{y} * p.size.width + left) * 4);
    out.rgba.insert(out.rgba.end(), row, row + static_cast<std::ptrdiff_t>(std::size_t{out.size.width} * 4));
  }
  return out;
}

Presenter::Presenter(gpu::Device device) : device_(std::move(device)) {
  sampler_ = device_.create_sampler({.label = "window", .mag_filter = gpu::FilterMode::Linear, .min_filter = gpu::FilterMode::Linear});
  const std::array entries{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture},
                           gpu::BindGroupLayoutEntry{.binding = 1, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::Sampler}};
  layout_ = device_.create_bind_group_layout({.label = "window", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 1> layouts{&layout_};
  pipeline_layout_ = device_.create_pipeline_layout({.label = "window", .bind_group_layouts = layouts, .push_constant_size = 16});
}

gpu::BindGroup Presenter::group_of(const gpu::Texture& texture) {
  const gpu::TextureView view = texture.create_view();
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &view}, gpu::BindGroupEntry{.binding = 1, .sampler = &sampler_}};
  return device_.create_bind_group({.label = texture.label(), .layout = &layout_, .entries = entries});
}

const Presenter::Pipelines& Presenter::pipelines(gpu::TextureFormat format) {
  const auto found = pipelines_.find(format);
  if (found != pipelines_.end()) return found->second;
  const gpu::BlendComponent over{gpu::BlendFactor::SrcAlpha, gpu::BlendFactor::OneMinusSrcAlpha}, keep{gpu::BlendFactor::Zero, gpu::BlendFactor::One};
  const auto make = [&](std::string_view label, std::uint32_t mode) {
    std::array targets{gpu::ColorTargetState{.format = format}};
    if (mode == sprite_mode) targets[0].blend = gpu::BlendState{over, keep};
    const std::array constants{gpu::spec(0, mode)};
    return passes::full_screen_pipeline(device_, {.label = label, .layout = &pipeline_layout_, .fragment = "window/picture.frag", .constants = constants, .targets = targets});
  };
  return pipelines_[format] = {make("window.exact", exact_mode), make("window.stretched", stretched_mode), make("window.sprite", sprite_mode)};
}

void Presenter::set(const std::string& name, const FlatPicture& picture) {
  if (picture.size.width == 0 || picture.size.height == 0) {
    sprites_.erase(name);
    return;
  }
  Sprite& sprite = sprites_[name];
  if (sprite.size != picture.size) {
    sprite.texture = device_.create_texture({.label = name, .size = {picture.size.width, picture.size.height, 1}, .format = gpu::TextureFormat::RGBA8Unorm,
                                             .usage = gpu::TextureUsage::CopyDst | gpu::TextureUsage::Sampled});
    sprite.group = group_of(sprite.texture);
    sprite.size = picture.size;
  }
  sprite.x = picture.x;
  sprite.y = picture.y;
  device_.queue().write_texture({.texture = &sprite.texture}, std::as_bytes(std::span(picture.rgba)), picture.size.width * 4, picture.size.height, {picture.size.width, picture.size.height, 1});
}

void Presenter::push(gpu::RenderPass& pass, float x, float y, float across, float down) {
  const std::array block{x, y, across, down};
  pass.set_push_constants(0, std::as_bytes(std::span(block)));
}

gpu::Submission Presenter::compose(const gpu::Texture& target, const gpu::Texture& picture, const std::function<void(gpu::RenderPass&)>& further) {
  const gpu::Extent3d size = target.size();
  const Pipelines& with = pipelines(target.format());
  if (picture && picture != shown_) {
    shown_ = picture;
    shown_group_ = group_of(picture);
  }
  gpu::CommandEncoder encoder = device_.create_command_encoder("window");
  const gpu::TextureView view = target.create_view();
  const std::array colors{gpu::ColorAttachment{.view = &view, .load = picture ? gpu::LoadOp::DontCare : gpu::LoadOp::Clear, .clear = {0.2, 0.2, 0.2, 1}}};
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "window", .colors = colors});
  if (picture) {
    const bool exact = picture.size() == size;
    pass.set_pipeline(exact ? with.exact : with.stretched);
    pass.set_bind_group(0, shown_group_);
    push(pass, 0, 0, 1.0f / static_cast<float>(size.width), 1.0f / static_cast<float>(size.height));
    pass.draw(3);
  }
  for (const auto& [name, sprite] : sprites_) {
    const std::int32_t left = std::max(sprite.x, 0), top = std::max(sprite.y, 0);
    const std::int32_t right = std::min(sprite.x + static_cast<std::int32_t>(sprite.size.width), static_cast<std::int32_t>(size.width));
    const std::int32_t bottom = std::min(sprite.y + static_cast<std::int32_t>(sprite.size.height), static_cast<std::int32_t>(size.height));
    if (left >= right || top >= bottom) continue;
    pass.set_pipeline(with.sprite);
    pass.set_bind_group(0, sprite.group);
    push(pass, static_cast<float>(sprite.x), static_cast<float>(sprite.y), 1, 1);
    pass.set_scissor(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top), static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top));
    pass.draw(3);
  }
  if (!sprites_.empty()) pass.set_scissor(0, 0, size.width, size.height);
  if (further) further(pass);
  pass.end();
  return device_.queue().submit(encoder.finish());
}

} // namespace mote::window
