// SPDX-License-Identifier: MIT
// mote formats, colormaps, views: what there is to choose from.
#include "app/commands/command.hpp"
#include "core/color/color_config.hpp"
#include "core/data/source.hpp"
#include "core/scene/colormaps.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

void list_formats() {
  for (const data::Format& format : data::formats()) fmt::print("{:<14}{}  ({})\n", format.name, format.summary, format.extensions);
  fmt::print("Formats are recognized by content; gzip, xz and zstd are looked through.\n");
}

void list_colormaps() {
  for (const ColorMap& map : color_maps())
    fmt::print("{:<10}{:>4} entries  {}  [{}]\n", map.name, map.entries.size(), map.summary, map.license);
  fmt::print("NAME_r is NAME reversed.\n");
}

void list_views(const std::string& path) {
  const ColorConfig config = ColorConfig::load(path);
  for (const std::string& display : config.displays()) {
    fmt::print("{}{}\n", display, display == config.default_display() ? "  (default display)" : "");
    for (const std::string& view : config.views(display))
      fmt::print("    {}{}\n", view, view == config.default_view(display) ? "  (default)" : "");
  }
}

} // namespace

void add_lists(CLI::App& app, Exit& exit) {
  auto done = [&exit](auto&& list) {
    return [&exit, list] {
      list();
      exit = Exit::Done;
    };
  };
  app.add_subcommand("formats", "list the particle formats that can be read")->callback(done(list_formats));
  app.add_subcommand("colormaps", "list the color maps")->callback(done(list_colormaps));
  CLI::App* views = app.add_subcommand("views", "list displays and view transforms of the color config");
  auto config = std::make_shared<std::string>();
  views->add_option("--ocio", *config, "OpenColorIO config instead of $OCIO or the shipped one")->type_name("FILE");
  views->callback(done([config] { list_views(*config); }));
}

} // namespace mote::app
