// SPDX-License-Identifier: MIT
// What a user says about a scene, before any particle is read: the scene file (schema 1), or the same
// made from data files or a generated name, with `--set` applied. Every value that can turn out wrong
// later (a missing attribute, a camera that cannot see) keeps its place. realize.hpp turns this into a
// Scene. Parsing reports all problems of a file at once and reads no other file.
//
// Colors are "#rgb", "#rrggbb", "#rrggbbaa" or [r, g, b] (0 to 1), sRGB-encoded unless `color_space = "linear"`
// stands in the same table (or at the top of the file, for all): then linear Rec.709.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/math/camera.hpp"
#include "core/scene/generated.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/user_type.hpp"
#include "core/scene/value_range.hpp"
#include "core/toml/node.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mote {

template <class T> struct Located {
  T value{};
  SourceLoc loc{};
};

// An attribute of a file turned into a number in [0,1] by range and scale, then into a color, a radius or an opacity.
struct Mapping {
  Located<std::string> attribute{};
  Located<std::string> map{};                            // color maps: a name, or a file when it has a '/' or '.'
  RangeRule rule{RangeRule::Series};
  std::optional<std::pair<double, double>> range{};      // Fixed: ends; Percentile: percents
  bool logarithmic{};
  std::pair<double, double> to{0.0, 1.0};                // radius and opacity: at the ends of the range
  // colors only, 0xRRGGBB sRGB-encoded
  std::optional<std::uint32_t> below{}, above{}, nan{};  // absent: the ends of the map; magenta
  std::vector<std::pair<std::string, std::uint32_t>> categories{}; // colors of words or whole numbers
  std::optional<std::string> title{}, unit{};            // of the legend; absent: the attribute's
};

enum class RadiusRule : std::uint8_t { Auto, Constant, Attribute, Mapped, Element };
struct RadiusDesc {
  RadiusRule rule{RadiusRule::Auto};
  double constant{};
  Mapping mapping{}; // Attribute: only its name
  SourceLoc loc{};
};

enum class ColorRule : std::uint8_t { Auto, Constant, Element, Type, Mapped };
struct ColorDesc {
  ColorRule rule{ColorRule::Auto};
  glm::dvec3 constant{0}; // working space
  Mapping mapping{};
  SourceLoc loc{};
};

// The opacity of each particle: one for all, the values of an attribute, or values mapped by range and `to`.
enum class AlphaRule : std::uint8_t { Constant, Attribute, Mapped };
struct AlphaDesc {
  AlphaRule rule{AlphaRule::Constant};
  Mapping mapping{};
  SourceLoc loc{};
};

enum class Wrapping : std::uint8_t { AsInFile, Wrap, Unwrap };
// How molecules are shown. The last two draw bonds as cylinders.
enum class MoleculeStyle : std::uint8_t { None, Spacefill, BallAndStick, Licorice };

// Of types with an axis (capsule, cylinder, cone, arrow). Measures: Auto where the type's own default applies.
enum class Anchor : std::uint8_t { Center, Start, End }; // which point of the axis the position is
enum class Ends : std::uint8_t { Flat, Open, Round };    // of cylinders
struct AxialDesc {
  std::optional<Located<std::string>> direction{}, end{}; // vector columns; neither: the column "direction"
  std::optional<glm::dvec3> constant{};                   // one direction for all
  double scale{1.0};                                      // of the vectors' own lengths
  RadiusDesc length{};                                    // Auto: the vector's length times `scale`
  std::optional<Anchor> anchor{};                         // absent: arrows start there, others have their middle there
  RadiusDesc radius_end{}, head_radius{}, head_length{};  // 0 is allowed where they are constants
  Ends ends{Ends::Flat};
};

// Of types with three axes of their own (ellipsoid, box, superquadric): half lengths and quaternions, or tensors.
struct OrientedDesc {
  std::optional<Located<std::string>> axes{};         // a vector column; absent: "shape", else the radius for all three
  std::optional<glm::dvec3> constant_axes{};
  std::optional<Located<std::string>> orientation{};  // a column of quaternions; absent: "orientation", else along the axes of space
  std::optional<Located<std::string>> order{};        // "xyzw", "wxyz"; absent: the column's unit says it
  std::optional<Located<std::string>> tensor{};       // a column of 6 or 9 numbers
  std::optional<Located<std::string>> tensor_order{}; // "xx yy zz xy xz yz"
  bool mean_squares{true};                            // axes are the roots of eigenvalues; else the eigenvalues
  double probability{0.5};                            // of mean squares: what the ellipsoid holds of a normal distribution
  double sharpness{3.0};                              // of superquadrics of tensors
  double scale{1.0};
  std::optional<glm::dvec2> exponents{};              // (e1, e2)
  std::optional<Located<std::string>> exponents_of{}; // a column of two numbers
};

struct PolylineDesc {
  std::optional<Located<std::string>> chain{}; // whose rows are one line; absent: the column "chain", else all
};

// What an attribute of a type from files is: a column or one number for all.
struct AttributeDesc {
  std::string name{};
  Located<std::string> column{};
  std::optional<double> constant{};
};

struct CellDesc { // of the periodic cell
  bool drawn{};
  glm::dvec3 color{0.25}; // working space
  double width{};         // pixels; 0: fits the picture
};

struct DataDesc {
  Located<std::filesystem::path> file{};     // a file or a pattern; relative paths are resolved; empty for generated spheres
  std::vector<std::filesystem::path> further{};    // more files of the same series
  std::vector<std::filesystem::path> trajectory{}; // files or patterns that move the particles of `file`
  std::optional<Located<std::string>> select{};    // expression: which particles are drawn
  std::optional<GeneratedName> generated{};
  std::string type{"sphere"};
  RadiusDesc radius{};
  AxialDesc axial{};
  OrientedDesc oriented{};
  PolylineDesc polyline{};
  std::shared_ptr<UserType> user{};          // null: a shipped type
  std::vector<AttributeDesc> attributes{};   // of `user`
  ColorDesc color{};
  double alpha{1.0};
  double density{};                          // above 0: absorption per world length; alpha is below 1 then
  AlphaDesc opacity{};                       // Constant: `alpha`
  Material material{};
  MoleculeStyle style{MoleculeStyle::None};
  bool radius_by_style{};                    // the style, not the scene, says how large atoms are
  std::optional<double> bond_radius{};       // absent: the style's
  Wrapping wrapping{Wrapping::AsInFile};
  glm::ivec3 replicas{1};                    // along the edges of the cell
  CellDesc cell{};
  glm::dmat4 transform{1.0};
  std::optional<Located<std::string>> assembly{}; // a name, or "none"; absent: the file's first
  SourceLoc loc{};
};

// Numbers that are absent are chosen so that the data is in view.
struct CameraDesc {
  Projection projection{Projection::Perspective};
  std::optional<glm::dvec3> eye{}, target{}, up{};
  std::optional<double> fov_y{}, height{}, near{}, far{};
  SourceLoc loc{};
};

struct LegendDesc {
  bool shown{true};
  std::optional<bool> scale_bar{}, time{}; // absent: where it makes sense
  LegendPlace place{LegendPlace::Right};
  double size{1.0};
  std::optional<std::string> unit{};       // of lengths, for the scale bar
};

struct SceneDesc {
  std::string name{};                         // the file, or the words that named the data
  std::optional<Located<std::string>> graph{}; // a shipped name or a path, as written
  std::filesystem::path folder{};             // that relative paths are relative to
  std::optional<Located<double>> tolerance{}; // pixels
  glm::dvec4 background{1};                   // working space, straight alpha
  CameraDesc camera{};
  glm::dvec3 ambient{0.2};                    // color * intensity, working space
  std::vector<Light> lights{};
  std::vector<DataDesc> data{};
  std::vector<std::shared_ptr<UserType>> types{}; // from folders
  std::optional<Located<std::int64_t>> frame{}; // of every series; negative: from the end; absent: the first, alone
  LegendDesc legend{};
};

// Does the file look like a scene (TOML whose top has data, camera, ...) rather than a particle file? Decides by
// the ending ".toml", unless it describes raw numbers (mote_raw = 1).
bool is_scene_path(const std::filesystem::path& path);

// Reads and checks a scene file, with overrides ("path=value") applied. The override "particle_types+=FOLDER" adds a type to
// those that the scene names. Throws Failure when the file cannot be read,
// is no TOML, or an override names nothing; everything else goes to `diagnostics` (S003...S025).
SceneDesc read_scene(const std::filesystem::path& file, std::span<const std::string> overrides, Diagnostics& diagnostics);
// The same for a text; `folder` resolves relative paths.
SceneDesc parse_scene(std::string_view text, const std::string& file, const std::filesystem::path& folder,
                      std::span<const std::string> overrides, Diagnostics& diagnostics);
// A scene of data files with everything else at its default.
SceneDesc scene_of_files(std::span<const std::string> files, std::span<const std::string> overrides, Diagnostics& diagnostics);
// A scene by name ("spheres:1e5:fill").
SceneDesc scene_by_name(std::string_view name, std::span<const std::string> overrides, Diagnostics& diagnostics);

// What command line words name: one scene file, one generated name, or data files. Throws Failure (Usage) for mixtures.
SceneDesc describe(std::span<const std::string> words, std::span<const std::string> overrides, Diagnostics& diagnostics);

} // namespace mote
