// Causes in the plan: walls, rooms and obstacles.
#include "survey.hpp"

namespace muster {
namespace {

double cross(double ax, double ay, double bx, double by) { return ax * by - ay * bx; }

// Intersection of a reading's link and a segment: shares of the length of each; null if they do not intersect.
struct Meeting {
  bool there;
  double along_link, along_wall, cosine;  // with the wall's normal, in space
};
Meeting meeting(const Reading& r, double x0, double y0, double x1, double y1) {
  const double ex = r.to.x - r.from.x, ey = r.to.y - r.from.y, wx = x1 - x0, wy = y1 - y0;
  const double det = cross(ex, ey, wx, wy);
  const double u = cross(x0 - r.from.x, y0 - r.from.y, wx, wy) / det;
  const double v = cross(x0 - r.from.x, y0 - r.from.y, ex, ey) / det;
  const bool there = u > 0 && u < 1 && v > 0 && v < 1;
  return {there, u, v, std::abs(det) / std::hypot(wx, wy) / length(r)};
}
double height_at(const Reading& r, double along) { return r.from.z + along * (r.to.z - r.from.z); }

// Crossings of a link in the plan of these tests: of w (its closed door or the wall) and of v (whose door is open).
bool in_door(const Reading& r, const Meeting& m, double wall_length, double at, double width) {
  return m.along_wall * wall_length >= at && m.along_wall * wall_length < at + width && height_at(r, m.along_link) < 2;
}
Meeting at_w(const Reading& r) {
  Meeting m = meeting(r, 5, -5, 5, 12);
  m.there = m.there && height_at(r, m.along_link) < 3;
  return m;
}
bool at_door_of_w(const Reading& r) { return at_w(r).there && in_door(r, at_w(r), 17, 6, 2); }
Meeting at_v(const Reading& r) {
  Meeting m = meeting(r, -3, 4.5, 16, 5.5);
  m.there = m.there && height_at(r, m.along_link) < 3 && !in_door(r, m, std::hypot(19, 1), 2, 3);
  return m;
}

TEST(WallMaterial, CountsTheWallButNotItsDoors) {
  expect_term("wall_material", "wall=\"w\" change=\"-2.5\"",
              [](const Reading& r) { return at_w(r).there && !at_door_of_w(r) ? 2.5 : 0; });
  int doors = 0;
  for (const Reading& r : survey()) doors += at_door_of_w(r);
  EXPECT_GT(doors, 0);
}

TEST(WallAbsent, GivesBackWhatStoodThere) {
  expect_term("wall_absent", "wall=\"w\" share=\"0.8\"",
              [](const Reading& r) { return !at_w(r).there ? 0 : 0.8 * (at_door_of_w(r) ? 2.25 : 7.5); });
  const Site site;
  const auto whole = column(site.world(effect("wall_absent", "wall=\"v\" share=\"1\""), true), "link/*/rssi");
  const std::string without =
      "<material name=\"brick\" loss=\"7.5\"/><material name=\"wood\" loss=\"2.25\"/>\n"
      "<wall name=\"w\" from=\"5 -5\" to=\"5 12\" height=\"3\" material=\"brick\"/>\n"
      "<door name=\"shut\" wall=\"w\" at=\"6\" width=\"2\" material=\"wood\" state=\"closed\"/>\n";
  const auto map = column(site.world("", true, 1, without + channel), "link/*/rssi");
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_NEAR(whole[i], map[i], 1e-9);
}

TEST(Incidence, GrowsAsTheWayThroughAWallUpToABound) {
  expect_term(
      "incidence", "share=\"0.7\" most=\"1.5\"",
      [](const Reading& r) {
        double sum = 0;
        for (const auto& [m, loss] : {std::pair{at_w(r), at_door_of_w(r) ? 2.25 : 7.5}, {at_v(r), 2.25}})
          sum -= m.there ? 0.7 * loss * std::min(1 / m.cosine - 1, 1.5) : 0;
        return sum;
      },
      1e-3);  // the scene snaps places to a quarter of a millimetre
}

TEST(UnmappedWall, LosesLessOverTheEdgesOfItsEnds) {
  const double length = std::hypot(7, 9);
  int between = 0;
  expect_term("unmapped_wall", "x0=\"2\" y0=\"-1\" x1=\"9\" y1=\"8\" loss=\"5\" height=\"2\" edge=\"1\"",
              [&](const Reading& r) {
                const Meeting m = meeting(r, 2, -1, 9, 8);
                if (m.along_link <= 0 || m.along_link >= 1 || height_at(r, m.along_link) >= 2) return 0.0;
                const double inside = std::min(m.along_wall, 1 - m.along_wall) * length;
                between += std::abs(inside) < 0.5;
                return -5 * std::clamp(inside + 0.5, 0.0, 1.0);
              });
  EXPECT_GT(between, 5);
}

TEST(UnmappedWall, IsWhatTheWallWouldCostIfItWereMapped) {
  expect_term("unmapped_wall", "x0=\"2\" y0=\"-1\" x1=\"9\" y1=\"8\" loss=\"5\" height=\"2\"", [](const Reading& r) {
    const Meeting m = meeting(r, 2, -1, 9, 8);
    return m.there && height_at(r, m.along_link) < 2 ? -5 : 0;
  });
  const Site site;
  const std::string stone = "<material name=\"stone\" loss=\"5\"/>",
                    wall = "<wall name=\"new\" from=\"2 -1\" to=\"9 8\" height=\"2\" material=\"stone\"/>";
  const auto map = column(site.world("", true, 1, stone + wall + plan + channel), "link/*/rssi");
  const auto found =
      column(site.world(effect("unmapped_wall", "x0=\"9\" y0=\"8\" x1=\"2\" y1=\"-1\" loss=\"5\" height=\"2\""), true,
                        1, stone + plan + channel),
             "link/*/rssi");
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_NEAR(found[i], map[i], 1e-9);
}

// By steps along the link, unlike the formulas under test.
double way_through(const Reading& r, double x, double y, double radius) {
  constexpr int steps = 20000;
  int inside = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps;
    inside += std::hypot(r.from.x + u * (r.to.x - r.from.x) - x, r.from.y + u * (r.to.y - r.from.y) - y) < radius;
  }
  return inside * std::hypot(r.to.x - r.from.x, r.to.y - r.from.y) / steps;
}

TEST(Obstacle, CostsMoreTheLongerTheWayThroughIt) {
  const Site site;
  const auto part = column(site.world(effect("obstacle", "x=\"6\" y=\"3\" radius=\"1.5\" loss=\"12\" height=\"10\"")),
                           "link/*/level@it");
  int hit = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double way = way_through(site.readings[i], 6, 3, 1.5);
    EXPECT_NEAR(part[i], -12 * (1 - std::exp(-way / 1.5)) / (1 - std::exp(-2)), 0.01);
    hit += part[i] < -1;
  }
  EXPECT_GT(hit, 20);
  EXPECT_LT(hit, 300);
}

TEST(Obstacle, EndsAtItsHeight) {
  Site site({{0, "a", "r", {0, 0, 0.5, 0}, {10, 0, 0.5, 0}, 0, 0}, {1, "a", "r", {0, 0, 3, 0}, {10, 0, 0.5, 0}, 0, 0}});
  const auto part = column(site.world(effect("obstacle", "x=\"5\" y=\"0\" radius=\"1\" loss=\"8\" height=\"1.7\"")),
                           "link/*/level@it");
  EXPECT_NEAR(part[0], -8, 1e-12);
  EXPECT_EQ(part[1], 0);  // 1.75 m up in the middle
}

bool inside(const Reading::At& p, double x, double y, double length, double width, double heading) {
  const double u = (p.x - x) * std::cos(heading) + (p.y - y) * std::sin(heading);
  const double v = (p.y - y) * std::cos(heading) - (p.x - x) * std::sin(heading);
  return std::abs(u) < length / 2 && std::abs(v) < width / 2;
}

TEST(RoomClutter, IsLostByLinksWithAnEndInTheRoomUpToABound) {
  const auto lost = [](const Reading& r) {
    constexpr int steps = 20000;
    const auto among = [](const Reading::At& p) { return p.z < 1.2 && inside(p, 8, 4, 9, 5, 0.4); };
    if (!among(r.from) && !among(r.to)) return 0.0;
    int count = 0;
    for (int i = 0; i < steps; ++i) {
      const double u = (i + 0.5) / steps;
      count += inside({r.from.x + u * (r.to.x - r.from.x), r.from.y + u * (r.to.y - r.from.y), 0, 0}, 8, 4, 9, 5, 0.4);
    }
    const double way = count * std::hypot(r.to.x - r.from.x, r.to.y - r.from.y) / steps;
    return -3 * (1 - std::exp(-way / 1.5));
  };
  expect_term("room_clutter",
              "x=\"8\" y=\"4\" length=\"9\" width=\"5\" heading=\"0.4\" depth=\"1.5\" height=\"1.2\" loss=\"3\"", lost,
              0.01);
}

TEST(Corridor, LowersTheExponentOfLinksInsideIt) {
  const double heading = std::atan2(8, 16), length_of = std::hypot(16, 8);
  expect_term("corridor", "x0=\"-2\" y0=\"-2\" x1=\"14\" y1=\"6\" width=\"6\" gain=\"0.6\"", [=](const Reading& r) {
    if (!inside(r.from, 6, 2, length_of, 6, heading) || !inside(r.to, 6, 2, length_of, 6, heading)) return 0.0;
    return 0.6 * 10 * std::log10(std::hypot(1, length(r) / 6));
  });
}

TEST(Height, CostsLinksThroughTheFloor) {
  expect_term("height", "z=\"2.7\" loss=\"11\"",
              [](const Reading& r) { return (r.from.z < 2.7) != (r.to.z < 2.7) ? -11 : 0; });
}

}  // namespace
}  // namespace muster
