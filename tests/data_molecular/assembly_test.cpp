// SPDX-License-Identifier: MIT
// Biological assemblies: the copies that PDB and mmCIF files describe.
#include "core/data/cif_assembly.hpp"
#include "tests/data_molecular/support.hpp"

#include <gmock/gmock.h>

namespace mote::data::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PdbAssembly, OperatorsMapPositions) {
  const Frame frame = open_text(molecule_file("two_models.pdb"))->read(0);
  ASSERT_EQ(frame.assemblies.size(), 1u);
  const Assembly& assembly = frame.assemblies[0];
  EXPECT_EQ(assembly.name, "1");
  EXPECT_EQ(assembly.chain_column, "chain");
  ASSERT_EQ(assembly.parts.size(), 1u); // "AND CHAINS" continues the list
  EXPECT_THAT(assembly.parts[0].chains, ElementsAre("A", "B"));
  ASSERT_EQ(assembly.parts[0].transforms.size(), 2u);
  EXPECT_EQ(assembly.parts[0].transforms[0], glm::dmat4(1.0));
  EXPECT_EQ(assembly.parts[0].transforms[1] * glm::dvec4(1, 2, 3, 1), glm::dvec4(8, 21, -27.5, 1));
}

TEST(CifAssembly, OperatorsMultiplyAndTheLastActsFirst) {
  const Frame frame = open_text(molecule_file("two_models.cif"))->read(0);
  ASSERT_EQ(frame.assemblies.size(), 2u);
  EXPECT_EQ(frame.assemblies[0].parts[0].transforms[1] * glm::dvec4(1, 2, 3, 1), glm::dvec4(8, 21, -27.5, 1));
  const Assembly& second = frame.assemblies[1];
  EXPECT_EQ(second.chain_column, "chain_label");
  ASSERT_EQ(second.parts.size(), 2u);
  ASSERT_EQ(second.parts[0].transforms.size(), 2u);
  EXPECT_EQ(second.parts[0].transforms[0] * glm::dvec4(0, 0, 0, 1), glm::dvec4(1, 2, 3, 1));      // P
  EXPECT_EQ(second.parts[0].transforms[1] * glm::dvec4(0, 0, 0, 1), glm::dvec4(8, 21, -27.5, 1)); // 2 after P
  EXPECT_THAT(second.parts[1].chains, ElementsAre("B"));
}

TEST(CifAssembly, Expressions) {
  auto parse = [](std::string_view text) { return parse_oper_expression(text, 100); };
  EXPECT_THAT(parse("1"), ElementsAre(ElementsAre("1")));
  EXPECT_THAT(parse("(1-3,X0)(7)"), ElementsAre(ElementsAre("1", "2", "3", "X0"), ElementsAre("7")));
  EXPECT_THAT(parse("P,2"), ElementsAre(ElementsAre("P", "2")));
  EXPECT_THAT(parse("X-Y"), ElementsAre(ElementsAre("X-Y"))); // no numbers: a name
  for (const char* bad : {"", "(", "(1-3", "(3-1)", "()", "(1-1000)", "(1(2))"})
    EXPECT_TRUE(parse(bad).empty()) << bad;
}

TEST(CifAssembly, FlawsAreNamed) {
  const std::string good = molecule_file("two_models.cif");
  const Diagnostic unknown = failure_of_text(changed(good, "1 1,2 A,B", "1 1,9 A,B"));
  EXPECT_EQ(unknown.code, "D045");
  EXPECT_THAT(unknown.text, HasSubstr("operator '9', which is not there"));
  EXPECT_THAT(unknown.hints, testing::Contains("operators: 1, 2, P"));
  EXPECT_EQ(unknown.loc.line, 19u);
  EXPECT_EQ(failure_of_text(changed(good, "(1-2)(P)", "(1-2(P)")).code, "D045");
  EXPECT_EQ(failure_of_text(changed(good, "2 0 -1 0 10", "2 0 x 0 10")).code, "D045");
  EXPECT_EQ(failure_of_text(changed(good, "(1-2)(P)", "(1-99999999999)(P)")).code, "D045");
}

TEST(PdbAssembly, FlawsAreNamed) {
  const std::string good = molecule_file("two_models.pdb");
  const Diagnostic missing = failure_of_text(changed(good, "  BIOMT2   2", "  BIOMT3   2"));
  EXPECT_EQ(missing.code, "D045");
  EXPECT_THAT(missing.text, HasSubstr("row BIOMT2 of an operator is needed here, not 'BIOMT3'"));
  EXPECT_THAT(failure_of_text(changed(good, "  BIOMT2   2", "  BIOMT    2")).text, HasSubstr("row BIOMT2 of an operator is needed here, not 'BIOMT'")); // found by fuzzing
  EXPECT_EQ(missing.loc.line, 10u);
  const Diagnostic number = failure_of_text(changed(good, "0.000000 -1.000000", "0.000000 -1.00x000"));
  EXPECT_EQ(number.code, "D045");
  EXPECT_EQ(number.loc.column, 35u);
}

} // namespace
} // namespace mote::data::test
