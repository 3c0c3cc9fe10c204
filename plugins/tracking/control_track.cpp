// One robot of a team that follows a target and keeps its link to a base: after Ghaffarkhah and Mostofi 2009.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <muster/plugin.hpp>
#include <vector>

#include "plugins/heading.hpp"
#include "plugins/own_radio.hpp"
#include "plugins/periods.hpp"
#include "plugins/table_rows.hpp"
#include "plugins/tracking/navigation_function.hpp"
#include "plugins/tracking/sighting.hpp"

namespace {

using namespace muster;
using tracking::Disc;
using tracking::Sighting;
using tracking::Told;
using tracking::Vector2;

struct ControlTrack {
  static constexpr auto id = "control.track/3";
  static constexpr auto summary = "follows a target down a navigation function that may keep the link to a base";
  static constexpr auto manual =
      "The robot drives down the navigation function of Rimon and Koditschek (1992) towards its place beside the\n"
      "target: `standoff` from where it last saw it, in direction `side`. The function is 1 at the bound of the room\n"
      "and at the obstacles, discs that grow by `clearance`. It tells the base of each sighting.\n"
      "With `aware`, the place where a message would be received with probability `reception` is another bound: the\n"
      "disc about the base whose radius follows from the mean rssi of the base's messages, by the path-loss exponent\n"
      "`n`, if received power is exponential about its mean (Rayleigh fading): P = exp(-sensitivity / mean power).\n"
      "A robot that has heard nothing for `lost` comes back; without a sighting, to the base itself. A goal outside\n"
      "of a bound or in an obstacle is moved to its edge. It knows its odometry, its sighting and its inbox; the "
      "other\n"
      "robots are no obstacles to it.\n"
      "A. Ghaffarkhah, Y. Mostofi: Communication-aware target tracking using navigation functions - centralized case,\n"
      "ROBOCOMM 2009.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it steers, on the radio of the same name").required(),
      reference("base", "radio", "the radio that it reports to and hears").required(),
      file("obstacles", "discs x[m],y[m],radius[m]").required(),
      real("base_x", 0, -1e6, 1e6, "m", "where the base is"),
      real("base_y", 0, -1e6, 1e6, "m", "where the base is"),
      real("room_x", 0, -1e6, 1e6, "m", "the middle of the room"),
      real("room_y", 0, -1e6, 1e6, "m", "the middle of the room"),
      real("room", 30, 0.1, 1e6, "m", "its radius"),
      flag("aware", true, "it keeps its link to the base"),
      real("reception", 0.7, 0.01, 0.99, "", "probability with which a message shall arrive"),
      real("sensitivity", -95, -250, 50, "dBm", "of the base's receiver"),
      real("n", 2, 0.1, 10, "", "path-loss exponent that it takes for granted"),
      real("smoothing", 3, 0, 1000, "s", "time constant of the filter of rssi"),
      real("lost", 3, 1e-3, 1000, "s", "silence of the base after which it comes back"),
      real("standoff", 1.5, 0, 1000, "m", "distance that it keeps from the target"),
      real("side", 0, -100, 100, "rad", "on which side of the target, from east to north"),
      real("clearance", 0.4, 0, 100, "m", "of its middle from the room's bound and obstacles"),
      real("sharpness", 5, 1, 50, "", "k of the navigation function"),
      real("speed", 0.4, 0, 10, "m/s", "forward speed"),
      real("turn_gain", 2, 0, 100, "1/s", "turn rate for each radian of bearing"),
      real("turn_speed", 1, 0, 10, "rad/s", "largest turn rate")};

  struct State {
    static constexpr const char* columns = "level[dBm]? heard[s] told[s]? reach[m]? goal_x[m]? goal_y[m]?";
    double level, heard, told;     // smoothed rssi of the base, null before the first message; when it came;
                                   // time of the last sighting that was told, or null
    double reach, goal_x, goal_y;  // radius of the bound of reception, null where there is none; where it heads for
  };

  explicit ControlTrack(Setup& s)
      : base_x(s.value("base_x")),
        base_y(s.value("base_y")),
        room_x(s.value("room_x")),
        room_y(s.value("room_y")),
        room(s.value("room")),
        aware(s.value("aware")),
        reception(s.value("reception")),
        sensitivity(s.value("sensitivity")),
        n(s.value("n")),
        smoothing(s.value("smoothing")),
        lost(s.value("lost")),
        standoff(s.value("standoff")),
        side(s.value("side")),
        clearance(s.value("clearance")),
        sharpness(s.value("sharpness")),
        speed(s.value("speed")),
        turn_gain(s.value("turn_gain")),
        turn_speed(s.value("turn_speed")),
        radio(own_radio(s)),
        base(s.param("base")),
        rows(s, "obstacles"),
        discs(s.file<Disc>("obstacles")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        sighting(s.read<Sighting>("robot/{robot}/sighting")),
        inbox(s.read<Incoming>("inbox/{robot}/message")),
        command(s.write<Command>("robot/{robot}/command")),
        outbox(s.write<Outgoing>("outbox/{robot}/message")),
        state(s.write<State>("self/state")) {
    expect_another_radio(s, "base", radio, "the robot's own radio");
  }

  // Warns of the first obstacle around the robot itself, and of the first that lies beyond the room.
  void check_discs(const Step& k, Vector2 here) const {
    bool is_around = false, is_beyond = false;
    for (std::size_t i = 0; i < k[discs].size(); ++i) {
      const Disc& d = k[discs][i];
      if (const double away = std::hypot(here.x - d.x, here.y - d.y); away < d.radius && !is_around) {
        is_around = true;
        k.event("warning: " + rows.at(i, "radius") + "column \"radius[m]\": " + print(d.radius) +
                " m, and the robot starts " + print(away) + " m from its middle, inside the obstacle; expected metres" +
                (away > d.radius / 100 ? "; are these centimetres?" : ""));
      }
      if (const double away = std::hypot(k[room_x] - d.x, k[room_y] - d.y); away - d.radius > k[room] && !is_beyond) {
        is_beyond = true;
        k.event("warning: " + rows.at(i, "x") + "the obstacle lies beyond the room, which ends " + print(k[room]) +
                " m from its middle, so that it has no effect; expected metres" +
                (away / 1000 < k[room] ? "; are these millimetres?" : ", or a larger room"));
      }
    }
  }

  static std::string print(double value) {
    char text[32];
    return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.4g", value))};
  }

  void step(const Step& k) const {
    State now = *k.last(state);
    const Vector2 here{k[odometry]->x, k[odometry]->y};
    const double from_base = std::hypot(here.x - k[base_x], here.y - k[base_y]);
    if (is_first_step(k.time(), k.dt())) check_discs(k, here);
    if (is_null(now.level) && now.heard == 0) now.heard = k.time();  // it listens from now on
    listen(k, now);
    now.reach = k[aware] != 0 ? reach(k, now, from_base) : null();
    const Sighting& seen = *k[sighting];
    *k[command] = {0, 0};
    if (is_null(seen.x)) {
      const bool is_lost = k.time() - now.heard > k[lost];
      if (k[aware] != 0 && is_lost) *k[command] = steer(k, now, here, from_base, {k[base_x], k[base_y]});
    } else {
      *k[command] = steer(k, now, here, from_base, beside(k, seen));
      if (is_null(now.told) || seen.t > now.told) tell(k, {seen.x, seen.y, seen.deviation});
      now.told = seen.t;
    }
    *k[state] = now;
  }

  void listen(const Step& k, State& now) const {
    for (const Incoming& message : k[inbox]) {
      if (message.from != base) continue;
      const double age = message.t_received - now.heard;
      const double share = is_null(now.level) || k[smoothing] == 0 ? 1 : 1 - std::exp(-age / k[smoothing]);
      now.level = is_null(now.level) ? message.rssi : now.level + share * (message.rssi - now.level);
      now.heard = message.t_received;
    }
  }

  void tell(const Step& k, const Told& told) const {
    k.send(outbox, 0, {reinterpret_cast<const char*>(&told), sizeof told}) = {radio, base, 0};
  }

  // How far from the base a message arrives with the probability wanted, by the level here.
  double reach(const Step& k, const State& now, double from_base) const {
    constexpr double back = 0.9;  // of the way to the base
    if (is_null(now.level) || k.time() - now.heard > k[lost]) return back * from_base;
    const double needed = k[sensitivity] - 10 * std::log10(-std::log(k[reception]));
    return std::max(from_base, 1.0) * std::pow(10, (now.level - needed) / (10 * k[n]));
  }

  Vector2 beside(const Step& k, const Sighting& seen) const {
    return {seen.x + k[standoff] * std::cos(k[side]), seen.y + k[standoff] * std::sin(k[side])};
  }

  // The goal is moved inside of all bounds; the robot may be outside of that of reception, which then goes through it.
  Command steer(const Step& k, State& now, Vector2 here, double from_base, Vector2 wanted) const {
    constexpr double margin = 0.05;  // [m]
    std::vector<Disc> bounds{{k[room_x], k[room_y], k[room] - k[clearance]}},
        obstacles(k[discs].begin(), k[discs].end());
    for (Disc& d : obstacles) d.radius += k[clearance];
    if (!is_null(now.reach)) bounds.push_back({k[base_x], k[base_y], std::max(now.reach, 2 * margin)});
    const Vector2 goal = tracking::inside(wanted, bounds, obstacles, margin);
    now.goal_x = goal.x, now.goal_y = goal.y;
    if (bounds.size() > 1) bounds[1].radius = std::max(bounds[1].radius, from_base + margin);
    const Vector2 way = direction(here, goal, bounds, obstacles, k[sharpness]);
    const double fast = k[speed] * std::min(1.0, std::hypot(goal.x - here.x, goal.y - here.y));
    if (way.x == 0 && way.y == 0) return {0, 0};
    return towards(*k[odometry], here.x + way.x, here.y + way.y, fast, {k[turn_gain], k[turn_speed]});
  }

  // Down the function, or straight out of the obstacle whose clearance the robot has come into.
  static Vector2 direction(Vector2 here, Vector2 goal, const std::vector<Disc>& bounds,
                           const std::vector<Disc>& obstacles, double sharpness) {
    const auto out = [&](const Disc& d, double sign) {
      const double far = std::hypot(here.x - d.x, here.y - d.y);
      return far > 0 ? Vector2{sign * (here.x - d.x) / far, sign * (here.y - d.y) / far} : Vector2{1, 0};
    };
    for (const Disc& d : obstacles) {
      if (std::hypot(here.x - d.x, here.y - d.y) <= d.radius) return out(d, 1);
    }
    for (const Disc& d : bounds) {
      if (std::hypot(here.x - d.x, here.y - d.y) >= d.radius) return out(d, -1);
    }
    return tracking::NavigationFunction(goal, bounds, obstacles, sharpness).downhill(here);
  }

  Value base_x, base_y, room_x, room_y, room, aware, reception, sensitivity, n, smoothing, lost, standoff, side,
      clearance, sharpness, speed, turn_gain, turn_speed;
  double radio, base;
  TableRows rows;  // of the obstacles
  In<Disc> discs;
  In<Odometry> odometry;
  In<Sighting> sighting;
  In<Incoming> inbox;
  Out<Command> command;
  Out<Outgoing> outbox;
  Out<State> state;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlTrack)
