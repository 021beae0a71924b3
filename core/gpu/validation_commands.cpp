// SPDX-License-Identifier: MIT
// Rules for passes, draws, copies and queries.
#include "core/gpu/error.hpp"
#include "core/gpu/validation.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

std::string size_text(Extent3d s) { return fmt::format("{}x{}", s.width, s.height); }

Extent3d view_size(const ViewFacts& v) { return mip_extent(v.texture->size, v.texture->dimension, v.range.base_mip); }

void check_attachment(const AttachmentFacts& a, bool depth) {
  const ViewFacts& v = a.view;
  const std::string name = named("TextureView", v.label);
  check_usage(a.name, *v.texture, TextureUsage::RenderAttachment);
  if (v.dimension != TextureViewDimension::D2 || v.range.mips != 1 || v.range.layers != 1) {
    invalid("V-PASS-003", "{} is {} with dimension {}, {} mip levels and {} layers; an attachment is 2d, one level, one layer.", a.name, name,
            to_string(v.dimension), v.range.mips, v.range.layers);
  }
  if ((format_info(v.texture->format).kind == FormatKind::Depth) != depth) {
    invalid("V-PASS-004", "{} is {} with format {}, which is {}.", a.name, name, to_string(v.texture->format),
            depth ? "no depth format" : "a depth format");
  }
}

void check_resolve(const AttachmentFacts& color, const AttachmentFacts& target) {
  check_attachment(target, false);
  const ViewFacts &from = color.view, &to = target.view;
  if (from.texture->samples == 1 || to.texture->samples != 1 || from.texture->format != to.texture->format ||
      view_size(from) != view_size(to)) {
    invalid("V-PASS-008", "{} ({}, {} samples, {}) cannot be resolved to {} ({}, {} samples, {}).", named("TextureView", from.label),
            to_string(from.texture->format), from.texture->samples, size_text(view_size(from)), named("TextureView", to.label),
            to_string(to.texture->format), to.texture->samples, size_text(view_size(to)));
  }
}

} // namespace

PassFacts check_render_pass(const RenderPassFacts& p) {
  PassFacts facts;
  std::vector<const AttachmentFacts*> all;
  for (const AttachmentFacts& a : p.colors) {
    check_attachment(a, false);
    facts.targets.push_back(a.view.texture->format);
    all.push_back(&a);
  }
  if (p.depth) {
    check_attachment(*p.depth, true);
    facts.depth = p.depth->view.texture->format;
    facts.depth_read_only = p.depth_read_only;
    all.push_back(&*p.depth);
    if (p.depth_read_only && (p.depth_load != LoadOp::Load || p.depth_store != StoreOp::Store)) {
      invalid("V-PASS-007", "The depth attachment is read-only; it must be loaded and stored.");
    }
  }
  if (all.empty()) invalid("V-PASS-005", "The pass has neither a color nor a depth attachment.");
  facts.size = view_size(all[0]->view);
  facts.samples = all[0]->view.texture->samples;
  for (const AttachmentFacts* a : all) {
    const Extent3d size = view_size(a->view);
    if (size.width != facts.size.width || size.height != facts.size.height || a->view.texture->samples != facts.samples) {
      invalid("V-PASS-006", "{} ({}) is {} with {} samples; {} ({}) is {} with {} samples.", a->name, named("TextureView", a->view.label),
              size_text(size), a->view.texture->samples, all[0]->name, named("TextureView", all[0]->view.label), size_text(facts.size), facts.samples);
    }
  }
  for (std::size_t i = 0; i < p.resolves.size(); ++i) {
    if (p.resolves[i]) check_resolve(p.colors[i], *p.resolves[i]);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (all[i]->view.texture == all[k]->view.texture && overlap(all[i]->view.range, all[k]->view.range)) {
        invalid("V-PASS-009", "{} and {} are the same subresource of {}.", all[k]->name, all[i]->name, named("Texture", all[i]->view.texture->label));
      }
    }
  }
  return facts;
}

void check_pipeline_in_pass(const PassFacts& pass, const PipelineFacts& pipeline) {
  const std::string name = named("RenderPipeline", pipeline.label);
  if (pipeline.targets.size() != pass.targets.size()) {
    invalid("V-PASS-010", "{} has {} color targets; the pass has {} color attachments.", name, pipeline.targets.size(), pass.targets.size());
  }
  for (std::size_t i = 0; i < pass.targets.size(); ++i) {
    if (pipeline.targets[i] != pass.targets[i]) {
      invalid("V-PASS-010", "targets[{}] of {} is {}; colors[{}] of the pass is {}.", i, name, to_string(pipeline.targets[i]), i, to_string(pass.targets[i]));
    }
  }
  if (pipeline.depth != pass.depth) {
    invalid("V-PASS-011", "The depth format of {} is {}; that of the pass is {}.", name, to_string(pipeline.depth), to_string(pass.depth));
  }
  if (pipeline.samples != pass.samples) {
    invalid("V-PASS-012", "The sample count of {} is {}; that of the pass is {}.", name, pipeline.samples, pass.samples);
  }
  if (pipeline.depth_write && pass.depth_read_only) {
    invalid("V-PASS-013", "{} writes depth; the depth attachment of the pass is read-only.", name);
  }
}

std::uint64_t check_range(std::string_view what, const BufferFacts& buffer, std::uint64_t offset, std::uint64_t size, std::uint64_t alignment) {
  const std::string name = named("Buffer", buffer.label);
  if (offset % alignment != 0 || size % alignment != 0) {
    invalid("V-BUF-006", "For {} of {}, offset {} and size {} must be multiples of {}.", what, name, offset, size, alignment);
  }
  if (offset > buffer.size || size > buffer.size - offset) {
    invalid("V-BUF-007", "For {}, bytes [{}, {}) are not inside {}, which has {} bytes.", what, offset, offset + size, name, buffer.size);
  }
  return size != 0 ? size : buffer.size - offset;
}

void check_usage(std::string_view what, const BufferFacts& buffer, BufferUsage needed) {
  if (has(buffer.usage, needed)) return;
  invalid("V-BUF-008", "As {}, {} needs usage {}; it has {}.", what, named("Buffer", buffer.label), to_string(needed), to_string(buffer.usage));
}
void check_usage(std::string_view what, const TextureFacts& texture, TextureUsage needed) {
  if (has(texture.usage, needed)) return;
  invalid("V-TEX-009", "As {}, {} needs usage {}; it has {}.", what, named("Texture", texture.label), to_string(needed), to_string(texture.usage));
}

void check_vertex_range(const PipelineFacts& pipeline, std::uint32_t slot, std::uint64_t bound_bytes, std::uint64_t first, std::uint64_t count,
                        VertexStepMode step) {
  if (pipeline.vertex_steps[slot] != step || count == 0) return;
  const std::uint64_t stride = pipeline.vertex_strides[slot];
  if (stride == 0 || (first + count) * stride <= bound_bytes) return;
  invalid("V-DRAW-012", "{} [{}, {}) are drawn; vertex buffer {} holds {} of {} bytes.", step == VertexStepMode::Vertex ? "Vertices" : "Instances", first,
          first + count, slot, bound_bytes / stride, stride);
}

void check_query(std::string_view what, std::string_view set_label, QueryType type, std::uint32_t count, QueryType needed, std::uint64_t index) {
  const std::string name = named("QuerySet", set_label);
  if (type != needed) invalid("V-QRY-002", "For {}, {} must have type {}; it has {}.", what, name, to_string(needed), to_string(type));
  if (index >= count) invalid("V-QRY-002", "For {}, index {} is not inside {}, which has {}.", what, index, name, count);
}

void check_texture_copy(std::string_view what, const TextureFacts& t, std::uint32_t mip, Origin3d origin, Extent3d size) {
  const std::string name = named("Texture", t.label);
  if (t.samples != 1) invalid("V-COPY-003", "As {}, {} has {} samples; only textures of one sample are copied.", what, name, t.samples);
  if (mip >= t.mips) invalid("V-COPY-004", "As {}, mip level {} is not inside {}, which has {}.", what, mip, name, t.mips);
  const Extent3d level = mip_extent(t.size, t.dimension, mip);
  const auto inside = [](std::uint64_t begin, std::uint64_t length, std::uint32_t whole) { return begin + length <= whole; };
  if (!inside(origin.x, size.width, level.width) || !inside(origin.y, size.height, level.height) ||
      !inside(origin.z, size.depth_or_layers, level.depth_or_layers)) {
    invalid("V-COPY-005", "As {}, the region at ({}, {}, {}) of {}x{}x{} is not inside mip level {} of {}, which is {}x{}x{}.", what, origin.x, origin.y,
            origin.z, size.width, size.height, size.depth_or_layers, mip, name, level.width, level.height, level.depth_or_layers);
  }
}

CopyLayout check_buffer_copy(std::string_view what, const BufferFacts& buffer, std::uint64_t offset, std::uint32_t bytes_per_row,
                             std::uint32_t rows_per_image, TextureFormat format, Extent3d size) {
  const std::uint32_t texel = format_info(format).bytes;
  const std::uint64_t row = std::uint64_t{size.width} * texel;
  CopyLayout layout;
  layout.bytes_per_row = bytes_per_row != 0 ? bytes_per_row : static_cast<std::uint32_t>(row);
  layout.rows_per_image = rows_per_image != 0 ? rows_per_image : size.height;
  if (layout.bytes_per_row < row || layout.bytes_per_row % texel != 0 || layout.rows_per_image < size.height) {
    invalid("V-COPY-006", "As {}, {} has rows of {} bytes and images of {} rows; {}x{} texels of {} need at least {} bytes (a multiple of {}) and {} rows.",
            what, named("Buffer", buffer.label), layout.bytes_per_row, layout.rows_per_image, size.width, size.height, to_string(format), row, texel,
            size.height);
  }
  if (offset % texel != 0 || (format == TextureFormat::Depth32Float && offset % 4 != 0)) {
    invalid("V-COPY-007", "As {}, {} is used at offset {}, which is no multiple of a texel ({} bytes).", what, named("Buffer", buffer.label), offset, texel);
  }
  if (size.width == 0 || size.height == 0 || size.depth_or_layers == 0) return layout;
  const std::uint64_t image = std::uint64_t{layout.bytes_per_row} * layout.rows_per_image;
  layout.bytes = image * (size.depth_or_layers - 1) + std::uint64_t{layout.bytes_per_row} * (size.height - 1) + row;
  check_range(what, buffer, offset, layout.bytes, 1);
  return layout;
}

void check_texture_pair(const TextureFacts& src, const TextureFacts& dst) {
  if (src.format == dst.format) return;
  invalid("V-COPY-002", "The source {} has format {}; the destination {} has {}.", named("Texture", src.label), to_string(src.format),
          named("Texture", dst.label), to_string(dst.format));
}

SubresourceRange copy_range(const TextureFacts& texture, std::uint32_t mip, Origin3d origin, Extent3d size) {
  if (texture.dimension == TextureDimension::D3) return {mip, 1, 0, 1};
  return {mip, 1, origin.z, size.depth_or_layers};
}

} // namespace mote::gpu
