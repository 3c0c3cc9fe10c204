#include "exam/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <set>
#include <stdexcept>

#include "exam/rooms.hpp"
#include "exam/table.hpp"
#include "exam/trajectory.hpp"

namespace muster::exam {
namespace {

constexpr double largest = 150;  // m, a side of the plan: the field has a value every 8 cm

int material_called(Plan& plan, const std::string& name) {
  const auto at =
      std::find_if(plan.materials.begin(), plan.materials.end(), [&](const auto& m) { return m.name == name; });
  if (at != plan.materials.end()) return static_cast<int>(at - plan.materials.begin());
  plan.materials.push_back({name});
  return static_cast<int>(plan.materials.size()) - 1;
}

void read_walls(Plan& plan, const std::string& csv) {
  const Table table("walls", csv);
  std::set<std::string> names;
  const auto metres = [](const Line& line, const char* name) { return to_millimetres(line.number(name)); };
  for (const Line& line : table.lines()) {
    const Wall wall{line.text("name"),
                    {metres(line, "x0[m]"), metres(line, "y0[m]")},
                    {metres(line, "x1[m]"), metres(line, "y1[m]")},
                    line.number("height[m]"),
                    line.number("thickness[m]"),
                    material_called(plan, line.text("material"))};
    if (!names.insert(wall.name).second) line.refuse("a second wall is called \"" + wall.name + "\"");
    if (wall.a.x == wall.b.x && wall.a.y == wall.b.y) line.refuse("the wall has no length");
    if (!(wall.height > 0 && wall.thickness > 0)) line.refuse("a wall's height and thickness are more than 0");
    plan.walls.push_back(wall);
  }
  if (plan.walls.empty()) throw std::runtime_error("walls: the table has no wall");
}

// Main direction of the walls, modulo a quarter turn.
double angle_along(const std::vector<Wall>& walls) {
  std::complex<double> sum;
  for (const Wall& w : walls) {
    const std::complex<double> way(w.b.x - w.a.x, w.b.y - w.a.y);
    sum += std::polar(std::abs(way), 4 * std::arg(way));
  }
  return std::arg(sum) / 4;
}

// Sets the plan's own frame at this angle, with its origin at the least corner.
void turn(Plan& plan, double angle) {
  plan.angle = angle;
  plan.shift = {};
  Vec2 low = plan.to_own(plan.walls[0].a), high = low;
  for (const Wall& w : plan.walls) {
    for (const Vec2 world : {w.a, w.b}) {
      const Vec2 own = plan.to_own(world);
      low = {std::min(low.x, own.x), std::min(low.y, own.y)};
      high = {std::max(high.x, own.x), std::max(high.y, own.y)};
    }
  }
  const double c = std::cos(angle), s = std::sin(angle);
  plan.shift = {c * low.x - s * low.y, s * low.x + c * low.y};
  plan.whole = {{0, 0}, {high.x - low.x, high.y - low.y}};
  if (std::max(plan.whole.high.x, plan.whole.high.y) > largest)
    throw std::runtime_error(fmt::format("walls: the plan is {:.0f} m x {:.0f} m; expected at most {:.0f} m a side",
                                         plan.whole.high.x, plan.whole.high.y, largest));
}

double width(const Room& r) { return r.high.x - r.low.x; }
double depth(const Room& r) { return r.high.y - r.low.y; }
double slenderness(const Room& r) { return std::max(width(r) / depth(r), depth(r) / width(r)); }

void find_rooms(Plan& plan) {
  plan.rooms = Floor(plan).connected(rooms_between(plan));
  if (plan.rooms.empty()) throw std::runtime_error("walls: there is no room between them where a robot could go");
}

}  // namespace

Plan plan_of_walls(const std::string& csv) {
  constexpr double slender = 3;  // least aspect ratio of a corridor
  Plan plan;
  read_walls(plan, csv);
  turn(plan, angle_along(plan.walls));
  find_rooms(plan);
  const auto longest = [&] {
    return std::max_element(plan.rooms.begin(), plan.rooms.end(),
                            [](const Room& a, const Room& b) { return slenderness(a) < slenderness(b); });
  };
  if (depth(*longest()) > width(*longest())) {
    turn(plan, plan.angle + std::numbers::pi / 2);
    find_rooms(plan);
  }
  const auto corridor = longest();
  plan.corridor = *corridor;
  plan.has_corridor = plan.rooms.size() > 1 && width(*corridor) > slender * depth(*corridor);
  if (plan.has_corridor) plan.rooms.erase(corridor);
  return plan;
}

}  // namespace muster::exam
