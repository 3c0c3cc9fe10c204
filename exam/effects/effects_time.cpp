// Effects of time and of settings.
#include <algorithm>
#include <numbers>

#include "exam/effects/effect.hpp"

namespace muster::exam {
namespace {

// Index of one station, or -1 for all.
int some_station(const Scene& s, Random& random) {
  return random.chance(0.5) ? -1 : random.below(static_cast<int>(s.site.plan.stations.size()));
}
std::vector<std::string> rows_of(const Scene& s, int station) {
  return station < 0 ? std::vector<std::string>{} : std::vector<std::string>{radio_row(s.site, station)};
}
bool concerns(int station, const Reading& r) { return station < 0 || r.station == station; }

// A device's warm-up: a logistic curve.
Effect drift(const Scene& s, Random& random) {
  const double middle = s.site.duration() * random.uniform(0.15, 0.75),
               slowness = s.site.duration() * random.uniform(0.06, 0.15);
  const double sign = random.sign(), start = 1 / (1 + std::exp(middle / slowness));
  const int station = some_station(s, random);
  Effect e{"drift"};
  e.rows = rows_of(s, station);
  e.shift = scaled([=](const Reading& r) {
    return concerns(station, r) ? sign * (1 / (1 + std::exp((middle - r.t) / slowness)) - start) : 0.0;
  });
  const double end = 1 / (1 + std::exp((middle - s.site.duration()) / slowness));
  e.parameters = [=](double x) {
    return std::vector<Parameter>{
        {"change", sign * x * (end - start), "dB"}, {"middle", middle, "s"}, {"slowness", slowness, "s"}};
  };
  return e;
}

Effect step(const Scene& s, Random& random) {
  const double at = s.site.duration() * random.uniform(0.2, 0.8), sign = random.sign();
  const int station = some_station(s, random);
  Effect e{"step"};
  e.rows = rows_of(s, station);
  e.shift = scaled(
      [=](const Reading& r) { return concerns(station, r) ? sign * (1 + std::tanh((r.t - at) / 0.3)) / 2 : 0.0; });
  e.parameters = [=](double x) { return std::vector<Parameter>{{"at", at, "s"}, {"size", sign * x, "dB"}}; };
  return e;
}

// A compressor or a lift: a wave between sine and triangle.
Effect periodic(const Scene& s, Random& random) {
  const double period = random.uniform(15, std::min(120.0, s.site.duration() / 3)),
               phase = random.uniform(0, 2 * std::numbers::pi);
  const double bend = random.uniform(0.7, 0.97);
  const int station = some_station(s, random);
  Effect e{"periodic"};
  e.rows = rows_of(s, station);
  e.shift = scaled([=](const Reading& r) {
    return concerns(station, r)
               ? std::asin(bend * std::sin(2 * std::numbers::pi * r.t / period + phase)) / std::asin(bend)
               : 0.0;
  });
  e.parameters = [=](double x) { return std::vector<Parameter>{{"period", period, "s"}, {"amplitude", x, "dB"}}; };
  return e;
}

// People crossing one link: dips with a rim, as behind a cylinder.
Effect people(const Scene& s, Random& random) {
  const int station = random.below(static_cast<int>(s.site.plan.stations.size())), robot = random.below(s.site.robots);
  struct Passage {
    double at, half, depth;  // s, s, share
  };
  std::vector<Passage> passages;
  for (double t = random.uniform(2, 20); t < s.site.duration(); t += random.uniform(12, 45))
    passages.push_back({t, random.uniform(0.8, 3), random.uniform(0.7, 1.3)});
  Effect e{"people"};
  e.rows = {radio_row(s.site, station), "radio/" + robot_name(robot)};
  const auto dip = [=](const Reading& r, const Passage& p) {
    const double u = (r.t - p.at) / p.half;
    const bool meets = r.station == station && r.robot == robot && std::abs(u) < 4;
    return meets ? p.depth * std::exp(-u * u) * (u * u * 0.8 - 1) : 0.0;
  };
  e.shift = scaled([=](const Reading& r) {
    double sum = 0;
    for (const Passage& p : passages) sum += dip(r, p);
    return sum;
  });
  e.passages = [=](const Data& data, double strength) {
    Eigen::MatrixXd result(data.size(), passages.size());
    for (std::size_t k = 0; k < passages.size(); ++k)
      result.col(static_cast<Eigen::Index>(k)) =
          scaled([&](const Reading& r) { return dip(r, passages[k]); })(data, strength);
    return result;
  };
  e.linear = false;
  e.most = 30;
  e.parameters = [count = static_cast<double>(passages.size())](double x) {
    return std::vector<Parameter>{{"loss", x, "dB"}, {"passages", count, ""}};
  };
  return e;
}

// Readings are relative to a nominal transmit power; the amplifier's real steps differ from the nominal ones.
Effect power_steps(const Scene&, Random& random) {
  std::array<double, power_levels.size()> error{};
  double largest = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = power_levels[i] == 0 ? 0 : random.uniform(-1, 1);
    largest = std::max(largest, std::abs(error[i]));
  }
  for (double& e : error) e /= largest;
  Effect e{"power_steps"};
  e.shift = scaled([=](const Reading& r) { return error[static_cast<std::size_t>(r.power)]; });
  e.parameters = [=](double x) {
    std::vector<Parameter> result;
    for (std::size_t i = 0; i < error.size(); ++i)
      result.push_back({"error_" + std::to_string(static_cast<int>(power_levels[i])), x * error[i], "dB"});
    return result;
  };
  return e;
}

// The reported value is relative to the receiver's noise, which rises with other traffic.
Effect noise_floor_rssi(const Scene&, Random&) {
  Effect e{"noise_floor_rssi"};
  e.shift = scaled([](const Reading& r) { return -r.noise; });
  e.parameters = [](double x) { return std::vector<Parameter>{{"swing", x, "dB"}, {"share", 1, ""}}; };
  return e;
}

}  // namespace

std::vector<Recipe> time_recipes() {
  SiteNeeds power, noise;
  power.power = true;
  noise.noise = true;
  return {{"drift", true, {}, drift},
          {"step", true, {}, step},
          {"periodic", true, {}, periodic},
          {"people", true, {}, people},
          {"power_steps", true, power, power_steps},
          {"noise_floor_rssi", true, noise, noise_floor_rssi}};
}

}  // namespace muster::exam
