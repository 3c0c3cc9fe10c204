// Robots stay on the floor: no step crosses a wall or a closed door, and none exceeds its reported speed.
#include <gtest/gtest.h>

#include "made.hpp"

namespace muster::exam {
namespace {

// Distance of a place to the solid parts of a wall, in small steps along it.
double gap(const Plan& plan, std::size_t wall, Vec2 p) {
  const Wall& w = plan.walls[wall];
  const double length = std::hypot(w.b.x - w.a.x, w.b.y - w.a.y);
  double least = 1e9;
  for (double s = 0; s <= length; s += 0.02) {
    bool is_door = false;
    for (const Door& d : plan.doors)
      is_door |= d.wall == static_cast<int>(wall) && d.open && s > d.at && s < d.at + d.width;
    if (is_door) continue;
    least = std::min(
        least, std::hypot(p.x - w.a.x - s / length * (w.b.x - w.a.x), p.y - w.a.y - s / length * (w.b.y - w.a.y)));
  }
  return least;
}

TEST(Robots, CrossNoWall) {
  int rooms_met = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const GroundTruth site = draw_site(seed, {}, 3000);
    for (const char* run : {"measured", "second"}) {
      const Data data = draw_data(site, seed, run);
      std::vector<const Reading*> last(static_cast<std::size_t>(site.robots), nullptr);
      std::vector<bool> met(site.plan.rooms.size());
      for (const Reading& r : data.readings) {
        const Reading*& before = last[static_cast<std::size_t>(r.robot)];
        if (before && before->t == r.t) continue;
        if (before) {
          ASSERT_FALSE(runs_into_wall(site.plan, {before->at.x, before->at.y}, {r.at.x, r.at.y}))
              << "seed " << seed << " at " << r.t << " s";
          ASSERT_LT(std::hypot(before->at.x - r.at.x, before->at.y - r.at.y), 0.8 * site.period)
              << "seed " << seed << " at " << r.t << " s";
        }
        if (const int room = site.plan.room_at({r.at.x, r.at.y}); room >= 0) met[static_cast<std::size_t>(room)] = true;
        before = &r;
      }
      rooms_met += static_cast<int>(std::count(met.begin(), met.end(), true));
    }
  }
  EXPECT_GT(rooms_met, 12 * 2 * 3);
}

TEST(Robots, KeepClearOfWalls) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const GroundTruth site = draw_site(seed, {}, 1200);
    const Data data = draw_data(site, seed, "measured");
    for (std::size_t i = 0; i < data.size(); i += 10)
      for (std::size_t w = 0; w < site.plan.walls.size(); ++w)
        ASSERT_GT(gap(site.plan, w, {data.readings[i].at.x, data.readings[i].at.y}), 0.15)
            << "seed " << seed << ", " << site.plan.walls[w].name;
  }
}

TEST(Robots, TheTwoRunsDiffer) {
  const Case c = made(2, "");
  ASSERT_EQ(c.measured.size(), c.second.size());
  double away = 0;
  for (std::size_t i = 0; i < c.measured.size(); ++i)
    away += std::hypot(c.measured.readings[i].at.x - c.second.readings[i].at.x,
                       c.measured.readings[i].at.y - c.second.readings[i].at.y);
  EXPECT_GT(away / static_cast<double>(c.measured.size()), 2);
}

}  // namespace
}  // namespace muster::exam
