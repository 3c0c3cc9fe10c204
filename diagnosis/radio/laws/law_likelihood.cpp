#include "diagnosis/radio/laws/law_likelihood.hpp"

#include <algorithm>
#include <cmath>
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

ReadingDensities LawLikelihood::densities_of(const ReadingDistribution& law, double log_variance, const Peak& there,
                                             double margin) {
  const ReadingView& view = field_.view(there.shape, there.place);
  const double size = log_variance - view.log_ratio;
  return {law, step_, size + view.log_spread.minCoeff() - margin, size + view.log_spread.maxCoeff() + margin};
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
  const double log_variance = log_variance_of(law);
  from.place = std::clamp(from.place, -farthest, farthest);
  for (int way = 0;;) {
    // Valid for two steps in either direction.
    const ReadingDensities densities = densities_of(law, log_variance, from, 0.5);
    const auto value = [&](int by) { return at(densities, log_variance, from.shape, from.place + by * places); };
    const double here = value(0), below = value(-1), above = value(1);
    const int better = std::max(below, above) <= here ? 0 : above > below ? 1 : -1;
    if (better == 0 || better == -way || std::abs(from.place + better * places) > farthest) {
      const double bend = 2 * here - below - above, slope = (above - below) / 2;
      const bool top = bend > 0 && std::abs(slope) <= bend;  // within a step; on a slope it is unbounded
      from.value = top ? here + slope * slope / (2 * bend) : here;
      return from;
    }
    way = better;
    from.place += way * places;
  }
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

Peak LawLikelihood::closer_distance(const ReadingDistribution& law, Peak best) {
  for (int by = distances / 2; by >= distances / 16; by /= 2) {
    for (const int way : {-by, by}) {
      Peak next = best;
      next.shape.distance += way;
      next = this->best(law, next);
      if (next.value <= best.value) continue;
      best = next;
      break;
    }
  }
  return best;
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
  return at(densities_of(law, log_variance, there, 0), log_variance, there.shape, there.place);
}

Eigen::VectorXd LawLikelihood::each(const ReadingDistribution& law, const Peak& there) {
  const double log_variance = log_variance_of(law);
  const ReadingDensities densities = densities_of(law, log_variance, there, 0);
  const ReadingView& view = field_.view(there.shape, there.place);
  const double size = log_variance - view.log_ratio;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(field_.size());
  for (const Index i : field_.judged()) result[i] = densities.log_at(view.error[i], size + view.log_spread[i]);
  return result;
}

double LawLikelihood::about(const ReadingDistribution& law, const Peak& there) {
  const double log_variance = log_variance_of(law);
  const Index every = static_cast<Index>(field_.judged().size()) / thresholds::rough_readings + 1;
  return at(densities_of(law, log_variance, there, 0), log_variance, there.shape, there.place, every);
}

}  // namespace muster::diagnosis
