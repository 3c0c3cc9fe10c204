// Robots that block radio links.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>
#include <tuple>

namespace {

using namespace muster;

struct RadioBodies {
  static constexpr auto id = "radio.bodies/2";
  static constexpr auto summary = "robots that stand between two radios cost a loss each";
  static constexpr auto manual =
      R"(Adds -`loss` to the level of a link for each living robot whose upright cylinder, `radius` about its origin and
`height` up from it, the straight way between both radios passes; a robot does not stand in the way of its own
radio.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("loss", 3, 0, 60, "dB", "of a robot in the way").free(),
                                     real("radius", 0.2, 0.01, 10, "m", "of a robot"),
                                     real("height", 0.5, 0.01, 100, "m", "of a robot, above its origin")};

  explicit RadioBodies(Setup& s)
      : loss(s.value("loss")),
        radius(s.value("radius")),
        height(s.value("height")),
        robot(s.read<Pose>("robot/*/pose")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        place(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      const auto tx = static_cast<std::size_t>(k[ends][i].tx), rx = static_cast<std::size_t>(k[ends][i].rx);
      const Pose &a = k[place][tx], &b = k[place][rx];
      const double own = carrier(k, tx), other = carrier(k, rx);
      int count = 0;
      for (std::size_t r = 0; r < k[robot].size(); ++r) {
        const auto row = static_cast<double>(r);
        count += row != own && row != other && k.alive("robot", r) && is_between(k, a, b, k[robot][r]);
      }
      k[level][i].level = -k[loss] * count;
    }
  }

  // The robot that carries a radio, or null.
  double carrier(const Step& k, std::size_t end) const {
    return k[mount][static_cast<std::size_t>(k[endpoint][end].radio)].robot;
  }

  // Reciprocal to the last bit: the ends are ordered by their places.
  bool is_between(const Step& k, const Pose& one, const Pose& two, const Pose& body) const {
    const bool in_order = std::tie(one.x, one.y, one.z) < std::tie(two.x, two.y, two.z);
    const Pose &a = in_order ? one : two, &b = in_order ? two : one;
    const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, square = x * x + y * y;
    // Shares of the way from a to b: where it is nearest in plan, and from where to where it is in the circle.
    const double at = square > 0 ? ((body.x - a.x) * x + (body.y - a.y) * y) / square : 0;
    const double miss = std::hypot(a.x + at * x - body.x, a.y + at * y - body.y);
    if (miss >= k[radius]) return false;
    const double half = square > 0 ? std::sqrt((k[radius] * k[radius] - miss * miss) / square) : 1;
    double from = std::max(0.0, at - half), to = std::min(1.0, at + half);
    const double above = a.z - body.z;
    if (z == 0) return from < to && above >= 0 && above < k[height];
    const double foot = -above / z, head = (k[height] - above) / z;
    from = std::max(from, std::min(foot, head)), to = std::min(to, std::max(foot, head));
    return from < to;
  }

  Value loss, radius, height;
  In<Pose> robot;
  In<Mount> mount;
  In<Endpoint> endpoint;
  In<Pose> place;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioBodies)
