// Effects of the radios themselves: their levels, patterns, places and names.
#include <algorithm>
#include <numbers>

#include "exam/effects/effect.hpp"

namespace muster::exam {
namespace {

int any_station(const Scene& s, Random& random) { return random.below(static_cast<int>(s.site.plan.stations.size())); }

Effect tx_offset(const Scene& s, Random& random) {
  const int station = any_station(s, random);
  const double sign = random.sign();
  Effect e{"tx_offset"};
  e.rows = {radio_row(s.site, station)};
  e.shift = scaled([=](const Reading& r) { return r.station == station && !r.up ? sign : 0.0; });
  e.parameters = [=](double x) { return std::vector<Parameter>{{"offset", sign * x, "dB"}}; };
  return e;
}

Effect rx_offset(const Scene&, Random& random) {
  const int robot = random.below(2);
  const double sign = random.sign();
  Effect e{"rx_offset"};
  e.rows = {"radio/" + robot_name(robot)};
  e.shift = scaled([=](const Reading& r) { return r.robot == robot && !r.up ? sign : 0.0; });
  e.parameters = [=](double x) { return std::vector<Parameter>{{"offset", sign * x, "dB"}}; };
  return e;
}

// Cardioid over a floor of scattered power, in dB, with mean 0 over directions and 1 from peak to peak.
struct Pattern {
  double direction, back;  // rad; power behind
  double operator()(double bearing) const {
    return (10 * std::log10(power(bearing)) - mean()) / (-10 * std::log10(back));
  }
  double power(double bearing) const {
    return back + (1 - back) * std::pow((1 + std::cos(bearing - direction)) / 2, 1.5);
  }
  double mean() const {
    double sum = 0;
    for (int i = 0; i < 72; ++i) sum += 10 * std::log10(power(direction + i * std::numbers::pi / 36)) / 72;
    return sum;
  }
  // Amplitude of the pattern's first harmonic.
  double amplitude() const {
    double sum = 0;
    for (int i = 0; i < 72; ++i)
      sum += (*this)(direction + i * std::numbers::pi / 36) * std::cos(i * std::numbers::pi / 36) / 36;
    return sum;
  }
};

Pattern draw_pattern(Random& random) {
  return {random.uniform(-std::numbers::pi, std::numbers::pi), random.uniform(0.1, 0.3)};
}

std::vector<Parameter> pattern_parameters(const Pattern& p, double depth) {
  return {{"direction", p.direction, "rad"}, {"amplitude", depth * p.amplitude(), "dB"}, {"depth", depth, "dB"}};
}

Effect antenna_tx(const Scene& s, Random& random) {
  const int station = any_station(s, random);
  const Pattern pattern = draw_pattern(random);
  const double mean = pattern.mean();
  Effect e{"antenna_tx"};
  e.rows = {radio_row(s.site, station)};
  e.shift = scaled([&site = s.site, station, pattern, mean](const Reading& r) {
    if (r.station != station) return 0.0;
    return (10 * std::log10(pattern.power(station_bearing(site, r))) - mean) / (-10 * std::log10(pattern.back));
  });
  e.parameters = [=](double x) { return pattern_parameters(pattern, x); };
  e.most = 30;
  return e;
}

Effect antenna_rx(const Scene& s, Random& random) {
  const Pattern pattern = draw_pattern(random);
  const double mean = pattern.mean();
  Effect e{"antenna_rx"};
  for (int i = 0; i < s.site.robots; ++i) e.rows.push_back("radio/" + robot_name(i));
  e.shift = scaled([&site = s.site, pattern, mean](const Reading& r) {
    return (10 * std::log10(pattern.power(robot_bearing(site, r))) - mean) / (-10 * std::log10(pattern.back));
  });
  e.parameters = [=](double x) { return pattern_parameters(pattern, x); };
  return e;
}

// A sector shadowed by the robot's body, with soft edges.
Effect body_shadow(const Scene& s, Random& random) {
  const double direction = random.uniform(-std::numbers::pi, std::numbers::pi), half = random.uniform(0.3, 0.6);
  Effect e{"body_shadow"};
  for (int i = 0; i < s.site.robots; ++i) e.rows.push_back("radio/" + robot_name(i));
  e.shift = scaled([&site = s.site, direction, half](const Reading& r) {
    const double away = std::abs(std::remainder(robot_bearing(site, r) - direction, 2 * std::numbers::pi));
    const double u = std::clamp((1.4 * half - away) / (0.8 * half), 0.0, 1.0);
    return -u * u * (3 - 2 * u);
  });
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"direction", direction, "rad"}, {"width", 2 * half, "rad"}, {"loss", x, "dB"}};
  };
  e.most = 30;
  return e;
}

// Change of reading i's level if its station is at `to`, with the map's own walls.
double moved_level(const GroundTruth& site, const Data& data, std::size_t i, Vec3 to) {
  const Reading& r = data.readings[i];
  const auto row = static_cast<Eigen::Index>(i);
  return (design_row(site, crossings(site.plan, to, r.at), to, r.at) - data.design.row(row)).dot(coefficients(site));
}

Effect tx_misplaced(const Scene& s, Random& random) {
  const int station = any_station(s, random);
  const double direction = random.uniform(0, 2 * std::numbers::pi);
  const Vec3 at = s.site.plan.stations[static_cast<std::size_t>(station)].at;
  const auto place = [=](double x) {
    return Vec3{at.x + x * std::cos(direction), at.y + x * std::sin(direction), at.z};
  };
  Effect e{"tx_misplaced"};
  e.linear = false;
  e.least = 0.2;
  e.most = 5;
  e.rows = {radio_row(s.site, station)};
  e.shift = [&site = s.site, station, place](const Data& data, double x) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i)
      if (data.readings[i].station == station)
        result[static_cast<Eigen::Index>(i)] = moved_level(site, data, i, place(x));
    return result;
  };
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"x", place(x).x, "m"}, {"y", place(x).y, "m"}, {"moved", x, "m"}};
  };
  return e;
}

Effect label_swap(const Scene& s, Random& random) {
  const int one = any_station(s, random);
  int other = any_station(s, random);
  while (other == one) other = any_station(s, random);
  const auto meant = [=](int station) { return station == one ? other : station == other ? one : station; };
  Effect e{"label_swap"};
  e.least = e.most = 1;
  e.rows = {radio_row(s.site, one), radio_row(s.site, other)};
  e.shift = [&site = s.site, meant](const Data& data, double x) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i) {
      const int true_station = meant(data.readings[i].station);
      if (true_station == data.readings[i].station) continue;
      result[static_cast<Eigen::Index>(i)] =
          x * moved_level(site, data, i, site.plan.stations[static_cast<std::size_t>(true_station)].at);
    }
    return result;
  };
  e.parameters = [](double) { return std::vector<Parameter>{}; };
  e.field_of = [=](const Reading& r) { return meant(r.station); };
  return e;
}

// A receiver of low sensitivity: the two directions of a link differ.
Effect asymmetry(const Scene& s, Random& random) {
  const int station = any_station(s, random);
  Effect e{"asymmetry"};
  e.also = {"rx_offset"};
  e.rows = {radio_row(s.site, station)};
  e.shift = scaled([=](const Reading& r) { return r.up && r.station == station ? -1.0 : 0.0; });
  e.parameters = [](double x) { return std::vector<Parameter>{{"loss", x, "dB"}}; };
  return e;
}

}  // namespace

std::vector<Recipe> radio_recipes() {
  SiteNeeds two_robots, two_way;
  two_robots.two_robots = true;
  two_way.two_way = true;
  return {{"tx_offset", true, {}, tx_offset},     {"rx_offset", true, two_robots, rx_offset},
          {"antenna_tx", true, {}, antenna_tx},   {"antenna_rx", true, {}, antenna_rx},
          {"body_shadow", true, {}, body_shadow}, {"tx_misplaced", true, {}, tx_misplaced},
          {"label_swap", true, {}, label_swap},   {"asymmetry", true, two_way, asymmetry}};
}

}  // namespace muster::exam
