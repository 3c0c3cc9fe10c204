#include "diagnosis/scatter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "diagnosis/search/tail.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t most_rows = 3000;
constexpr Index neighbours = 12;

// The rows of the same anchor that lie nearest.
std::vector<Index> nearest(const noise::Sites& sites, Index row, const std::vector<bool>& usable) {
  std::vector<std::pair<double, Index>> all;
  for (Index j = 0; j < sites.size(); ++j) {
    if (j == row || sites.radio[static_cast<std::size_t>(j)] != sites.radio[static_cast<std::size_t>(row)]) continue;
    if (usable[static_cast<std::size_t>(j)]) all.emplace_back((sites.place.col(j) - sites.place.col(row)).norm(), j);
  }
  const auto count = std::min(all.size(), static_cast<std::size_t>(neighbours));
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end());
  std::vector<Index> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(all[k].second);
  return result;
}

// The field at a row given its neighbours' means.
void predict(const noise::Sites& sites, const noise::Covariance& c, const std::vector<Index>& others, Index row,
             const VectorXd& means, ScatterRow& out) {
  const auto covariance = [&](Index a, Index b) {
    const double d =
        (sites.place.col(a) - sites.place.col(b)).norm() + (sites.anchor.col(a) - sites.anchor.col(b)).norm();
    return c.field_variance() *
           noise::correlation(c.family, noise::softened(c.family, d, sites.soft) / c.decorrelation());
  };
  const auto n = static_cast<Index>(others.size());
  Eigen::MatrixXd among(n, n);
  VectorXd to(n), y(n);
  for (Index i = 0; i < n; ++i) {
    const Index a = others[static_cast<std::size_t>(i)];
    for (Index j = 0; j <= i; ++j) among(i, j) = among(j, i) = covariance(a, others[static_cast<std::size_t>(j)]);
    among(i, i) += c.reading_variance() / sites.count[a];
    to[i] = covariance(a, row);
    y[i] = means[a];
  }
  const VectorXd weights = n > 0 ? VectorXd(among.ldlt().solve(to)) : VectorXd();
  out.level = n > 0 ? weights.dot(y) : 0;
  out.variance = std::max(c.field_variance() - (n > 0 ? weights.dot(to) : 0), 0.02 * c.field_variance() + 1e-6);
}

// What the field varies about its mean over a row's readings, at their true distances.
double within_row(const search::Bench& bench, const std::vector<Index>& readings) {
  const noise::Readings& r = bench.problem().readings;
  const noise::Covariance& c = bench.fit.covariance;
  double sum = 0;
  for (const Index i : readings) {
    for (const Index j : readings)
      sum += noise::correlation(
          c.family,
          ((r.rx_at.col(i) - r.rx_at.col(j)).norm() + (r.tx_at.col(i) - r.tx_at.col(j)).norm()) / c.decorrelation());
  }
  const auto n = static_cast<double>(readings.size());
  return c.field_variance() * (1 - sum / (n * n));
}

struct Base {
  ReadingLaw law;
  double within = 1, log_likelihood = -1e300;
};

using Change = std::function<ReadingLaw(ReadingLaw)>;

// The stated law with readings averaged over n fades of the same spread, each with more or less of the field within a
// row; one after the other, twice.
Base best_base(const Scatter& s, const ReadingLaw& stated, const Change& change, double within) {
  Base best;
  const double variance = fading_variance(stated.rician_k, stated.averaged);
  const auto try_one = [&](int n, double share) {
    ReadingLaw law = stated;
    law.averaged = n;
    if (n > 1) law.rician_k = rician_k_of(variance, n);
    if (std::isnan(law.rician_k)) return;
    law = change(law);
    if (std::isnan(law.rician_k)) return;
    const double value = s.log_likelihood(law, share);
    if (value > best.log_likelihood) best = {law, share, value};
  };
  best.within = within;
  for (const int n : {1, 2, 3, 4, 6}) try_one(n, within);
  for (const double share : {0.0, 0.5, 1.0, 1.6, 2.4}) try_one(best.law.averaged, share);
  for (const int n : {1, 2, 3, 4, 6}) {
    if (best.within != within) try_one(n, best.within);
  }
  return best;
}

ReadingLaw unchanged(const ReadingLaw& law) { return law; }

// A law along one strength, at the shape of fading that the stated law fits best with.
struct Family {
  std::string cause, name;
  std::vector<double> strengths;
  std::function<ReadingLaw(ReadingLaw, double)> with;
  std::function<double(double)> reported;  // of a strength
  std::vector<LawValue> beside;
  int parameters;
  double tests;
};

double crossing(const std::function<double(double)>& value, double from, double to, double least) {
  for (int round = 0; round < 7; ++round) {
    const double middle = (from + to) / 2;
    (value(middle) > least ? from : to) = middle;
  }
  return (from + to) / 2;
}

LawTest tested(const Scatter& s, const ReadingLaw& stated, const Base& null, const Family& family) {
  std::size_t best = 0;
  double highest = -1e300;
  for (std::size_t k = 0; k < family.strengths.size(); ++k) {
    for (const ReadingLaw& from : {null.law, stated}) {  // what is averaged cannot vary much
      const ReadingLaw law = family.with(from, family.strengths[k]);
      const double value = std::isnan(law.rician_k) ? -1e300 : s.log_likelihood(law, null.within);
      if (value > highest) highest = value, best = k;
    }
  }
  const auto with = [&](double strength) {
    return best_base(
        s, stated, [&](const ReadingLaw& law) { return family.with(law, strength); }, null.within);
  };
  LawTest result{family.cause, {}, 0, 0, 0};
  double strength = family.strengths[best];
  Base at = with(strength);
  const auto value = [&](double x) {
    const ReadingLaw law = family.with(at.law, x);
    return std::isnan(law.rician_k) ? -1e300 : s.log_likelihood(law, at.within);
  };
  const double below = best > 0 ? family.strengths[best - 1] : strength / 2;
  const double above = best + 1 < family.strengths.size() ? family.strengths[best + 1] : strength * 1.5;
  for (const double share : {0.25, 0.5, 0.75}) {
    for (const double x : {below + share * (strength - below), strength + share * (above - strength)}) {
      if (const double v = value(x); v > at.log_likelihood) at.log_likelihood = v, strength = x;
    }
  }
  constexpr double fall = 1.92;  // of the log-likelihood at the ends of a 95 % interval
  const double least = at.log_likelihood - fall;
  const double a = family.reported(crossing(value, strength, strength / 3, least));
  const double b = family.reported(crossing(value, strength, strength * 3, least));
  result.values.push_back({family.name, family.reported(strength), std::min(a, b), std::max(a, b)});
  result.values.insert(result.values.end(), family.beside.begin(), family.beside.end());
  result.gain = std::max(0.0, 2 * (at.log_likelihood - null.log_likelihood));
  result.log_p = std::log(family.tests) + search::log_tail(result.gain, family.parameters);
  result.evidence =
      result.gain / 2 - family.parameters / 2.0 * std::log(static_cast<double>(s.rows.size())) - std::log(family.tests);
  return result;
}

std::vector<Family> families_of(const ReadingLaw& stated) {
  const double variance = std::max(fading_variance(stated.rician_k, stated.averaged), 0.05);
  std::vector<double> variances;
  for (const double f : {0.2, 0.35, 0.5, 0.65, 0.78, 0.88, 1.13, 1.28, 1.5, 1.8, 2.3, 3.2, 5.0})
    variances.push_back(variance * f);
  std::vector<Family> result;
  result.push_back({"effect.fading_law",
                    "rician_k",
                    variances,
                    [](ReadingLaw law, double v) {
                      law.rician_k = rician_k_of(v, law.averaged);
                      return law;
                    },
                    [](double v) {
                      const double k = rician_k_of(v, 1);
                      return std::isnan(k) ? (v > 20 ? -40 : 60) : k;
                    },
                    {},
                    1,
                    1});
  for (const double width : {12.0, 20.0, 30.0}) {
    result.push_back({"effect.outliers",
                      "share",
                      {0.001, 0.003, 0.006, 0.012, 0.025, 0.05, 0.1},
                      [width](ReadingLaw law, double share) {
                        law.outliers = std::min(share, 0.9);
                        law.half_width = width;
                        return law;
                      },
                      [](double share) { return share; },
                      {{"half_width", width, width / 1.4, width * 1.3}},
                      1,
                      3});
  }
  for (const int channels : {2, 3, 4}) {
    const double count = channels;
    result.push_back({"effect.channel_mixture",
                      "sd",
                      {0.5, 0.8, 1.2, 1.7, 2.4, 3.4, 5, 7},
                      [channels](ReadingLaw law, double sd) {
                        law.channel_sd = sd;
                        law.channels = channels;
                        return law;
                      },
                      [](double sd) { return sd; },
                      {{"channels", count, count, count}},
                      1,
                      3});
  }
  return result;
}

}  // namespace

double Scatter::log_likelihood(const ReadingLaw& law, double within_share) const {
  const ReadingDensity density(law, std::sqrt(within * within_share), step);
  constexpr int places = 33;
  constexpr double reach = 3.5;  // sd
  double sum = 0;
  std::array<double, places> logs;
  for (const ScatterRow& row : rows) {
    const double sd = std::sqrt(row.variance);
    double most = -1e300;
    for (int q = 0; q < places; ++q) {
      const double z = reach * (2.0 * q / (places - 1) - 1), level = row.level + sd * z;
      double log = -z * z / 2;
      for (const double reading : row.readings) log += density.log_at(reading - level);
      logs[static_cast<std::size_t>(q)] = log;
      most = std::max(most, log);
    }
    double total = 0;
    for (const double log : logs) total += std::exp(log - most);
    sum += most + std::log(total);
  }
  return sum;
}

Scatter scatter_of(const search::Bench& bench, const VectorXd& residual, double step) {
  const noise::Sites& sites = bench.field().sites();
  std::vector<std::vector<Index>> readings(static_cast<std::size_t>(sites.size()));
  for (Index i = 0; i < residual.size(); ++i) {
    const Index row = bench.rows().row_of()[static_cast<std::size_t>(i)];
    readings[static_cast<std::size_t>(row)].push_back(i);
  }
  VectorXd means(sites.size());
  std::vector<bool> usable(readings.size(), true);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    double sum = 0;
    for (const Index i : readings[k]) sum += residual[i];
    means[static_cast<Index>(k)] = sum / static_cast<double>(readings[k].size());
    usable[k] = std::isfinite(sum);
  }
  Scatter result;
  result.step = step;
  const std::size_t every = readings.size() / most_rows + 1;
  double within = 0, count = 0;
  for (std::size_t k = 0; k < readings.size(); k += every) {
    if (!usable[k]) continue;
    const auto row = static_cast<Index>(k);
    ScatterRow out;
    predict(sites, bench.fit.covariance, nearest(sites, row, usable), row, means, out);
    for (const Index i : readings[k]) out.readings.push_back(residual[i]);
    result.rows.push_back(std::move(out));
    const auto n = static_cast<double>(readings[k].size());
    within += n * within_row(bench, readings[k]);
    count += n;
  }
  result.within = count > 0 ? within / count : 0;
  return result;
}

std::vector<LawTest> law_tests(const Scatter& scatter, const ReadingLaw& stated) {
  Base null = best_base(scatter, stated, unchanged, 1);
  // What the field does between the readings of a row is known no better than this: fading so near counts as stated.
  const double variance = fading_variance(stated.rician_k, stated.averaged);
  const double unsure = 0.15 + 0.6 * scatter.within;
  for (const double near : {variance * 1.1 + unsure, variance / 1.1 - unsure}) {
    ReadingLaw law = stated;
    law.rician_k = rician_k_of(near, stated.averaged);
    if (!(near > 0) || std::isnan(law.rician_k)) continue;
    const Base other = best_base(scatter, law, unchanged, null.within);
    if (other.log_likelihood > null.log_likelihood) null = other;
  }
  std::vector<LawTest> result;
  for (const Family& family : families_of(stated)) {
    LawTest test = tested(scatter, stated, null, family);
    const auto same =
        std::find_if(result.begin(), result.end(), [&](const LawTest& t) { return t.cause == test.cause; });
    if (same == result.end())
      result.push_back(std::move(test));
    else if (test.gain > same->gain)
      *same = std::move(test);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const LawTest& a, const LawTest& b) { return a.evidence > b.evidence; });
  return result;
}

}  // namespace muster::diagnosis
