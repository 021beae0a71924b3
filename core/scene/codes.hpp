// SPDX-License-Identifier: MIT
// Every code that scenes report: named constants for the code that reports them, one line each for
// docs/errors.md. A code keeps its meaning for ever; new ones go to the end.
#pragma once

#include <array>
#include <string_view>

namespace mote {

namespace code {
inline constexpr std::string_view scene_unreadable = "S001";
inline constexpr std::string_view scene_syntax = "S002";
inline constexpr std::string_view scene_unknown_key = "S003";
inline constexpr std::string_view scene_wrong_type = "S004";
inline constexpr std::string_view scene_out_of_range = "S005";
inline constexpr std::string_view scene_unknown_word = "S006";
inline constexpr std::string_view scene_missing_key = "S007";
inline constexpr std::string_view scene_schema = "S008";
inline constexpr std::string_view scene_is_graph = "S009";
inline constexpr std::string_view light_useless = "S010";
inline constexpr std::string_view scene_camera = "S011";
inline constexpr std::string_view transform_form = "S012";
inline constexpr std::string_view transform_singular = "S013";
inline constexpr std::string_view transform_not_similar = "S014";
inline constexpr std::string_view key_not_of_kind = "S015";
inline constexpr std::string_view no_assembly = "S016";
inline constexpr std::string_view set_path = "S017";
inline constexpr std::string_view data_file_missing = "S018";
inline constexpr std::string_view generated_name = "S019";
inline constexpr std::string_view generated_type = "S020";
inline constexpr std::string_view attribute_missing = "S021";
inline constexpr std::string_view attribute_is_text = "S022";
inline constexpr std::string_view element_missing = "S023";
inline constexpr std::string_view radius_negative = "S024";
inline constexpr std::string_view light_name_twice = "S025";
inline constexpr std::string_view too_many_particles = "S026";
inline constexpr std::string_view expression_syntax = "S027";
inline constexpr std::string_view expression_type = "S028";
inline constexpr std::string_view color_map_file = "S029";
inline constexpr std::string_view position_not_finite = "S030";
inline constexpr std::string_view radius_zero = "S031";
inline constexpr std::string_view radius_not_finite = "S032";
inline constexpr std::string_view value_not_finite = "S033";
inline constexpr std::string_view element_unknown = "S034";
inline constexpr std::string_view selection_empty = "S035";
inline constexpr std::string_view range_empty = "S036";
inline constexpr std::string_view no_cell = "S037";
inline constexpr std::string_view needs_cylinders = "S038";
inline constexpr std::string_view range_sampled = "S039";
inline constexpr std::string_view alpha_range = "S040";
inline constexpr std::string_view not_a_vector = "S041";
inline constexpr std::string_view no_shape = "S042";
inline constexpr std::string_view no_bonds = "S043";
inline constexpr std::string_view wrong_components = "S060";
inline constexpr std::string_view order_unknown = "S061";
inline constexpr std::string_view bad_orientation = "S062";
inline constexpr std::string_view user_type = "S063";
inline constexpr std::string_view user_type_wrong = "S064";
} // namespace code

struct SceneCode {
  std::string_view code{}, line{};
};
inline constexpr std::array<SceneCode, 48> scene_codes{{
    {code::scene_unreadable, "error: a scene file is missing, is a folder or may not be read"},
    {code::scene_syntax, "error: a scene file is not TOML"},
    {code::scene_unknown_key, "error: a key that no scene has"},
    {code::scene_wrong_type, "error: a value of another type than its key takes"},
    {code::scene_out_of_range, "error: a number outside the range of its key"},
    {code::scene_unknown_word, "error: a word that its key does not know"},
    {code::scene_missing_key, "error: a key that must be there is missing"},
    {code::scene_schema, "error: the scene is of a schema that this version does not read"},
    {code::scene_is_graph, "error: a graph file stands where a scene is needed"},
    {code::light_useless, "error: a light that cannot shine (no direction, inner angle above outer angle, no attenuation)"},
    {code::scene_camera, "error: the camera cannot see (eye = target, up along the view, near >= far, ...)"},
    {code::transform_form, "error: a transform step is not one of the known ones"},
    {code::transform_singular, "error: a transform flattens space"},
    {code::transform_not_similar, "error: a transform of an assembly is no rigid motion"},
    {code::key_not_of_kind, "error: a key that belongs to another kind of light, projection or color"},
    {code::no_assembly, "error: an assembly is asked for that the file does not have"},
    {code::set_path, "error: --set names no place in the scene"},
    {code::data_file_missing, "error: a data file of the scene is not there"},
    {code::generated_name, "error: the name of a generated scene is malformed"},
    {code::generated_type, "error: a generated scene needs a particle type that versions before did not have"},
    {code::attribute_missing, "error: a file has no such attribute"},
    {code::attribute_is_text, "error: an attribute holds text where numbers are needed"},
    {code::element_missing, "error: colors by element are asked of a file without elements"},
    {code::radius_negative, "error: a radius is below zero"},
    {code::light_name_twice, "error: two lights have the same name"},
    {code::too_many_particles, "error: a data set has more particles than ids can count"},
    {code::expression_syntax, "error: a selection is no expression"},
    {code::expression_type, "error: a selection compares what cannot be compared"},
    {code::color_map_file, "error: a color map file is missing or holds no color map"},
    {code::position_not_finite, "warning: particles without a finite position are left out"},
    {code::radius_zero, "warning: particles of radius zero are drawn as nothing"},
    {code::radius_not_finite, "warning: particles without a finite radius are left out"},
    {code::value_not_finite, "warning: particles whose color attribute is NaN are drawn in magenta"},
    {code::element_unknown, "warning: element names that are in no table"},
    {code::selection_empty, "warning: a selection leaves no particle"},
    {code::range_empty, "warning: no value of an attribute can be mapped (all NaN, or none above 0 for a logarithm)"},
    {code::no_cell, "error: wrapping, replicas or outlines need a periodic cell, image flags or a volume that the file does not have"},
    {code::needs_cylinders, "error: a molecule style that needs cylinders, which versions before there were any did not draw"},
    {code::range_sampled, "note: the range of a long series is that of some of its frames"},
    {code::alpha_range, "warning: opacities outside 0 to 1 are cut"},
    {code::not_a_vector, "error: a direction or an end is asked of an attribute that is no vector"},
    {code::no_shape, "warning: particles without a length, a direction or a measure that could be drawn are left out"},
    {code::no_bonds, "error: a style draws bonds, and the file has neither bonds nor elements to find them by"},
    {code::wrong_components, "error: an attribute has another number of components than axes, quaternions, tensors or exponents need"},
    {code::order_unknown, "error: the order of a quaternion's or tensor's components is not said, or is none"},
    {code::bad_orientation, "warning: quaternions that are not of length 1 are made so; those of no length, and singular or negative tensors, are left out"},
    {code::user_type, "error: a particle type from a folder cannot be read or said, or needs a device"},
    {code::user_type_wrong, "warning: functions of a particle type from a folder give NaN or do not agree with each other"},
}};

} // namespace mote
