// Effects outside the vocabulary: the right answer is the covariate's name, and no cause.
#include <algorithm>
#include <numbers>

#include "exam/effects/effect.hpp"

namespace muster::exam {
namespace {

Effect outside(const char* id, std::vector<std::string> covariates) {
  Effect e{id};
  e.covariates = std::move(covariates);
  e.parameters = [](double x) { return std::vector<Parameter>{{"strength", x, "dB"}}; };
  return e;
}

// Interference from motors, which grows with their speed.
Effect motor_noise(const Scene&, Random& random) {
  const double power = random.uniform(1.3, 2.5);
  Effect e = outside("motor_noise", {"speed"});
  e.shift = scaled([=](const Reading& r) { return -std::pow(r.speed / 0.6, power); });
  return e;
}

Effect lobes_3_and_4(const Scene& s, Random& random) {
  const double third = random.uniform(0, 6.28), fourth = random.uniform(0, 6.28), share = random.uniform(0.3, 0.7);
  Effect e = outside("lobes_3_and_4", {"bearing", "rx_bearing"});
  e.shift = scaled([&site = s.site, third, fourth, share](const Reading& r) {
    const double b = robot_bearing(site, r);
    return share * std::cos(3 * b + third) + (1 - share) * std::cos(4 * b + fourth);
  });
  return e;
}

// Moisture at one end of the house: a curved slope over the plan.
Effect moisture(const Scene& s, Random& random) {
  const double direction = random.uniform(0, 2 * std::numbers::pi), curve = random.uniform(0.5, 1);
  const Vec2 size = s.site.plan.whole.high;
  Effect e = outside("moisture", {"position", "rx_position", "rxpos"});
  e.shift = scaled([&site = s.site, direction, curve, size](const Reading& r) {
    const Vec2 own = site.plan.to_own({r.at.x, r.at.y});
    const double u = std::cos(direction) * (2 * own.x / size.x - 1) + std::sin(direction) * (2 * own.y / size.y - 1);
    return -(u + curve * u * u);
  });
  return e;
}

Effect battery_knee(const Scene& s, Random& random) {
  std::vector<double> charge;
  for (const Reading& r : s.measured.readings) charge.push_back(r.battery);
  std::sort(charge.begin(), charge.end());
  const double knee = charge[static_cast<std::size_t>(random.uniform(0.25, 0.6) * static_cast<double>(charge.size()))];
  Effect e = outside("battery_knee", {"battery"});
  e.shift = scaled([=](const Reading& r) { return -std::pow(std::max(0.0, knee - r.battery) / 0.5, 1.4); });
  return e;
}

Effect time_chirp(const Scene& s, Random& random) {
  const double first = s.site.duration() / random.uniform(2, 4), last = s.site.duration() / random.uniform(7, 12);
  const double phase = random.uniform(0, 6.28);
  Effect e = outside("time_chirp", {"time", "t"});
  e.shift = scaled([=, duration = s.site.duration()](const Reading& r) {
    return std::sin(phase + 2 * std::numbers::pi * (r.t / first + r.t * r.t / (2 * duration) * (1 / last - 1 / first)));
  });
  return e;
}

Effect speed_times_distance(const Scene& s, Random&) {
  Effect e = outside("speed_times_distance", {"speed*logd", "speed*log_distance", "speed*distance"});
  e.shift = scaled([&site = s.site](const Reading& r) {
    return (r.speed - 0.45) / 0.2 * (std::log10(distance_of(place_of(site, r), r.at)) - 0.9) / 0.3;
  });
  return e;
}

Effect temperature_curve(const Scene&, Random& random) {
  const double middle = random.uniform(20.5, 23.5), width = random.uniform(0.8, 1.6);
  Effect e = outside("temperature_curve", {"temperature"});
  e.shift = scaled([=](const Reading& r) { return -1 / (1 + std::pow((r.temperature - middle) / width, 2)); });
  return e;
}

Effect firmware_levels(const Scene&, Random& random) {
  const double one = random.sign(), other = random.uniform(-0.5, 0.5);
  Effect e = outside("firmware_levels", {"firmware"});
  e.shift = scaled([=](const Reading& r) { return r.firmware == 0 ? 0.0 : r.firmware == 1 ? one : other; });
  return e;
}

}  // namespace

std::vector<Recipe> outside_recipes() {
  SiteNeeds firmware;
  firmware.firmware = true;
  return {{"motor_noise", false, {}, motor_noise},
          {"lobes_3_and_4", false, {}, lobes_3_and_4},
          {"moisture", false, {}, moisture},
          {"battery_knee", false, {}, battery_knee},
          {"time_chirp", false, {}, time_chirp},
          {"speed_times_distance", false, {}, speed_times_distance},
          {"temperature_curve", false, {}, temperature_curve},
          {"firmware_levels", false, firmware, firmware_levels}};
}

}  // namespace muster::exam
