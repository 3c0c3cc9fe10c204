// Causes of radios: powers, receivers, antennas, bodies, names and places.
#include <algorithm>
#include <numbers>

#include "exam/simulated/planted_cause.hpp"

namespace muster::exam::simulated {
namespace {

constexpr double pi = std::numbers::pi;

std::string robot(int r) { return "robot" + std::to_string(r + 1); }

const Station& any_station(const Setting& s, Random& random) { return random.pick(s.site.plan.stations); }

std::vector<std::string> senders(const Setting& s) {
  std::vector<std::string> names;
  for (const Station& station : s.site.plan.stations) names.push_back(station.name);
  for (int r = 0; s.both_ways && r < s.site.robots; ++r) names.push_back(robot(r));
  return names;
}

std::vector<std::string> receivers(const Setting& s) {
  std::vector<std::string> names;
  for (int r = 0; r < s.site.robots; ++r) names.push_back(robot(r));
  for (const Station& station : s.site.plan.stations)
    if (s.both_ways) names.push_back(station.name);
  return names;
}

PlantedCause of_radio(const char* id, const std::string& radio) {
  PlantedCause cause{id};
  cause.texts = {{"radio", radio}};
  cause.rows = {"radio/" + radio};
  return cause;
}

std::optional<PlantedCause> offset(const char* id, const std::vector<std::string>& radios, Random& random) {
  if (radios.size() < 2) return {};
  PlantedCause cause = of_radio(id, random.pick(radios));
  cause.numbers = {{"offset", random.sign() * random.uniform(2, 8), "dB"}};
  cause.also = {"asymmetry"};
  cause.size = "offset";
  cause.least = 0.3;
  cause.most = 20;
  return cause;
}

std::optional<PlantedCause> tx_offset(const Setting& s, Random& random) {
  return offset("tx_offset", senders(s), random);
}
std::optional<PlantedCause> rx_offset(const Setting& s, Random& random) {
  return offset("rx_offset", receivers(s), random);
}

std::optional<PlantedCause> asymmetry(const Setting& s, Random& random) {
  if (!s.both_ways) return {};
  PlantedCause cause = of_radio("asymmetry", any_station(s, random).name);
  cause.numbers = {{"loss", random.sign() * random.uniform(2, 8), "dB"}};
  cause.also = {"tx_offset", "rx_offset"};
  cause.size = "loss";
  cause.least = 0.3;
  cause.most = 20;
  return cause;
}

std::optional<PlantedCause> feeder_loss(const Setting& s, Random& random) {
  if (!s.both_ways) return {};
  PlantedCause cause = of_radio("feeder_loss", any_station(s, random).name);
  cause.numbers = {{"loss", random.uniform(1.5, 8), "dB"}};
  cause.size = "loss";
  cause.least = 0.3;
  cause.most = 20;
  return cause;
}

PlantedCause antenna(const char* id, const std::string& radio, Random& random) {
  PlantedCause cause = of_radio(id, radio);
  cause.numbers = {{"amplitude", random.uniform(2, 6), "dB"}, {"direction", random.uniform(-pi, pi), "rad"}};
  cause.also = {"antenna_tx", "antenna_rx"};  // one function
  cause.size = "amplitude";
  cause.least = 0.3;
  cause.most = 20;
  return cause;
}

std::optional<PlantedCause> antenna_tx(const Setting& s, Random& random) {
  return antenna("antenna_tx", any_station(s, random).name, random);
}
std::optional<PlantedCause> sector_antenna(const Setting& s, Random& random) {
  PlantedCause cause = of_radio("sector_antenna", any_station(s, random).name);
  cause.numbers = {{"front_to_back", random.uniform(8, 25), "dB"},
                   {"direction", random.uniform(-pi, pi), "rad"},
                   {"edge", random.uniform(1.2, 2.2), "rad"}};
  cause.kin = {"antenna_tx", "antenna_rx", "body_shadow"};
  cause.size = "front_to_back";
  cause.least = 0.5;
  cause.most = 45;
  return cause;
}
std::optional<PlantedCause> antenna_rx(const Setting& s, Random& random) {
  return antenna("antenna_rx", robot(random.below(s.site.robots)), random);
}

std::optional<PlantedCause> body_shadow(const Setting& s, Random& random) {
  PlantedCause cause = of_radio("body_shadow", robot(random.below(s.site.robots)));
  cause.numbers = {{"loss", random.uniform(3, 10), "dB"},
                   {"direction", random.uniform(-pi, pi), "rad"},
                   {"width", random.uniform(0.5, 1.3), "rad"}};
  cause.kin = {"antenna_rx", "antenna_tx"};
  cause.size = "loss";
  cause.least = 0.5;
  cause.most = 30;
  return cause;
}

std::optional<PlantedCause> tx_misplaced(const Setting& s, Random& random) {
  const Station& station = any_station(s, random);
  const double way = random.uniform(0.4, 3), turn = random.uniform(-pi, pi);
  PlantedCause cause = of_radio("tx_misplaced", station.name);
  cause.numbers = {{"x", to_millimetres(station.at.x + way * std::cos(turn)), "m"},
                   {"y", to_millimetres(station.at.y + way * std::sin(turn)), "m"}};
  return cause;
}

std::optional<PlantedCause> label_swap(const Setting& s, Random& random) {
  const int stations = static_cast<int>(s.site.plan.stations.size());
  if (stations < 2) return {};
  const int a = random.below(stations), b = (a + 1 + random.below(stations - 1)) % stations;
  const auto& name = [&](int i) { return s.site.plan.stations[static_cast<std::size_t>(i)].name; };
  PlantedCause cause{"label_swap"};
  cause.texts = {{"a", name(a)}, {"b", name(b)}};
  cause.rows = {"radio/" + name(a), "radio/" + name(b)};
  cause.kin = {"tx_misplaced"};
  return cause;
}

std::optional<PlantedCause> labels_shifted(const Setting& s, Random& random) {
  const int stations = static_cast<int>(s.site.plan.stations.size());
  if (stations < 3) return {};
  const int which = 1 + random.below(stations - 1);
  const std::string first = s.site.plan.stations[static_cast<std::size_t>(which)].name;
  PlantedCause cause{"labels_shifted"};
  cause.texts = {{"first", first}};
  cause.rows = {"radio/" + first};
  cause.also = {"label_swap"};  // a shift by half of an even number exchanges pairs
  return cause;
}

std::optional<PlantedCause> column_shifted(const Setting&, Random& random) {
  PlantedCause cause{"column_shifted"};
  cause.texts = {{"column", random.chance(0.5) ? "names" : "places"}, {"by", random.chance(0.5) ? "1" : "-1"}};
  return cause;
}

// About the middle of the stations.
std::optional<PlantedCause> plan_turned(const Setting& s, Random& random) {
  static const char* ways[] = {"mirrored_x", "mirrored_y", "turned_90", "turned_180", "turned_270"};
  const auto& stations = s.site.plan.stations;
  if (stations.size() < 3) return {};
  double west = 1e300, east = -1e300, south = 1e300, north = -1e300;
  for (const Station& station : stations) {
    west = std::min(west, station.at.x);
    east = std::max(east, station.at.x);
    south = std::min(south, station.at.y);
    north = std::max(north, station.at.y);
  }
  PlantedCause cause{"plan_turned"};
  cause.texts = {{"of", "stations"}, {"how", ways[random.below(5)]}};
  cause.numbers = {{"x", to_millimetres((west + east) / 2), "m"}, {"y", to_millimetres((south + north) / 2), "m"}};
  return cause;
}

// All stations by the same way, as where another corner of the building is the map's origin.
std::optional<PlantedCause> plan_shifted(const Setting& s, Random& random) {
  if (s.site.plan.stations.size() < 2) return {};
  const double way = random.uniform(1, 5), turn = random.uniform(-pi, pi);
  PlantedCause cause{"plan_shifted"};
  cause.texts = {{"of", "stations"}};
  cause.numbers = {{"east", to_millimetres(way * std::cos(turn)), "m"},
                   {"north", to_millimetres(way * std::sin(turn)), "m"}};
  return cause;
}

std::optional<PlantedCause> power_steps(const Setting& s, Random& random) {
  if (!s.site.has_power) return {};
  PlantedCause cause{"power_steps"};
  cause.texts = {{"file", "places.csv"}};
  for (int level = 1; level <= static_cast<int>(power_levels.size()); ++level)
    cause.numbers.push_back({"error" + std::to_string(level), random.sign() * random.uniform(0.5, 3), "dB"});
  return cause;
}

}  // namespace

std::vector<CauseKind> radio_causes() {
  SiteNeeds two_way, power;
  two_way.two_way = true;
  power.power = true;
  return {{"tx_offset", {}, tx_offset},           {"rx_offset", {}, rx_offset},
          {"asymmetry", two_way, asymmetry},      {"feeder_loss", two_way, feeder_loss},
          {"antenna_tx", {}, antenna_tx},         {"antenna_rx", {}, antenna_rx},
          {"sector_antenna", {}, sector_antenna}, {"body_shadow", {}, body_shadow},
          {"label_swap", {}, label_swap},         {"tx_misplaced", {}, tx_misplaced},
          {"power_steps", power, power_steps},    {"labels_shifted", {}, labels_shifted},
          {"plan_turned", {}, plan_turned},       {"column_shifted", {}, column_shifted},
          {"plan_shifted", {}, plan_shifted}};
}

}  // namespace muster::exam::simulated
