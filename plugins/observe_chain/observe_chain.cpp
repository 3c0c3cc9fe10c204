// Records a chain of radios: level, rssi, distance and walls of each of its links, tick by tick.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <muster/names.hpp>
#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "plugins/other_kinds.hpp"

namespace {

using namespace muster;

struct ObserveChain {
  static constexpr auto id = "observe.chain/3";
  static constexpr auto summary = "level, rssi, distance and walls of the links along a chain of radios";
  static constexpr auto manual =
      "`chain` names radios from one end to the other; the link of two neighbours is the one on which the further\n"
      "hears the nearer, and its columns in self/chain end in the further's name. level, rssi and distance are\n"
      "those of this tick, null without a link; rssi that was not received keeps its last value. smooth is rssi in\n"
      "a first-order filter. walls is the part of the level that the adder named by `walls` gave. below is the time\n"
      "that smooth spent under `threshold` or nothing was received, share that time over the time since rssi was "
      "first\n"
      "received, worst the lowest smooth so far. constant is the time constant with which smooth goes to `threshold`, "
      "from its first "
      "value\n"
      "to this one by the method of areas (Astrom and Hagglund, PID Controllers, 1995, section 2.4): the integral of\n"
      "smooth - threshold over how much that fell. It is exact for an exponential, holds the filter's own lag, and is\n"
      "null until smooth has come nearer by 3 dB.";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      text("chain", "", "names of radios, the nearest to the base first").required(),
      text("walls", "radio.multiwall.walls", "the part of link/*/level that is the loss of walls"),
      real("threshold", -60, -200, 0, "dBm", "rssi under which a link counts as weak"),
      real("smoothing", 5, 0, 1000, "s", "time constant of the filter; 0: none")};

  // One link's columns.
  struct Seen {
    double level, rssi, smooth, distance, walls, below, share, worst, constant;
  };

  // One link's way to the threshold: smooth at its first reading, the time since, and the integral of how much it fell.
  struct Approach {
    double first, since, area;
  };
  static constexpr double least_fall = 3;  // dB; below it noise is most of what smooth fell by

  struct Part {
    static constexpr const char* columns = "level[dBm]";
    double level;
  };

  explicit ObserveChain(Setup& s)
      : threshold(s.value("threshold")),
        smoothing(s.value("smoothing")),
        radios(rows_of(s)),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.read_if_any<Level>("link/*/level")),
        rssi(s.read_if_any<Rssi>("link/*/rssi")),
        walls(s.read_if_any<Part>("link/*/level@" + s.text("walls"))),
        chain{s.host()->claim(s.host(), MUSTER_WRITE, 0, "self/chain", columns_of(s).c_str())},
        approach{s.host()->claim(s.host(), MUSTER_WRITE, 0, "self/approach", approaches_of(s).c_str())} {
    if (chain.index < 0 || approach.index < 0) throw std::runtime_error("");
  }

  static std::vector<std::string> names_of(const Setup& s) {
    std::vector<std::string> result = names_in(s.host(), "chain");
    const std::string given = "attribute \"chain\": \"" + s.text("chain") + "\"";
    if (result.size() < 2)
      throw BadInput(given + " has no link; expected two names or more, with blanks between, from the base outwards");
    for (auto name = result.begin(); name != result.end(); ++name) {
      if (std::find(result.begin(), name, *name) != name)
        throw BadInput(given + " names \"" + *name +
                       "\" twice; expected each radio once, from the nearest to the base to the furthest");
    }
    return result;
  }

  static std::vector<std::size_t> rows_of(const Setup& s) {
    std::vector<std::size_t> result;
    const muster_host* host = s.host();
    for (const std::string& name : names_of(s)) {
      uint32_t row = 0;
      while (row < host->rows(host, "radio") && host->row_name(host, "radio", row) != name) ++row;
      if (row == host->rows(host, "radio"))
        throw BadInput("attribute \"chain\": no radio is called \"" + name + "\"" + which_is_no_radio(host, name) +
                       "; expected some of " + radios_of(*host));
      result.push_back(row);
    }
    return result;
  }

  static std::string radios_of(const muster_host& host) {
    std::string result;
    for (uint32_t row = 0; row < host.rows(&host, "radio"); ++row)
      result += (row ? ", " : "") + std::string(host.row_name(&host, "radio", row));
    return result;
  }

  // The further ends of the links, as they stand in the names of columns.
  static std::vector<std::string> ends_of(const Setup& s) {
    const std::vector<std::string> names = names_of(s);
    std::vector<std::string> ends;
    for (std::size_t i = 1; i < names.size(); ++i) {
      std::string name = names[i];
      std::replace_if(
          name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
      if (const auto same = std::find(ends.begin(), ends.end(), name); same != ends.end())
        throw BadInput("attribute \"chain\": both \"" + names[static_cast<std::size_t>(same - ends.begin()) + 1] +
                       "\" and \"" + names[i] + "\" would give the column level_" + name +
                       "; rename one of these radios");
      ends.push_back(name);
    }
    return ends;
  }

  static std::string columns_of(const Setup& s) {
    std::string result;
    for (const std::string& name : ends_of(s))
      result += " level_" + name + "[dBm]? rssi_" + name + "[dBm]? smooth_" + name + "[dBm]? distance_" + name +
                "[m]? walls_" + name + "[dB]? below_" + name + "[s] share_" + name + " worst_" + name +
                "[dBm]? constant_" + name + "[s]?";
    return result;
  }

  static std::string approaches_of(const Setup& s) {
    std::string result;
    for (const std::string& name : ends_of(s))
      result += " first_" + name + "[dBm]? since_" + name + "[s] area_" + name + "[dB*s]";
    return result;
  }

  void step(const Step& k) const {
    for (std::size_t i = 0; i + 1 < radios.size(); ++i) {
      Seen& now = reinterpret_cast<Seen*>(&k[chain]->first)[i];
      const Seen& before = reinterpret_cast<const Seen*>(&k.last(chain)->first)[i];
      now = {null(),       before.rssi,  before.smooth, null(),         null(),
             before.below, before.share, before.worst,  before.constant};
      const int link = link_of(k, radios[i], radios[i + 1]);
      const bool is_silent = link < 0 || !look(k, static_cast<std::size_t>(link), now);
      Approach& way = reinterpret_cast<Approach*>(&k[approach]->first)[i];
      way = reinterpret_cast<const Approach*>(&k.last(approach)->first)[i];
      if (is_null(now.smooth)) continue;
      if (is_silent || now.smooth < k[threshold]) now.below += k.dt();
      follow(k, before.smooth, way, now);
    }
  }

  // The time counts the first tick, the integral goes from its end on, by the trapezoidal rule.
  void follow(const Step& k, double smooth_before, Approach& way, Seen& now) const {
    if (is_null(way.first)) way.first = smooth_before = now.smooth;
    if (way.since > 0) way.area += k.dt() * (way.first - (smooth_before + now.smooth) / 2);
    way.since += k.dt();
    now.share = now.below / way.since;
    const double fell = way.first - now.smooth, away = way.first - k[threshold];
    const bool is_nearer = std::copysign(fell, away) == fell && std::abs(fell) >= least_fall;
    now.constant = is_nearer ? (away * (way.since - k.dt()) - way.area) / fell : null();
  }

  // False where nothing was received.
  bool look(const Step& k, std::size_t link, Seen& now) const {
    const Pose& a = k[pose][static_cast<std::size_t>(k[ends][link].tx)];
    const Pose& b = k[pose][static_cast<std::size_t>(k[ends][link].rx)];
    now.distance = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
    if (!k[level].empty()) now.level = k[level][link].level;
    if (!k[walls].empty()) now.walls = 0 - k[walls][link].level;
    if (k[rssi].empty() || is_null(k[rssi][link].rssi)) return false;
    now.rssi = k[rssi][link].rssi;
    const double weight = k[smoothing] > 0 ? 1 - std::exp(-k.dt() / k[smoothing]) : 1;
    now.smooth = is_null(now.smooth) ? now.rssi : now.smooth + weight * (now.rssi - now.smooth);
    if (!(now.worst <= now.smooth)) now.worst = now.smooth;  // also without an earlier one
    return true;
  }

  // The row of the link from radio `tx` to radio `rx`, or -1.
  int link_of(const Step& k, std::size_t tx, std::size_t rx) const {
    const auto radio = [&](double row) {
      return static_cast<std::size_t>(k[endpoint][static_cast<std::size_t>(row)].radio);
    };
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      if (radio(k[ends][i].tx) == tx && radio(k[ends][i].rx) == rx) return static_cast<int>(i);
    }
    return -1;
  }

  // The row of self/chain has as many columns as the chain needs.
  struct Row {
    double first;
  };

  Value threshold, smoothing;
  std::vector<std::size_t> radios;
  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  In<Level> level;
  In<Rssi> rssi;
  In<Part> walls;
  Out<Row> chain, approach;
};

}  // namespace

MUSTER_PLUGIN_IS(ObserveChain)
