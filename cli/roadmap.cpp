// muster roadmap WORLD: where a robot can drive on the world's plan, as a table of pieces, and a way from place to
// place.
#include <fmt/core.h>

#include <cmath>
#include <muster/tables.hpp>

#include "declared_rows.hpp"
#include "diagnosis/radio/links/run_tables.hpp"
#include "roadmap/plan.hpp"
#include "roadmap/route.hpp"
#include "roadmap/rows.hpp"
#include "run_options.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/text_table_writer.hpp"
#include "world_file/kinds.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

namespace rm = muster::roadmap;

struct RoadmapWords {
  std::string world, out, path, method = "visibility";
  std::optional<std::string> robot, radius;
  std::vector<std::string> plugins;
  std::vector<double> from, to;
  double step = 0.5, margin = 0.05, room = 1, height = 0.5;
  bool open_doors = false, json = false;
};

RoadmapWords roadmap_words(const Arguments& arguments) {
  CommandLine line("roadmap",
                   "Where a robot can drive on a world's plan: walls are grown by its radius, and the free space is "
                   "made a graph,\n"
                   "of a grid or of what corners see of one another. A table for control.navigate; and, with --path, "
                   "the shortest\n"
                   "way as points for any controller that follows such. Doors stand as the world file has them.\n"
                   "Example: muster roadmap worlds/navigate --out roadmap.csv --to 11 1 --path way.csv");
  RoadmapWords words;
  std::string step = "0.5", margin = "0.05", room = "1", height = "0.5";
  std::vector<std::string> from, to;
  line.option("world", words.world, "the world's folder or file").required();
  line.option("--robot", words.robot, "whose radius, by its model; the only one of the world if there is one");
  line.option("--radius", words.radius, "of the robot, in m, instead").excludes("--robot");
  line.option("--method", words.method, "how the free space is made a graph")
      .one_of({"visibility", "grid"})
      .shows_default();
  line.option("--step", step, "with --method grid: between its places, in m").shows_default();
  line.option("--margin", margin, "kept from walls beyond the radius, in m").shows_default();
  line.option("--room", room, "around walls and robots, in m").shows_default();
  line.option("--height", height, "with --radius: walls above it are in nobody's way, in m").shows_default();
  line.flag("--open-doors", words.open_doors, "doors that are closed count as open");
  line.option("--from", from, "X Y in m; by default where the robot is").takes(2);
  line.option("--to", to, "X Y in m of a goal: the length of the shortest way there").takes(2);
  line.option("--path", words.path, "a table x[m],y[m] of that way, for control.waypoint or control.connectivity");
  line.option("--out", words.out, "the table to write, a row a piece and a wall").required();
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first");
  line.flag("--json", words.json, "print the figures as JSON");
  line.only_with("--step", "--method", "grid");
  line.only_with("--height", "--radius");
  line.parse(arguments);
  const auto positive = [](const std::string& text, const char* option, double least) {
    const double value = real_of(text, option);
    if (value >= least && value <= 1000) return value;
    throw Error(Exit::invalid_input,
                std::string(option) + ": " + text + " m; expected metres from " + print_real(least) + " to 1000");
  };
  words.step = positive(step, "--step", 0.01), words.margin = positive(margin, "--margin", 0);
  words.room = positive(room, "--room", 0), words.height = positive(height, "--height", 0.01);
  if (words.radius) positive(*words.radius, "--radius", 1e-3);
  for (const std::string& one : from) words.from.push_back(real_of(one, "--from", "m"));
  for (const std::string& one : to) words.to.push_back(real_of(one, "--to", "m"));
  if (words.to.empty() && (!words.path.empty() || !words.from.empty()))
    throw Error(Exit::invalid_input,
                std::string(words.path.empty() ? "--from" : "--path") + " needs a goal; expected --to X Y beside it");
  return words;
}

std::vector<std::string> declared_names(const World& world, const std::string& set) {
  std::vector<std::string> result;
  for (const RowDeclaration& row : world.rows)
    if (row.set == set) result.push_back(row.name);
  return result;
}

// The box that a robot of the world fills, by its model.
Geometry box_of(World world, std::size_t robot, const RoadmapWords& words) {
  world.stand_still();
  world.records = {{"robot/*/geometry", 1, {"--robot"}}};  // so that its provider joins
  Simulation run(std::move(world), standard(), {plugin_path(words.plugins), 1, {}});
  run.evaluate(MUSTER_SENSE, true);
  return rows_of<Geometry>(run, "robot/*/geometry").at(robot);
}

struct PlannedRobot {
  std::size_t row = 0;
  bool is_of_world = false;  // false: only a radius was given
  std::string name;
  double radius = 0;
  rm::Heights heights{0, 0};
};

PlannedRobot planned_robot(const World& world, const RoadmapWords& words) {
  PlannedRobot result;
  const auto names = declared_names(world, "robot");
  if (words.radius) {
    result.radius = real_of(*words.radius, "--radius", "m");
    result.heights = {0, words.height};
    return result;
  }
  if (!words.robot && names.size() != 1)
    throw Error(Exit::invalid_input, world.file.string() + ": the world has " + std::to_string(names.size()) +
                                         " robots; expected --robot NAME or --radius R");
  result.name = words.robot ? *words.robot : names[0];
  const auto found = std::find(names.begin(), names.end(), result.name);
  if (found == names.end())
    throw Error(Exit::invalid_input, "--robot: no robot is called " + quote(result.name) +
                                         which_is(world, result.name, "robot") + "; " + suggest(result.name, names));
  result.row = static_cast<std::size_t>(found - names.begin());
  result.is_of_world = true;
  const Geometry box = box_of(world, result.row, words);
  result.radius = std::hypot(std::abs(box.x) + box.length / 2, std::abs(box.y) + box.width / 2);
  if (!(result.radius > 0))
    throw Error(Exit::invalid_input,
                "--robot: the model of " + quote(result.name) + " has no shapes; expected --radius R instead");
  const double z = declared_rows<Pose>(world, "robot", "pose").at(result.row).z;
  result.heights = {z + box.z - box.height / 2, z + box.z + box.height / 2};
  return result;
}

struct MadeRoadmap {
  rm::Graph graph;
  rm::Obstacles obstacles;
  rm::Area area{};
  std::size_t alone = 0;
};

MadeRoadmap made_roadmap(const World& world, const PlannedRobot& robot, const RoadmapWords& words) {
  const auto blocks =
      rm::blocks_of(declared_rows<Wall>(world, "wall", "shape"), declared_rows<Door>(world, "door", "shape"),
                    declared_rows<DoorState>(world, "door", "state"),
                    words.open_doors ? rm::Doors::open : rm::Doors::as_they_stand, robot.heights);
  std::vector<rm::Point> places;
  for (const Pose& p : declared_rows<Pose>(world, "robot", "pose")) places.push_back({p.x, p.y});
  for (const auto* one : {&words.from, &words.to})
    if (!one->empty()) places.push_back({(*one)[0], (*one)[1]});
  MadeRoadmap made;
  try {
    made.obstacles = rm::Obstacles(blocks, robot.radius + words.margin);
    made.area = rm::area_of(blocks, places, words.room + made.obstacles.radius());
    made.graph = rm::without_lone(words.method == "grid" ? rm::lattice(made.obstacles, made.area, words.step)
                                                         : rm::visibility_graph(made.obstacles, made.area),
                                  made.alone);
  } catch (const std::runtime_error& e) {
    throw Error(Exit::invalid_input, world.file.string() + ": " + e.what());
  }
  return made;
}

struct RobotsGoal {
  std::string robot;
  rm::Point at;
};

// Goals of controllers that name robot and goals, where the file can be read; else the run will say why.
std::vector<RobotsGoal> goals_of(const World& world) {
  std::vector<RobotsGoal> result;
  for (const InstanceDeclaration& instance : world.instances) {
    const auto value = [&](const char* name) {
      const auto found = std::find_if(instance.attributes.begin(), instance.attributes.end(),
                                      [&](const XmlAttribute& a) { return a.name == name; });
      return found == instance.attributes.end() ? std::string() : found->value;
    };
    if (value("goals").empty() || value("robot").empty()) continue;
    try {
      const TextTable table = TextTable::read(world.file.parent_path() / value("goals"));
      const auto x = table.reals(table.require("x", "m")), y = table.reals(table.require("y", "m"));
      for (std::size_t i = 0; i < x.size(); ++i) result.push_back({value("robot"), {x[i], y[i]}});
    } catch (const Error&) {
      continue;
    }
  }
  return result;
}

constexpr double largest = 10;                          // m, radius of a robot, and
constexpr double usual_least = 0.05, usual_most = 1.5;  // of one that is meant in another unit

// `; is this in centimetres? expected --radius 0.3`, of a radius that no robot has.
std::string meant_radius(double radius) {
  const double in_centimetres = radius / 100, in_millimetres = radius / 1000;
  const bool is_usual = in_centimetres >= usual_least && in_centimetres <= usual_most;
  return std::string("; is this in ") + (is_usual ? "centi" : "milli") + "metres? expected --radius " +
         print_real(is_usual ? in_centimetres : in_millimetres);
}

// Throws Error where the walls, grown by a radius that no robot has, leave no place for any robot of the world.
void check_radius(const World& world, const PlannedRobot& robot, const MadeRoadmap& made) {
  if (robot.is_of_world || robot.radius <= largest) return;
  const auto poses = declared_rows<Pose>(world, "robot", "pose");
  if (std::any_of(poses.begin(), poses.end(), [&](const Pose& p) { return made.obstacles.is_free({p.x, p.y}); }))
    return;
  throw Error(Exit::invalid_input, "--radius: " + print_real(robot.radius) + " m, with which " +
                                       (poses.empty() ? "no robot drives between these walls"
                                                      : "no robot of the world has room where it stands") +
                                       meant_radius(robot.radius));
}

// What keeps robots from where they are to go.
std::vector<std::string> roadmap_warnings(const World& world, const PlannedRobot& robot, const MadeRoadmap& made) {
  std::vector<std::string> result;
  if (robot.radius > largest)
    result.push_back(
        (robot.is_of_world ? "robot " + quote(robot.name) + " has a radius of " : "--radius: ") +
        print_real(robot.radius) + " m, more than any robot" +
        (robot.is_of_world ? "; is its model in millimetres? expected metres" : meant_radius(robot.radius)));
  const auto names = declared_names(world, "robot");
  const auto poses = declared_rows<Pose>(world, "robot", "pose");
  const auto goals = goals_of(world);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (robot.is_of_world && i != robot.row) continue;
    const rm::Point at{poses[i].x, poses[i].y};
    const std::string who = "robot " + quote(names[i]);
    if (!made.obstacles.is_free(at) && robot.radius <= largest)
      result.push_back(who + " stands in no free space, " + print_real(made.obstacles.clearance(at)) +
                       " m from a wall; expected at least " + print_real(made.obstacles.radius()) + " m on all sides");
    rm::Point from = at;
    for (const RobotsGoal& goal : goals) {
      if (goal.robot != names[i]) continue;
      const rm::Route way = rm::route(made.graph, made.obstacles, from, goal.at);
      if (!way.fault.empty()) result.push_back(who + " cannot reach its goal: " + way.fault);
      from = goal.at;
    }
  }
  if (!declared_names(world, "mesh").empty())
    result.push_back("the world's meshes are not in the roadmap, which is made of walls alone");
  return result;
}

void write_roadmap(const MadeRoadmap& made, const std::string& file) {
  TextTableWriter table(file, {{"x0", "m"}, {"y0", "m"}, {"x1", "m"}, {"y1", "m"}, {"width", "m"}, {"radius", "m"}});
  for (const rm::Row& r : rm::rows_of(made.graph, made.obstacles)) {
    for (const double cell : {r.x0, r.y0, r.x1, r.y1, r.width, r.radius}) table.real(cell);
    table.end_row();
  }
  table.close();
}

void write_way(const rm::Route& way, const std::string& file) {
  TextTableWriter table(file, {{"x", "m"}, {"y", "m"}});
  for (const rm::Point& p : way.points) {
    table.real(p.x), table.real(p.y);
    table.end_row();
  }
  table.close();
}

// The way that --to asks for. Throws Error where there is none and a file of it is wanted.
std::optional<rm::Route> wanted_way(const World& world, const PlannedRobot& robot, const MadeRoadmap& made,
                                    const RoadmapWords& words, std::vector<std::string>& warnings) {
  if (words.to.empty()) return {};
  if (words.from.empty() && !robot.is_of_world)
    throw Error(Exit::invalid_input, "--to needs a start; expected --from X Y, or --robot NAME in place of --radius");
  rm::Point from;
  if (words.from.empty()) {
    const Pose at = declared_rows<Pose>(world, "robot", "pose").at(robot.row);
    from = {at.x, at.y};
  } else {
    from = {words.from[0], words.from[1]};
  }
  rm::Route way = rm::route(made.graph, made.obstacles, from, {words.to[0], words.to[1]});
  if (way.fault.empty()) return way;
  const bool is_large = made.obstacles.radius() > largest;
  const std::string large = is_large ? "; is the radius in millimetres? expected metres" : "";
  const std::string option = way.fault.starts_with("the start ") ? (words.from.empty() ? "" : "--from: ") : "--to: ";
  if (!words.path.empty()) throw Error(Exit::invalid_input, option + way.fault + large);
  warnings.push_back(option + way.fault);
  return {};
}

std::string method_text(const RoadmapWords& words) {
  return words.method == "grid" ? "grid of " + print_real(words.step) + " m" : "visibility graph";
}

}  // namespace

int run_roadmap(const Arguments& arguments) {
  const RoadmapWords words = roadmap_words(arguments);
  WrittenFiles files;
  files.reads_world(words.world);
  files.writes(words.out, "--out");
  files.writes(words.path, "--path");
  const World world = read_world(words.world, standard());
  const PlannedRobot robot = planned_robot(world, words);
  const MadeRoadmap made = made_roadmap(world, robot, words);
  check_radius(world, robot, made);
  std::vector<std::string> warnings = roadmap_warnings(world, robot, made);
  const auto way = wanted_way(world, robot, made, words, warnings);

  write_roadmap(made, words.out);
  if (way && !words.path.empty()) write_way(*way, words.path);
  const std::size_t components = rm::count_of(rm::components_of(made.graph)), branches = rm::branches_of(made.graph);
  const double free = rm::free_area(made.obstacles, made.area);
  const double whole = (made.area.x1 - made.area.x0) * (made.area.y1 - made.area.y0);
  if (words.json) {
    Json json{{"world", world.name},
              {"method", words.method},
              {"radius_m", made.obstacles.radius()},
              {"nodes", made.graph.nodes.size()},
              {"edges", made.graph.edges.size()},
              {"branches", branches},
              {"components", components},
              {"left_out", made.alone},
              {"free_m2", free},
              {"area_m2", whole},
              {"warnings", Json::array()},
              {"file", words.out}};
    if (way) json["way_m"] = way->length, json["way_pieces"] = way->points.size() - 1;
    for (const std::string& one : warnings) json["warnings"].push_back(one);
    return fmt::print("{}\n", json.dump(2)), 0;
  }
  for (const std::string& one : warnings) fmt::print("warning: {}\n", one);
  fmt::print("{}: {}, walls grown by {:.3f} m ({:.3f} m and a margin)\n", world.name, method_text(words),
             made.obstacles.radius(), robot.radius);
  fmt::print("  {} places, {} pieces, {} branches, {} component{}\n", made.graph.nodes.size(), made.graph.edges.size(),
             branches, components, components == 1 ? "" : "s");
  if (made.alone > 0) fmt::print("  {} places that no piece leads to are left out\n", made.alone);
  fmt::print("  free: {:.1f} of {:.1f} m2\n", free, whole);
  if (way) fmt::print("  the way: {:.3f} m by {} pieces\n", way->length, way->points.size() - 1);
  fmt::print("  wrote {}\n", words.out);
  if (way && !words.path.empty()) fmt::print("  wrote {}\n", words.path);
  return 0;
}

}  // namespace muster::cli
