#include "exam/plan.hpp"

#include <algorithm>
#include <numbers>

namespace muster::exam {
namespace {

constexpr int drywall = 0, brick = 1;

// Draws a plan in its own frame; walls are turned into the world's at the end.
class Architect {
 public:
  Architect(Random& random, Plan& plan) : random_(random), plan_(plan) {}

  void draw() {
    const double width = random_.uniform(20, 34), depth = random_.uniform(12, 19);
    const double passage = random_.uniform(1.8, 2.8), middle = depth * random_.uniform(0.4, 0.6);
    plan_.whole = {{0, 0}, {width, depth}};
    plan_.corridor = {{0, middle - passage / 2}, {width, middle + passage / 2}};
    along_ = random_.chance(0.3) ? brick : drywall;
    for (const Room& side :
         {Room{{0, 0}, {width, plan_.corridor.low.y}}, Room{{0, plan_.corridor.high.y}, {width, depth}}})
      rooms_of(side, side.low.y > 0);
    wall({0, 0}, {width, 0}, brick);
    wall({0, depth}, {width, depth}, brick);
    wall({0, 0}, {0, depth}, brick);
    wall({width, 0}, {width, depth}, brick);
    some_brick();
  }

 private:
  void rooms_of(const Room& side, bool above) {
    const double inner = above ? side.low.y : side.high.y;  // y of the corridor's wall
    for (double x = 0; x < side.high.x;) {
      double next = x + random_.uniform(3.2, 6.5);
      if (side.high.x - next < 3.2) next = side.high.x;
      door_in(wall({x, inner}, {next, inner}, along_), true);
      room({{x, side.low.y}, {next, side.high.y}}, above);
      if (next < side.high.x) {
        const int between = wall({next, side.low.y}, {next, side.high.y}, random_.chance(0.25) ? brick : drywall);
        if (random_.chance(0.3)) door_in(between, random_.chance(0.5));
      }
      x = next;
    }
  }

  // A deep room may be split into two.
  void room(const Room& all, bool above) {
    const double depth = all.high.y - all.low.y;
    if (depth < 5.5 || random_.chance(0.6)) {
      plan_.rooms.push_back(all);
      return;
    }
    const double y = all.low.y + depth * random_.uniform(0.42, 0.58);
    door_in(wall({all.low.x, y}, {all.high.x, y}, drywall), true);
    const Room low{all.low, {all.high.x, y}}, high{{all.low.x, y}, all.high};
    plan_.rooms.push_back(above ? low : high);
    plan_.rooms.push_back(above ? high : low);
  }

  int wall(Vec2 a, Vec2 b, int material) {
    const int index = static_cast<int>(plan_.walls.size());
    plan_.walls.push_back({"w" + std::to_string(index + 1), a, b, 2.7, material == brick ? 0.2 : 0.1, material});
    return index;
  }

  void door_in(int wall, bool open) {
    const Wall& in = plan_.walls[static_cast<std::size_t>(wall)];
    const double length = std::hypot(in.b.x - in.a.x, in.b.y - in.a.y);
    const double at = to_millimetres(random_.uniform(0.4, length - 1.4));
    plan_.doors.push_back({"d" + std::to_string(plan_.doors.size() + 1), wall, at, 0.9, 2.0, open});
  }

  // Sets enough inner walls to brick: losses are identifiable only if links cross both materials often.
  void some_brick() {
    std::vector<std::size_t> inner;
    for (std::size_t i = 0; i + 4 < plan_.walls.size(); ++i) inner.push_back(i);
    const auto bricks = [&] {
      return std::count_if(inner.begin(), inner.end(), [&](auto i) { return plan_.walls[i].material == brick; });
    };
    while (bricks() < 3 || bricks() > static_cast<std::ptrdiff_t>(inner.size()) - 4)
      plan_.walls[random_.pick(inner)].material = bricks() < 3 ? brick : drywall;
  }

  Random& random_;
  Plan& plan_;
  int along_ = drywall;
};

Vec2 place_in(Random& random, const Room& room) {
  const double margin = 0.5;
  return {random.uniform(room.low.x + margin, room.high.x - margin),
          random.uniform(room.low.y + margin, room.high.y - margin)};
}

void place_stations(Random& random, Plan& plan, const PlanNeeds& needs) {
  const int count = needs.high_stations ? 4 + random.below(2) : 3 + random.below(3);
  std::vector<Vec2> taken;
  for (int i = 0; i < count; ++i) {
    const bool in_corridor = i == 0 && needs.corridor_station && plan.has_corridor;
    Vec2 own;
    for (int attempt = 0; attempt < 50; ++attempt) {  // apart from each other if there is space
      own = place_in(random, in_corridor ? plan.corridor : random.pick(plan.rooms));
      if (std::all_of(taken.begin(), taken.end(), [&](Vec2 t) { return std::hypot(t.x - own.x, t.y - own.y) > 4; }))
        break;
    }
    taken.push_back(own);
    const Vec2 at = plan.to_world(own);
    const bool high = needs.high_stations && i >= count - 2;
    plan.stations.push_back(
        {"beacon" + std::to_string(i + 1),
         {at.x, at.y, to_millimetres(high ? plan.top() + random.uniform(0.5, 1.3) : random.uniform(0.8, 1.9))},
         to_millimetres(random.uniform(-std::numbers::pi, std::numbers::pi))});
  }
}

// Draws the stated losses, the start of a fit.
void state_losses(Random& random, Plan& plan) {
  for (Material& m : plan.materials) m.stated = std::round(10 * m.loss * random.uniform(0.7, 1.4)) / 10;
}

}  // namespace

Vec2 Plan::to_world(Vec2 own) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return {to_millimetres(shift.x + c * own.x - s * own.y), to_millimetres(shift.y + s * own.x + c * own.y)};
}

Vec2 Plan::to_own(Vec2 world) const {
  const double c = std::cos(angle), s = std::sin(angle), x = world.x - shift.x, y = world.y - shift.y;
  return {c * x + s * y, -s * x + c * y};
}

double Plan::top() const {
  const auto lower = [](const Wall& a, const Wall& b) { return a.height < b.height; };
  return std::max_element(walls.begin(), walls.end(), lower)->height;
}

int Plan::room_at(Vec2 world) const {
  const Vec2 own = to_own(world);
  for (std::size_t i = 0; i < rooms.size(); ++i)
    if (rooms[i].holds(own)) return static_cast<int>(i);
  return -1;
}

Plan draw_plan(Random& random, const PlanNeeds& needs) {
  Plan plan;
  plan.angle = random.uniform(0, std::numbers::pi);
  plan.shift = {random.uniform(-15, 15), random.uniform(-15, 15)};
  plan.materials = {{"drywall", random.uniform(2.5, 5)}, {"brick", random.uniform(6, 11)}};
  state_losses(random, plan);
  Architect(random, plan).draw();
  for (Wall& w : plan.walls) {
    w.a = plan.to_world(w.a);
    w.b = plan.to_world(w.b);
  }
  place_stations(random, plan, needs);
  return plan;
}

Plan furnished(Plan given, Random& random, const PlanNeeds& needs) {
  for (Material& m : given.materials) m.loss = random.uniform(2.5, 11);
  state_losses(random, given);
  place_stations(random, given, needs);
  return given;
}

}  // namespace muster::exam
