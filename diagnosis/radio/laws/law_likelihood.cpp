#include "diagnosis/radio/laws/law_likelihood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

constexpr int farthest = 9000;  // a field of one part in 8,000 of the variance, or of all but that

}  // namespace

double LawLikelihood::log_variance_of(ReadingDistribution law) const {
  const std::vector<LawPart> added = std::exchange(law.added, {});
  std::vector<LawPart> heavy;
  for (const LawPart& part : added) (part.law->is_heavy_tailed(part.params) ? heavy : law.added).push_back(part);
  const double light = variance_of(law, step_);
  double result = light;
  for (const LawPart& part : heavy) {
    double share = 1;
    for (const Atom& atom : part.law->atoms(part.params)) share -= atom.probability;
    result += std::min(part.law->variance(part.params, 1), share * field_.far_off() * field_.far_off() * light);
  }
  return std::log(result);
}

const ReadingDensities& LawLikelihood::densities_of(const ReadingDistribution& law, double log_variance,
                                                    const Peak& there) {
  constexpr std::size_t most = 200;  // laws; some 100 kB each
  const ReadingView& view = field_.view(there.shape, there.place);
  if (known_.size() >= most && !known_.contains(law)) known_.clear();
  ReadingDensities& result = known_.try_emplace(law, law, step_).first->second;
  result.reach(log_variance - view.log_ratio + view.log_spread.maxCoeff());
  return result;
}

double LawLikelihood::at(const ReadingDensities& densities, double log_variance, const FieldShape& shape, int place,
                         Index every) {
  const ReadingView& view = field_.view(shape, place);
  const double size = log_variance - view.log_ratio;
  const double variance = std::exp(size);
  const std::vector<Index>& judged = field_.judged();
  // One logarithm for the product of several: no density is below 1e-8.
  constexpr int together = 16;
  double sum = 0, product = 1;
  int factors = 0;
  for (std::size_t k = 0; k < judged.size(); k += static_cast<std::size_t>(every)) {
    const Index i = judged[k];
    product *= densities.at(view.error[i], size + view.log_spread[i], variance * view.spread[i]);
    if (++factors < together) continue;
    sum += std::log(product);
    product = 1;
    factors = 0;
  }
  return (sum + std::log(product)) * static_cast<double>(every);
}

Peak LawLikelihood::best(const ReadingDistribution& law, Peak from) {
  from.place = std::clamp(from.place, -farthest, farthest);
  const int start = from.place;
  const double log_variance = log_variance_of(law);
  std::map<int, double> values;  // by steps from the start
  const auto value = [&](int step) {
    const int place = start + step * places;
    if (std::abs(place) > farthest) return -std::numeric_limits<double>::infinity();
    const auto [known, is_new] = values.try_emplace(step, 0);
    if (is_new)
      known->second = at(densities_of(law, log_variance, {0, from.shape, place}), log_variance, from.shape, place);
    return known->second;
  };
  // Pattern search: after the second step uphill strides double, and then they halve.
  int best = 0, stride = 1, way = 0, uphill = 0;
  while (stride > 0) {
    const bool on = uphill > 0;
    const int next = best + (on ? way : value(best - stride) > value(best + stride) ? -1 : 1) * stride;
    if (value(next) > value(best)) {
      way = next > best ? 1 : -1;
      best = next;
      if (uphill >= 0 && ++uphill > 1) stride *= 2;
    } else {
      uphill = -1;
      if (!on || stride > 1) stride /= 2;
    }
  }
  const double here = value(best), below = value(best - 1), above = value(best + 1);
  const double bend = 2 * here - below - above, slope = (above - below) / 2;
  const bool top = std::isfinite(bend) && bend > 0;
  return {top ? here + slope * slope / (2 * bend) : here, from.shape, start + best * places};
}

Peak LawLikelihood::best_distance(const ReadingDistribution& law, const Peak& from) {
  Peak best = this->best(law, from);
  for (const int way : {-distances, distances}) {
    for (int step = 0; step < 4; ++step) {
      Peak next = best;
      next.shape.distance += way;
      next = this->best(law, next);
      if (next.value <= best.value) break;
      best = next;
    }
  }
  return best;
}

Peak LawLikelihood::closer_distance(const ReadingDistribution& law, const Peak& from) {
  constexpr int by = distances / 2, most = 8;  // steps; rounds
  constexpr int finest = distances / 12;       // a fortieth: views at the same distances are computed once
  const auto moved = [&](const Peak& peak, int way) {
    Peak next = peak;
    next.shape.distance += way;
    return best(law, next);
  };
  Peak here = best(law, from), nearer = moved(here, -by), farther = moved(here, by);
  for (int round = 0; round < most && std::max(nearer.value, farther.value) > here.value; ++round) {
    if (nearer.value > farther.value) {
      farther = std::exchange(here, nearer);
      nearer = moved(here, -by);
    } else {
      nearer = std::exchange(here, farther);
      farther = moved(here, by);
    }
  }
  const double bend = 2 * here.value - nearer.value - farther.value, slope = (farther.value - nearer.value) / 2;
  const double vertex = bend > std::abs(slope) ? by * slope / bend : 0;
  const int steps = static_cast<int>(std::lround(vertex / finest));
  std::array<Peak, 4> tried{here, nearer, farther, steps == 0 ? here : moved(here, steps * finest)};
  return *std::max_element(tried.begin(), tried.end(), [](const Peak& a, const Peak& b) { return a.value < b.value; });
}

std::vector<Peak> LawLikelihood::shapes(const ReadingDistribution& law, const noise::Covariance& from) {
  if (field_.size() < thresholds::sampled_from) return shapes_by_all(law, from);
  KrigedReadings sample = field_.some(thresholds::sample_size);
  std::vector<Peak> result = LawLikelihood(sample, step_).shapes_by_all(law, from);
  double most = -1e300;
  for (Peak& peak : result) most = std::max(most, peak.value = value(law, peak));
  for (Peak& peak : result) {
    if (peak.value > most - thresholds::hopeless_shape_nats) peak = best_distance(law, peak);
  }
  return result;
}

std::vector<Peak> LawLikelihood::shapes_by_all(const ReadingDistribution& law, const noise::Covariance& from) {
  std::vector<Peak> result;
  const auto place = static_cast<int>(std::lround(1e3 * (from.theta[2] - from.theta[0])));
  for (const noise::Family family : field_.families()) {
    const double distance = from.theta[1] + noise::log_scale_of(family) - noise::log_scale_of(from.family);
    result.push_back(best_distance(law, {0, {family, static_cast<int>(std::lround(1e3 * distance))}, place}));
  }
  return result;
}

double LawLikelihood::value(const ReadingDistribution& law, const Peak& there) {
  const double log_variance = log_variance_of(law);
  return at(densities_of(law, log_variance, there), log_variance, there.shape, there.place);
}

Eigen::VectorXd LawLikelihood::each(const ReadingDistribution& law, const Peak& there) {
  const double log_variance = log_variance_of(law);
  const ReadingDensities& densities = densities_of(law, log_variance, there);
  const ReadingView& view = field_.view(there.shape, there.place);
  const double size = log_variance - view.log_ratio;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(field_.size());
  for (const Index i : field_.judged()) result[i] = densities.log_at(view.error[i], size + view.log_spread[i]);
  return result;
}

double LawLikelihood::about(const ReadingDistribution& law, const Peak& there) {
  const double log_variance = log_variance_of(law);
  const Index every = static_cast<Index>(field_.judged().size()) / thresholds::rough_readings + 1;
  return at(densities_of(law, log_variance, there), log_variance, there.shape, there.place, every);
}

}  // namespace muster::diagnosis
