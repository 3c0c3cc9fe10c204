// Causes along time and of the receiver's reading.
#include <algorithm>
#include <numbers>

#include "exam/simulated/planted_cause.hpp"

namespace muster::exam::simulated {
namespace {

// All links, or those of one radio.
void of_some(PlantedCause& cause, const Setting& s, Random& random) {
  if (random.chance(0.4)) return;
  const std::string radio = random.chance(0.5) ? random.pick(s.site.plan.stations).name
                                               : "robot" + std::to_string(1 + random.below(s.site.robots));
  cause.texts = {{"radio", radio}};
  cause.rows = {"radio/" + radio};
}

std::optional<PlantedCause> drift(const Setting& s, Random& random) {
  PlantedCause cause{"drift"};
  of_some(cause, s, random);
  cause.numbers = {{"rate", random.sign() * random.uniform(2, 8) * 3600 / s.site.duration(), "dB/h"}};
  cause.size = "rate";
  cause.least = 0.3 * 3600 / s.site.duration();
  cause.most = 20 * 3600 / s.site.duration();
  return cause;
}

std::optional<PlantedCause> step(const Setting& s, Random& random) {
  PlantedCause cause{"step"};
  of_some(cause, s, random);
  cause.numbers = {{"at", s.site.duration() * random.uniform(0.15, 0.85), "s"},
                   {"size", random.sign() * random.uniform(2, 8), "dB"}};
  cause.size = "size";
  cause.least = 0.3;
  cause.most = 20;
  return cause;
}

std::optional<PlantedCause> periodic(const Setting& s, Random& random) {
  PlantedCause cause{"periodic"};
  of_some(cause, s, random);
  cause.numbers = {{"period", s.site.duration() / random.uniform(4, 30), "s"},
                   {"amplitude", random.uniform(1, 4), "dB"},
                   {"phase", random.uniform(-std::numbers::pi, std::numbers::pi), "rad"}};
  cause.size = "amplitude";
  cause.least = 0.1;
  cause.most = 15;
  return cause;
}

// The same of what one radio sends, in networks that hear both ways.
template <std::optional<PlantedCause> (*of_links)(const Setting&, Random&)>
std::optional<PlantedCause> of_sender(const Setting& s, Random& random) {
  auto cause = of_links(s, random);
  const std::string radio = random.pick(s.site.plan.stations).name;
  cause->kin = {cause->id};
  cause->id = "tx_" + cause->id;
  cause->texts = {{"radio", radio}};
  cause->rows = {"radio/" + radio};
  return cause;
}

std::optional<PlantedCause> noise_floor(const Setting& s, Random& random) {
  if (!s.site.has_noise) return {};
  PlantedCause cause{"noise_floor_rssi"};
  cause.texts = {{"file", "places.csv"}};
  cause.numbers = {{"share", random.uniform(0.2, 1)}};
  cause.size = "share";
  cause.least = 0.02;
  cause.most = 2;
  return cause;
}

// Level that a share of the readings is expected below, dBm.
double quantile(const Setting& s, double share) {
  std::vector<double> levels(s.expected.begin(), s.expected.end());
  std::sort(levels.begin(), levels.end());
  return std::round(levels[static_cast<std::size_t>(share * static_cast<double>(levels.size() - 1))]);
}

std::optional<PlantedCause> saturation(const Setting& s, Random& random) {
  PlantedCause cause{"rssi_saturation", Acts::receiver};
  cause.numbers = {{"level", quantile(s, random.uniform(0.85, 0.98)), "dBm"}};
  return cause;
}

std::optional<PlantedCause> compression(const Setting& s, Random& random) {
  PlantedCause cause{"rssi_compression", Acts::receiver};
  cause.numbers = {{"knee", quantile(s, random.uniform(0.6, 0.9)), "dBm"},
                   {"share", random.uniform(0.3, 0.8), "dB/dB"}};
  return cause;
}

std::optional<PlantedCause> floor(const Setting& s, Random& random) {
  PlantedCause cause{"rssi_floor", Acts::receiver};
  cause.texts = {{"silent", random.chance(0.7) ? "true" : "false"}};
  cause.numbers = {{"level", quantile(s, random.uniform(0.03, 0.2)), "dBm"}};
  return cause;
}

}  // namespace

std::vector<CauseKind> time_causes() {
  SiteNeeds noise, two_way;
  noise.noise = true;
  two_way.two_way = true;
  return {{"drift", {}, drift},
          {"step", {}, step},
          {"periodic", {}, periodic},
          {"tx_drift", two_way, of_sender<drift>},
          {"tx_step", two_way, of_sender<step>},
          {"tx_periodic", two_way, of_sender<periodic>},
          {"noise_floor_rssi", noise, noise_floor},
          {"rssi_saturation", {}, saturation},
          {"rssi_compression", {}, compression},
          {"rssi_floor", {}, floor}};
}

}  // namespace muster::exam::simulated
