// A compass on every robot: its heading, with noise.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct SkeletonSensor {
  // What it fills: a row a robot. The columns, with their units, are the type of the table.
  struct Reading {
    static constexpr const char* columns = "heading[rad]";
    double heading;  // from east, to the left
  };

  static constexpr auto id = "sensors.skeleton/1";
  static constexpr auto summary = "the heading of each robot, with noise";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {real("noise", 0.02, 0, 3, "rad", "standard deviation of a reading").free()};

  // MUSTER_SENSED: controllers of a robot may read what its sensor reads.
  explicit SkeletonSensor(Setup& s)
      : noise(s.value("noise")),
        stream(s.stream("skeleton")),
        pose(s.read<Pose>("robot/*/pose")),
        reading(s.write<Reading>("robot/*/skeleton_reading", MUSTER_SENSED)) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[reading].size(); ++i) {
      const Pose& p = k[pose][i];
      const double heading = std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
      k[reading][i].heading = heading + error(k, i);
    }
  }

  // A function of robot and tick, never of how often it is asked.
  double error(const Step& k, std::size_t robot) const {
    if (k.expected()) return 0;
    return k[noise] * stream.of(k.key("robot", robot)).normal(k.tick(), 0);
  }

  Value noise;
  Stream stream;
  In<Pose> pose;
  Out<Reading> reading;
};

}  // namespace

MUSTER_PLUGIN_IS(SkeletonSensor)
