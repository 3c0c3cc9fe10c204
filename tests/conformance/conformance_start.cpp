// Starts robots in motion: keeps poses, gives each robot a velocity in its own frame, and is then swapped for the
// backend in question.
#include <muster/limbs.hpp>
#include <muster/plugin.hpp>
#include <optional>

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
                                     real("right", 0, -99, 99, "rad/s", "rate of the right wheel"),
                                     real("cone", 0, -99, 99, "rad/s", "of first limbs, on balls, about the vertical")};

  explicit Start(Setup& s)
      : forward(s.value("forward")),
        rise(s.value("rise")),
        tumble(s.value("tumble")),
        turn(s.value("turn")),
        left(s.value("left")),
        right(s.value("right")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")),
        cone(s.value("cone")),
        wheels(s.write<Wheels>("robot/*/wheels")) {
    if (s.param("cone") != 0) limbs = s.write<Limbs>("robot/*/limbs");
  }

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      const Pose& p = k[pose][i] = k.last(pose)[i];
      const double cosine = p.qw * p.qw - p.qz * p.qz, sine = 2 * p.qw * p.qz;
      k[twist][i] = {k[forward] * cosine, k[forward] * sine, k[rise], k[tumble] * cosine, k[tumble] * sine, k[turn]};
      k[wheels][i] = {0, 0, k[left], k[right]};
      if (limbs) k[*limbs][i] = {}, k[*limbs][i].limb[0].wz = k[cone];
    }
  }

  Value forward, rise, tumble, turn, left, right;
  Out<Pose> pose;
  Out<Twist> twist;
  Value cone;
  Out<Wheels> wheels;
  std::optional<Out<Limbs>> limbs;
};

}  // namespace

MUSTER_PLUGIN_IS(Start)
