// What a cause adds to the level of links, as a function of a link's two ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <muster/plugin.hpp>
#include <tuple>

namespace muster {

constexpr double full_turn = 6.283185307179586;
// The columns of measured data that say where both ends of a link were.
constexpr const char* places_in_plan = "tx_x tx_y rx_x rx_y";

// One end of a link: which radio, when and where.
struct End {
  double radio, t;
  const Pose& at;
};

// Heading of a body's x axis over the ground, from east to north.
inline double yaw(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

// Under which angle the antenna of `end` sees the other end, from its own heading to its left; not wrapped.
inline double bearing(const End& end, const End& other) {
  return std::atan2(other.at.y - end.at.y, other.at.x - end.at.x) - yaw(end.at);
}

// In metres, and at least 1 cm, as for the path loss.
inline double distance(const End& a, const End& b) {
  const double x = a.at.x - b.at.x, y = a.at.y - b.at.y, z = a.at.z - b.at.z;
  return std::max(std::sqrt(x * x + y * y + z * z), 0.01);
}

// The links with a radio at one end: `term` of that end and the other. Where no radio is named, of the receiving end.
template <class Term>
double at_radio(double radio, const End& from, const End& to, const Term& term) {
  if (radio < 0) return term(to, from);
  return (from.radio == radio ? term(from, to) : 0.0) + (to.radio == radio ? term(to, from) : 0.0);
}

// Whether a link is one of the radio's; all are where no radio is named.
inline bool concerns(double radio, const End& from, const End& to) {
  return radio < 0 || from.radio == radio || to.radio == radio;
}

class LinkTerm {
 public:
  explicit LinkTerm(Setup& s)
      : endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}

  // term(from, to) is in dB.
  template <class Term>
  void add(const Step& k, const Term& term) const {
    const auto links = k[ends];
    const auto radios = k[endpoint];
    const auto poses = k[pose];
    const auto out = k[level];
    const auto end = [&](double row) {
      const auto i = static_cast<std::size_t>(static_cast<std::int64_t>(row));  // as machines convert
      return End{radios[i].radio, radios[i].t, poses[i]};
    };
    for (std::size_t i = 0; i < links.size(); ++i) out[i].level = term(end(links[i].tx), end(links[i].rx));
  }

  // A term that is the same both ways: the ends come in an order of their places, so it is so to the last bit.
  template <class Term>
  void add_both_ways(const Step& k, const Term& term) const {
    add(k, [&](const End& a, const End& b) { return is_before(b.at, a.at) ? term(b, a) : term(a, b); });
  }

  // Where most links have nothing to do with it: `concerns` says so, whichever end comes first, and they have `none`.
  template <class Concerns, class Term>
  void add_both_ways(const Step& k, double none, const Concerns& concerns, const Term& term) const {
    add(k, [&](const End& a, const End& b) {
      if (!concerns(a.at, b.at)) return none;
      const bool turned = is_before(b.at, a.at);
      return term(turned ? b : a, turned ? a : b);
    });
  }

 private:
  static bool is_before(const Pose& a, const Pose& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace muster
