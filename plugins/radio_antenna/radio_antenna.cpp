// Gains of the antennas at both ends of a link, by its direction.
#include <array>
#include <muster/plugin.hpp>
#include <optional>
#include <vector>

#include "antenna_shapes.hpp"
#include "gain_table.hpp"

namespace {

using namespace muster;

// The highest gain of the antenna that an instance gives a radio; null where it gives none.
struct HighestGain {
  static constexpr const char* columns = "gain[dBi]?";
  double gain;
};

// Of a radio's own antenna. A radio that joins as a copy begins with the cell of another, whose row `of` then is.
struct OwnGain {
  static constexpr const char* columns = "gain[dBi]? of:radio?";
  double gain, of;
};

struct RadioAntenna {
  static constexpr auto id = "radio.antenna/2";
  static constexpr auto summary = "an antenna that radiates more in some directions than in others";
  static constexpr auto manual =
      R"(Adds to the level of a link the gain in dBi that the antenna of `radio` has in the direction of the other
radio, at either end: an antenna is reciprocal. Without `radio` it is the antenna of all whom no other radio.antenna
names. It turns with its body in all three axes. Its x axis is the lobe, forward on the radio; a dipole's wire
is its z axis, upright on the radio; azimuth, elevation and roll turn it.
    isotropic   0 dBi everywhere
    dipole      half a wavelength of wire, 2.15 dBi
    cosine      power as cos^n off the lobe, with half of it at beamwidth/2
    sector      3GPP TR 36.814: 12 (angle/beamwidth)^2 dB less in azimuth and, by beamwidth_up, in elevation
    table       azimuth[rad],elevation[rad],gain[dBi] from `file`, on a grid over the whole sphere
All that an antenna is fed it radiates, but for `loss`, what `depth` leaves beside the lobe included: a narrower lobe
is a stronger one, and of a table the mean gain is at most 0 dBi. Polarisation does not count, nor a coupling to the
body.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose antenna; without it, that of all others"),
      choice("pattern", "dipole|isotropic|cosine|sector|table", "its gain by direction"),
      real("beamwidth", 1.1345, 0.1, 3.1, "rad",
           "between the two directions of half power; only with pattern=\"cosine|sector\""),
      real("beamwidth_up", 1.1345, 0.1, 3.1, "rad", "the same in elevation; only with pattern=\"sector\""),
      real("depth", 30, 3, 100, "dB",
           "from its highest gain to its lowest; only with pattern=\"dipole|cosine|sector\""),
      real("loss", 0, 0, 60, "dB", "of the power fed to it, in itself and its cable"),
      real("azimuth", 0, -half_turn, half_turn, "rad", "of its lobe, from the radio's heading to the left"),
      real("elevation", 0, -half_turn / 2, half_turn / 2, "rad", "of its lobe, upward"),
      real("roll", 0, -half_turn, half_turn, "rad", "about its lobe"),
      file("file", "table: its gains"),
  };

  explicit RadioAntenna(Setup& s)
      : radio(s.value("radio")),
        pattern(s.value("pattern")),
        beamwidth(s.value("beamwidth")),
        beamwidth_up(s.value("beamwidth_up")),
        depth(s.value("depth")),
        loss(s.value("loss")),
        azimuth(s.value("azimuth")),
        elevation(s.value("elevation")),
        roll(s.value("roll")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")),
        is_of_one(s.param("radio") >= 0) {
    // Claims detect a second antenna of a radio as its second writer, and a second common antenna likewise.
    if (is_of_one) {
      of_one = s.write<OwnGain>("radio/{radio}/antenna");
    } else {
      others = s.read_if_any<OwnGain>("radio/*/antenna");
      highest = s.write<HighestGain>("radio/*/common_antenna");
    }
    if (s.param("pattern") == table) {
      rows = s.file<MeasuredGain>("file");
    } else if (!s.text("file").empty()) {
      throw BadInput("attribute \"file\": only pattern=\"table\" reads one");
    }
  }

  void step(const Step& k) {
    prepare(k);
    const auto links = k[ends];
    const auto at = k[pose];
    const std::vector<char> own = own_radios(k);
    const auto gain = [&](double end, double other) {
      const auto from = static_cast<std::size_t>(end), to = static_cast<std::size_t>(other);
      if (!own[static_cast<std::size_t>(k[endpoint][from].radio)]) return 0.0;
      return gain_toward(k, in_frame(mounted, in_frame(at[from], from_to(at[from], at[to]))));
    };
    for (std::size_t i = 0; i < links.size(); ++i)
      k[level][i].level = gain(links[i].tx, links[i].rx) + gain(links[i].rx, links[i].tx);
  }

  // Radios that have this antenna; publishes their highest gain.
  std::vector<char> own_radios(const Step& k) const {
    std::vector<char> own(k.rows("radio"), is_of_one ? 0 : 1);
    const double gain = (k[pattern] == table ? measured.highest() : directivity) - k[loss];
    if (is_of_one) {
      own[static_cast<std::size_t>(k[radio])] = 1;
      *k[of_one] = {gain, k[radio]};
      return own;
    }
    const auto named = k[others];
    for (std::size_t i = 0; i < k[highest].size(); ++i) {
      own[i] = named.empty() || named[i].of != static_cast<double>(i);
      k[highest][i].gain = own[i] ? gain : null();
    }
    return own;
  }

  // Recomputes values of the parameters alone, when these change.
  void prepare(const Step& k) {
    mounted = turn(k[azimuth], k[elevation], k[roll]);
    const std::array<double, 4> now{k[pattern], k[beamwidth], k[beamwidth_up], k[depth]};
    if (prepared == now) return;
    if (k[pattern] == table && measured.empty()) {
      if (!rows) throw BadInput("attribute \"file\": pattern=\"table\" needs it from the start");
      measured = GainTable(k[*rows]);
    }
    directivity =
        -10 * std::log10(mean_over_sphere([&](const Direction& d) { return std::pow(10, shape(k, d) / 10); }));
    prepared = now;
  }

  // In dBi. Without a direction: the mean over all directions.
  double gain_toward(const Step& k, const Direction& d) const {
    if (d.x == 0 && d.y == 0 && d.z == 0) return -k[loss];
    return (k[pattern] == table ? measured.gain(d) : directivity + shape(k, d)) - k[loss];
  }

  // In dB, relative to the highest gain.
  double shape(const Step& k, const Direction& d) const {
    double result = 0;
    if (k[pattern] == dipole) result = dipole_shape(d);
    if (k[pattern] == cosine) result = cosine_shape(d, k[beamwidth]);
    if (k[pattern] == sector) result = sector_shape(d, k[beamwidth], k[beamwidth_up], k[depth]);
    return std::max(result, -k[depth]);
  }

  enum Pattern { dipole, isotropic, cosine, sector, table };

  Value radio, pattern, beamwidth, beamwidth_up, depth, loss, azimuth, elevation, roll;
  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
  bool is_of_one;
  In<OwnGain> others{};
  Out<OwnGain> of_one{};
  Out<HighestGain> highest{};
  std::optional<In<MeasuredGain>> rows;
  GainTable measured;
  std::optional<std::array<double, 4>> prepared;
  double directivity = 0;  // dBi, of a shape
  Pose mounted{};          // the antenna's orientation on its radio
};

}  // namespace

MUSTER_PLUGIN_IS(RadioAntenna)
