// SPDX-License-Identifier: MIT
#include "app/library/device_costs.hpp"

#include "app/codes.hpp"
#include "core/base/atomic_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace mote::app {
namespace {

using passes::DeviceCosts;
using passes::ExpansionCosts;
constexpr int version = 1; // of the file

using Field = std::pair<const char*, double ExpansionCosts::*>;
constexpr std::array<Field, 5> fields{{{"fixed_ms", &ExpansionCosts::fixed_ms},
                                       {"particle_ns", &ExpansionCosts::particle_ns},
                                       {"unit_ns", &ExpansionCosts::unit_ns},
                                       {"pixel_ns", &ExpansionCosts::pixel_ns},
                                       {"pipeline_ms", &ExpansionCosts::pipeline_ms}}};

// Throws nlohmann's exceptions for whatever is not there or not a number; std::domain_error for a number that cannot be.
double number(const nlohmann::json& from, const char* name) {
  const double value = from.at(name).get<double>();
  if (!(value >= 0.0 && value < 1e9)) throw std::domain_error(fmt::format("{} is {}", name, value));
  return value;
}

DeviceCosts parse(const nlohmann::json& json, const gpu::AdapterInfo& info) {
  if (json.at("version").get<int>() != version) throw std::domain_error("it is of another version");
  if (json.at("device_uuid").get<std::string>() != info.device_uuid) throw std::domain_error("it is of another device");
  DeviceCosts costs;
  costs.source = "measured by mote calibrate";
  costs.aov_ns = number(json, "aov_ns");
  for (std::size_t i = 0; i < costs.costs.size(); ++i) {
    const nlohmann::json& from = json.at("expansions").at(std::string(passes::to_string(passes::costed_expansions[i])));
    for (const auto& [name, field] : fields) costs.costs[i].*field = number(from, name);
  }
  return costs;
}

} // namespace

std::string costs_path(const gpu::AdapterInfo& info, const std::string& directory) {
  return directory.empty() ? std::string() : fmt::format("{}/costs-{}-{:08x}.json", directory, info.device_uuid, info.driver_version);
}

DeviceCosts device_costs(const gpu::AdapterInfo& info, const std::string& directory, Diagnostics& diagnostics) {
  const std::string path = costs_path(info, directory);
  std::ifstream file(path, std::ios::binary);
  if (!path.empty() && file) try {
      return parse(nlohmann::json::parse(file), info);
    } catch (const std::exception& error) {
      diagnostics.warning(code::bad_costs, {path}, fmt::format("the measured costs of the device cannot be read: {}", error.what()),
                          {"mote calibrate measures them anew"});
    }
  return passes::shipped_costs(info.type);
}

std::string costs_json(const DeviceCosts& costs, const gpu::AdapterInfo& info) {
  nlohmann::ordered_json json;
  json["version"] = version;
  json["device"] = info.name;
  json["driver"] = info.driver + " " + info.driver_info;
  json["device_uuid"] = info.device_uuid;
  auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  for (std::size_t i = 0; i < costs.costs.size(); ++i)
    for (const auto& [name, field] : fields)
      json["expansions"][std::string(passes::to_string(passes::costed_expansions[i]))][name] = rounded(costs.costs[i].*field);
  json["aov_ns"] = rounded(costs.aov_ns);
  return json.dump(2) + "\n";
}

void save_costs(const DeviceCosts& costs, const gpu::AdapterInfo& info, const std::string& directory) {
  if (directory.empty())
    fail(Exit::Failed, code::no_cache, {}, "there is no folder for caches: neither XDG_CACHE_HOME nor HOME names one");
  std::error_code error;
  std::filesystem::create_directories(directory, error); // the write says what is wrong
  write_file(costs_path(info, directory), costs_json(costs, info));
}

} // namespace mote::app
