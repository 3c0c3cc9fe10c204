#include "diagnosis/calibration/missing_data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

double below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

struct Mixture {
  double log_likelihood = 0, random = 0, by_floor = 0;
  double below = 0, above = 0;  // readings expected below the floor without one, and closely above it
};

// Mixture model: a reading is lost at random with probability `random`, or because its level, normal about the mean,
// lies below the floor. Fits `random` by EM; the floor's share of the missing ones is their mean posterior.
Mixture with_floor(const std::vector<double>& lost_at, const std::vector<double>& heard_at, double floor,
                   double sigma) {
  Mixture result;
  const double lost = static_cast<double>(lost_at.size()), all = lost + static_cast<double>(heard_at.size());
  result.random = 0.5 * lost / all;
  const auto chances = [&](std::vector<double> levels) {  // probabilities of a level below the floor
    for (double& level : levels) level = below((floor - level) / sigma);
    return levels;
  };
  const std::vector<double> chance = chances(lost_at), heard_chance = chances(heard_at);
  for (int i = 0; i < 60; ++i) {
    double by_chance = 0;  // expected number of random losses
    for (const double f : chance) by_chance += result.random / (result.random + (1 - result.random) * f + 1e-300);
    result.random = std::max(by_chance / all, 1e-9);
  }
  double by_floor = 0;
  for (const double f : chance) {
    const double p = result.random + (1 - result.random) * f;
    result.log_likelihood += std::log(p);
    by_floor += f * (1 - result.random) / p;
  }
  for (const double f : heard_chance)
    result.log_likelihood += std::log1p(-std::min(result.random + (1 - result.random) * f, 1 - 1e-12));
  result.by_floor = by_floor / lost;
  for (const std::vector<double>* levels : {&lost_at, &heard_at}) {
    for (const double m : *levels) {
      const double lower = below((floor - m) / sigma);
      result.below += (1 - result.random) * lower;
      result.above += (1 - result.random) * (below((floor + thresholds::above_floor - m) / sigma) - lower);
    }
  }
  return result;
}

// Poisson probability of at most so many events.
double at_most(std::size_t events, double expected) {
  double term = std::exp(-expected), sum = term;
  for (std::size_t k = 1; k <= events; ++k) sum += term *= expected / static_cast<double>(k);
  return sum;
}

std::vector<MissingData::Bin> binned(const Eigen::VectorXd& rssi, const Eigen::VectorXd& mean) {
  constexpr Eigen::Index bins = 10;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(rssi.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return mean[a] < mean[b]; });
  std::vector<MissingData::Bin> result;
  for (Eigen::Index b = 0; b < bins; ++b) {
    MissingData::Bin bin{};
    for (Eigen::Index k = rssi.size() * b / bins; k < rssi.size() * (b + 1) / bins; ++k) {
      const auto i = order[static_cast<std::size_t>(k)];
      bin.level += mean[i];
      bin.rows += 1;
      bin.missing += std::isnan(rssi[i]);
    }
    if (bin.rows == 0) continue;
    bin.level /= bin.rows;
    result.push_back(bin);
  }
  return result;
}

}  // namespace

bool MissingData::rises() const {
  if (bins.size() < 2) return false;
  const auto share = [](const Bin& b) { return b.missing / b.rows; };
  const auto variance = [&](const Bin& b) { return std::max(share(b) * (1 - share(b)), 1 / b.rows) / b.rows; };
  const double more = share(bins.front()) - share(bins.back());
  // Five standard errors of independent losses, and a seventh of all readings: neighbouring readings are lost
  // jointly.
  return more > thresholds::rising_share &&
         more > thresholds::rising_errors * std::sqrt(variance(bins.front()) + variance(bins.back()));
}

MissingData missing_data(const Eigen::VectorXd& rssi, const Eigen::VectorXd& mean, double sigma,
                         std::optional<double> stated) {
  std::vector<double> lost_at, heard_at, heard;
  for (Eigen::Index i = 0; i < rssi.size(); ++i) {
    (std::isnan(rssi[i]) ? lost_at : heard_at).push_back(mean[i]);
    if (!std::isnan(rssi[i])) heard.push_back(rssi[i]);
  }
  std::sort(heard.begin(), heard.end());
  MissingData result{.count = lost_at.size(), .floor = heard.front()};
  if (result.count == 0) return result;
  result.bins = binned(rssi, mean);
  const double lost = static_cast<double>(lost_at.size()), all = static_cast<double>(rssi.size());
  const double chance = lost * std::log(lost / all) + (all - lost) * std::log1p(-lost / all);
  // The floor is near the weakest received readings, except for outliers: the likeliest of these. One that was received
  // below it is as unlikely as an outlier is rare.
  const auto received_below = [&](double floor) {
    return std::lower_bound(heard.begin(), heard.end(), floor) - heard.begin();
  };
  const auto at = [&](double floor) {
    Mixture mixture = with_floor(lost_at, heard_at, floor, std::max(sigma, 0.1));
    mixture.log_likelihood += static_cast<double>(received_below(floor)) * thresholds::log_share_below_a_floor;
    return mixture;
  };
  Mixture best{.log_likelihood = -1e300};
  for (std::size_t rank = 0; rank <= heard.size() / 1000; rank = std::max<std::size_t>(2 * rank, 1)) {
    const Mixture mixture = at(heard[rank]);
    if (mixture.log_likelihood <= best.log_likelihood) continue;
    best = mixture;
    result.floor = heard[rank];
  }
  result.share_at_random = best.random;
  result.by_floor = best.by_floor;
  result.evidence = 2 * (best.log_likelihood - chance);
  result.beyond_stated = result.evidence;
  double lost_anyway = 0;  // readings expected below the stated floor
  if (stated) {            // where levels have a gap, the weakest that was heard may lie far above it
    const Mixture there = at(*stated);
    result.beyond_stated = std::min(result.evidence, 2 * (best.log_likelihood - there.log_likelihood));
    lost_anyway = there.below;
  }
  // Censored needs both a significant rise and most of the losses explained by the floor. 10 is p < 0.002 for one
  // parameter; neighbouring readings are lost jointly.
  const bool risen = result.evidence > thresholds::censored_evidence;
  result.censored = risen && result.by_floor > thresholds::censored_share;
  // With mostly random losses, levels must also end abruptly at the floor; a smaller rise (p < 0.05) then suffices.
  result.none_below =
      at_most(static_cast<std::size_t>(received_below(result.floor)), std::max(best.below - lost_anyway, 0.0));
  const auto closely_above =
      static_cast<double>(received_below(result.floor + thresholds::above_floor) - received_below(result.floor));
  result.cut_off = result.beyond_stated > thresholds::cut_off_evidence &&
                   thresholds::cut_off_alpha > result.none_below && closely_above > best.above / 2;
  return result;
}

}  // namespace muster::diagnosis
