// SPDX-License-Identifier: MIT
// From names in files to canonical names: see the table in names.hpp.
#include "core/data/names.hpp"
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

namespace mote::data {
namespace {

using testing::ElementsAre;

std::vector<std::string> columns_of(std::initializer_list<Declared> declared, const Customs& customs = {}) {
  std::vector<std::string> out;
  const std::vector<Declared> list(declared);
  for (const RowColumn& column : plan_columns(list, customs).columns)
    out.push_back(fmt::format("{}({})", column.name, column.components));
  return out;
}

TEST(Names, SpellingsOfGroups) {
  EXPECT_THAT(columns_of({{"Positions", 3},
                          {"vel", 3},
                          {"forces", 3},
                          {"Colour", 3},
                          {"quat", 4},
                          {"virial", 9},
                          {"bec", 9}}),
              ElementsAre("position(3)", "velocity(3)", "force(3)", "color(3)", "orientation(4)", "stress(9)",
                          "bec(9)"));
}

TEST(Names, SpellingsOfSingleFields) {
  EXPECT_THAT(columns_of({{"Particle Identifier"},
                          {"rad"},
                          {"Charges"},
                          {"mol"},
                          {"masses"},
                          {"v"},
                          {"species", 1, Cell::Text}}),
              ElementsAre("id(1)", "radius(1)", "charge(1)", "molecule(1)", "mass(1)", "v(1)", "element(1)"));
}

TEST(Names, SingleFieldsFormGroups) {
  EXPECT_THAT(columns_of({{"FZ"}, {"x"}, {"fx"}, {"y"}, {"fy"}, {"z"}, {"r"}, {"g"}, {"b"}}),
              ElementsAre("force(3)", "position(3)", "color(3)"));
  EXPECT_THAT(columns_of({{"nx"}, {"NY"}, {"nz"}}), ElementsAre("normal(3)"));
  EXPECT_THAT(columns_of({{"nx"}, {"ny"}}), ElementsAre("nx(1)", "ny(1)"));
  EXPECT_THAT(columns_of({{"Normals", 3}}), ElementsAre("normal(3)"));
  EXPECT_THAT(columns_of({{"r"}, {"vx"}, {"vy"}}),
              ElementsAre("radius(1)", "vx(1)", "vy(1)")); // incomplete: as they are
  EXPECT_THAT(
      columns_of({{"a[1]"}, {"a[3]"}, {"b[2]"}, {"b[1]"}, {"c[0]"}, {"c[1]"}, {"d_x"}, {"d_y"}, {"d_z"}}),
      ElementsAre("a[1](1)", "a[3](1)", "b(2)", "c(2)", "d(3)"));
}

TEST(Names, ANameIsGivenOnce) {
  EXPECT_THAT(columns_of({{"pos", 3}, {"positions", 3}, {"pos", 3}, {"id"}, {"ID"}, {"id"}}),
              ElementsAre("position(3)", "positions(3)", "pos(3)", "id(1)", "ID(1)", "id_2(1)"));
  EXPECT_THAT(columns_of({{"x"}, {"x"}, {"y"}, {"z"}}), ElementsAre("position(3)", "x(1)"));
}

TEST(Names, UnitsOnlyInTables) {
  const std::vector<Declared> list{{"Mass [kg]"}, {"radius/mm"}, {"a[1]"}, {"speed (m/s)"}};
  const RowLayout layout = plan_columns(list, {.units_in_names = true});
  EXPECT_EQ(layout.columns[0].name, "mass");
  EXPECT_EQ(layout.columns[0].unit, "kg");
  EXPECT_EQ(layout.columns[1].unit, "mm");
  EXPECT_EQ(layout.columns[2].name, "a[1]");
  EXPECT_EQ(layout.columns[3].unit, "m/s");
  EXPECT_EQ(plan_columns(list, {}).columns[1].name, "radius/mm");
}

} // namespace
} // namespace mote::data
