// Robots see a target's place, the worse the farther it is.
#include <cmath>
#include <muster/plugin.hpp>

#include "plugins/periods.hpp"
#include "plugins/tracking/sighting.hpp"

namespace {

using namespace muster;
using tracking::Sighting;

struct SensorsSighting {
  static constexpr auto id = "sensors.sighting/2";
  static constexpr auto summary = "the place of a target as each robot sees it, worse with distance";
  static constexpr auto manual =
      "Every `period` each robot but the target sees where the target is, with Gaussian noise of its own on each\n"
      "coordinate of standard deviation noise + growth x distance. robot/*/sighting keeps the last one, with its time\n"
      "and its deviation; it is null before the first, and where the target is farther than `range` or has\n"
      "left. What stands between the two is not looked at.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {reference("target", "robot", "the robot that is looked for").required(),
                                     real("period", 0.5, 1e-3, 1000, "s", "of sightings"),
                                     real("range", 50, 0.01, 1e6, "m", "the target is seen up to there"),
                                     real("noise", 0.1, 0, 100, "m", "deviation of a coordinate close to it").free(),
                                     real("growth", 0.05, 0, 10, "", "and for each metre of distance").free()};

  explicit SensorsSighting(Setup& s)
      : period(s.value("period")),
        range(s.value("range")),
        noise(s.value("noise")),
        growth(s.value("growth")),
        target(static_cast<std::size_t>(s.param("target"))),
        stream(s.stream("sighting")),
        pose(s.read<Pose>("robot/*/pose")),
        sighting(s.write<Sighting>("robot/*/sighting", MUSTER_SENSED)) {}

  void step(const Step& k) const {
    const bool due = is_due(k.time(), k.dt(), k[period]);
    const Pose& there = k[pose][target];
    const bool is_there = k.alive("robot", target);
    for (std::size_t i = 0; i < k[sighting].size(); ++i) {
      k[sighting][i] = k.last(sighting)[i];
      if (!due || i == target) continue;
      const double distance = std::hypot(k[pose][i].x - there.x, k[pose][i].y - there.y);
      const double deviation = k[noise] + k[growth] * distance;
      const auto off = [&](unsigned axis) {
        return k.expected() || deviation == 0 ? 0 : deviation * stream.of(k.key("robot", i)).normal(k.tick(), axis);
      };
      k[sighting][i] = !is_there || distance > k[range]
                           ? Sighting{k.time(), null(), null(), null()}
                           : Sighting{k.time(), there.x + off(0), there.y + off(1), deviation};
    }
  }

  Value period, range, noise, growth;
  std::size_t target;
  Stream stream;
  In<Pose> pose;
  Out<Sighting> sighting;
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsSighting)
