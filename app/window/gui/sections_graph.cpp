// SPDX-License-Identifier: MIT
// Sections of the panel about the render graph: passes with switches, parameters and timings; any slot as a picture with its
// range and values; messages with their places.
#include "app/window/gui/sections.hpp"
#include "render_graph/value.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace mote::window {
namespace {

void parameter(Session& session, const std::string& pass, const rg::Entry& entry) {
  const std::string path = pass + "." + entry.key;
  if (const auto* on = std::get_if<bool>(&entry.value.data)) {
    bool value = *on;
    if (ImGui::Checkbox(entry.key.c_str(), &value)) session.set(path, value ? "true" : "false");
  } else if (const auto* whole = std::get_if<std::int64_t>(&entry.value.data)) {
    int value = static_cast<int>(*whole);
    if (ImGui::InputInt(entry.key.c_str(), &value, 1, 100, ImGuiInputTextFlags_EnterReturnsTrue)) session.set(path, fmt::format("{}", value));
  } else if (const auto* number = std::get_if<double>(&entry.value.data)) {
    auto value = static_cast<float>(*number);
    if (ImGui::InputFloat(entry.key.c_str(), &value, 0.0f, 0.0f, "%.4g", ImGuiInputTextFlags_EnterReturnsTrue)) session.set(path, toml_number(static_cast<double>(value)));
  } else {
    ImGui::TextWrapped("%s = %s", entry.key.c_str(), rg::to_text(entry.value).c_str());
  }
}

rg::GraphDesc graph_of(const Session& session) {
  Diagnostics ignored; // it has been compiled
  rg::GraphDesc graph = app::load_graph(session.job().graph, ignored);
  for (const std::string& setting : session.job().graph.settings) rg::apply_setting(graph, setting, ignored);
  return graph;
}

} // namespace

void pass_section(Session& session, GuiState& state) {
  const std::vector<rg::PassTiming>& timings = session.painter().renderer().timings(false);
  const rg::GraphDesc graph = graph_of(session);
  for (const rg::PassDesc& pass : graph.passes) {
    ImGui::PushID(pass.name.text.c_str());
    bool enabled = pass.enabled;
    if (ImGui::Checkbox("##enabled", &enabled)) session.set(pass.name.text + ".enabled", enabled ? "true" : "false");
    ImGui::SameLine();
    const auto timing = std::find_if(timings.begin(), timings.end(), [&](const rg::PassTiming& t) { return t.name == pass.name.text; });
    std::string text = fmt::format("{} ({})", pass.name.text, pass.kind.text);
    if (timing != timings.end() && timing->skipped.empty()) text += fmt::format("  {:.1f} ms", timing->gpu_ms.value_or(timing->cpu_ms));
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::Indent();
    for (const rg::Entry& entry : pass.params) parameter(session, pass.name.text, entry);
    ImGui::Unindent();
    ImGui::PopID();
  }
  if (ImGui::InputTextWithHint("set", "opaque.samples=4", state.setting.data(), state.setting.size(), ImGuiInputTextFlags_EnterReturnsTrue)) {
    const std::string setting = state.setting.data();
    const std::size_t equals = setting.find('=');
    if (equals != std::string::npos) session.set(setting.substr(0, equals), setting.substr(equals + 1));
    else session.message("'" + setting + "' is not PATH=VALUE");
  }
  ImGui::Text("picture %.1f ms, panels %.1f ms", session.frame_ms(), session.panels_ms());
}

void slot_section(Session& session, GuiState& state, GuiRenderer& renderer) {
  if (ImGui::BeginCombo("slot", state.slot.empty() ? "(choose)" : state.slot.c_str())) {
    for (const rg::PlannedTexture& texture : session.painter().renderer().plan().textures)
      if (ImGui::Selectable(texture.name.c_str(), texture.name == state.slot)) state.slot = texture.name;
    ImGui::EndCombo();
  }
  if (state.slot.empty()) return;
  const Camera& c = session.camera();
  const std::string seen = fmt::format("{} {} {} {}x{} {}", state.slot, toml_vector(c.eye), toml_vector(c.target), session.size().width, session.size().height, session.document().text().size());
  if (seen != state.slot_seen && session.refined()) { // not while something moves: it is drawn once more for this
    state.slot_seen = seen;
    Diagnostics problems;
    state.pixels = session.painter().slot(state.slot, session.view(), problems);
    state.slot_problem = to_string(problems);
    if (state.pixels) {
      state.slot_range = state.pixels->range(0);
      renderer.set_picture(state.pixels->size, state.pixels->picture(state.slot_range));
    }
  }
  if (!state.pixels) return ImGui::TextWrapped("%s", state.slot_problem.empty() ? "this slot cannot be shown" : state.slot_problem.c_str());
  const Size2d size = state.pixels->size;
  const float wide = ImGui::GetContentRegionAvail().x, high = wide * static_cast<float>(size.height) / static_cast<float>(std::max(1u, size.width));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Image(reinterpret_cast<ImTextureID>(GuiRenderer::picture), ImVec2(wide, high));
  ImGui::Text("%ux%u, first component from %.6g to %.6g", size.width, size.height, state.slot_range.first, state.slot_range.second);
  if (!ImGui::IsItemHovered() && !ImGui::IsMouseHoveringRect(corner, ImVec2(corner.x + wide, corner.y + high))) return ImGui::TextDisabled("point at the picture for values");
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto x = static_cast<std::uint32_t>(std::clamp((mouse.x - corner.x) / wide, 0.0f, 0.9999f) * static_cast<float>(size.width));
  const auto y = static_cast<std::uint32_t>(std::clamp((mouse.y - corner.y) / high, 0.0f, 0.9999f) * static_cast<float>(size.height));
  ImGui::TextWrapped("(%u, %u): %s", x, y, state.pixels->text(x, y).c_str());
}

void diagnostics_section(Session& session) {
  for (const Diagnostic& d : session.problems().list()) ImGui::TextWrapped("%s", to_string(d).c_str());
  const std::vector<std::string>& said = session.messages();
  for (std::size_t i = said.size() > 12 ? said.size() - 12 : 0; i < said.size(); ++i) ImGui::TextWrapped("%s", said[i].c_str());
}

} // namespace mote::window
