// SPDX-License-Identifier: MIT
// What `mote chart` can draw. A topic measures its methods, errors against double precision or an exact answer, times on
// the device, and fills a chart. A new one is one file with a function and one line in topics.cpp.
#pragma once

#include "app/library/device.hpp"
#include "app/library/job.hpp"
#include "core/chart/chart.hpp"
#include "core/color/color_config.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace mote::app {

struct TopicContext {
  DrawingDevice& device;
  const ColorConfig& config;
  JobRequest request{};                                // the scene, or the topic's own
  std::function<void(const std::string&)> say{};       // progress, a line each
};

struct Topic {
  std::string_view name{}, summary{};
  std::string_view scene{}; // drawn where the user names none; empty: the topic draws no scene
  std::string_view size{};  // of its pictures where the user gives none
  chart::Chart (*measure)(TopicContext& context){};
};
std::span<const Topic> topics();

// One a topic; each in a file of its name.
chart::Chart chart_color_models(TopicContext& context);
chart::Chart chart_depth(TopicContext& context);
chart::Chart chart_mesh(TopicContext& context);
chart::Chart chart_ocio(TopicContext& context);
chart::Chart chart_placement(TopicContext& context);
chart::Chart chart_proxy(TopicContext& context);
chart::Chart chart_sampling(TopicContext& context);
chart::Chart chart_shadow(TopicContext& context);
chart::Chart chart_sphere(TopicContext& context);
chart::Chart chart_transparency(TopicContext& context);

} // namespace mote::app
