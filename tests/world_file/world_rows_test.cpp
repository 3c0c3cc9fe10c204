// Rows of the standard sets, from elements and from files.
#include "world_text.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Rows = WorldText;

const std::string header = "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\n";
const std::string elements =
    "<material name='brick' loss='6'/>\n<walls file='walls.csv'/>\n<material name='wood' loss='2'/>";

const RowDeclaration& row(const World& world, const std::string& set, const std::string& name) {
  for (const auto& row : world.rows) {
    if (row.set == set && row.name == name) return row;
  }
  throw std::out_of_range(set + '/' + name);
}

// The values of a row's table, as the kernel stores them.
std::vector<double> stored(const RowDeclaration& row, const std::string& table, std::size_t width) {
  std::vector<double> result(width, 0);
  for (const auto& values : row.values) {
    if (values.table != table) continue;
    if (values.store)
      values.store(values.values.data(), result.data());
    else
      result = values.values;
  }
  return result;
}

TEST_F(Rows, AnElementIsARowInEachSetThatItsAttributesName) {
  const World world = read_with(
      "<robot name='a' model='rdk' at='1 2 3' heading='3.141592653589793' antenna='0 0 0.5'/>\n<robot at='0 0 0'/>");
  const auto& robot = row(world, "robot", "a");
  EXPECT_THAT(robot.sets, ElementsAre("robot", "radio"));
  const auto pose = stored(robot, "robot/pose", 7);
  EXPECT_THAT(std::vector<double>(pose.begin(), pose.begin() + 3), ElementsAre(1, 2, 3));
  EXPECT_NEAR(pose[3], 0, 1e-15);
  EXPECT_EQ(pose[6], 1);
  EXPECT_EQ(world.texts.at("robot/a/model"), "rdk");
  EXPECT_EQ(world.texts.at("robot/robot2/model"), "scarab");
}

TEST_F(Rows, ReferencesMayPointDownTheFile) {
  const World world = read_with(
      "<door wall='w' at='1' state='open'/>\n<wall name='w' from='0 0' to='4 0' material='m'/>\n<material name='l' "
      "loss='1'/>\n<material name='m' loss='1'/>");
  EXPECT_EQ(stored(row(world, "wall", "w"), "wall/shape", 8), (std::vector<double>{0, 0, 4, 0, 0, 2.7, 0.1, 1}));
  EXPECT_EQ(stored(row(world, "door", "door1"), "door/state", 1), std::vector<double>{1});
  EXPECT_EQ(error_with("<door wall='w' at='1' state='ajar'/>\n<wall name='w' from='0 0' to='4 0' "
                       "material='m'/>\n<material name='m' loss='1'/>"),
            "world.xml:2:30: attribute \"state\": \"ajar\" is not a choice; expected one of closed, open");
}

TEST_F(Rows, WallsFromAFile) {
  put("walls.csv", header + "w1,0,0,12,0,2.7,0.12,brick\nw2,0,0,0,5,3,0,wood\n");
  const World world = read_with(elements + "\n<wall name='w3' from='0 0' to='1 1' material='wood'/>");
  EXPECT_EQ(stored(row(world, "wall", "w1"), "wall/shape", 8), (std::vector<double>{0, 0, 12, 0, 0, 2.7, 0.12, 0}));
  EXPECT_EQ(stored(row(world, "wall", "w2"), "wall/shape", 8), (std::vector<double>{0, 0, 0, 5, 0, 3, 0, 1}));
  EXPECT_EQ(row(world, "wall", "w2").place.line, 3);
  put("walls.csv", "name,x0[m],y0[m],x1[m],y1[m],material\nw1,0,0,12,0,brick\n");
  EXPECT_EQ(stored(row(read_with(elements), "wall", "w1"), "wall/shape", 8),
            (std::vector<double>{0, 0, 12, 0, 0, 2.7, 0.1, 0}));
}

// A wall in the line and the column of its file in which the world has a robot.
TEST_F(Rows, ARowThatJoinsIsThatOfTheWorldsOwnFile) {
  put("walls.csv", header +
                       "w2,0,0,9,0,3,0,wood\nw3,0,0,9,0,3,0,wood\nw4,0,0,9,0,3,0,wood\nw5,0,0,9,0,3,0,wood\n"
                       "w6,0,0,9,0,3,0,wood\n");
  const World world = read_with(elements + "\n<at t='1'>\n<robot name='late' at='0 0 0'/></at>");
  EXPECT_EQ(row(world, "wall", "w6").place.line, row(world, "robot", "late").place.line);
  EXPECT_EQ(row(world, "wall", "w6").place.column, row(world, "robot", "late").place.column);
  EXPECT_EQ(world.occasions.at(0).rows.at(0).row, "late");
}

TEST_F(Rows, WhatAFileMayGetWrong) {
  const auto with = [&](const std::string& text) {
    put("walls.csv", text);
    return error_with(elements);
  };
  EXPECT_EQ(with(header + "w1,0,0,12,0,-2.7,0.12,brick\n"),
            "walls.csv:2:13: column \"height[m]\": -2.7 is out of bounds; expected a number from 0.001 to 1e+06 m");
  EXPECT_EQ(with(header + "w1,0,0,12,0,2.7,0.1,brick\nw2,0,0,12,0,2.7,-0.12,brick\n"),
            "walls.csv:3:17: column \"thickness[m]\": -0.12 is out of bounds; expected a number from 0 to 100 m");
  EXPECT_EQ(with(header + "w1,0,-1e7,12,0,2.7,0.1,brick\n"),
            "walls.csv:2:6: column \"y0[m]\": -1e+07 is out of bounds; expected a number from -1e+06 to 1e+06 m");
  EXPECT_EQ(with(header + "w1,0,0,12,0,2.7,0.12,brik\n"),
            "walls.csv:2:22: no material is called \"brik\"; expected one of brick, wood; did you mean \"brick\"?");
  EXPECT_EQ(with(header + "w1,0,0,12,0,2.7,0.12,brick\nw1,0,0,0,5,3,0,wood\n"),
            "walls.csv:3:1: a second wall is called \"w1\"; the first is at walls.csv:2:1; expected another name for "
            "one of them");
  EXPECT_EQ(with(header + "w 1,0,0,12,0,2.7,0.12,brick\n"),
            "walls.csv:2:1: attribute \"name\": \"w 1\" is not a name; expected letters, digits, _, - and .");
  EXPECT_EQ(with("name,x0[m],y0[m],x1[m],y1[m],material,colour\nw1,0,0,12,0,brick,red\n"),
            "walls.csv:1:39: column \"colour\" means nothing here; expected one of base, height, material, name, "
            "thickness, x0, x1, y0, y1");
  EXPECT_THAT(with("name,x0[cm],y0[m],x1[m],y1[m],material\nw1,0,0,12,0,brick\n"), HasSubstr("walls.csv:1:6: "));
  EXPECT_THAT(with("name,x0[m],y0[m],x1[m],material\nw1,0,0,12,brick\n"), HasSubstr("walls.csv:1:1: "));
  EXPECT_THAT(with(header + "w1,0,0,12,0,2.7,nan,brick\n"), HasSubstr("walls.csv:2:17: "));
  EXPECT_THAT(with(header + "w1,0,0,12,0,2.7,,brick\n"), HasSubstr("walls.csv:2:17: "));
  std::filesystem::remove(folder / "walls.csv");
  EXPECT_EQ(error_with(elements), "world.xml:3:14: attribute \"file\": there is no file \"walls.csv\"");
}

}  // namespace
}  // namespace muster
