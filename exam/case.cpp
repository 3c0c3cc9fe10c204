#include "exam/case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exam/effect_sizing.hpp"
#include "exam/reading_law.hpp"

namespace muster::exam {
namespace {

SiteNeeds needs_of(const Order& order) {
  SiteNeeds all;
  for (const std::string& id : order.effects) {
    const SiteNeeds& n = recipe(id).needs;
    all.plan.corridor_station |= n.plan.corridor_station;
    all.plan.high_stations |= n.plan.high_stations;
    all.two_robots |= n.two_robots;
    all.two_way |= n.two_way;
    all.power |= n.power;
    all.firmware |= n.firmware;
    all.noise |= n.noise;
    all.single_fades |= n.single_fades;
  }
  return all;
}

std::vector<char> lost_at_random(const Case& made, const Data& data, const std::string& run) {
  Random random(made.seed, "lost " + run);
  std::vector<char> use(data.size());
  for (char& u : use) u = !random.chance(made.site->noise.lost);
  return use;
}

Eigen::VectorXd mean_shift(const std::vector<Hidden>& hidden, const Data& data) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
  for (const Hidden& h : hidden)
    if (h.effect.acts == Acts::mean) sum += h.effect.shift(data, h.strength);
  return sum;
}

// Reported code of a level. Real receivers use 0 and -128 as marks for a missing reading, so neither is written for a
// level. hide() keeps levels so far below 0 that this concerns one reading in many cases.
double reported(const std::vector<Hidden>& hidden, double level) {
  for (const Hidden& h : hidden)
    if (h.effect.acts == Acts::receiver && !std::isnan(level)) level = h.effect.receive(level, h.strength);
  const double code = std::round(level);
  return code == -128 ? -127 : std::min(code, -1.0);
}

}  // namespace

std::vector<char> heard(const Data& data) {
  std::vector<char> result(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) result[i] = !std::isnan(data.rssi[static_cast<Eigen::Index>(i)]);
  return result;
}

Eigen::VectorXd draw_noise(const Case& made, const Field& field, const Data& data, const std::string& run) {
  Random random(made.seed, "readings " + run);
  std::function<int(const Reading&)> whose = [](const Reading& r) { return r.station; };
  for (const Hidden& h : made.hidden)
    if (h.effect.field_of) whose = h.effect.field_of;
  const double fading = fading_moments(made.site->noise.reading).mean;
  Eigen::VectorXd result(static_cast<Eigen::Index>(data.size()));
  for (std::size_t i = 0; i < data.size(); ++i) {
    const Reading& r = data.readings[i];
    result[static_cast<Eigen::Index>(i)] =
        field(whose(r), {r.at.x, r.at.y}) + draw_reading(made.site->noise.reading, random) - fading;
  }
  return result;
}

void hear(const Case& made, const Field& field, Data& data, const std::string& run) {
  const std::vector<char> use = lost_at_random(made, data, run);
  const Eigen::VectorXd level =
      data.design * coefficients(*made.site) + mean_shift(made.hidden, data) + draw_noise(made, field, data, run);
  data.rssi.resize(level.size());
  for (Eigen::Index i = 0; i < level.size(); ++i)
    data.rssi[i] =
        use[static_cast<std::size_t>(i)] ? reported(made.hidden, level[i]) : std::numeric_limits<double>::quiet_NaN();
}

Eigen::VectorXd expected_shift(const GroundTruth& site, const std::vector<Hidden>& hidden, const Data& data) {
  Eigen::VectorXd sum = mean_shift(hidden, data);
  for (const Hidden& h : hidden)
    if (h.effect.acts == Acts::receiver) sum += received_shift(site, h.effect, h.strength, data, sum).shift;
  return sum;
}

namespace {

// A site with its effects, without readings; another attempt draws another site.
Case hidden_in(const std::string& name, std::uint64_t seed, const Order& order) {
  Case made{name, seed, order, std::make_shared<GroundTruth>(draw_site(seed, needs_of(order), order.rows, order.walls)),
            {},   {},   {},    {}};
  made.measured = draw_data(*made.site, seed, "measured");
  made.second = draw_data(*made.site, seed, "second");
  hide(made, lost_at_random(made, made.measured, "measured"));
  return made;
}

void hear_both(Case& made) {
  const Field field(*made.site, made.seed);
  hear(made, field, made.measured, "measured");
  hear(made, field, made.second, "second");
}

double worst_miss(const Case& made) {
  double worst = 1;
  for (const Hidden& h : made.hidden)
    worst = std::max(worst, std::max(h.lambda / h.wanted, h.wanted / std::max(h.lambda, 1e-6)));
  return worst;
}

}  // namespace

Case make_case(const std::string& name, std::uint64_t seed, const Order& order) {
  constexpr int attempts = 6;  // number of sites tried for the requested lambdas
  Case made = hidden_in(name, seed, order);
  for (int i = 1; i < attempts && worst_miss(made) > 1.25; ++i) {
    Case other = hidden_in(name, Random(seed, "site " + std::to_string(i)).bits(), order);
    if (worst_miss(other) < worst_miss(made)) made = std::move(other);
  }
  hear_both(made);
  weigh(made);
  return made;
}

Case remake_case(const std::string& name, std::uint64_t site_seed, const Order& order) {
  Case made = hidden_in(name, site_seed, order);
  hear_both(made);
  return made;
}

}  // namespace muster::exam
