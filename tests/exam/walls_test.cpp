// An exam over a user's own floor plan.
#include "exam/walls.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "exam/files.hpp"
#include "exam/follow_up.hpp"
#include "exam/rooms.hpp"
#include "tests/exam/made.hpp"

namespace muster::exam {
namespace {

std::string hall() { return read_file(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds" / "hall" / "walls.csv"); }

constexpr const char* header = "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\n";

// Rooms of 5 m and 8 m with a door between them, or none, turned by 30 degrees.
std::string two_rooms(bool door = true) {
  const double c = std::cos(0.5236), s = std::sin(0.5236);
  std::string out = header;
  int number = 0;
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    out += fmt::format("w{},{},{},{},{},3.1,0.15,stone\n", ++number, 40 + c * x0 - s * y0, -7 + s * x0 + c * y0,
                       40 + c * x1 - s * y1, -7 + s * x1 + c * y1);
  };
  wall(0, 0, 13, 0);
  wall(0, 6, 13, 6);
  wall(0, 0, 0, 6);
  wall(13, 0, 13, 6);
  wall(5, 0, 5, 2);
  wall(5, door ? 2.9 : 2, 5, 6);
  return out;
}

TEST(PlanOfWalls, LiesAlongItsWallsAndHasRoomsBetweenThem) {
  const Plan plan = plan_of_walls(two_rooms());
  EXPECT_NEAR(std::remainder(plan.angle - 0.5236, std::numbers::pi / 2), 0, 1e-3);
  EXPECT_NEAR(plan.whole.high.x, 13, 0.01);
  EXPECT_NEAR(plan.whole.high.y, 6, 0.01);
  ASSERT_EQ(plan.rooms.size(), 2u);
  const auto area = [](const Room& r) { return (r.high.x - r.low.x) * (r.high.y - r.low.y); };
  EXPECT_NEAR(area(plan.rooms[0]), 8 * 6, 5);
  EXPECT_NEAR(area(plan.rooms[1]), 5 * 6, 4);
  EXPECT_FALSE(plan.has_corridor);
  EXPECT_EQ(plan.top(), 3.1);
}

TEST(PlanOfWalls, ARoomThatNoRobotReachesIsLeftOut) {
  const Plan plan = plan_of_walls(two_rooms(false));
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_TRUE(plan.rooms[0].holds({9, 3}) || plan.rooms[0].holds({4, 3})) << plan.rooms[0].low.x;
  EXPECT_GT((plan.rooms[0].high.x - plan.rooms[0].low.x) * (plan.rooms[0].high.y - plan.rooms[0].low.y), 40);
}

TEST(PlanOfWalls, TheHallHasACorridorAndItsRooms) {
  const Plan plan = plan_of_walls(hall());
  EXPECT_TRUE(plan.has_corridor);
  EXPECT_GT(plan.corridor.high.x - plan.corridor.low.x, 3 * (plan.corridor.high.y - plan.corridor.low.y));
  EXPECT_GE(plan.rooms.size(), 8u);
  for (const Room& r : plan.rooms)
    for (const auto& [a, b] : solid_pieces(plan))
      EXPECT_GT(distance_to({(r.low.x + r.high.x) / 2, (r.low.y + r.high.y) / 2}, a, b), 0.5);
}

TEST(PlanOfWalls, ACaseHasTheWallsThatWereGiven) {
  Order order{"one", {"unmapped_wall"}, {60}, 2000, hall()};
  const Case made = make_case("case_0001", 5, order);
  const Plan& plan = made.site->plan;
  const std::string there = walls_csv(plan), given = hall();
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(lines(there), lines(given));
  EXPECT_NE(there.find("outer_north,-14.000,8.000,22.000,8.000,2.7,0.1,drywall\n"), there.npos) << there;
  EXPECT_NEAR(made.hidden[0].lambda, 60, 6);
  for (const Station& s : plan.stations) {
    EXPECT_GT(s.at.x, -14);
    EXPECT_LT(s.at.x, 22);
  }
  const Reading* last = nullptr;
  for (const Reading& r : made.measured.readings) {
    if (r.robot != 0) continue;
    EXPECT_FALSE(last && runs_into_wall(plan, {last->at.x, last->at.y}, {r.at.x, r.at.y})) << r.t;
    last = &r;
  }
}

TEST(PlanOfWalls, TheAnswerIsEnoughToMakeTheCaseAgain) {
  const Case made = make_case("case_0001", 6, {"one", {"tx_offset"}, {60}, 1500, two_rooms()});
  const auto folder = std::filesystem::temp_directory_path() / "muster_exam_walls";
  write_case(made, folder);
  const Case again = read_case(folder / "answers" / "case_0001.json");
  std::filesystem::remove_all(folder);
  EXPECT_EQ(readings_csv(*again.site, again.measured), readings_csv(*made.site, made.measured));
}

TEST(PlanOfWalls, EveryEffectCanBeHiddenInTheHall) {
  for (const Recipe& r : recipes()) {
    const Case made = make_case("case_0001", 9, {r.in_vocabulary ? "one" : "outside", {r.id}, {60}, 1500, hall()});
    EXPECT_GT(made.hidden[0].lambda, 5) << r.id;
  }
}

TEST(PlanOfWalls, WithoutACorridorNoneIsHidden) {
  Syllabus syllabus;
  syllabus.kinds = {"each"};
  syllabus.walls = two_rooms();
  syllabus.corridor = false;
  for (int number = 1; number <= static_cast<int>(recipes().size()); ++number)
    EXPECT_NE(draw_order(syllabus, number).effects.at(0), "corridor");
}

void expect_refused(const std::string& csv, const std::string& why) {
  try {
    plan_of_walls(csv);
    FAIL() << "expected: " << why;
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()), why);
  }
}

TEST(PlanOfWalls, SaysWhatIsWrongWithATable) {
  expect_refused(header, "walls: the table has no wall");
  expect_refused("name,x0[m]\nw1,2\n", "walls, line 2: no column y0[m]");
  expect_refused(std::string(header) + "w1,0,0,1\n", "walls, line 2: 4 cells, expected 8");
  expect_refused(std::string(header) + "w1,0,zero,1,1,2.7,0.1,brick\n", "walls, line 2: y0[m] is no number: \"zero\"");
  expect_refused(std::string(header) + "w1,0,0,0,0,2.7,0.1,brick\n", "walls, line 2: the wall has no length");
  expect_refused(std::string(header) + "w1,0,0,9,0,0,0.1,brick\n",
                 "walls, line 2: a wall's height and thickness are more than 0");
  expect_refused(std::string(header) + "w1,0,0,9,0,2.7,0.1,brick\nw1,0,0,9,1,2.7,0.1,brick\n",
                 "walls, line 3: a second wall is called \"w1\"");
  expect_refused(std::string(header) + "w1,0,0,400,0,2.7,0.1,brick\n",
                 "walls: the plan is 400 m x 0 m; expected at most 150 m a side");
  expect_refused(std::string(header) + "w1,0,0,9,0,2.7,0.1,brick\n",
                 "walls: there is no room between them where a robot could go");
}

}  // namespace
}  // namespace muster::exam
