// An antenna with two lobes: a dipole that lies flat hears well to both sides of its axis and badly along it.
#include <cmath>
#include <muster/plugin.hpp>
using namespace muster;

struct Dipole {
  static constexpr auto id = "cause.dipole/1", summary = "a radio's antenna is a dipole that lies flat";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose antenna").required(),
      real("amplitude", 0, 0, 20, "dB", "of its lobes, over the mean of all sides").free().with(MUSTER_LINEAR),
      real("direction", 0, -3.15, 3.15, "rad", "of a lobe, from the heading").free().with(MUSTER_CYCLIC)};
  static constexpr muster_cause cause = {
      sizeof(muster_cause), MUSTER_TERM, "the antenna of {radio} is a dipole with lobes of {amplitude} toward {direction}",
      "radio", "tx_x tx_y rx_x rx_y rx_yaw", "effect.antenna_rx effect.body_shadow",
      "turn on the spot once: a dipole has two lobes, another antenna has one", nullptr, 0};
  explicit Dipole(Setup& s)
      : radio(s.value("radio")), amplitude(s.value("amplitude")), direction(s.value("direction")),
        of(s.read<Endpoint>("endpoint/*/radio")), pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")), level(s.add<Level>("link/*/level")) {}
  void step(const Step& k) const {
    for (size_t i = 0; i < k[ends].size(); ++i)
      k[level][i].level = gain(k, k[ends][i].tx, k[ends][i].rx) + gain(k, k[ends][i].rx, k[ends][i].tx);
  }
  double gain(const Step& k, double own, double other) const {
    if (k[of][size_t(own)].radio != k[radio]) return 0;
    const Pose &a = k[pose][size_t(own)], &b = k[pose][size_t(other)];
    const double bearing = std::atan2(b.y - a.y, b.x - a.x) - 2 * std::atan2(a.qz, a.qw);
    return k[amplitude] * std::cos(2 * (bearing - k[direction]));
  }
  Value radio, amplitude, direction;
  In<Endpoint> of;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};
MUSTER_PLUGIN_IS(Dipole)
