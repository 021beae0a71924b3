// SPDX-License-Identifier: MIT
// The table of what can go wrong, seen from outside: words, exit status, code, what the message says.
// Rows that need no device come first; they must not touch one either.
#include "run_mote.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace mote::test {
namespace {

using ::testing::HasSubstr;

struct BadInput {
  std::string_view name, words;
  int exit;
  std::string_view code, says;
};

// Files that every row finds in its folder.
class BadInputTable : public CommandTest, public ::testing::WithParamInterface<BadInput> {
protected:
  void SetUp() override {
    CommandTest::SetUp();
    write("good.csv", "x,y,z,radius,mass\n0,0,0,1,3\n2,0,0,1,5\n");
    write("good.xyz", "2\n\nO 0 0 0\nH 0.96 0 0\n");
    write("negative.csv", "x,y,z,radius\n0,0,0,1\n2,0,0,-1\n");
    write("truncated.xyz", "5\n\nO 0 0 0\n");
    write("noise.bin", std::string("\x01\x02\x03\xff\xfe\x00zzzz", 10));
    write("empty.xyz", "");
    write("syntax.toml", "schema = 1\n[[data]\n");
    write("key.toml", "schema = 1\nbackgroud = \"#fff\"\n[[data]]\nfile = \"good.csv\"\n");
    write("missing.toml", "schema = 1\n[[data]]\nfile = \"gone.csv\"\n");
    write("attribute.toml", "schema = 1\n[[data]]\nfile = \"good.csv\"\ncolor = { attribute = \"mas\" }\n");
    write("camera.toml", "schema = 1\n[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\nup = [0, 0, 1]\n[[data]]\nfile = \"good.csv\"\n");
    write("flat.toml", "schema = 1\n[[data]]\nfile = \"good.csv\"\ntransform = [ { scale = [1, 0, 1] } ]\n");
    write("graph.toml", "schema = 1\noutput = \"display.color\"\n[[pass]]\nname = \"display\"\nkind = \"ocio_tonemap\"\ninputs = { color = \"opaque.color\" }\n");
    write("usesgraph.toml", "schema = 1\ngraph = \"graph.toml\"\n[[data]]\nfile = \"good.csv\"\n");
    write("nograph.toml", "schema = 1\ngraph = \"defalt\"\n[[data]]\nfile = \"good.csv\"\n");
    write("broken.ocio", "not a config");
  }
};

TEST_P(BadInputTable, IsRefusedInWords) {
  const BadInput& row = GetParam();
  const Ran ran = mote(std::string(row.words));
  EXPECT_EQ(ran.exit, row.exit) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr(fmt::format("error {}", row.code)));
  EXPECT_THAT(ran.err, HasSubstr(std::string(row.says)));
  EXPECT_EQ(ran.out, "");
  EXPECT_FALSE(exists("out.png"));
}

INSTANTIATE_TEST_SUITE_P(
    Usage, BadInputTable,
    ::testing::Values(
        BadInput{"unknown_option", "render good.csv --widht 3", 2, "A001", "no option '--widht'"},
        BadInput{"near_option", "render good.csv --sizes 3x3", 2, "A001", "Did you mean '--size'?"},
        BadInput{"no_scene", "render", 2, "A001", "SCENE"},
        BadInput{"unknown_command", "rendr", 2, "A001", "Did you mean 'render'?"},
        BadInput{"later_command", "convert good.csv", 2, "A009", "no command 'convert'"},
        BadInput{"size_zero", "render good.csv -o out.png --size 0x0", 2, "A002", "'0x0' is not a size"},
        BadInput{"size_half", "render good.csv -o out.png --size 100", 2, "A002", "'100' is not a size"},
        BadInput{"size_huge", "render good.csv -o out.png --size 100000x1", 2, "A002", "'100000x1' is not a size"},
        BadInput{"size_beyond", "render good.csv -o out.png --size 32769x1", 2, "A002", "each from 1 to 32768"},
        BadInput{"panel_small", "render good.csv -o out.png --panel 8", 2, "A016", "at least 16 pixels a side"},
        BadInput{"panel_dump", "render good.csv -o out.png --size 64x64 --panel 32 --dump opaque.color=c.npy", 2, "A016", "drawn in 4 panels"},
        BadInput{"size_words", "render good.csv -o out.png --size bigxsmall", 2, "A002", "For example --size 1280x720"},
        BadInput{"output_ending", "render good.csv -o out.jpg", 2, "A003", "Endings: .png, .exr"},
        BadInput{"aov_name", "render good.csv --aov dept=a.npy", 2, "A004", "Did you mean 'depth'?"},
        BadInput{"aov_form", "render good.csv --aov depth", 2, "A004", "'depth' is not NAME=FILE"},
        BadInput{"aov_ending", "render good.csv --aov depth=a.png", 2, "A003", "Endings: .npy"},
        BadInput{"two_stdout", "render good.csv -o - --aov depth=-", 2, "A015", "only one output"},
        BadInput{"dump_form", "render good.csv --dump opaque.color", 2, "A004", "is not NAME=FILE"},
        BadInput{"dump_source", "render good.csv --dump opaque.colour=a.npy", 2, "G062", "opaque.colour"},
        BadInput{"bits", "render good.csv --bits 12", 2, "A001", "12"},
        BadInput{"expansion", "render good.csv --expansion vertx", 2, "A001", "Did you mean 'vertex'?"},
        BadInput{"graph_name", "render good.csv --graph defualts", 2, "A006", "Shipped graphs: default"},
        BadInput{"set_form", "render good.csv --set camera.fov_y", 2, "S017", "there is no '='"},
        BadInput{"set_range", "render good.csv --set camera.fov_y=200", 2, "S005", "--set: error S005: camera.fov_y is '200'"},
        BadInput{"set_key", "render good.csv --set camera.fov=20", 2, "S003", "camera has no key 'fov'"},
        BadInput{"set_nothing", "render good.csv --set displya.exposure=1", 2, "A011", "Did you mean 'display'?"},
        BadInput{"set_pass_parameter", "render good.csv --set display.exposur=1", 2, "G021", "exposur"},
        BadInput{"set_light", "render good.csv --set light.sun.intensity=1", 2, "S017", "names: headlight"},
        BadInput{"generated_count", "render spheres:lots:fit", 2, "S019", "'lots' is not a number"},
        BadInput{"generated_camera", "render spheres:1e3:fitt", 2, "S019", "Did you mean 'fit'?"},
        BadInput{"style", "render good.csv --style lycorice", 2, "S006", "Did you mean 'licorice'?"},
        BadInput{"two_scenes", "render key.toml good.csv", 2, "S009", "cannot be combined"},
        BadInput{"bench_frames", "bench good.csv --frames 0", 2, "A001", "0"},
        BadInput{"compare_one", "compare good.png", 2, "A001", "compare takes two pictures"},
        BadInput{"compare_limits", "compare a.png b.png --limits idd=0", 2, "K001", "idd"},
        BadInput{"compare_ending", "compare a.png b.jpg", 2, "A003", "'b.jpg' is no picture"},
        BadInput{"graph_options", "graph --dot --plan", 2, "A001", "--plan"}),
    [](const auto& row) { return std::string(row.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Files, BadInputTable,
    ::testing::Values(
        BadInput{"missing_data", "render gone.csv -o out.png", 3, "S018", "'gone.csv' does not exist"},
        BadInput{"missing_scene", "render gone.toml -o out.png", 3, "S001", "does not exist"},
        BadInput{"folder", "render . -o out.png", 3, "D001", ""},
        BadInput{"noise", "render noise.bin -o out.png", 3, "D005", "noise.bin"},
        BadInput{"empty", "render empty.xyz -o out.png", 3, "D002", "empty.xyz"},
        BadInput{"truncated", "render truncated.xyz -o out.png", 3, "D006", "truncated.xyz:"},
        BadInput{"negative_radius", "render negative.csv -o out.png", 3, "S024", "radius of particle 1 is '-1'"},
        BadInput{"scene_syntax", "render syntax.toml -o out.png", 3, "S002", "syntax.toml:2:"},
        BadInput{"scene_key", "render key.toml -o out.png", 3, "S003", "key.toml:2:1: error S003"},
        BadInput{"scene_file", "render missing.toml -o out.png", 3, "S018", "missing.toml:3:8: error S018"},
        BadInput{"scene_attribute", "render attribute.toml -o out.png", 3, "S021", "Did you mean 'mass'?"},
        BadInput{"scene_camera", "render camera.toml -o out.png", 3, "S011", "eye and target are the same point"},
        BadInput{"graph_name_in_scene", "render nograph.toml -o out.png", 3, "A006", "Did you mean 'default'?"},
        BadInput{"camera_up", "render camera.toml --set camera.target=[1,2,9] -o out.png", 2, "S011", "up lies along the view"},
        BadInput{"camera_near_far", "render good.csv --set camera.near=5 --set camera.far=4 -o out.png", 2, "S011", "near (5) must be less than far (4)"},
        BadInput{"camera_fov", "render good.csv --set camera.fov_y=180 -o out.png", 2, "S005", "fov_y"},
        BadInput{"scene_flat", "render flat.toml -o out.png", 3, "S013", "flat.toml:4:25"},
        BadInput{"graph_as_scene", "render graph.toml -o out.png", 3, "S009", "render graph"},
        BadInput{"graph_source", "render good.csv --graph graph.toml -o out.png", 3, "G013", "graph.toml:6:"},
        BadInput{"graph_of_scene", "render usesgraph.toml -o out.png", 3, "G013", "opaque"},
        BadInput{"graph_missing", "render good.csv --graph gone.toml -o out.png", 3, "G007", "gone.toml"},
        BadInput{"check_key", "check key.toml", 3, "S003", "Did you mean 'background'?"},
        BadInput{"graph_check", "graph graph.toml --check", 3, "G013", "graph.toml:6:"},
        BadInput{"info_missing", "info gone.xyz", 3, "D001", "gone.xyz"},
        BadInput{"ocio_missing", "render good.csv --ocio gone.ocio -o out.png", 3, "C001", "gone.ocio"},
        BadInput{"ocio_broken", "render good.csv --ocio broken.ocio -o out.png", 3, "C002", "broken.ocio"},
        BadInput{"view_transform", "render good.csv --view Filmic -o out.png", 3, "C004", "Un-tone-mapped"},
        BadInput{"compare_missing", "compare gone.png gone.png", 3, "I004", "gone.png"},
        BadInput{"compare_text", "compare good.csv good.csv", 2, "A003", "Endings"}),
    [](const auto& row) { return std::string(row.param.name); });

INSTANTIATE_TEST_SUITE_P(Device, BadInputTable,
                         ::testing::Values(BadInput{"MemoryForTheScene", "render spheres:1e5:fit -o out.png --memory 1M", 1, "A025", "the particles of the scene need 2.0 MiB, pictures come on top; allowed are 1.0 MiB"},
                                           BadInput{"MemoryForThePicture", "render spheres:1e3:fit -o out.png --memory 2M", 1, "G071", "the whole graph takes 14 MiB at this size"},
                                           BadInput{"no_such_device", "render good.csv --device nosuch -o out.png", 4, "V-ADPT-002", "nosuch"},
                                           BadInput{"no_window", "good.csv", 1, "A010", "mote render good.csv -o picture.png"},
                                           BadInput{"no_folder", "render good.csv -o gone/out.png", 1, "I001", "gone/out.png"},
                                           BadInput{"disk_full", "render good.csv -o /dev/full", 2, "A003", ""},
                                           BadInput{"disk_full_aov", "render good.csv --aov depth=- >/dev/full", 1, "I002", ""}),
                         [](const auto& row) { return std::string(row.param.name); });

class Environment : public CommandTest {};

TEST_F(Environment, WithoutADriver) {
  write("good.csv", "x,y,z\n0,0,0\n");
  const Ran ran = mote("render good.csv -o out.png", "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent");
  EXPECT_EQ(ran.exit, 4) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("V-INST-001"));
  EXPECT_THAT(ran.err, HasSubstr("mesa-vulkan-drivers"));
}

TEST_F(Environment, AllProblemsOfAFileComeOutAtOnce) {
  write("many.toml", "schema = 1\nfoo = 1\ntolerance = 3\n[camera]\nfov_y = -1\n[[data]]\nradius = -3\n");
  const Ran ran = mote("check many.toml");
  EXPECT_EQ(ran.exit, 3);
  for (const char* code : {"S003", "S004", "S005", "S007"}) EXPECT_THAT(ran.err, HasSubstr(code));
}

} // namespace
} // namespace mote::test
