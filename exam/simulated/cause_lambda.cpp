#include "exam/simulated/cause_lambda.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace muster::exam::simulated {
namespace {

// Densities in dB on a grid.
constexpr double width = 0.1, lowest = -80;
constexpr int bins = 1200;
using Density = std::vector<double>;

double centre(int i) { return lowest + width * (i + 0.5); }

// Density of 10 log10 of the power of a Rician fade of mean 1.
double rician(double k_db, double db) {
  const double k = k_db <= -40 ? 0 : std::pow(10, k_db / 10), power = std::pow(10, db / 10);
  const double x = 2 * std::sqrt(k * (1 + k) * power);
  const double bessel = x < 500 ? std::log(std::cyl_bessel_i(0.0, x)) : x - std::log(2 * std::numbers::pi * x) / 2;
  return (1 + k) * power * std::log(10.0) / 10 * std::exp(bessel - k - (1 + k) * power);
}

double mean_of(const Density& d) {
  double sum = 0;
  for (int i = 0; i < bins; ++i) sum += d[static_cast<std::size_t>(i)] * centre(i);
  return sum;
}

double variance_of(const Density& d) {
  const double mean = mean_of(d);
  double sum = 0;
  for (int i = 0; i < bins; ++i) sum += d[static_cast<std::size_t>(i)] * (centre(i) - mean) * (centre(i) - mean);
  return sum;
}

// Density of the sum with another variable, given by its density on the grid of multiples of `width` about 0.
Density convolved(const Density& d, const std::map<int, double>& other) {
  Density result(d.size(), 0);
  for (const auto& [by, weight] : other)
    for (int i = 0; i < bins; ++i)
      if (const int j = i + by; j >= 0 && j < bins)
        result[static_cast<std::size_t>(j)] += weight * d[static_cast<std::size_t>(i)];
  return result;
}

std::map<int, double> gaussian(double variance) {
  std::map<int, double> result;
  const double sd = std::sqrt(variance);
  double sum = 0;
  for (int i = static_cast<int>(-6 * sd / width) - 1; i <= static_cast<int>(6 * sd / width) + 1; ++i)
    sum += result[i] = std::exp(-i * width * i * width / (2 * variance));
  for (auto& [by, weight] : result) weight /= sum;
  return result;
}

std::map<int, double> uniform(double half_width) {
  std::map<int, double> result;
  const int steps = std::max(0, static_cast<int>(half_width / width));
  for (int i = -steps; i <= steps; ++i) result[i] = 1.0 / (2 * steps + 1);
  return result;
}

Density fades(double k_db, bool has_fading, double step) {
  Density d(bins, 0);
  if (!has_fading)
    d[static_cast<std::size_t>(-lowest / width)] = 1;
  else
    for (int i = 0; i < bins; ++i) d[static_cast<std::size_t>(i)] = rician(k_db, centre(i)) * width;
  double sum = 0;
  for (const double v : d) sum += v;
  for (double& v : d) v /= sum;
  return convolved(d, uniform(step / 2));
}

}  // namespace

Moments rician_moments(double k_db) {
  const Density d = fades(k_db, true, 0);
  return {mean_of(d), variance_of(d)};
}

double reading_divergence(const PlantedCause& cause, double rician_k, bool has_fading, double step) {
  const Density stated = fades(rician_k, has_fading, step);
  Density truth = stated;
  if (cause.id == "fading_law") truth = fades(cause.number("rician_k"), true, step);
  if (cause.id == "outliers") {
    const double share = cause.number("share");
    const Density far = convolved(stated, uniform(cause.number("half_width")));
    for (std::size_t i = 0; i < truth.size(); ++i) truth[i] = (1 - share) * stated[i] + share * far[i];
  }
  if (cause.id == "channel_mixture") {
    const int by = static_cast<int>(std::round(cause.number("sd") * std::sqrt(1.5) / width));  // three, evenly spaced
    truth = convolved(stated, {{-by, 1.0 / 3}, {0, 1.0 / 3}, {by, 1.0 / 3}});
  }
  // The same mean, and at least the same variance: what a fit of the level and of the noise would reach.
  std::map<int, double> moved{{static_cast<int>(std::round((mean_of(truth) - mean_of(stated)) / width)), 1.0}};
  Density best = convolved(stated, moved);
  const double missing = variance_of(truth) - variance_of(stated);
  if (missing > width * width) best = convolved(best, gaussian(missing));
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (truth[i] > 1e-12) sum += truth[i] * std::log(truth[i] / std::max(best[i], 1e-12));
  return 2 * sum;
}

double unexplained(const Eigen::VectorXd& effect, const Eigen::MatrixXd& others) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(others);
  return (effect - others * fit.solve(effect)).squaredNorm();
}

double blockage_lambda(const Eigen::VectorXd& loss, const Setting& setting, const LinkCovariance& covariance,
                       const Eigen::MatrixXd& others, double duration) {
  const double energy = unexplained(covariance.whitened(loss).col(0), others);
  // A passage is a run of blocked readings of one link without a pause.
  std::map<std::pair<int, int>, double> last;
  int passages = 0;
  for (std::size_t i = 0; i < setting.data.size(); ++i) {
    const Reading& r = setting.data.readings[i];
    if (std::abs(loss[static_cast<Eigen::Index>(i)]) < 0.5) continue;
    const auto [at, is_new] = last.try_emplace({r.station, r.robot}, r.t);
    passages += is_new || r.t - at->second > std::max(duration, 2 * setting.site.period);
    at->second = r.t;
  }
  return std::max(0.0, energy - 2 * passages * std::log(std::max(setting.site.duration() / duration, 1.0)));
}

double silence_lambda(const Setting& setting, double floor, double sd) {
  std::vector<double> chance;
  std::set<std::tuple<int, int, double>> seen;
  double mean = 0;
  for (std::size_t i = 0; i < setting.data.size(); ++i) {
    const Reading& r = setting.data.readings[i];
    if (!seen.insert({r.station, r.robot, r.t}).second) continue;
    chance.push_back(std::erfc((setting.expected[static_cast<Eigen::Index>(i)] - floor) / (sd * std::sqrt(2.0))) / 2);
    mean += chance.back();
  }
  mean /= static_cast<double>(chance.size());
  const auto term = [](double p, double q) { return p > 0 && q > 0 ? p * std::log(p / q) : 0.0; };
  double sum = 0;
  for (const double p : chance) sum += 2 * (term(p, mean) + term(1 - p, 1 - mean));
  return sum;
}

}  // namespace muster::exam::simulated
