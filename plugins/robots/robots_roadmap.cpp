// The roadmap that a robot is given: made once from the world's plan, for the robot's radius.
#include <cmath>
#include <cstring>

#include "description/world_robots.hpp"
#include "roadmap/plan.hpp"
#include "roadmap/rows.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

// What of a robot counts for its way, as it stands.
struct Body {
  double radius;     // of the circle around its origin that holds its plan, however it turns [m]
  double low, high;  // above its origin [m]
};

Body body_of(const description::Robot& robot) {
  const Eigen::AlignedBox3d box = bounds(robot);
  if (box.isEmpty()) throw BadInput("the robot's model has no shapes, thus no radius; expected radius=\"METRES\"");
  const Eigen::Vector3d far = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  return {std::hypot(far.x(), far.y()), box.min().z(), box.max().z()};
}

// Differs where a setting does, and is not 0: an instance that was exchanged makes its own roadmap.
double recipe_of(const std::vector<double>& settings) {
  uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const double setting : settings) {
    unsigned char bytes[sizeof setting];
    std::memcpy(bytes, &setting, sizeof setting);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
  }
  return static_cast<double>((hash >> 12) | 1);  // whole in a double
}

struct RobotsRoadmap {
  static constexpr auto id = "robots.roadmap/1";
  static constexpr auto summary = "a robot's roadmap, made from the plan for its radius: a grid or a visibility graph";
  static constexpr auto manual =
      "Walls are grown by the radius of the robot (of the circle around its origin that holds it however it turns) "
      "and\n"
      "a `margin`, with square corners. `method`: the reduced visibility graph of their corners (Lozano-Perez and\n"
      "Wesley 1979), whose ways are the shortest, or a grid of free places `step` apart, each joined to eight. It is\n"
      "made at the first tick, with the doors as they stand then; with open_doors every door is a way, and it is for\n"
      "the robot to find it closed. Walls above or below the robot, such as that over a door, are in nobody's way.\n"
      "Meshes of the world are not seen. control.navigate reads the result, robot/*/roadmap; its graph has the rows\n"
      "of the table that `muster roadmap` writes.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot that is given it").required(),
      choice("method", "visibility|grid", "the reduced visibility graph, or a lattice"),
      real("step", 0.5, 0.01, 100, "m", "between places of the grid; only with method=\"grid\""),
      real("radius", 0, 0, 100, "m", "of the robot; 0: by its model"),
      real("margin", 0.05, 0, 100, "m", "that it keeps from walls beyond its radius"),
      real("room", 1, 0, 1000, "m", "around walls and robot in which it plans"),
      flag("open_doors", false, "doors that are closed at the start count as open")};

  explicit RobotsRoadmap(Setup& s)
      : is_grid(s.param("method") == 1),
        open_doors(s.param("open_doors") != 0),
        step_length(s.param("step")),
        margin(s.param("margin")),
        room(s.param("room")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        pose(s.read<Pose>("robot/{robot}/pose")),
        cell(s.write<roadmap::Cell>("robot/{robot}/roadmap", MUSTER_SENSED)) {
    const WorldRobots robots(s, description::Meshes::import);
    const auto* robot = robots.of(s.param("robot") + 1);
    const double radius = s.param("radius");
    if (!robot && !(radius > 0)) throw BadInput("the robot has no model, thus no radius; expected radius=\"METRES\"");
    if (robot) body = body_of(*robot);
    if (radius > 0) body.radius = radius;
    recipe = recipe_of({s.param("method"), step_length, body.radius, margin, room, s.param("open_doors")});
    if (s.host()->rows(s.host(), "mesh") > 0)
      s.warn("self", "the world's meshes are not in the roadmap, which is made of walls alone");
  }

  void step(const Step& k) const {
    if (k.last(cell)->recipe == recipe) {
      k.put_bytes(cell, 0, roadmap::Cell::payload_column, k.last_bytes(cell, 0, roadmap::Cell::payload_column));
      const double graph = k[cell]->graph;
      *k[cell] = *k.last(cell);
      k[cell]->graph = graph;
      return;
    }
    const Pose& at = *k[pose];
    const auto blocks = roadmap::blocks_of(k[wall], k[door], k[state],
                                           open_doors ? roadmap::Doors::open : roadmap::Doors::as_they_stand,
                                           {at.z + body.low, at.z + body.high});
    roadmap::Graph graph;
    std::size_t alone = 0;
    std::vector<roadmap::Row> rows;
    try {
      const roadmap::Obstacles obstacles(blocks, body.radius + margin);
      const roadmap::Area area = roadmap::area_of(blocks, {{at.x, at.y}}, room + obstacles.radius());
      graph = roadmap::without_lone(
          is_grid ? roadmap::lattice(obstacles, area, step_length) : roadmap::visibility_graph(obstacles, area), alone);
      rows = roadmap::rows_of(graph, obstacles);
    } catch (const std::runtime_error& e) {
      throw BadInput(e.what());
    }
    const std::string_view bytes(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof rows[0]);
    k.put_bytes(cell, 0, roadmap::Cell::payload_column, bytes);
    const auto components = static_cast<double>(roadmap::count_of(roadmap::components_of(graph)));
    *k[cell] = {static_cast<double>(graph.nodes.size()),
                static_cast<double>(graph.edges.size()),
                static_cast<double>(roadmap::branches_of(graph)),
                components,
                body.radius + margin,
                recipe,
                k[cell]->graph};
    k.event("note: a roadmap of " + std::to_string(graph.nodes.size()) + " places and " +
            std::to_string(graph.edges.size()) + " pieces");
  }

  bool is_grid, open_doors;
  double step_length, margin, room;
  Body body{0, 0, 0.3};
  double recipe = 0;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  In<Pose> pose;
  Out<roadmap::Cell> cell;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsRoadmap)
