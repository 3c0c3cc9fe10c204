// Causes of the building and of the way of waves through it.
#include <algorithm>
#include <numbers>

#include "exam/simulated/planted_cause.hpp"

namespace muster::exam::simulated {
namespace {

// The number of readings that cross each wall.
std::vector<int> crossings_by_wall(const Setting& s) {
  std::vector<int> result(s.site.plan.walls.size(), 0);
  for (const auto& crossed : s.data.crossings)
    for (const Crossing& c : crossed) ++result[static_cast<std::size_t>(c.wall)];
  return result;
}

// A wall that one reading in fifty crosses, or more.
std::optional<int> crossed_wall(const Setting& s, Random& random) {
  const std::vector<int> count = crossings_by_wall(s);
  std::vector<int> often;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (count[i] * 50 > static_cast<int>(s.data.size())) often.push_back(static_cast<int>(i));
  if (often.empty()) return {};
  return random.pick(often);
}

PlantedCause of_wall(const char* id, const Setting& s, int wall) {
  const std::string& name = s.site.plan.walls[static_cast<std::size_t>(wall)].name;
  PlantedCause cause{id};
  cause.texts = {{"wall", name}};
  cause.rows = {"wall/" + name};
  return cause;
}

std::optional<PlantedCause> wall_material(const Setting& s, Random& random) {
  const auto wall = crossed_wall(s, random);
  if (!wall) return {};
  PlantedCause cause = of_wall("wall_material", s, *wall);
  cause.numbers = {{"change", random.uniform(2, 8), "dB"}};
  cause.kin = {"wall_absent"};
  cause.size = "change";
  cause.least = 0.5;
  cause.most = 20;
  return cause;
}

std::optional<PlantedCause> wall_absent(const Setting& s, Random& random) {
  const auto wall = crossed_wall(s, random);
  if (!wall) return {};
  PlantedCause cause = of_wall("wall_absent", s, *wall);
  cause.numbers = {{"share", 1}};
  cause.also = {"wall_material"};
  return cause;
}

// A place in a room, in the world's frame.
Vec2 place(const Setting& s, Random& random) {
  const Room& room = random.pick(s.site.plan.rooms);
  return s.site.plan.to_world({random.uniform(room.low.x, room.high.x), random.uniform(room.low.y, room.high.y)});
}

std::optional<PlantedCause> unmapped_wall(const Setting& s, Random& random) {
  const Vec2 middle = place(s, random);
  const double half = random.uniform(0.8, 2.5),
               turn = s.site.plan.angle + (random.chance(0.5) ? 0 : std::numbers::pi / 2) + 0.25 * random.normal();
  const double x = half * std::cos(turn), y = half * std::sin(turn);
  PlantedCause cause{"unmapped_wall"};
  cause.numbers = {{"x0", to_millimetres(middle.x - x), "m"},
                   {"y0", to_millimetres(middle.y - y), "m"},
                   {"x1", to_millimetres(middle.x + x), "m"},
                   {"y1", to_millimetres(middle.y + y), "m"},
                   {"loss", random.uniform(3, 10), "dB"}};
  cause.size = "loss";
  cause.least = 1;
  cause.most = 30;
  return cause;
}

std::optional<PlantedCause> obstacle(const Setting& s, Random& random) {
  const Vec2 middle = place(s, random);
  PlantedCause cause{"obstacle"};
  cause.numbers = {{"x", to_millimetres(middle.x), "m"},
                   {"y", to_millimetres(middle.y), "m"},
                   {"radius", to_millimetres(random.uniform(0.3, 1.2)), "m"},
                   {"loss", random.uniform(4, 12), "dB"}};
  cause.size = "loss";
  cause.least = 1;
  cause.most = 40;
  return cause;
}

std::optional<PlantedCause> room_clutter(const Setting& s, Random& random) {
  const Room& room = random.pick(s.site.plan.rooms);
  const Vec2 middle = s.site.plan.to_world({(room.low.x + room.high.x) / 2, (room.low.y + room.high.y) / 2});
  PlantedCause cause{"room_clutter"};
  cause.numbers = {{"x", to_millimetres(middle.x), "m"},
                   {"y", to_millimetres(middle.y), "m"},
                   {"length", to_millimetres(room.high.x - room.low.x), "m"},
                   {"width", to_millimetres(room.high.y - room.low.y), "m"},
                   {"heading", std::remainder(s.site.plan.angle, 2 * std::numbers::pi), "rad"},
                   {"loss", random.uniform(3, 10), "dB"}};
  cause.kin = {"obstacle", "unmapped_wall"};
  cause.size = "loss";
  cause.least = 0.5;
  cause.most = 30;
  return cause;
}

std::optional<PlantedCause> corridor(const Setting& s, Random& random) {
  if (!s.site.plan.has_corridor) return {};
  const Room& room = s.site.plan.corridor;
  const double y = (room.low.y + room.high.y) / 2;
  const Vec2 a = s.site.plan.to_world({room.low.x, y}), b = s.site.plan.to_world({room.high.x, y});
  PlantedCause cause{"corridor"};
  cause.numbers = {{"x0", to_millimetres(a.x), "m"},
                   {"y0", to_millimetres(a.y), "m"},
                   {"x1", to_millimetres(b.x), "m"},
                   {"y1", to_millimetres(b.y), "m"},
                   {"width", to_millimetres(room.high.y - room.low.y), "m"},
                   {"gain", random.uniform(0.3, 1.2)}};
  cause.size = "gain";
  cause.least = 0.05;
  cause.most = 4;
  return cause;
}

std::optional<PlantedCause> height(const Setting& s, Random& random) {
  const int high = static_cast<int>(std::count_if(s.site.plan.stations.begin(), s.site.plan.stations.end(),
                                                  [](const Station& v) { return v.at.z > 2.8; }));
  if (high == 0 || high == static_cast<int>(s.site.plan.stations.size())) return {};
  PlantedCause cause{"height"};
  cause.numbers = {{"z", 2.7, "m"}, {"loss", random.uniform(2, 10), "dB"}};
  cause.size = "loss";
  cause.least = 0.5;
  cause.most = 30;
  return cause;
}

std::optional<PlantedCause> incidence(const Setting&, Random& random) {
  PlantedCause cause{"incidence"};
  cause.numbers = {{"share", random.uniform(0.3, 1.5)}};
  cause.size = "share";
  cause.least = 0.02;
  cause.most = 4;
  return cause;
}

std::optional<PlantedCause> saturation(const Setting&, Random& random) {
  PlantedCause cause{"multiwall_saturation"};
  cause.numbers = {{"knee", random.uniform(6, 20), "dB"}};
  return cause;
}

std::optional<PlantedCause> dual_slope(const Setting&, Random& random) {
  PlantedCause cause{"dual_slope"};
  cause.numbers = {{"break", random.uniform(3, 9), "m"}, {"n_change", random.uniform(0.4, 2.5)}};
  cause.size = "n_change";
  cause.least = 0.05;
  cause.most = 6;
  return cause;
}

std::optional<PlantedCause> two_ray(const Setting&, Random& random) {
  PlantedCause cause{"two_ray"};
  cause.numbers = {{"reflection", random.uniform(0.5, 1)}, {"permittivity", random.uniform(3, 9)}};
  return cause;
}

// The world has no plan: the data have the number of walls instead.
std::optional<PlantedCause> counted_walls(const Setting& s, Random& random) {
  if (!s.counts_walls) return {};
  std::vector<int> often;
  for (std::size_t m = 0; m < s.site.plan.materials.size(); ++m)
    if (s.data.design.col(2 + static_cast<Eigen::Index>(m)).cwiseAbs().sum() >
        0.05 * static_cast<double>(s.data.size()))
      often.push_back(static_cast<int>(m));
  if (often.empty()) return {};
  const Material& material = s.site.plan.materials[static_cast<std::size_t>(random.pick(often))];
  PlantedCause cause{"counted_walls"};
  cause.texts = {{"material", material.name}, {"file", "places.csv"}};
  cause.rows = {"material/" + material.name};
  cause.numbers = {{"loss", material.loss, "dB"}};
  cause.size = "loss";
  cause.least = 0.3;
  cause.most = 30;
  return cause;
}

}  // namespace

std::vector<CauseKind> building_causes() {
  SiteNeeds high, hall;
  high.plan.high_stations = true;
  hall.plan.corridor_station = true;
  return {{"wall_material", {}, wall_material},
          {"wall_absent", {}, wall_absent},
          {"unmapped_wall", {}, unmapped_wall},
          {"obstacle", {}, obstacle},
          {"room_clutter", {}, room_clutter},
          {"corridor", hall, corridor},
          {"height", high, height},
          {"incidence", {}, incidence},
          {"multiwall_saturation", {}, saturation},
          {"dual_slope", {}, dual_slope},
          {"two_ray", {}, two_ray},
          {"counted_walls", {}, counted_walls}};
}

}  // namespace muster::exam::simulated
