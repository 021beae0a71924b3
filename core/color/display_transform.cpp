// SPDX-License-Identifier: MIT
#include "core/color/display_transform.hpp"

#include "core/color/display_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote {

namespace {
void run(const OCIO::ConstCPUProcessorRcPtr& cpu, std::span<float> values, long channels) {
  OCIO::PackedImageDesc picture(values.data(), static_cast<long>(values.size()) / channels, 1, channels);
  cpu->apply(picture);
}

float without_nan(float v) { return std::isnan(v) ? 0.0f : v; }

// The frame around every view transform; `transform` sees guarded colors and alpha 1.
template <class F> void guarded(std::span<float> rgba, float gain, F&& transform) {
  std::vector<float> alpha(rgba.size() / 4);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    float* p = &rgba[4 * i];
    for (int k = 0; k < 3; ++k) p[k] = std::clamp(without_nan(p[k]) * gain, -display_limit, display_limit);
    alpha[i] = std::clamp(without_nan(p[3]), 0.0f, 1.0f);
    p[3] = 1.0f;
  }
  transform(rgba);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    float* p = &rgba[4 * i];
    for (int k = 0; k < 3; ++k) p[k] = std::clamp(without_nan(p[k]), 0.0f, 1.0f);
    p[3] = alpha[i];
  }
}

bool is_diagonal(const OCIO::ConstTransformRcPtr& transform) {
  double m[16], offset[4];
  const auto matrix = OCIO_DYNAMIC_POINTER_CAST<const OCIO::MatrixTransform>(transform);
  if (!matrix) return false;
  matrix->getMatrix(m);
  matrix->getOffset(offset);
  for (int i = 0; i < 16; ++i)
    if (i % 5 != 0 && m[i] != 0.0) return false;
  return m[15] == 1.0 && offset[3] == 0.0;
}

// Cost of a per-channel operation on a CPU device, in powers of one channel; nothing when it mixes
// channels or is a texture already. A table costs about as much as two powers.
std::optional<int> separable_cost(const OCIO::ConstTransformRcPtr& transform) {
  switch (transform->getTransformType()) {
  case OCIO::TRANSFORM_TYPE_LOG:
  case OCIO::TRANSFORM_TYPE_LOG_AFFINE:
  case OCIO::TRANSFORM_TYPE_LOG_CAMERA:
  case OCIO::TRANSFORM_TYPE_EXPONENT:
  case OCIO::TRANSFORM_TYPE_EXPONENT_WITH_LINEAR: return 1;
  case OCIO::TRANSFORM_TYPE_GRADING_RGB_CURVE: return 8;
  case OCIO::TRANSFORM_TYPE_RANGE: return 0;
  case OCIO::TRANSFORM_TYPE_MATRIX: return is_diagonal(transform) ? std::optional(0) : std::nullopt;
  default: return std::nullopt;
  }
}

struct Run {
  int first{}, last{}; // operations [first, last)
  bool table{};
};

// Cuts a list of operations into runs; only a run of per-channel operations that costs more than a
// table becomes one, and leading operations that cost nothing stay outside (a range has a kink).
std::vector<Run> find_runs(const OCIO::GroupTransform& group) {
  constexpr int worth = 3;
  std::vector<Run> runs;
  auto arithmetic = [&](int first, int last) {
    if (first == last) return;
    if (!runs.empty() && !runs.back().table)
      runs.back().last = last;
    else
      runs.push_back({first, last, false});
  };
  const int count = group.getNumTransforms();
  for (int i = 0; i < count;) {
    int end = i, cost = 0, start = -1;
    for (; end < count; ++end) {
      const auto c = separable_cost(group.getTransform(end));
      if (!c) break;
      cost += *c;
      if (*c > 0 && start < 0) start = end;
    }
    if (cost >= worth) {
      arithmetic(i, start);
      runs.push_back({start, end, true});
    } else {
      end = std::max(end, i + 1);
      arithmetic(i, end);
    }
    i = end;
  }
  return runs;
}

DisplayPiece make_piece(const OCIO::Config& config, const OCIO::GroupTransform& all, const Run& part) {
  const OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
  for (int i = part.first; i < part.last; ++i)
    group->appendTransform(all.getTransform(i)->createEditableCopy());
  DisplayPiece piece;
  piece.processor = config.getProcessor(group);
  piece.cpu = piece.processor->getDefaultCPUProcessor();
  if (part.table) piece.table.emplace([&](std::span<float> rgb) { run(piece.cpu, rgb, 3); });
  return piece;
}

// Empty when nothing is worth a table, or when a table cannot stand for the arithmetic.
std::vector<DisplayPiece> bake(const OCIO::Config& config, const OCIO::ConstProcessorRcPtr& processor) {
  const auto group = processor->getOptimizedProcessor(OCIO::OPTIMIZATION_DEFAULT)->createGroupTransform();
  const std::vector<Run> runs = find_runs(*group);
  std::vector<DisplayPiece> pieces;
  if (std::none_of(runs.begin(), runs.end(), [](const Run& r) { return r.table; })) return pieces;
  for (const Run& part : runs) {
    pieces.push_back(make_piece(config, *group, part));
    if (pieces.back().table && !pieces.back().table->usable()) return {};
  }
  return pieces;
}

void run_pieces(const std::vector<DisplayPiece>& pieces, std::span<float> rgba) {
  for (const DisplayPiece& piece : pieces) {
    if (!piece.table) {
      run(piece.cpu, rgba, 4);
      continue;
    }
    for (std::size_t i = 0; i < rgba.size(); ++i)
      if (i % 4 != 3) rgba[i] = (*piece.table)(static_cast<std::uint32_t>(i % 4), rgba[i]);
  }
}

double largest_difference(const DisplayTransform::Inner& inner) {
  std::vector<float> exact = bake_grid(), baked = exact;
  guarded(exact, 1.0f, [&](std::span<float> rgba) { run(inner.cpu, rgba, 4); });
  guarded(baked, 1.0f, [&](std::span<float> rgba) { run_pieces(inner.pieces, rgba); });
  double largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    largest = std::max(largest, std::fabs(double{exact[i]} - double{baked[i]}));
  return largest * 255.0;
}
} // namespace

std::vector<float> bake_grid() {
  std::vector<float> axis{-0.1f, -0.03f, -0.01f, -0.001f, 0.0f};
  for (int k = 0; k < 28; ++k) axis.push_back(static_cast<float>(0.001 * std::pow(64000.0, k / 27.0)));
  std::vector<float> rgba;
  rgba.reserve((axis.size() * axis.size() * axis.size() + 1000) * 4);
  for (const float b : axis)
    for (const float g : axis)
      for (const float r : axis) rgba.insert(rgba.end(), {r, g, b, 1.0f});
  for (int i = 0; i < 1000; ++i) {
    const auto grey = static_cast<float>(i < 100 ? -0.001 * i : 0.001 * std::pow(64000.0, (i - 100) / 899.0));
    rgba.insert(rgba.end(), {grey, grey, grey, 1.0f});
  }
  return rgba;
}

DisplayTransform make_display_transform(const ColorConfig& config, const DisplayRequest& request) {
  auto inner = std::make_shared<DisplayTransform::Inner>();
  inner->loc = request.loc;
  inner->display = request.display.empty() ? config.default_display() : request.display;
  config.check_display(inner->display, request.loc);
  inner->view = request.view.empty() ? config.default_view(inner->display) : request.view;
  config.check_view(inner->display, inner->view, request.loc);
  inner->source_space = request.source_space.empty() ? config.working_space() : request.source_space;
  config.check_color_space(inner->source_space, request.loc);
  inner->gain = std::exp2(request.exposure);
  if (!std::isfinite(request.exposure) || inner->gain > 1e30 || inner->gain < 1e-30)
    fail(Exit::BadInput, "C009", request.loc,
         fmt::format("the exposure '{}' is not a number of stops between -99 and 99", request.exposure));
  const std::string what = fmt::format("OpenColorIO cannot build the view transform '{}' of the display '{}'",
                                       inner->view, inner->display);
  with_ocio("C007", request.loc, what, [&] {
    const OCIO::ConstConfigRcPtr& ocio = config.inner().config;
    const auto transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(inner->source_space.c_str());
    transform->setDisplay(inner->display.c_str());
    transform->setView(inner->view.c_str());
    inner->processor = ocio->getProcessor(transform);
    inner->cpu = inner->processor->getDefaultCPUProcessor();
    if (!request.exact) inner->pieces = bake(*ocio, inner->processor);
    if (!inner->pieces.empty()) inner->baked_error = largest_difference(*inner);
    if (!(inner->baked_error <= 1.0)) inner->pieces.clear();
    if (inner->pieces.empty()) {
      inner->baked_error = 0;
      inner->pieces.push_back({inner->processor, inner->cpu, std::nullopt});
    }
  });
  return DisplayTransform(std::move(inner));
}

const std::string& DisplayTransform::display() const { return inner_->display; }
const std::string& DisplayTransform::view() const { return inner_->view; }
const std::string& DisplayTransform::source_space() const { return inner_->source_space; }
double DisplayTransform::gain() const { return inner_->gain; }
double DisplayTransform::baked_error() const { return inner_->baked_error; }
bool DisplayTransform::baked() const {
  return std::any_of(inner_->pieces.begin(), inner_->pieces.end(),
                     [](const DisplayPiece& piece) { return piece.table.has_value(); });
}

std::string DisplayTransform::describe() const {
  if (!baked()) return fmt::format("{} / {}, OpenColorIO's arithmetic", display(), view());
  return fmt::format("{} / {}, baked: at most {:.3f} of 1/255 from OpenColorIO's arithmetic", display(),
                     view(), baked_error());
}

void DisplayTransform::apply(std::span<float> rgba) const {
  if (rgba.empty()) return;
  guarded(rgba, static_cast<float>(inner_->gain), [&](std::span<float> all) { run(inner_->cpu, all, 4); });
}

void DisplayTransform::apply_baked(std::span<float> rgba) const {
  if (rgba.empty()) return;
  guarded(rgba, static_cast<float>(inner_->gain),
          [&](std::span<float> all) { run_pieces(inner_->pieces, all); });
}

} // namespace mote
