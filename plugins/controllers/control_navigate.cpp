// Plans a robot's way on a roadmap, follows it, and plans anew where its laser sees it blocked.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "description/world_robots.hpp"
#include "plugins/heading.hpp"
#include "plugins/periods.hpp"
#include "plugins/table_rows.hpp"
#include "roadmap.hpp"
#include "roadmap/route.hpp"
#include "roadmap/rows.hpp"
#include "rssi_map.hpp"
#include "seen_obstacles.hpp"

namespace {

using namespace muster;
using roadmap::Point;

std::string metres(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 2).ptr};
}

struct ControlNavigate {
  static constexpr auto id = "control.navigate/2";
  static constexpr auto summary =
      "plans a robot's way on a roadmap (A*), follows it and plans anew where it is blocked";
  static constexpr auto manual =
      "The goal is robot/*/goal2d, which control.mission asks for, or each row of `goals` in turn. The way is the\n"
      "cheapest on the roadmap by A* (Hart, Nilsson, Raphael 1968), straight onto it and straight off it; the robot\n"
      "pursues a point of it `lookahead` ahead (control.connectivity's law). The roadmap is a table of muster roadmap\n"
      "(`roadmap`), or that of a robots.roadmap in the world. Two inputs are optional. With `laser` an echo farther "
      "than\n"
      "`off_plan` from every wall of the roadmap is an obstacle: pieces nearer to it than the roadmap's radius are\n"
      "closed, until it was not seen for `forget`, and where the way ahead is closed the robot plans anew. With "
      "`rssi`,\n"
      "a table of muster map, each metre counts as 1 + `weight` for each dB that `station`'s rssi there is below\n"
      "`threshold`. Without a way the robot stops, says why, and tries again each second. The table self/state has "
      "what\n"
      "it does: status (0 no goal, 1 on its way, 2 there, 3 no way), plans made, place along the way, echoes kept. "
      "The\n"
      "robot knows its odometry, in whose frame roadmap and goals are.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it steers").required(),
      file("roadmap", "of muster roadmap; by default the robot's own, of robots.roadmap"),
      file("goals", "x[m],y[m] of places to go to in turn; by default robot/*/goal2d"),
      flag("loop", false, "begin anew after the last row of goals; only with goals"),
      flag("laser", false, "echoes that are on no wall of the roadmap close pieces of it"),
      file("rssi", "of muster map: x[m],y[m] and a column of the station, such as base[dBm]"),
      reference("station", "radio", "whose column of rssi counts; only with rssi"),
      real("threshold", -70, -200, 100, "dBm", "rssi below which a way costs more; only with rssi"),
      real("weight", 0.1, 0, 1000, "1/dB", "cost of a metre for each dB below the threshold; only with rssi"),
      real("speed", 0.3, 0, 10, "m/s", "along the way"),
      real("slow_gain", 1, 0, 100, "1/s", "speed for each metre that is left"),
      real("turn_gain", 2, 0, 100, "1/s", "at the goal: turn rate for each radian of bearing"),
      real("turn_speed", 1, 0, 10, "rad/s", "largest turn rate at the goal, and that of turns on the spot"),
      real("lookahead", 0.25, 0.01, 10, "m", "how far along the way it aims"),
      real("tolerance", 0.05, 1e-6, 10, "m", "the goal is reached within this distance"),
      real("turn_tolerance", 0.01, 1e-6, 3, "rad", "and the heading within this angle"),
      real("off_plan", 0.2, 0, 10, "m", "an echo farther than this from every wall is an obstacle; only with laser"),
      real("reach", 3, 0.01, 1000, "m", "echoes from beyond are left out; only with laser"),
      real("forget", 30, 0.001, 1e6, "s", "an obstacle that was not seen for so long is gone; only with laser")};

  enum Status { no_goal, on_its_way, there, no_way };

  struct State {
    static constexpr const char* columns =
        "status goal_x[m]? goal_y[m]? next reached plans along[m] length[m] cost[m] echoes told way{} seen{}";
    double status, goal_x, goal_y;
    double next, reached;        // row of goals, from 0; number of those reached
    double plans;                // made so far
    double along, length, cost;  // place on the way; its length, and what A* made of it
    double echoes;               // kept
    double told, way, seen;      // 1: its way to the goal was an event; points of the way; the echoes
  };
  static constexpr unsigned way_column = 11, seen_column = 12;

  // What a tick begins with and leaves.
  struct Memory {
    State now;
    std::vector<Waypoint> way;
    SeenObstacles seen;
  };

  explicit ControlNavigate(Setup& s)
      : loop(s.value("loop")),
        threshold(s.value("threshold")),
        weight(s.value("weight")),
        speed(s.value("speed")),
        slow_gain(s.value("slow_gain")),
        turn_gain(s.value("turn_gain")),
        turn_speed(s.value("turn_speed")),
        lookahead(s.value("lookahead")),
        tolerance(s.value("tolerance")),
        turn_tolerance(s.value("turn_tolerance")),
        off_plan(s.value("off_plan")),
        reach(s.value("reach")),
        forget(s.value("forget")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        command(s.write<Command>("robot/{robot}/command")),
        state(s.write<State>("self/state")) {
    if (s.text("roadmap").empty()) {
      cell = s.read_if_any<roadmap::Cell>("robot/{robot}/roadmap");
      robot = s.host()->row_name(s.host(), "robot", static_cast<uint32_t>(s.param("robot")));
    } else {
      rows = s.file<roadmap::Row>("roadmap");
      road_rows.emplace(s, "roadmap");
    }
    if (s.text("goals").empty()) {
      goal = s.read<Goal2d>("robot/{robot}/goal2d");
    } else {
      goals = s.file<Waypoint>("goals");
      goal_rows.emplace(s, "goals");
    }
    if (s.param("laser") != 0) {
      scan = s.read<Scan>("scan/{robot}/message");
      description::WorldRobots(s, description::Meshes::skip).require_laser(s, s.param("robot"));
    }
    if (!s.text("rssi").empty()) take_station(s);
  }

  void take_station(Setup& s) {
    if (s.param("station") < 0) throw BadInput("has rssi and no station; expected station=\"RADIO\", a column of it");
    station = s.host()->row_name(s.host(), "radio", static_cast<uint32_t>(s.param("station")));
    column = station == "x" || station == "y" ? "rssi_" + station : station;  // as muster map writes it
    const std::string columns = "x[m] y[m] " + column + "[dBm]?";
    const int claimed = s.host()->file(s.host(), "rssi", columns.c_str());
    if (claimed < 0) throw std::runtime_error("");  // the kernel has the message
    levels = In<RssiPlace>{claimed};
  }

  void step(const Step& k) {
    *k[command] = {0, 0};
    Memory m = recalled(k);
    if (take_roadmap(k)) navigate(k, m);
    store(k, m);
  }

  Memory recalled(const Step& k) const {
    Memory m{*k.last(state), {}, SeenObstacles(k.last_bytes(state, 0, seen_column))};
    const std::string_view bytes = k.last_bytes(state, 0, way_column);
    m.way.resize(bytes.size() / sizeof(Waypoint));
    if (!m.way.empty()) std::memcpy(m.way.data(), bytes.data(), bytes.size());
    return m;
  }

  void store(const Step& k, Memory& m) const {
    m.now.echoes = static_cast<double>(m.seen.size());
    k.put_bytes(state, 0, way_column, {reinterpret_cast<const char*>(m.way.data()), m.way.size() * sizeof(Waypoint)});
    k.put_bytes(state, 0, seen_column, m.seen.bytes());
    m.now.way = k[state]->way, m.now.seen = k[state]->seen;
    *k[state] = m.now;
  }

  // Reads the roadmap where it changed. False while the robot has none yet.
  bool take_roadmap(const Step& k) {
    if (cell && k[*cell].empty())
      throw BadInput(
          "the robot has no roadmap; expected roadmap=\"FILE\" of muster roadmap, or <robots.roadmap robot=\"" + robot +
          "\"/> in the world");
    try {
      if (rows && !map) map = roadmap::map_of(k[*rows].begin(), k[*rows].size());
      if (cell && !(k[*cell]->radius > 0)) return false;
      if (cell && (!map || k.bytes(*cell, 0, roadmap::Cell::payload_column) != map_bytes)) {
        map_bytes = k.bytes(*cell, 0, roadmap::Cell::payload_column);
        std::vector<roadmap::Row> copy(map_bytes.size() / sizeof(roadmap::Row));
        if (!copy.empty()) std::memcpy(copy.data(), map_bytes.data(), map_bytes.size());
        map = roadmap::map_of(copy.data(), copy.size());
      }
    } catch (const std::runtime_error& e) {
      throw BadInput(in_file(e.what()));
    }
    if (!levels || rssi) return true;
    rssi = RssiMap(k[*levels]);
    if (!rssi->any_received())
      throw BadInput("the table of rssi has no value in a column " + column +
                     "[dBm]; expected that of muster map --from " + station);
    return true;
  }

  // "roadmap.csv:3:1: the piece has no length" of "row 2 of the roadmap has no length", where it is a file.
  std::string in_file(const std::string& what) const {
    const std::string begin = "row ", end = " of the roadmap ";
    const auto at = what.find(end);
    if (!road_rows || what.rfind(begin, 0) != 0 || at == what.npos) return what;
    std::size_t row = 1;
    std::from_chars(what.data() + begin.size(), what.data() + at, row);
    return road_rows->at(row - 1) + "the row " + what.substr(at + end.size());
  }

  // At the first plan: a roadmap that lies elsewhere than the robot.
  void look_at_roadmap(const Step& k, const Point& start) const {
    constexpr double far_off = 100;  // m
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& p : map->graph.nodes) nearest = std::min(nearest, std::hypot(p.x - start.x, p.y - start.y));
    if (!road_rows || map->graph.nodes.empty() || nearest < far_off) return;
    k.event("warning: " + road_rows->at(0) + "the roadmap begins " + metres(nearest) +
            " m from the robot; expected metres of the plan; are these centimetres?");
  }

  void navigate(const Step& k, Memory& m) const {
    const bool has_news = look(k, m);
    const Goal2d to = goal_of(k, m);
    if (is_null(to.x) || is_null(to.y)) {
      m.now.status = no_goal, m.now.goal_x = m.now.goal_y = null();
      m.way.clear();
      return;
    }
    const Odometry& here = *k[odometry];
    const bool is_new = m.now.status == no_goal || m.now.goal_x != to.x || m.now.goal_y != to.y;
    const double away = std::hypot(to.x - here.x, to.y - here.y);
    const bool stays = !is_new && m.now.status == there;
    if (away <= k[tolerance] * (stays ? 2 : 1)) return rest(k, m, to);
    if (is_new || stays) {
      plan(k, m, to, is_new ? "" : "it is off its goal: ");
    } else if (m.now.status == no_way) {
      if (is_due(k.time(), k.dt(), again)) plan(k, m, to, "");
    } else if (has_news && is_blocked(m, here)) {
      plan(k, m, to, "an obstacle is in the way: ");
    } else if (is_astray(m, here)) {
      plan(k, m, to, "it is off its way: ");
    }
    if (m.now.status == on_its_way) follow(k, m, to, away);
  }

  // True where the laser saw something that it had not: what is forgotten blocks no way.
  bool look(const Step& k, Memory& m) const {
    if (!scan) return false;
    m.seen.forget(k.time(), k[forget]);
    bool result = false;
    for (std::size_t i = 0; i < k[*scan].size(); ++i) {
      for (const Point& echo : echoes_of(k[*scan][i], k.bytes(*scan, i, Scan::payload_column), k[reach])) {
        if (map->obstacles.clearance(echo) > k[off_plan]) result = m.seen.see(echo, k.time()) || result;
      }
    }
    return result;
  }

  Goal2d goal_of(const Step& k, Memory& m) const {
    if (goal) return *k[*goal];
    const auto all = k[*goals];
    const bool stays = k[loop] != 0 && all.size() == 1;  // the next goal is where it is
    if (m.now.status == there && m.now.next < static_cast<double>(all.size()) && !stays)
      ++m.now.next, m.now.status = no_goal;
    if (m.now.next >= static_cast<double>(all.size()) && k[loop] != 0) m.now.next = 0;
    if (m.now.next >= static_cast<double>(all.size())) return {null(), null(), null()};
    const Waypoint& to = all[static_cast<std::size_t>(m.now.next)];
    return {to.x, to.y, null()};
  }

  // At the goal: turns to the heading that is asked for.
  void rest(const Step& k, Memory& m, const Goal2d& to) const {
    if (m.now.told != 0 || is_elsewhere(m, to)) {
      ++m.now.reached;
      k.event("is at " + place_text(to));
    }
    m.now.told = 0;
    m.now.status = there, m.now.goal_x = to.x, m.now.goal_y = to.y;
    m.now.along = m.now.length = m.now.cost = 0;
    m.way.clear();
    const double off = is_null(to.yaw) ? 0 : turn_to(to.yaw, k[odometry]->yaw);
    if (std::abs(off) > k[turn_tolerance]) k[command]->w = Turning{k[turn_gain], k[turn_speed]}.rate(off);
  }

  // True where the goal is another than before. One that moves on a little, as that of a mission which follows
  // somebody, is no news.
  bool is_elsewhere(const Memory& m, const Goal2d& to) const {
    constexpr double little = 0.5;  // [m]
    if (m.now.status == no_goal || is_null(m.now.goal_x)) return true;
    const double moved = std::hypot(to.x - m.now.goal_x, to.y - m.now.goal_y);
    return moved > (goals ? 0 : little);
  }

  static std::string place_text(const Goal2d& to) { return metres(to.x) + ' ' + metres(to.y); }

  double kept_radius() const { return std::max(least_radius, map->obstacles.radius()); }

  void plan(const Step& k, Memory& m, const Goal2d& to, const std::string& why) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const Point start{k[odometry]->x, k[odometry]->y};
    const roadmap::Cost cost = [&](const Point& a, const Point& b) {
      if (!m.seen.is_free(a, b, start, kept_radius())) return infinite;
      return rssi ? rssi->cost(a, b, k[threshold], k[weight]) : roadmap::distance(a, b);
    };
    const roadmap::Route found = roadmap::route(map->graph, map->obstacles, start, {to.x, to.y}, cost);
    const bool was_without = m.now.status == no_way, is_news = !why.empty() || is_elsewhere(m, to);
    if (is_news) m.now.told = 1;
    ++m.now.plans;
    m.now.goal_x = to.x, m.now.goal_y = to.y;
    m.now.along = 0, m.now.length = found.length, m.now.cost = found.cost;
    m.way.clear();
    for (const Point& p : found.points) m.way.push_back({p.x, p.y});
    m.now.status = m.way.size() < 2 ? no_way : on_its_way;
    if (m.now.plans == 1 && goals) look_at_goals(k);
    if (m.now.plans == 1) look_at_roadmap(k, start);
    if (m.now.status == no_way && (!was_without || is_news))
      k.event((m.seen.size() > 0 ? "" : "warning: " + place_of_goal(m)) + why + "no way to " + place_text(to) + ": " +
              found.fault +
              (m.seen.size() > 0 ? ", around " + std::to_string(m.seen.size()) + " echoes off the plan" : ""));
    if (m.now.status == on_its_way && (was_without || is_news))
      k.event(why + "plans " + metres(found.length) + " m by " + std::to_string(m.way.size() - 1) + " pieces to " +
              place_text(to));
  }

  // Of the goal that it goes to: "goals.csv:2:1: ", or nothing where it is not of a table.
  std::string place_of_goal(const Memory& m) const {
    return goals ? goal_rows->at(static_cast<std::size_t>(m.now.next)) : "";
  }

  // At its first plan: warns of goals of the table to which no way leads from the one before.
  void look_at_goals(const Step& k) const {
    const auto all = k[*goals];
    for (std::size_t i = 1; i < all.size(); ++i) {
      const roadmap::Route found =
          roadmap::route(map->graph, map->obstacles, {all[i - 1].x, all[i - 1].y}, {all[i].x, all[i].y});
      if (!found.fault.empty())
        k.event("warning: " + goal_rows->at(i) + "no way to " + place_text({all[i].x, all[i].y, null()}) + ": " +
                found.fault);
    }
  }

  // True where an echo is nearer to the way ahead than the radius, less what a cell of echoes rounds.
  bool is_blocked(const Memory& m, const Odometry& here) const {
    constexpr double rounding = 0.07;  // [m]
    const Point start{here.x, here.y};
    const double radius = std::max(0.0, kept_radius() - rounding);
    double gone = 0;
    for (std::size_t i = 1; i < m.way.size(); ++i) {
      const Waypoint &a = m.way[i - 1], &b = m.way[i];
      const double length = Roadmap::distance(a, b), t = std::max(0.0, (m.now.along - gone) / length);
      gone += length;
      if (t >= 1) continue;
      const Point from{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      if (!m.seen.is_free(from, {b.x, b.y}, start, radius)) return true;
    }
    return false;
  }

  static bool is_astray(const Memory& m, const Odometry& here) {
    constexpr double most = 0.5;  // [m]
    return m.way.size() < 2 || Roadmap::distance(Roadmap(m.way).at(m.now.along), {here.x, here.y}) > most;
  }

  void follow(const Step& k, Memory& m, const Goal2d& to, double away) const {
    constexpr double window = 1;  // [m] it is localised at most this far along from where it was
    const Roadmap line(m.way);
    const Odometry& here = *k[odometry];
    m.now.along = line.nearest({here.x, here.y}, m.now.along - window, m.now.along + window);
    const double left = line.length() - m.now.along, v = std::min(k[speed], k[slow_gain] * std::max(left, away));
    if (left > k[lookahead]) {
      *k[command] = pursuit(here, line.at(m.now.along + k[lookahead]), v, k[turn_speed]);
    } else {
      *k[command] = towards(here, to.x, to.y, v, {k[turn_gain], k[turn_speed]});
    }
  }

  static constexpr double again = 1;           // [s] between plans while there is no way
  static constexpr double least_radius = 0.1;  // [m] kept from echoes where the roadmap has no walls, thus no radius

  Value loop, threshold, weight, speed, slow_gain, turn_gain, turn_speed, lookahead, tolerance, turn_tolerance,
      off_plan, reach, forget;
  In<Odometry> odometry;
  Out<Command> command;
  Out<State> state;
  std::optional<In<roadmap::Cell>> cell;
  std::optional<In<roadmap::Row>> rows;
  std::optional<In<Goal2d>> goal;
  std::optional<In<Waypoint>> goals;
  std::optional<TableRows> goal_rows, road_rows;
  std::optional<In<Scan>> scan;
  std::optional<In<RssiPlace>> levels;
  std::string robot, station, column;  // column: that of the station in the table of levels
  // Kept between ticks, and the same from the same inputs.
  std::optional<roadmap::Map> map;
  std::string map_bytes;
  std::optional<RssiMap> rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlNavigate)
