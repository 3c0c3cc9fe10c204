// From a controller's command to the angles of six legs.
#include <algorithm>

#include "description/world_robots.hpp"
#include "tripod_gait.hpp"

namespace {

using namespace muster;
using description::LegDrive;
using description::WorldRobots;

struct RobotsGait {
  static constexpr auto id = "robots.gait/1";
  static constexpr auto summary = "commands to the angles of six legs: Buehler's clock, alternating tripods";
  static constexpr auto manual =
      "Three legs stand and turn slowly by `sweep` while the others swing around; a stance takes the share `duty` of\n"
      "a cycle. Cycles a second follow from the speed asked for: at full sweep a rigid robot without slip walks as "
      "fast\n"
      "as asked; beyond `max_frequency` command and turn rate are scaled alike. To turn, the legs of the inner side\n"
      "sweep less, or backwards; feet slip in a turn, so a robot turns less than asked. A leg takes a new sweep when\n"
      "it is upright or straight up, where its angle does not depend on it: so nothing jumps. Without a command the\n"
      "legs come to stand upright within a cycle. Robots whose model has no <legs> are asked for nothing.";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {
      real("duty", 0.65, 0.6, 0.9, "", "share of a cycle in which a leg stands"),
      real("sweep", 1.0, 0.1, 1.2, "rad", "angle of a leg in its stance, at full stride"),
      real("max_frequency", 1.0, 0.01, 10, "Hz", "most cycles a second")};

  // State of the gait's clock: phase of the first tripod, and the sweeps of both tripods' legs on either side.
  struct Clock {
    static constexpr const char* columns =
        "model phase frequency[Hz] sweep1_left[rad] sweep1_right[rad] sweep2_left[rad] sweep2_right[rad]";
    double model, phase, frequency;
    double sweep[2][2];  // [tripod][0 left, 1 right]
  };

  explicit RobotsGait(Setup& s)
      : duty(s.value("duty")),
        sweep(s.value("sweep")),
        max_frequency(s.value("max_frequency")),
        robots(s, description::Meshes::skip),
        command(s.read_if_any<Command>("robot/*/command")),
        gait(s.write<Gait>("robot/*/gait")),
        clock(s.write<Clock>("robot/*/gait_clock")) {}

  void step(const Step& k) const {
    const auto commands = k[command];
    for (std::size_t i = 0; i < k[gait].size(); ++i) {
      const Clock& before = k.last(clock)[i];
      Clock& now = k[clock][i];
      now = before;
      now.model = WorldRobots::model_of(before.model, i);
      k[gait][i] = {};
      const LegDrive* legs = robots.legs_of(now.model);
      if (!legs || !k.alive("robot", i)) continue;
      if (before.model == 0) now.phase = rest;
      const Clock from = now;
      advance(k, i < commands.size() ? commands[i] : Command{0, 0}, *legs, now);
      for (std::size_t leg = 0; leg < LegDrive::count; ++leg) {
        const double begin = angle(k, *legs, leg, from), end = angle(k, *legs, leg, now);
        k[gait][i].angle[leg] = begin;
        k[gait][i].rate[leg] = std::remainder(end - begin, whole_turn) / k.dt();
      }
    }
  }

  // Phase at rest: both tripods on the ground, half way between their turns.
  static constexpr double rest = 0.25;

  static bool is_left(const LegDrive::Leg& leg) { return leg.hip.y() > 0; }

  double angle(const Step& k, const LegDrive& legs, std::size_t index, const Clock& at) const {
    const LegDrive::Leg& leg = legs.legs[index];
    return clock_angle(at.phase + 0.5 * leg.tripod, at.sweep[leg.tripod][is_left(leg) ? 0 : 1], k[duty]);
  }

  void advance(const Step& k, const Command& asked, const LegDrive& legs, Clock& now) const {
    const double side[] = {asked.v - asked.w * legs.track() / 2, asked.v + asked.w * legs.track() / 2};
    const double fastest = std::max(std::abs(side[0]), std::abs(side[1]));
    const double longest = stride_of(k[sweep], k[duty], legs.radius);
    double wanted[] = {0, 0};
    if (fastest > 0) {
      now.frequency = std::min(fastest / longest, k[max_frequency]);
      for (int s = 0; s < 2; ++s) {
        if (side[s] != 0) wanted[s] = sweep_of(longest * side[s] / fastest, k[duty], legs.radius);
      }
    }
    const double before = now.phase, after = before + now.frequency * k.dt();
    const bool stands = now.sweep[0][0] == 0 && now.sweep[0][1] == 0 && now.sweep[1][0] == 0 && now.sweep[1][1] == 0;
    if (fastest == 0 && stands && passes(before, after, rest)) {
      now.frequency = 0;
      now.phase = std::round(2 * (after - rest)) / 2 + rest;
      return;
    }
    now.phase = after;
    for (int tripod = 0; tripod < 2; ++tripod) {
      if (passes(before + 0.5 * tripod, after + 0.5 * tripod, 0)) std::copy_n(wanted, 2, now.sweep[tripod]);
    }
  }

  // True if a phase that is `of` or half a cycle from it is in [before, after].
  static bool passes(double before, double after, double of) {
    return std::ceil(2 * (before - of)) <= std::floor(2 * (after - of));
  }

  Value duty, sweep, max_frequency;
  WorldRobots robots;
  In<Command> command;
  Out<Gait> gait;
  Out<Clock> clock;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsGait)
