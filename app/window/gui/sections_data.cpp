// SPDX-License-Identifier: MIT
// Sections of the panel about data: what there is, frames, and how attributes become colors.
#include "app/window/gui/sections.hpp"
#include "core/scene/colormaps.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace mote::window {
namespace {

std::shared_ptr<const data::Frame> frame_of(const Session& session, std::size_t data) {
  const app::Job& job = session.job();
  if (data >= job.desc.data.size() || job.desc.data[data].generated || !job.source) return nullptr;
  Diagnostics ignored; // reading the scene has told them
  return job.source->frame(data, job.frame, ignored);
}

// Numbers that can be mapped: "mass", "velocity.x", "velocity.magnitude".
std::vector<std::string> attributes_of(const data::Frame& frame) {
  std::vector<std::string> names;
  for (const data::Column& column : frame.columns) {
    if (column.type() == data::ColumnType::Text) continue;
    if (column.components == 1) names.push_back(column.name);
    else if (column.components == 3)
      for (const char* part : {".x", ".y", ".z"}) names.push_back(column.name + part);
  }
  return names;
}

void make_histogram(GuiState& state, const data::Frame& frame, const std::string& attribute) {
  state.histogram.fill(0.0f);
  state.low = state.high = 0.0;
  const std::size_t dot = attribute.rfind('.');
  const data::Column* column = frame.find(attribute);
  std::uint32_t component = 0;
  if (!column && dot != std::string::npos && attribute.size() == dot + 2) {
    column = frame.find(attribute.substr(0, dot));
    component = static_cast<std::uint32_t>(attribute.back() - 'x');
  }
  if (!column || column->type() == data::ColumnType::Text || component >= column->components) return;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const double v = column->number(row, component);
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (!(low <= high)) return;
  state.low = low;
  state.high = high;
  const double length = high > low ? high - low : 1.0;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const double v = column->number(row, component);
    if (!std::isfinite(v)) continue;
    const auto bin = static_cast<std::size_t>((v - low) / length * static_cast<double>(state.histogram.size()));
    state.histogram[std::min(bin, state.histogram.size() - 1)] += 1.0f;
  }
}

std::string mapping_text(const std::string& attribute, const std::string& map, const std::optional<std::pair<double, double>>& range) {
  std::string text = fmt::format("{{ attribute = \"{}\", map = \"{}\"", attribute, map);
  if (range) text += fmt::format(", range = [{}, {}]", toml_number(range->first), toml_number(range->second));
  return text + " }";
}

bool combo(const char* label, const std::string& shown, const std::vector<std::string>& names, std::string& chosen) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, shown.c_str())) return false;
  for (const std::string& name : names)
    if (ImGui::Selectable(name.c_str(), name == shown)) {
      chosen = name;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

void map_one(Session& session, GuiState& state, std::size_t d) {
  const std::shared_ptr<const data::Frame> frame = frame_of(session, d);
  const ColorDesc color = session.job().desc.data[d].color;
  if (!frame) return ImGui::TextDisabled("a generated scene has no attributes");
  const std::string path = fmt::format("data[{}].color", d);
  const bool mapped = color.rule == ColorRule::Mapped;
  const std::string attribute = mapped ? color.mapping.attribute.value : std::string();
  std::string map = mapped ? color.mapping.map.value : std::string("viridis"), chosen;
  if (combo("color by", mapped ? attribute : "(the scene's colors)", attributes_of(*frame), chosen)) session.set(path, mapping_text(chosen, map, std::nullopt));
  if (!mapped) return;
  const std::string key = fmt::format("{} {} {}", d, attribute, session.frame());
  if (state.histogram_of != key) {
    make_histogram(state, *frame, attribute);
    state.histogram_of = key;
  }
  if (combo("map", map, color_map_names(), chosen)) session.set(path, mapping_text(attribute, chosen, color.mapping.range));
  ImGui::PlotHistogram("##histogram", state.histogram.data(), static_cast<int>(state.histogram.size()), 0, nullptr, 0.0f, FLT_MAX, ImVec2(0, 50));
  const std::pair<double, double> range = color.mapping.range.value_or(std::pair(state.low, state.high));
  float ends[2] = {static_cast<float>(range.first), static_cast<float>(range.second)};
  const auto speed = static_cast<float>(std::max(state.high - state.low, 1e-9) / 300.0);
  if (ImGui::DragFloat2("range", ends, speed, 0.0f, 0.0f, "%.4g") && ends[0] < ends[1])
    session.set(path, mapping_text(attribute, map, std::pair<double, double>(ends[0], ends[1])), true);
  if (color.mapping.range && ImGui::SmallButton("range of the data")) session.set(path, mapping_text(attribute, map, std::nullopt));
}

} // namespace

void data_section(Session& session, GuiState&) {
  const app::Job& job = session.job();
  ImGui::TextWrapped("%s", job.desc.name.c_str());
  ImGui::Text("%llu particles", static_cast<unsigned long long>(job.scene.particle_count()));
  const std::uint64_t count = session.frame_count();
  if (count > 1) {
    int frame = static_cast<int>(session.frame());
    if (ImGui::SliderInt("frame", &frame, 0, static_cast<int>(count) - 1)) session.set_frame(static_cast<std::uint64_t>(frame));
    if (ImGui::Button(session.playing() ? "pause" : "play")) session.set_playing(!session.playing());
    ImGui::SameLine();
    ImGui::Checkbox("loop", &session.loop);
    auto speed = static_cast<float>(session.frames_a_second);
    if (ImGui::SliderFloat("frames a second", &speed, 0.5f, 60.0f, "%.1f")) session.frames_a_second = speed;
  }
  const bool unsaved = session.document().changed();
  if (ImGui::Button(unsaved ? "save *" : "save")) session.save();
  ImGui::SameLine();
  if (ImGui::Button("undo")) session.undo();
  ImGui::SameLine();
  if (ImGui::Button("redo")) session.redo();
  ImGui::SameLine();
  if (ImGui::Button("help")) session.act(Action::ToggleHelp);
}

void mapping_section(Session& session, GuiState& state) {
  for (std::size_t d = 0; d < session.job().desc.data.size(); ++d) {
    ImGui::PushID(static_cast<int>(d));
    if (session.job().desc.data.size() > 1) ImGui::TextWrapped("%s", session.job().desc.data[d].file.value.filename().string().c_str());
    map_one(session, state, d);
    ImGui::PopID();
  }
}

} // namespace mote::window
