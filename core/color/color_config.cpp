// SPDX-License-Identifier: MIT
#include "core/color/color_config.hpp"

#include "core/color/default_config.hpp"
#include "core/color/ocio_bridge.hpp"
#include "core/color/srgb.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace mote {

namespace {
// Names under which configs in use carry Linear Rec.709 (ACES CG and studio configs, Blender, older ACES).
constexpr std::array<const char*, 8> rec709_names{
    "Linear Rec.709", "Linear Rec.709 (sRGB)",   "lin_rec709", "lin_rec709_scene",
    "Linear BT.709",  "Utility - Linear - sRGB", "lin_srgb",   "Linear sRGB"};

void find_working_space(ColorConfig::Inner& inner) {
  for (const char* name : rec709_names)
    if (const OCIO::ConstColorSpaceRcPtr space = inner.config->getColorSpace(name)) {
      inner.working_space = space->getName();
      inner.working_is_rec709 = true;
      return;
    }
  if (const OCIO::ConstColorSpaceRcPtr space = inner.config->getColorSpace(OCIO::ROLE_SCENE_LINEAR)) {
    inner.working_space = space->getName();
    return;
  }
  fail(Exit::BadInput, "C006", {inner.origin},
       "the color config has neither a color space 'Linear Rec.709' nor a role 'scene_linear'");
}

// A flaw in a part that is never used must not stop anybody: what validate() dislikes is a message,
// and the view that needs the broken part fails with C007.
void finish(ColorConfig::Inner& inner) {
  inner.messages = take_ocio_log();
  try {
    inner.config->validate();
  } catch (const OCIO::Exception& e) {
    inner.messages.push_back(one_line(e.what()));
  }
  find_working_space(inner);
}

// The message of a file that cannot be opened must name the reason, which OCIO's does not.
void check_readable(const std::string& path, const std::string& named_by) {
  struct stat info {};
  int problem = stat(path.c_str(), &info) == 0 ? 0 : errno;
  if (problem == 0 && S_ISDIR(info.st_mode)) problem = EISDIR;
  if (problem == 0) {
    errno = 0;
    if (!std::ifstream(path)) problem = errno != 0 ? errno : EIO;
  }
  if (problem != 0)
    fail(Exit::BadInput, "C001", {path},
         fmt::format("the color config '{}'{} cannot be read: {}", path, named_by, std::strerror(problem)));
}

std::vector<std::string> described(std::span<const std::string> exist, const std::string& word,
                                   const char* what) {
  return {did_you_mean(word, exist), fmt::format("{}: {}", what, list_of(exist))};
}

bool contains(std::span<const std::string> list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}
} // namespace

ColorConfig ColorConfig::from_text(std::string_view text, const std::string& origin) {
  auto inner = std::make_shared<Inner>();
  inner->origin = origin;
  take_ocio_log();
  inner->config = with_ocio("C002", {origin}, "OpenColorIO does not understand this color config", [&] {
    std::istringstream stream{std::string(text)};
    return OCIO::Config::CreateFromStream(stream);
  });
  finish(*inner);
  return ColorConfig(std::move(inner));
}

ColorConfig ColorConfig::load(const std::string& path) {
  const char* variable = path.empty() ? std::getenv("OCIO") : nullptr;
  const bool from_variable = variable != nullptr && *variable != '\0';
  if (path.empty() && !from_variable) return from_text(default_color_config(), "shipped");
  const std::string file = from_variable ? variable : path;
  check_readable(file, from_variable ? " named by $OCIO" : "");
  auto inner = std::make_shared<Inner>();
  inner->origin = file;
  take_ocio_log();
  inner->config = with_ocio("C002", {file}, "OpenColorIO does not understand this color config",
                            [&] { return OCIO::Config::CreateFromFile(file.c_str()); });
  finish(*inner);
  return ColorConfig(std::move(inner));
}

const std::string& ColorConfig::origin() const { return inner_->origin; }
const std::string& ColorConfig::working_space() const { return inner_->working_space; }
const std::vector<std::string>& ColorConfig::messages() const { return inner_->messages; }

std::string ColorConfig::default_display() const { return inner_->config->getDefaultDisplay(); }
std::string ColorConfig::default_view(const std::string& display) const {
  return inner_->config->getDefaultView(display.c_str());
}

std::vector<std::string> ColorConfig::displays() const {
  std::vector<std::string> names{default_display()};
  for (int i = 0; i < inner_->config->getNumDisplays(); ++i)
    if (const std::string name = inner_->config->getDisplay(i); name != names.front()) names.push_back(name);
  return names;
}

std::vector<std::string> ColorConfig::views(const std::string& display) const {
  std::vector<std::string> names;
  for (int i = 0; i < inner_->config->getNumViews(display.c_str()); ++i)
    names.emplace_back(inner_->config->getView(display.c_str(), i));
  return names;
}

std::vector<std::string> ColorConfig::color_spaces() const {
  std::vector<std::string> names;
  const OCIO::ConstConfigRcPtr& config = inner_->config;
  for (int i = 0; i < config->getNumColorSpaces(OCIO::SEARCH_REFERENCE_SPACE_SCENE, OCIO::COLORSPACE_ACTIVE);
       ++i)
    names.emplace_back(
        config->getColorSpaceNameByIndex(OCIO::SEARCH_REFERENCE_SPACE_SCENE, OCIO::COLORSPACE_ACTIVE, i));
  return names;
}

void ColorConfig::check_display(const std::string& display, const SourceLoc& loc) const {
  const std::vector<std::string> exist = displays();
  if (!contains(exist, display))
    fail(Exit::BadInput, "C003", loc,
         fmt::format("there is no display '{}' in the color config '{}'", display, origin()),
         described(exist, display, "displays"));
}

void ColorConfig::check_view(const std::string& display, const std::string& view,
                             const SourceLoc& loc) const {
  check_display(display, loc);
  const std::vector<std::string> exist = views(display);
  if (!contains(exist, view))
    fail(Exit::BadInput, "C004", loc,
         fmt::format("the display '{}' has no view transform '{}' in the color config '{}'", display, view,
                     origin()),
         described(exist, view, "view transforms"));
}

void ColorConfig::check_color_space(const std::string& space, const SourceLoc& loc) const {
  if (!space.empty() && inner_->config->getColorSpace(space.c_str())) return; // roles and aliases count, too
  const std::vector<std::string> exist = color_spaces();
  fail(Exit::BadInput, "C005", loc,
       fmt::format("there is no color space '{}' in the color config '{}'", space, origin()),
       described(exist, space, "color spaces"));
}

void ColorConfig::to_working(const std::string& space, std::span<float> rgba, const SourceLoc& loc) const {
  check_color_space(space, loc);
  if (rgba.empty()) return;
  with_ocio("C007", loc, fmt::format("OpenColorIO cannot convert '{}' to '{}'", space, working_space()), [&] {
    const auto processor = inner_->config->getProcessor(space.c_str(), working_space().c_str());
    OCIO::PackedImageDesc picture(rgba.data(), static_cast<long>(rgba.size() / 4), 1, 4);
    processor->getDefaultCPUProcessor()->apply(picture);
  });
}

std::array<double, 3> ColorConfig::to_working(const std::string& space, const std::array<double, 3>& rgb,
                                              const SourceLoc& loc) const {
  if (space == "sRGB" && inner_->working_is_rec709) return srgb_decode(rgb);
  std::array<float, 4> pixel{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                             static_cast<float>(rgb[2]), 1.0f};
  to_working(space, std::span<float>(pixel), loc);
  return {pixel[0], pixel[1], pixel[2]};
}

} // namespace mote
