// SPDX-License-Identifier: MIT
// The parts that the scene file is read in; private to core/scene. Each function reads one table or
// value through a TableReader and reports there; scene_file.cpp puts the parts together.
#pragma once

#include "core/scene/codes.hpp"
#include "core/scene/scene_file.hpp"
#include "core/toml/reader.hpp"

namespace mote::scene_parser {

inline constexpr config::Codes reader_codes{code::scene_unknown_key, code::scene_wrong_type, code::scene_out_of_range,
                                            code::scene_unknown_word, code::scene_missing_key};

// `color_space` of the table if it has one, else `inherited`. True: linear Rec.709; false: sRGB-encoded.
bool read_color_space(config::TableReader& reader, bool inherited);

// A color in the working space with its straight alpha, or nothing when absent or wrong (reported).
std::optional<glm::dvec4> read_color(config::TableReader& reader, std::string_view key, bool linear, bool alpha_allowed = false);
std::optional<glm::dvec4> as_color(config::TableReader& reader, const config::Node& node, std::string_view key, bool linear,
                                   bool alpha_allowed = false);

// "#rrggbb" and the like as 0xRRGGBB, sRGB-encoded whatever `color_space` says; alpha is refused.
std::optional<std::uint32_t> read_encoded_color(config::TableReader& reader, std::string_view key);

// A number, an attribute's name, or { attribute, range, to }; `key` "radius" also takes "element".
RadiusDesc read_radius(config::TableReader& reader, std::string_view key = "radius");
// The keys of types that are more than a center and a radius; others are left unread. Needs data.type.
void read_shape(config::TableReader& reader, DataDesc& data);
ColorDesc read_particle_color(config::TableReader& reader, bool linear);
// A number goes to `alpha`, everything else into the answer.
AlphaDesc read_opacity(config::TableReader& reader, double& alpha);
LegendDesc read_legend(config::TableReader& top);
CameraDesc read_camera(const config::Node& table, Diagnostics& diagnostics);
std::vector<Light> read_lights(std::span<const config::Node* const> tables, bool linear, Diagnostics& diagnostics);
// Folders in `particle_types`; those that cannot be read are reported.
std::vector<std::shared_ptr<UserType>> read_types(config::TableReader& top, const std::filesystem::path& folder);
DataDesc read_data(const config::Node& table, std::size_t index, const std::filesystem::path& folder, bool linear,
                   std::span<const std::shared_ptr<UserType>> types, Diagnostics& diagnostics);
// A list of steps, applied from first to last; singular ones are reported and left out.
glm::dmat4 read_transform(config::TableReader& reader, std::string_view key);

} // namespace mote::scene_parser
