#include "exam/ground_truth.hpp"

#include <algorithm>
#include <numbers>

#include "exam/walls.hpp"

namespace muster::exam {
namespace {

double wrapped(double a) { return std::remainder(a, 2 * std::numbers::pi); }

// A smooth, slow, aperiodic curve: a sum of waves of incommensurate lengths.
class SlowCurve {
 public:
  SlowCurve(Random& random, double duration) {
    for (double& w : pace_) w = random.uniform(1.5, 7) / duration;
    for (double& p : phase_) p = random.uniform(0, 6.28);
  }
  double operator()(double t) const {
    double sum = 0;
    for (std::size_t i = 0; i < pace_.size(); ++i) sum += std::sin(2 * std::numbers::pi * pace_[i] * t + phase_[i]);
    return sum / 2;
  }

 private:
  std::array<double, 4> pace_{}, phase_{};
};

// Bursts of foreign traffic, from 0 to about 1.
class Traffic {
 public:
  Traffic(Random& random, double duration) {
    for (double t = random.uniform(0, 30); t < duration; t += random.uniform(15, 70))
      bursts_.push_back({t, random.uniform(4, 15), random.uniform(0.3, 1)});
  }
  double operator()(double t) const {
    double sum = 0;
    for (const auto& [at, width, size] : bursts_) sum += size / (1 + std::pow((t - at) / width, 4));
    return sum;
  }

 private:
  std::vector<std::array<double, 3>> bursts_;
};

Noise draw_noise(Random& random) {
  Noise noise;
  const double kind = random.uniform();
  noise.field.family = kind < 0.5 ? Family::exponential : kind < 0.75 ? Family::gaussian : Family::two_scale;
  noise.field.sigma = random.uniform(2, 6);
  noise.field.decorrelation = random.uniform(1, 3);
  noise.field.shared = random.uniform(0, 0.3);
  noise.reading.rician_k = random.uniform(3, 10);
  noise.reading.averaged = random.chance(0.4) ? 2 + random.below(5) : 1;
  noise.lost = random.chance(0.25) ? 0.1 : 0;
  return noise;
}

// A setting constant over epochs: it varies, but is no function of place.
int setting_at(Random& random, double t, double duration, double& until, int now, int levels) {
  if (t < until) return now;
  until = t + duration * random.uniform(0.03, 0.09);
  return (now + 1 + random.below(levels - 1)) % levels;
}

}  // namespace

Vec3 place_of(const GroundTruth& site, const Reading& r) {
  return site.plan.stations[static_cast<std::size_t>(r.station)].at;
}

double distance_of(Vec3 a, Vec3 b) { return std::max(0.01, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z)); }

double robot_bearing(const GroundTruth& site, const Reading& r) {
  const Vec3 s = place_of(site, r);
  return wrapped(std::atan2(s.y - r.at.y, s.x - r.at.x) - r.yaw);
}

double station_bearing(const GroundTruth& site, const Reading& r) {
  const Vec3 s = place_of(site, r);
  return wrapped(std::atan2(r.at.y - s.y, r.at.x - s.x) - site.plan.stations[static_cast<std::size_t>(r.station)].yaw);
}

Eigen::RowVectorXd design_row(const GroundTruth& site, const std::vector<Crossing>& crossed, Vec3 a, Vec3 b) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(2 + static_cast<Eigen::Index>(site.plan.materials.size()));
  row[0] = 1;
  row[1] = -10 * std::log10(distance_of(a, b));
  for (const Crossing& c : crossed) row[2 + c.material] -= 1;
  return row;
}

Data data_of(const GroundTruth& site, std::vector<Reading> readings) {
  Data data;
  data.readings = std::move(readings);
  data.design.resize(static_cast<Eigen::Index>(data.size()), 2 + static_cast<Eigen::Index>(site.plan.materials.size()));
  for (std::size_t i = 0; i < data.size(); ++i) {
    const Reading& r = data.readings[i];
    const Vec3 station = place_of(site, r);
    data.crossings.push_back(crossings(site.plan, station, r.at));
    data.design.row(static_cast<Eigen::Index>(i)) = design_row(site, data.crossings[i], station, r.at);
  }
  return data;
}

Eigen::VectorXd coefficients(const GroundTruth& site) {
  Eigen::VectorXd result(2 + static_cast<Eigen::Index>(site.plan.materials.size()));
  result[0] = site.base.level_at_1m;
  result[1] = site.base.n;
  for (std::size_t m = 0; m < site.plan.materials.size(); ++m)
    result[2 + static_cast<Eigen::Index>(m)] = site.plan.materials[m].loss;
  return result;
}

GroundTruth draw_site(std::uint64_t seed, const SiteNeeds& needs, int rows, const std::string& walls) {
  Random random(seed, "site");
  GroundTruth site;
  PlanNeeds plan = needs.plan;
  plan.corridor_station = plan.corridor_station || random.chance(0.4);
  plan.high_stations = plan.high_stations || random.chance(0.2);
  site.robots = needs.two_robots || random.chance(0.5) ? 2 : 1;
  site.two_way = needs.two_way || random.chance(0.15);
  site.has_power = needs.power || random.chance(0.15);
  site.has_firmware = needs.firmware || random.chance(0.15);
  site.plan = walls.empty() ? draw_plan(random, plan) : furnished(plan_of_walls(walls), random, plan);
  site.noise = draw_noise(random);
  if (needs.single_fades) site.noise.reading.averaged = 1;
  site.has_noise = needs.noise || random.chance(0.15);
  site.noise_swing = random.uniform(2, 6);
  site.stated_field = site.noise.field;
  site.stated_reading = site.noise.reading;
  site.base.n = random.uniform(1.6, 2.4);
  site.base.tx_power = std::round(random.uniform(0, 8));
  site.base.level_at_1m = site.base.tx_power - random.uniform(36, 44);
  site.base.stated_l0 = std::round(10 * random.uniform(35, 45)) / 10;
  site.base.stated_n = std::round(100 * (site.base.n + random.uniform(-0.4, 0.4))) / 100;
  const int links = static_cast<int>(site.plan.stations.size()) * site.robots * (site.two_way ? 2 : 1);
  site.ticks = (rows + links - 1) / links;
  // Short runs have a longer period, so that they cover more than two rooms.
  const double shortest = std::min(1.0, 150.0 / site.ticks);
  site.period = to_millimetres(std::max(shortest, random.uniform(0.25, 0.4) * (site.robots == 2 ? 1.5 : 1)));
  return site;
}

Data draw_data(const GroundTruth& site, std::uint64_t seed, const std::string& name) {
  Random random(seed, "run " + name), building(seed, "climate");
  const Floor floor(site.plan);
  const SlowCurve climate(building, site.duration());
  std::vector<std::vector<Stop>> tours;
  std::vector<Traffic> traffic;
  std::vector<double> charge, fall;
  for (int r = 0; r < site.robots; ++r) {
    tours.push_back(floor.wander(random, site.ticks, site.period));
    traffic.push_back(Traffic(building, site.duration()));
    charge.push_back(random.uniform(12.1, 12.6));
    fall.push_back(random.uniform(0.8, 1.6) / site.duration());
  }
  std::vector<Reading> readings;
  double power_until = 0, firmware_until = 0;
  int power = 0, firmware = 0;
  for (int i = 0; i < site.ticks; ++i) {
    const double t = to_millimetres(i * site.period);
    power = setting_at(random, t, site.duration(), power_until, power, static_cast<int>(power_levels.size()));
    firmware =
        setting_at(random, t, site.duration(), firmware_until, firmware, static_cast<int>(firmware_names.size()));
    for (int r = 0; r < site.robots; ++r) {
      const Stop& stop = tours[static_cast<std::size_t>(r)][static_cast<std::size_t>(i)];
      Reading reading{t,
                      0,
                      r,
                      false,
                      {stop.at.x, stop.at.y, 0.4},
                      stop.yaw,
                      stop.speed,
                      0,
                      0,
                      power,
                      firmware,
                      traffic[static_cast<std::size_t>(r)](t)};
      reading.battery = to_millimetres(charge[static_cast<std::size_t>(r)] - fall[static_cast<std::size_t>(r)] * t -
                                       0.15 * stop.speed + 0.01 * random.normal());
      reading.temperature = to_millimetres(22 + 2.5 * climate(t) + 0.05 * random.normal());
      for (reading.station = 0; reading.station < static_cast<int>(site.plan.stations.size()); ++reading.station)
        for (const bool up : {false, true}) {
          reading.up = up;
          if (!up || site.two_way) readings.push_back(reading);
        }
    }
  }
  return data_of(site, std::move(readings));
}

}  // namespace muster::exam
