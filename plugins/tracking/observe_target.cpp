// What a base knows of a target from the messages that it receives, and how far off that is.
#include <cmath>
#include <cstring>
#include <muster/plugin.hpp>

#include "plugins/tracking/sighting.hpp"

namespace {

using namespace muster;
using tracking::Told;

struct ObserveTarget {
  static constexpr auto id = "observe.target/3";
  static constexpr auto summary = "a base's estimate of a target from what robots tell, and its error";
  static constexpr auto manual =
      "A Kalman filter on each coordinate: place and velocity, driven by white acceleration of deviation\n"
      "`acceleration` that holds for a second, corrected by every message of control.track that arrives at `base`.\n"
      "Where none arrives it goes on straight. `error` is the distance to where the target is; it is null before the\n"
      "first message and where the target has left. `heard` counts messages, `silence` is the time since the last one.";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      reference("base", "radio", "where messages arrive").required(),
      reference("target", "robot", "the robot that is looked for").required(),
      real("acceleration", 0.1, 1e-6, 100, "m/s2", "that the target is taken to be capable of")};

  struct Estimate {
    static constexpr const char* columns =
        "x[m]? y[m]? vx[m/s] vy[m/s] place_variance[m2] covariance[m2/s] speed_variance[m2/s2] error[m]? heard "
        "silence[s]";
    double x, y, vx, vy, pp, pv, vv, error, heard, silence;
  };

  explicit ObserveTarget(Setup& s)
      : target(static_cast<std::size_t>(s.param("target"))),
        acceleration(s.value("acceleration")),
        inbox(s.read<Incoming>("inbox/{base}/message")),
        pose(s.read<Pose>("robot/{target}/pose")),
        estimate(s.write<Estimate>("self/estimate")) {}

  void step(const Step& k) const {
    Estimate now = *k.last(estimate);  // null before the first message
    predict(now, k.dt(), k[acceleration]);
    now.silence += k.dt();
    for (std::size_t m = 0; m < k[inbox].size(); ++m) {
      const auto bytes = k.bytes(inbox, m, Incoming::payload_column);
      Told told;
      if (bytes.size() != sizeof told) continue;  // somebody else's message
      std::memcpy(&told, bytes.data(), sizeof told);
      if (std::memcmp(told.tag, Told().tag, sizeof told.tag) != 0) continue;
      correct(now, told);
      ++now.heard, now.silence = 0;
    }
    const bool is_there = k.alive("robot", target);
    now.error = is_null(now.x) || !is_there ? null() : std::hypot(now.x - k[pose]->x, now.y - k[pose]->y);
    *k[estimate] = now;
  }

  static void predict(Estimate& now, double dt, double acceleration) {
    if (is_null(now.x)) return;
    const double q = acceleration * acceleration;  // [m2/s3], over a second
    now.x += now.vx * dt, now.y += now.vy * dt;
    now.pp += 2 * dt * now.pv + dt * dt * now.vv + q * dt * dt * dt / 3;
    now.pv += dt * now.vv + q * dt * dt / 2;
    now.vv += q * dt;
  }

  static void correct(Estimate& now, const Told& told) {
    constexpr double any_speed = 1;  // [m2/s2] variance of a component before it is known
    const double noise = told.deviation * told.deviation;
    if (is_null(now.x)) {
      now.x = told.x, now.y = told.y, now.pp = noise, now.pv = 0, now.vv = any_speed;
      return;
    }
    if (now.pp + noise == 0) return;  // both are exact
    const double place = now.pp / (now.pp + noise), speed = now.pv / (now.pp + noise);
    const double off_x = told.x - now.x, off_y = told.y - now.y;
    now.x += place * off_x, now.y += place * off_y, now.vx += speed * off_x, now.vy += speed * off_y;
    now.vv -= speed * now.pv, now.pv *= 1 - place, now.pp *= 1 - place;
  }

  std::size_t target;
  Value acceleration;
  In<Incoming> inbox;
  In<Pose> pose;
  Out<Estimate> estimate;
};

}  // namespace

MUSTER_PLUGIN_IS(ObserveTarget)
