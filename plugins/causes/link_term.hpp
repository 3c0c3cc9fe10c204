// Contribution of a cause to the level of links, as a function of a link's two ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <muster/plugin.hpp>
#include <tuple>

namespace muster {

constexpr double full_turn = 6.283185307179586;
// The columns of measured data with the positions of both ends of a link.
constexpr const char* places_in_plan = "tx_x tx_y rx_x rx_y";

// One end of a link: radio, time and pose.
struct End {
  double radio, t;
  const Pose& at;
};

// Heading of a body's x axis over the ground, from east to north.
inline double yaw(const Pose& p) {
  return std::atan2(2 * (p.qw * p.qz + p.qx * p.qy), 1 - 2 * (p.qy * p.qy + p.qz * p.qz));
}

// Bearing of the other end from the antenna of `end`, relative to its heading and counter-clockwise; not wrapped.
inline double bearing(const End& end, const End& other) {
  return std::atan2(other.at.y - end.at.y, other.at.x - end.at.x) - yaw(end.at);
}

// In metres, and at least 1 cm, as for the path loss.
inline double distance(const End& a, const End& b) {
  const double x = a.at.x - b.at.x, y = a.at.y - b.at.y, z = a.at.z - b.at.z;
  return std::max(std::sqrt(x * x + y * y + z * z), 0.01);
}

// Sum of `term` over the link's ends with that radio, each with its other end. Without a radio: of the receiving end.
template <class Term>
double at_radio(double radio, const End& from, const End& to, const Term& term) {
  if (radio < 0) return term(to, from);
  return (from.radio == radio ? term(from, to) : 0.0) + (to.radio == radio ? term(to, from) : 0.0);
}

// True if the link has the radio at an end; always true without a radio.
inline bool concerns(double radio, const End& from, const End& to) {
  return radio < 0 || from.radio == radio || to.radio == radio;
}

// The radios of the ends, passed on as they are. An edit of poses takes them so and not as they are after all edits, of
// which one may need these poses.
inline Rows<const Endpoint> unchanged(const Step& k, Stage<Endpoint> endpoint) {
  const auto before = k.before(endpoint);
  std::copy(before.begin(), before.end(), k[endpoint].begin());
  return before;
}

// Places in the plan of both ends of some links.
struct PlanEnds {
  static constexpr std::size_t most = 256;
  double ax[most], ay[most], bx[most], by[most];
};

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
    add_of_each(k, [&](const End& from, const End& to, std::size_t) { return term(from, to); });
  }

  // term(from, to, i) of the link in row i; `size(k)`: how many there are.
  std::size_t size(const Step& k) const { return k[ends].size(); }
  template <class Term>
  void add_of_each(const Step& k, const Term& term) const {
    const auto links = k[ends];
    const auto radios = k[endpoint];
    const auto poses = k[pose];
    const auto out = k[level];
    for (std::size_t i = 0; i < links.size(); ++i)
      out[i].level = term(end(radios, poses, links[i].tx), end(radios, poses, links[i].rx), i);
  }

  // A reciprocal term: the ends are ordered by their places, so both directions agree to the last bit.
  template <class Term>
  void add_both_ways(const Step& k, const Term& term) const {
    add(k, [&](const End& a, const End& b) { return is_before(b.at, a.at) ? term(b, a) : term(a, b); });
  }

  // For terms of few links, which `meets(ends, count, met)` selects, many at a time and whichever end comes first: all
  // where met[i] is 0 get `none`.
  template <class Meets, class Term>
  void add_both_ways(const Step& k, double none, const Meets& meets, const Term& term) const {
    const auto links = k[ends];
    const auto radios = k[endpoint];
    const auto poses = k[pose];
    const auto out = k[level];
    PlanEnds at;
    double met[PlanEnds::most];
    for (std::size_t first = 0; first < links.size(); first += PlanEnds::most) {
      const std::size_t count = std::min(links.size() - first, PlanEnds::most);
      for (std::size_t i = 0; i < count; ++i) {
        const Pose &a = poses[row(links[first + i].tx)], &b = poses[row(links[first + i].rx)];
        at.ax[i] = a.x, at.ay[i] = a.y, at.bx[i] = b.x, at.by[i] = b.y;
      }
      meets(at, count, met);
      for (std::size_t i = 0; i < count; ++i) {
        out[first + i].level = none;
        if (met[i] == 0) continue;
        const End a = end(radios, poses, links[first + i].tx), b = end(radios, poses, links[first + i].rx);
        const bool turned = is_before(b.at, a.at);
        out[first + i].level = term(turned ? b : a, turned ? a : b);
      }
    }
  }

 private:
  static std::size_t row(double number) {
    return static_cast<std::size_t>(static_cast<std::int64_t>(number));  // the conversion that machines have
  }
  static End end(const Rows<const Endpoint>& radios, const Rows<const Pose>& poses, double number) {
    const std::size_t i = row(number);
    return {radios[i].radio, radios[i].t, poses[i]};
  }
  static bool is_before(const Pose& a, const Pose& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace muster
