// Distances between radios by time of flight, as ultra-wideband radios measure them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <muster/names.hpp>
#include <muster/plugin.hpp>
#include <muster/senses.hpp>
#include <optional>
#include <string>
#include <vector>

#include "obstructions.hpp"
#include "plugins/other_kinds.hpp"
#include "plugins/periods.hpp"
#include "plugins/table_rows.hpp"

namespace {

using namespace muster;

struct SensorsRange {
  static constexpr auto id = "sensors.range/1";
  static constexpr auto summary = "distances of robots' radios to stations and other robots, by time of flight (UWB)";
  static constexpr auto manual =
      R"(At `rate` each radio of `robot`, or of all robots, measures its distance to the radios named by `to`, or by name in
`peers`; each that succeeds is a row of range/*/message. The way is that between the two antennas.
A reading = way + bias + noise, at least 0. bias: `bias` for all; what the table `biases` has of the pair; a draw of
standard deviation `pair_bias`, once a pair of radios from the world's seed, the same both ways; and `wall_bias` for
each dB that the walls, closed doors and floors on the straight way lose, since waves are slower in them and the first
echo goes around. Noise is white and Gaussian, of standard deviation `noise` and, independently, `share` of the way.
Nothing is measured beyond `max_range` of free space: each dB of walls, times `wall_loss`, shortens it as it shortens
the way at which the same power arrives (a factor of ten for 20 dB). Of the rest a share `drop` is lost, and of what is
left `wall_drop` at each wall. Not modelled: other bodies and meshes in the way, clocks that drift, collisions on the
air, the time that a measurement takes.)";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      reference("robot", "robot", "whose radio measures; by default all"),
      choice("to", "stations|robots|all", "which radios it measures to; only without peers"),
      text("peers", "", "names of radios with blanks between"),
      real("rate", 10, 0, 1e6, "Hz", "of measurements of each pair, at most one a step; 0: each step"),
      real("noise", 0.05, 0, 100, "m", "standard deviation of a reading").free(),
      real("share", 0, 0, 1, "", "standard deviation of a reading, of the way").free(),
      real("bias", 0, -100, 100, "m", "of all readings").free(),
      real("pair_bias", 0, 0, 100, "m", "standard deviation of a bias of each pair"),
      file("biases", "a table a,b,bias[m] of radios' names: bias of their readings of each other"),
      real("wall_bias", 0, -10, 10, "m/dB", "bias for each dB that walls lose").free(),
      real("wall_loss", 1, 0, 100, "", "loss of walls in this band, over that in the world's").free(),
      real("max_range", 60, 0, 1e5, "m", "largest way in free space"),
      real("drop", 0, 0, 1, "", "share of readings that is lost"),
      real("wall_drop", 0, 0, 1, "", "share that each wall takes of the rest"),
  };

  struct PairBias {
    static constexpr const char* columns = "a:radio b:radio bias[m] .";
    double a, b, bias;
  };

  explicit SensorsRange(Setup& s)
      : robot(s.param("robot")),
        to(static_cast<int>(s.param("to"))),
        rate(s.value("rate")),
        noise(s.value("noise")),
        share(s.value("share")),
        bias(s.value("bias")),
        pair_bias(s.value("pair_bias")),
        wall_bias(s.value("wall_bias")),
        wall_loss(s.value("wall_loss")),
        max_range(s.value("max_range")),
        drop(s.value("drop")),
        wall_drop(s.value("wall_drop")),
        stream(s.stream("range")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        obstructions(s),
        range(s.write<Range>("range/*/message", MUSTER_SENSED)) {
    if (!s.text("biases").empty()) {
      biases = s.file<PairBias>("biases");
      places.emplace(s, "biases");
    }
    for (const std::string& name : names_in(s.host(), "peers")) peers.push_back(radio_named(s, name));
    if (robot >= 0 && peers.size() == 1) expect_no_own(s);
  }

  void step(const Step& k) const {
    if (k.tick() > 0 && k[rate] > 0 && !is_due(k.time(), k.dt(), 1 / k[rate])) return;
    Obstructions::Now between(obstructions, k);
    const auto own = stated(k);
    for (std::size_t i = 0; i < k[endpoint].size(); ++i) {
      const auto from = static_cast<std::size_t>(k[endpoint][i].radio);
      const double bearer = k[mount][from].robot;
      if (is_null(bearer) || (robot >= 0 && bearer != robot)) continue;
      for (std::size_t j = 0; j < k[endpoint].size(); ++j) {
        const auto peer = static_cast<std::size_t>(k[endpoint][j].radio);
        if (i == j || !is_peer(k, peer) || k[mount][peer].robot == bearer) continue;
        const std::optional<double> measured = reading(k, between, own, i, j, from, peer);
        if (measured) *k.append(range, 1).begin() = {bearer, static_cast<double>(peer), *measured, k.time()};
      }
    }
  }

 private:
  using Stated = std::map<std::pair<std::size_t, std::size_t>, double>;

  // Its own radio as the only peer: there is no distance to it.
  void expect_no_own(const Setup& s) const {
    const auto name = [&](const char* set, double row) -> std::string {
      return s.host()->row_name(s.host(), set, static_cast<uint32_t>(row));
    };
    if (name("robot", robot) == name("radio", peers[0]))
      throw BadInput("attribute \"peers\": \"" + name("radio", peers[0]) +
                     "\" is the robot's own radio, to which it measures nothing; expected others");
  }

  static double radio_named(const Setup& s, const std::string& name) {
    std::string known;
    for (uint32_t row = 0; row < s.host()->rows(s.host(), "radio"); ++row) {
      const std::string one = s.host()->row_name(s.host(), "radio", row);
      if (one == name) return row;
      known += (known.empty() ? "" : ", ") + one;
    }
    throw BadInput("attribute \"peers\": no radio is called \"" + name + "\"" + which_is_no_radio(s.host(), name) +
                   "; expected some of " + known);
  }

  static std::pair<std::size_t, std::size_t> pair_of(std::size_t a, std::size_t b) { return std::minmax(a, b); }

  Stated stated(const Step& k) const {
    Stated result;
    if (!biases) return result;
    for (std::size_t i = 0; i < k[*biases].size(); ++i) {
      const PairBias& row = k[*biases][i];
      const auto pair = pair_of(static_cast<std::size_t>(row.a), static_cast<std::size_t>(row.b));
      if (row.a == row.b) refuse_itself(k, i);
      if (std::abs(row.bias) > usual_bias && k.tick() == 0) warn_of_bias(k, i);
      if (!result.emplace(pair, row.bias).second) refuse_second(k, i);
    }
    return result;
  }

  [[noreturn]] void refuse_itself(const Step& k, std::size_t i) const {
    const std::string name(k.name("radio", static_cast<std::size_t>(k[*biases][i].a)));
    throw BadInput(places->at(i, "b") + name + " measures no range to itself; expected another radio than in column a");
  }

  void warn_of_bias(const Step& k, std::size_t i) const {
    char text[160];
    const double metres = k[*biases][i].bias;
    std::snprintf(text, sizeof text, "a bias of %.6g m; is this millimetres? %.6g mm are %.6g m", metres, metres,
                  metres / 1000);
    k.event("warning: " + places->at(i, "bias") + text);
  }

  static constexpr double usual_bias = 10;  // m; those of ultra-wideband are less than one

  // A pair that has a row already, in this order or the other.
  [[noreturn]] void refuse_second(const Step& k, std::size_t second) const {
    const auto pair = [&](std::size_t i) {
      const PairBias& row = k[*biases][i];
      return pair_of(static_cast<std::size_t>(row.a), static_cast<std::size_t>(row.b));
    };
    std::size_t first = 0;
    while (pair(first) != pair(second)) ++first;
    const PairBias& row = k[*biases][second];
    const auto name = [&](double radio) { return std::string(k.name("radio", static_cast<std::size_t>(radio))); };
    const bool is_turned = k[*biases][first].a != row.a;
    throw BadInput(places->at(second) + "the pair of " + name(row.a) + " and " + name(row.b) + " has a bias in line " +
                   std::to_string(places->line(first)) + " already" + (is_turned ? ", in the other order" : "") +
                   "; expected one row a pair: its bias counts both ways");
  }

  bool is_peer(const Step& k, std::size_t radio) const {
    if (!peers.empty()) return std::find(peers.begin(), peers.end(), static_cast<double>(radio)) != peers.end();
    const bool is_station = is_null(k[mount][radio].robot);
    return to == 2 || (to == 0) == is_station;
  }

  std::optional<double> reading(const Step& k, Obstructions::Now& between, const Stated& own, std::size_t i,
                                std::size_t j, std::size_t from, std::size_t peer) const {
    const Pose &a = k[pose][i], &b = k[pose][j];
    const double way = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
    if (way > k[max_range]) return {};
    const auto walls = between.between({a.x, a.y, a.z}, {b.x, b.y, b.z});
    if (way * std::pow(10, k[wall_loss] * walls.loss / 20) > k[max_range]) return {};
    const Stream draws = stream.of(k.key("radio", from)).of(k.key("radio", peer));
    const double kept = (1 - k[drop]) * std::pow(1 - k[wall_drop], walls.number);
    if (!k.expected() && kept < 1 && draws.uniform(k.tick(), 1) >= kept) return {};
    double told = way + k[bias] + k[wall_bias] * walls.loss;
    if (const auto found = own.find(pair_of(from, peer)); found != own.end()) told += found->second;
    if (!k.expected()) {
      if (k[pair_bias] > 0) told += k[pair_bias] * pair_draw(k, from, peer);
      const double deviation = std::hypot(k[noise], k[share] * way);
      if (deviation > 0) told += deviation * draws.normal(k.tick(), 0);
    }
    return std::max(0.0, told);
  }

  // Of a pair alone: neither direction nor the order of rows matters.
  double pair_draw(const Step& k, std::size_t a, std::size_t b) const {
    const uint64_t one = k.key("radio", a), other = k.key("radio", b);
    return stream.of(std::min(one, other)).of(std::max(one, other)).of(1).normal(0, 0);
  }

  double robot;
  int to;
  Value rate, noise, share, bias, pair_bias, wall_bias, wall_loss, max_range, drop, wall_drop;
  Stream stream;
  In<Mount> mount;
  In<Endpoint> endpoint;
  In<Pose> pose;
  Obstructions obstructions;
  Out<Range> range;
  std::optional<In<PairBias>> biases;
  std::optional<TableRows> places;
  std::vector<double> peers;
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsRange)
