// Recorded rows are read by the world's table, and each fault has its place.
#include "diagnosis/replicates/recorded_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Recorded : public testing::Test {
 protected:
  Recorded() : table_("robot/*/odometry", robots_, Columns("x[m] y[m] yaw[rad]"), "") {
    robots_.name = "robot";
    robots_.add("rover");
    robots_.add("scout");
  }
  diagnosis::RecordedTable read(const std::string& text) {
    return diagnosis::read_recorded(folder_.write("log.csv", text), table_);
  }
  std::string refused(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return folder_.inside(error.what());
    }
    return "no error";
  }

  Folder folder_;
  Set robots_;
  Table table_;
};

TEST_F(Recorded, RowsBecomeCoursesOfTheirColumns) {
  const auto read_ =
      read("t[s],robot,yaw[rad],note,x[m]\n0,rover,1,a,2\n0,scout,5,a,6\n0.5,rover,3,b,4\n1,scout,7,b,8\n");
  ASSERT_EQ(read_.courses.size(), 2u);
  EXPECT_THAT(read_.cells, ElementsAre(0, 2));  // x and yaw, in the order of the world's table
  EXPECT_EQ(read_.courses[0].row, "rover");
  EXPECT_THAT(read_.courses[0].t, ElementsAre(0, 0.5));
  EXPECT_EQ(read_.courses[1].values, (Eigen::Matrix2d() << 6, 5, 8, 7).finished());
  EXPECT_EQ(read_.last(), 1);
}

TEST_F(Recorded, AYawStandsForAQuaternion) {
  Table poses("robot/*/pose", robots_, Columns("x[m] y[m] z[m] qw qx qy qz"), "");
  const auto read_ = diagnosis::read_recorded(
      folder_.write("log.csv", "t[s],robot,x[m],y[m],yaw[rad]\n0,rover,1,2,0\n1,rover,3,4,-2\n"), poses);
  EXPECT_THAT(read_.cells, ElementsAre(0, 1, 3, 4, 5, 6));
  EXPECT_EQ(read_.courses[0].values.row(1),
            (Eigen::Matrix<double, 1, 6>() << 3, 4, std::cos(1.0), 0, 0, -std::sin(1.0)).finished());
}

TEST_F(Recorded, FaultsHaveTheirPlace) {
  EXPECT_THAT(
      refused("t[s],robot,speed\n0,rover,1\n"),
      HasSubstr("log.csv:1:1: has no column of robot/*/odometry; expected t[s],robot and some of x[m],y[m],yaw[rad]"));
  EXPECT_THAT(refused("t[s],robot,x[m]\n0,rover,1\n1,scuot,1\n"),
              AllOf(HasSubstr("log.csv:3:3: "), HasSubstr("\"scout\"")));
  EXPECT_THAT(refused("t[s],robot,x[m]\n1,rover,1\n0.5,rover,1\n"), HasSubstr("log.csv:3:1: time does not rise"));
  EXPECT_THAT(refused("t[s],robot,x[m]\n-1,rover,1\n0.5,rover,1\n"), HasSubstr("log.csv:2:1: a time before the start"));
  EXPECT_THAT(refused("t[s],robot,x[m]\n0,rover,1\n"), HasSubstr("\"rover\" has one sample; expected two or more"));
  EXPECT_THAT(refused("t[s],robot,x[m],y[m]\n0,rover,1,1\n1,rover,1,1\n"),
              HasSubstr("log.csv:1:12: has x and y without the heading"));
  EXPECT_THAT(refused("t[s],robot,x[m]\n0,rover,1\n1,rover,-999\n"),
              HasSubstr("log.csv:3:9: column \"x[m]\": -999 lies far from all others, 1: is it a mark for no value?"));
  EXPECT_THAT(refused("t[s],robot,x[mm]\n0,rover,1\n1,rover,1\n"), HasSubstr("x[m]"));
}

}  // namespace
}  // namespace muster::test
