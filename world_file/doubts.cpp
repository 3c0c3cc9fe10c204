#include "doubts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "below_ground.hpp"
#include "door_overlaps.hpp"
#include "params.hpp"
#include "stored_cells.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double longest_tick = 5;               // s; robots are steered some 10 to 100 times a second
constexpr double extent = 1000;                  // m; a scene's walls and floors are within it
constexpr double tower = 50, many_storeys = 20;  // m, and times the highest wall: where no station stands
constexpr std::size_t shape_width = 8;  // columns of a wall's shape: x0 y0 x1 y1 base height thickness material

struct Shape {
  const RowDeclaration* row;
  double cells[shape_width];
  double base() const { return cells[4]; }
  double height() const { return cells[5]; }
};

std::vector<Shape> shapes_of(const World& world) {
  std::vector<Shape> result;
  for (const auto& row : world.rows) {
    if (row.set != "wall") continue;
    Shape shape{&row, {}};
    const auto cells = stored_cells(row, "wall/shape", shape_width);
    std::copy(cells.begin(), cells.end(), shape.cells);
    result.push_back(shape);
  }
  return result;
}

// Numbers of an attribute that has been read and found sound; none where it is not given.
std::vector<double> numbers(const XmlElement& element, const char* name, std::size_t count) {
  const XmlAttribute* given = element.attribute(name);
  const auto values = given ? parse_reals(given->value, count) : std::nullopt;
  return values ? *values : std::vector<double>();
}

class Doubts {
 public:
  Doubts(const XmlElement& root, World& world) : root_(root), world_(world), walls_(shapes_of(world)) {}

  void look() {
    look_at_tick();
    look_at_spans();
    refuse_overlapping_doors(root_, world_);
    look_below_ground(root_, world_);
    for (const auto& child : root_.children) {
      for (const auto& inside : child.children) {  // of <at>: what joins later
        if (inside.name == "station") look_at_station(inside);
        if (inside.name == "robot") look_at_antenna(inside);
      }
      if (child.name == "door") look_at_door(child);
      if (child.name == "station") look_at_station(child);
      if (child.name == "robot") look_at_antenna(child);
      if (child.name == "floor") look_at_floor(child);
    }
  }

 private:
  void warn(const Place& place, const std::string& what) { world_.warnings.push_back({place, what}); }

  // Long ticks are sound where nobody steers: radios alone, or robots that measurements move.
  void look_at_tick() {
    const XmlAttribute* dt = root_.attribute("dt");
    const bool is_steered = std::any_of(world_.instances.begin(), world_.instances.end(), [](const auto& instance) {
      const bool has_robot = std::any_of(instance.attributes.begin(), instance.attributes.end(),
                                         [](const XmlAttribute& given) { return given.name == "robot"; });
      return has_robot && instance.plugin.rfind("control.", 0) == 0;
    });
    if (dt && is_steered && world_.dt > longest_tick)
      warn(dt->value_place, "attribute \"dt\": robots are steered once in " + print_real(world_.dt) +
                                " s; expected some 0.01 to 0.1 s; are these milliseconds?");
  }

  void look_at_spans() {
    using Key = std::tuple<double, double, double, double, double, double>;
    std::map<Key, const RowDeclaration*> first;
    for (const Shape& wall : walls_) {
      const double* c = wall.cells;
      const double* farthest = std::max_element(c, c + 4, [](double a, double b) { return std::abs(a) < std::abs(b); });
      if (std::abs(*farthest) > extent)
        throw invalid(wall.row->place, "wall " + quote(wall.row->name) + " reaches to " + print_real(*farthest) +
                                           " m, beyond the scene; expected coordinates within 1000 m; are these "
                                           "millimetres?");
      const bool is_turned = std::tie(c[2], c[3]) < std::tie(c[0], c[1]);  // ends may be exchanged
      const double* a = is_turned ? c + 2 : c;
      const double* b = is_turned ? c : c + 2;
      const auto [other, is_new] = first.emplace(Key{a[0], a[1], b[0], b[1], wall.base(), wall.height()}, wall.row);
      if (!is_new)
        warn(wall.row->place, "wall " + quote(wall.row->name) + " has the ends of wall " + quote(other->second->name) +
                                  " (" + other->second->place.text() +
                                  "), so that links pay for both; expected one of the two");
    }
  }

  // The default height does not count: a low wall's door is as high as it.
  void look_at_door(const XmlElement& door) {
    const XmlAttribute *given = door.attribute("height"), *wall = door.attribute("wall");
    const auto height = numbers(door, "height", 1);
    for (const Shape& each : walls_) {
      if (height.empty() || each.row->name != wall->value || !(height[0] > each.height())) continue;
      warn(given->value_place, "attribute \"height\": the door is " + print_real(height[0]) + " m high in a wall of " +
                                   print_real(each.height()) + " m; expected at most that");
    }
  }

  void look_at_station(const XmlElement& station) {
    const auto at = numbers(station, "at", 3);
    double top = 0;
    for (const Shape& wall : walls_) top = std::max(top, wall.base() + wall.height());
    if (at.empty() || top <= 0 || !(at[2] > tower && at[2] > many_storeys * top)) return;
    warn(station.attribute("at")->value_place, "attribute \"at\": " + print_real(at[2]) + " m up, beside walls of " +
                                                   print_real(top) + " m; is this centimetres?");
  }

  void look_at_antenna(const XmlElement& robot) {
    const auto at = numbers(robot, "at", 3), antenna = numbers(robot, "antenna", 3);
    if (at.empty() || antenna.empty() || at[2] < 0 || !(at[2] + antenna[2] < 0)) return;
    warn(robot.attribute("antenna")->value_place,
         "attribute \"antenna\": it is " + print_real(-at[2] - antenna[2]) + " m below the ground");
  }

  // The corners in turn around their middle, where that makes edges that do not cross; as they are given else.
  static std::vector<double> in_turn(const std::vector<double>& corners) {
    double x = 0, y = 0;
    for (std::size_t i = 0; i < corners.size(); i += 2) x += corners[i] / 4, y += corners[i + 1] / 4;
    std::vector<std::pair<double, std::size_t>> order;
    const double first = std::atan2(corners[1] - y, corners[0] - x);
    for (std::size_t i = 0; i < corners.size(); i += 2) {
      const double angle = std::atan2(corners[i + 1] - y, corners[i] - x) - first;
      order.emplace_back(angle < 0 ? angle + 2 * std::acos(-1.0) : angle, i);
    }
    std::sort(order.begin(), order.end());
    std::vector<double> result;
    for (const auto& [angle, i] : order) result.push_back(corners[i]), result.push_back(corners[i + 1]);
    return result;
  }

  // True if two edges of the four corners cross in a point that is no end of either.
  static bool is_crossed(const std::vector<double>& c) {
    const auto side = [&](std::size_t a, std::size_t b, std::size_t p) {
      return (c[2 * b] - c[2 * a]) * (c[2 * p + 1] - c[2 * a + 1]) -
             (c[2 * b + 1] - c[2 * a + 1]) * (c[2 * p] - c[2 * a]);
    };
    const auto cross = [&](std::size_t a, std::size_t b, std::size_t p, std::size_t q) {
      return side(a, b, p) * side(a, b, q) < 0 && side(p, q, a) * side(p, q, b) < 0;
    };
    return cross(0, 1, 2, 3) || cross(1, 2, 3, 0);
  }

  void look_at_corners(const XmlElement& floor) const {
    const auto corners = numbers(floor, "corners", 8);
    if (corners.empty() || !is_crossed(corners)) return;
    std::string turned;
    for (const double each : in_turn(corners)) turned += (turned.empty() ? "" : " ") + print_real(each);
    const XmlAttribute* name = floor.attribute("name");
    throw invalid(floor.attribute("corners")->value_place,
                  "floor" + (name ? ' ' + quote(name->value) : "") +
                      ": two of its edges cross; expected its corners in turn, around it: corners=\"" + turned + '"');
  }

  void look_at_floor(const XmlElement& floor) {
    look_at_corners(floor);
    const auto z = numbers(floor, "z", 1);
    if (z.empty() || std::abs(z[0]) <= extent) return;
    throw invalid(floor.attribute("z")->value_place, "attribute \"z\": " + print_real(z[0]) +
                                                         " m is beyond the scene; expected a height within 1000 m; is "
                                                         "this millimetres?");
  }

  const XmlElement& root_;
  World& world_;
  std::vector<Shape> walls_;
};

}  // namespace

void look_for_doubts(const XmlElement& root, World& world) { Doubts(root, world).look(); }

}  // namespace muster
