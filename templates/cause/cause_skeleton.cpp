// A cause of a misfit that a diagnosis can name: here an antenna that has two lobes, where the world says that it has
// none.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct SkeletonCause {
  static constexpr auto id = "cause.skeleton/1";
  static constexpr auto summary = "the antenna of a radio has two lobes";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose antenna").required(),
      real("amplitude", 0, 0, 20, "dB", "of its lobes, over the mean of all sides").free().with(MUSTER_LINEAR),
      real("direction", 0, -3.15, 3.15, "rad", "of a lobe, from the heading").free().with(MUSTER_CYCLIC)};
  // Its sentence in a report, what it refers to, the columns that data need, what it is mistaken for, what separates
  // these.
  static constexpr muster_cause cause = {sizeof(muster_cause),
                                         MUSTER_TERM,
                                         "the antenna of {radio} has two lobes of {amplitude} toward {direction}",
                                         "radio",
                                         "tx_x tx_y rx_x rx_y rx_yaw",
                                         "effect.antenna_rx effect.body_shadow",
                                         "turn on the spot once: two lobes are heard twice, one is heard once",
                                         nullptr,
                                         0};

  explicit SkeletonCause(Setup& s)
      : radio(s.value("radio")),
        amplitude(s.value("amplitude")),
        direction(s.value("direction")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      const auto tx = static_cast<std::size_t>(k[ends][i].tx), rx = static_cast<std::size_t>(k[ends][i].rx);
      k[level][i].level = gain(k, tx, rx) + gain(k, rx, tx);
    }
  }

  // dB, towards the other end; 0 for the antenna of another radio.
  double gain(const Step& k, std::size_t own, std::size_t other) const {
    if (k[endpoint][own].radio != k[radio]) return 0;
    const Pose &a = k[pose][own], &b = k[pose][other];
    const double bearing = std::atan2(b.y - a.y, b.x - a.x) - 2 * std::atan2(a.qz, a.qw);
    return k[amplitude] * std::cos(2 * (bearing - k[direction]));
  }

  Value radio, amplitude, direction;
  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(SkeletonCause)
