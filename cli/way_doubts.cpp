#include "way_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "declared_rows.hpp"
#include "roadmap/plan.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/table_doubts.hpp"
#include "text/text_table.hpp"

namespace muster::cli {
namespace {

namespace rm = muster::roadmap;

constexpr double kilometre = 1000;            // m
constexpr double far_off = 100;               // m; and
constexpr double fastest = 100;               // m/s, at which no robot reaches it within the run
constexpr rm::Heights in_the_way{0.05, 0.2};  // m, of what a robot on the ground runs into

struct Way {
  const Instance* instance;
  rm::Point start;
  TextTable table;
  std::vector<rm::Point> points;
};

double param_of(const Instance& instance, const std::string& name) {
  return instance.params().at(static_cast<std::size_t>(instance.find_param(name)));
}

bool leads(const Instance& instance) {
  const std::string& plugin = instance.declared().plugin;
  return (plugin == "control.waypoint" || plugin == "control.strafe") && instance.declared().attribute("path") &&
         instance.bound_row() >= 0;
}

Way way_of(const Simulation& run, const Instance& instance) {
  const auto poses = declared_rows<Pose>(run.world(), "robot", "pose");
  const Pose at = poses.at(static_cast<std::size_t>(instance.bound_row()));
  Way way{&instance,
          {at.x, at.y},
          TextTable::read(run.world().file.parent_path() / instance.declared().attribute("path")->value),
          {}};
  const auto x = way.table.reals(way.table.require("x", "m")), y = way.table.reals(way.table.require("y", "m"));
  for (std::size_t i = 0; i < x.size(); ++i) way.points.push_back({x[i], y[i]});
  return way;
}

// True of places that are not told to be doubtful where the table is read.
bool is_sound(const TextTable& table) {
  const auto is_plain = [&](const char* name) {
    const std::size_t column = table.require(name, "m");
    return column_doubts(table, column, table.reals(column)).empty();
  };
  return is_plain("x") && is_plain("y");
}

std::string far_away(const Way& way, double until) {
  for (std::size_t i = 0; i < way.points.size() && until > 0; ++i) {
    const double away = rm::distance(way.start, way.points[i]);
    if (away > far_off && away > fastest * until && is_sound(way.table))
      return way.table.place(i, 0).text() + ": a way point " + print_real(std::round(away)) +
             " m away, where no robot comes in the run of " + print_real(until) + " s; are these " +
             (away < kilometre ? "centimetres?" : "millimetres?");
  }
  return "";
}

// Places of the globe: all of a track lie within a thousandth of a degree or so, and far from the plan.
std::string on_the_globe(const Way& way) {
  constexpr double extent = 0.1, away = 5;  // m, if they were metres
  constexpr std::size_t fewest = 3;
  if (way.points.size() < fewest) return "";
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300, nearest = 1e300;
  for (const rm::Point& each : way.points) {
    x0 = std::min(x0, each.x), x1 = std::max(x1, each.x), y0 = std::min(y0, each.y), y1 = std::max(y1, each.y);
    nearest = std::min(nearest, rm::distance(way.start, each));
  }
  const double size = std::hypot(x1 - x0, y1 - y0);
  if (!(size > 0 && size < extent && nearest > away)) return "";
  return way.table.place(0, 0).text() + ": all " + std::to_string(way.points.size()) + " way points lie within " +
         print_real(std::ceil(size * 1000) / 1000) + " m, and " + print_real(std::round(nearest)) +
         " m from the start; are these latitude and longitude? expected metres of the plan: 0.00001 degrees of "
         "latitude "
         "are 1.1 m to the north";
}

std::string at_once(const Way& way) {
  const double tolerance = param_of(*way.instance, "tolerance");
  double longest = 0;
  for (const rm::Point& each : way.points) longest = std::max(longest, rm::distance(way.start, each));
  const XmlAttribute* given = way.instance->declared().attribute("tolerance");
  if (!given || longest == 0 || !(longest <= tolerance)) return "";
  return given->value_place.text() + ": attribute \"tolerance\": " + print_real(tolerance) +
         " m is more than the way to each way point, " + std::string("at most ") +
         print_real(std::round(longest * 100) / 100) +
         " m, so that all count as reached at the start; is this centimetres? " + print_real(tolerance) + " cm are " +
         print_real(tolerance / 100) + " m";
}

// Physics that lets walls stop robots.
bool has_hard_walls(const Simulation& run) {
  return std::any_of(run.instances().begin(), run.instances().end(), [](const auto& each) {
    const std::string& plugin = each->declared().plugin;
    if (plugin == "physics.simbody") return true;
    return (plugin == "physics.ode" || plugin == "physics.mujoco") && param_of(*each, "obstacles") != 0;
  });
}

// `wall "north" (world.xml:3:3)`: the first whose middle line the piece crosses; "a wall" where it is its edge alone.
std::string wall_between(const World& world, const std::vector<Wall>& walls, const rm::Point& from,
                         const rm::Point& to) {
  const auto side = [](const rm::Point& a, const rm::Point& b, const rm::Point& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  std::size_t row = 0;
  for (const RowDeclaration& declared : world.rows) {
    if (declared.set != "wall") continue;
    const Wall& wall = walls[row++];
    const rm::Point a{wall.x0, wall.y0}, b{wall.x1, wall.y1};
    if (side(a, b, from) * side(a, b, to) <= 0 && side(from, to, a) * side(from, to, b) <= 0)
      return "wall " + quote(declared.name) + " (" + declared.place.text() + ')';
  }
  return "a wall";
}

// The first piece of the way that crosses a wall, doors open.
std::string through_wall(const Simulation& run, const Way& way) {
  const World& world = run.world();
  const auto walls = declared_rows<Wall>(world, "wall", "shape");
  const auto states = declared_rows<DoorState>(world, "door", "state");
  const rm::Obstacles obstacles(
      rm::blocks_of(walls, declared_rows<Door>(world, "door", "shape"), states, rm::Doors::open, in_the_way), 0);
  rm::Point from = way.start;
  for (std::size_t i = 0; i < way.points.size(); ++i) {
    const rm::Point to = way.points[i];
    if (obstacles.is_free(from) && !obstacles.is_free(from, to))
      return way.table.place(i, 0).text() + ": the way to this way point leads through " +
             wall_between(world, walls, from, to) +
             ", which stops the robot; expected way points around it, or <control.navigate>, which finds a way";
    from = to;
  }
  return "";
}

}  // namespace

std::vector<std::string> way_doubts(const Simulation& run) {
  std::vector<std::string> result;
  const bool is_hard = has_hard_walls(run);
  for (const auto& instance : run.instances()) {
    if (!leads(*instance)) continue;
    const Way way = way_of(run, *instance);
    std::string doubt = far_away(way, run.world().until());
    if (doubt.empty()) doubt = on_the_globe(way);
    if (doubt.empty()) doubt = at_once(way);
    if (doubt.empty() && is_hard && is_sound(way.table)) doubt = through_wall(run, way);
    if (!doubt.empty()) result.push_back(doubt);
  }
  return result;
}

}  // namespace muster::cli
