// Hands robots over in motion: it keeps poses as they are, gives each robot a velocity in its own frame, and is then
// swapped for the backend in question.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Start {
  static constexpr auto id = "conformance.start/1", summary = "robots that move already";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {real("forward", 0, -9, 9, "m/s", "along the body's x axis"),
                                     real("rise", 0, -9, 9, "m/s", "upwards"),
                                     real("tumble", 0, -9, 9, "rad/s", "about the body's x axis"),
                                     real("turn", 0, -9, 9, "rad/s", "about the vertical"),
                                     real("left", 0, -99, 99, "rad/s", "rate of the left wheel"),
                                     real("right", 0, -99, 99, "rad/s", "rate of the right wheel")};

  explicit Start(Setup& s)
      : forward(s.value("forward")),
        rise(s.value("rise")),
        tumble(s.value("tumble")),
        turn(s.value("turn")),
        left(s.value("left")),
        right(s.value("right")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")),
        wheels(s.write<Wheels>("robot/*/wheels")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      const Pose& p = k[pose][i] = k.last(pose)[i];
      const double cosine = p.qw * p.qw - p.qz * p.qz, sine = 2 * p.qw * p.qz;
      k[twist][i] = {k[forward] * cosine, k[forward] * sine, k[rise], k[tumble] * cosine, k[tumble] * sine, k[turn]};
      k[wheels][i] = {0, 0, k[left], k[right]};
    }
  }

  Value forward, rise, tumble, turn, left, right;
  Out<Pose> pose;
  Out<Twist> twist;
  Out<Wheels> wheels;
};

}  // namespace

MUSTER_PLUGIN_IS(Start)
