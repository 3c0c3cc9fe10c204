#include "diagnosis/inference/noise/fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::noise {
namespace {

// Information with its eigenvalues bounded from below, so that steps and draws stay finite where the data are
// uninformative.
Eigen::Matrix4d bounded(const Eigen::Matrix4d& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(information);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(inference::thresholds::least_curvature).asDiagonal() *
         solver.eigenvectors().transpose();
}

struct Step {
  Theta whole = Theta::Zero();
  double expected = 0;  // nats, by which the value falls
};

// A scoring step along the entries of `moves`. Those at a limit over which the gradient leads stay there, and then
// those over which the others' step does: cut off at the limit, a step to the free minimum may lead up (an active set;
// Nocedal and Wright, Numerical Optimization, 2006, section 16.7).
Step scoring_step(const Theta& theta, const Objective& here, const Prior& prior, Theta moves) {
  const Theta lower = prior.lower(), upper = prior.upper();
  const auto held = [&](const Theta& way) {
    Theta left = moves;
    for (Eigen::Index j = 0; j < way.size(); ++j) {
      if ((theta[j] <= lower[j] && way[j] < 0) || (theta[j] >= upper[j] && way[j] > 0)) left[j] = 0;
    }
    return left;
  };
  moves = held(-here.gradient);
  while (true) {
    const Theta gradient = moves.cwiseProduct(here.gradient);
    const Eigen::Matrix4d curvature = bounded(moves.asDiagonal() * here.information * moves.asDiagonal());
    const Theta whole = moves.cwiseProduct(-curvature.ldlt().solve(gradient));
    const Theta left = held(whole);
    if (left == moves) return {whole, -whole.dot(gradient) / 2};
    moves = left;
  }
}

constexpr double unlimited = std::numeric_limits<double>::max();

// Ends early where the value would stay above `to_beat` even if it fell by several times what is expected.
Fit fit_from(Covariance at, Objective here, const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
             const Prior& prior, int steps, const Theta& moves, double to_beat = unlimited) {
  for (int step = 0; step < steps; ++step) {
    const auto [whole, expected] = scoring_step(at.theta, here, prior, moves);
    if (expected < 0.01 || here.value - inference::thresholds::trusted_multiple * expected > to_beat) break;
    Theta move = whole / std::max(1.0, whole.cwiseAbs().maxCoeff());
    bool better = false;
    for (int shorter = 0; shorter < 5 && !better; ++shorter, move *= 0.35) {
      const Covariance next{at.family, prior.inside(at.theta + move)};
      const Objective there = objective(field, next, y, design, prior);
      if (!(there.value < here.value - 1e-4)) continue;
      at = next;
      here = there;
      better = true;
    }
    if (!better) break;
  }
  return {at, here.value, bounded(here.information), here.log_determinant};
}

}  // namespace

Covariance default_start(const Eigen::VectorXd& y, const Eigen::MatrixXd& design, Family family) {
  const double variance = std::max(basis_of(design).rest(y).squaredNorm() / static_cast<double>(y.size()), 0.1);
  return {family, {std::log(0.7 * variance), std::log(1.5) + log_scale_of(family), std::log(0.3 * variance), -1.5}};
}

Fit fit(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
        const Covariance& start, int steps, const Theta& moves) {
  const Covariance at{start.family, prior.inside(start.theta)};
  return fit_from(at, objective(field, at, y, design, prior), field, y, design, prior, steps, moves);
}

Fit fit(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
        const WhitenerSlopes& start, int steps) {
  return fit_from(start.whitener().covariance(), objective(start, y, design, prior), field, y, design, prior, steps,
                  Theta::Ones());
}

Fit fit_long_too(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
                 const Covariance& start, int steps) {
  Fit from_start = fit(field, y, design, prior, start, steps);
  if (!prior.allows_long()) return from_start;
  Covariance long_one = start;
  long_one.theta[1] = prior.log_long();
  Fit from_long = fit(field, y, design, prior, long_one, steps);
  return from_long.value < from_start.value ? from_long : from_start;
}

Fit fit_over_shares(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design, const Prior& prior,
                    const WhitenerSlopes& start, int steps) {
  Fit best = fit(field, y, design, prior, start, steps);
  if (fixed_share(best.covariance.family) == 0) return best;
  std::vector<Family (*)(Family)> ways{with_less_fixed, with_more_fixed};
  if (field.sites().over_time() && field.recurring().several_streams())
    ways.insert(ways.end(), {with_less_of_stream, with_more_of_stream});
  for (const auto& way : ways) {
    while (true) {
      const Family family = best.covariance.family, next = way(family);
      if (next == family || fixed_share(next) == 0) break;
      const Covariance at{next, prior.inside(best.covariance.theta)};
      const Fit other = fit_from(at, objective(field, at, y, design, prior), field, y, design, prior, steps,
                                 Theta::Ones(), best.value);
      if (!(other.value < best.value)) break;
      best = other;
    }
  }
  return best;
}

namespace {

// The stated family's fit, begun a second time from the likeliest family of places: a smooth field's fit lies far from
// that of the exponential one.
void fit_stated_again(std::vector<Fit>& fits, const Field& field, const Eigen::VectorXd& y,
                      const Eigen::MatrixXd& design, const Prior& prior) {
  const auto stated =
      std::find_if(fits.begin(), fits.end(), [](const Fit& f) { return f.covariance.family == Family::stated; });
  if (stated == fits.end()) return;
  const Fit* best = &fits.front();
  for (const Fit& f : fits) {
    if (!is_stated(f.covariance.family) && fixed_share(f.covariance.family) == 0 && f.value < best->value) best = &f;
  }
  if (best->covariance.family == Family::exponential) return;
  const double within = field.sites().within();
  const StatedField size = stated_by(best->covariance, within);
  const Fit again = fit(field, y, design, prior, as_stated(size, Family::stated, best->covariance.theta, within));
  if (again.value < stated->value) *stated = again;
}

}  // namespace

namespace {

// Over time the levels of a site's streams differ by less than those of sites: beside the likeliest share of a site,
// the part of it that is a stream's own.
void fit_parts_of_streams(std::vector<Fit>& fits, const Field& field, const Eigen::VectorXd& y,
                          const Eigen::MatrixXd& design, const Prior& prior) {
  if (!field.sites().over_time() || !field.recurring().several_streams()) return;
  const Fit* best = nullptr;
  for (const Fit& f : fits) {
    if (fixed_share(f.covariance.family) > 0 && (!best || f.value < best->value)) best = &f;
  }
  if (!best) return;
  const Covariance start{with_more_of_stream(best->covariance.family), best->covariance.theta};
  fits.push_back(fit_over_shares(field, y, design, prior, WhitenerSlopes(field, start), 20));
}

}  // namespace

std::vector<Fit> fit_families(const Field& field, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                              const Prior& prior, double advantage) {
  std::vector<Fit> fits{fit_long_too(field, y, design, prior, default_start(y, design, Family::exponential), 20)};
  std::vector<Family> all = field.families();
  const std::vector<Family> fixed = field.fixed_families();
  all.insert(all.end(), fixed.begin(), fixed.end());
  const auto value_of = [&](Family family) {
    const auto at = std::find_if(fits.begin(), fits.end(), [&](const Fit& f) { return f.covariance.family == family; });
    return at == fits.end() ? std::numeric_limits<double>::infinity() : at->value;
  };
  for (const Family family : all) {
    if (family == Family::exponential) continue;
    // Shares grow, and the value has one minimum along them.
    if (const Family less = with_less_fixed(family);
        less != family && value_of(less) > value_of(with_less_fixed(less)) + inference::thresholds::leave_family_nats)
      continue;
    // Warm start from a similar family: the fit of the smoothest lies far from that of the roughest.
    const Family similar = family == Family::gaussian ? Family::matern52
                           : fixed_share(family) > 0  ? without_fixed(family)
                                                      : Family::exponential;
    const auto like =
        std::find_if(fits.begin(), fits.end(), [&](const Fit& f) { return f.covariance.family == similar; });
    Covariance start{family, like->covariance.theta};
    start.theta[1] += log_scale_of(family) - log_scale_of(like->covariance.family);
    fits.push_back(fit(field, y, design, prior, start));
    if (family == Family::gaussian) fit_stated_again(fits, field, y, design, prior);
  }
  fit_parts_of_streams(fits, field, y, design, prior);
  double least = std::numeric_limits<double>::infinity();
  for (const Fit& f : fits) least = std::min(least, f.value);
  std::erase_if(fits, [&](const Fit& f) {
    const bool hopeless = f.value > least + inference::thresholds::hopeless_family_nats;
    return !std::isfinite(f.value) || (hopeless && fixed_share(f.covariance.family) > 0);
  });
  const auto cost = [&](const Fit& f) { return f.value + (f.covariance.family == all.front() ? 0 : advantage); };
  std::stable_sort(fits.begin(), fits.end(), [&](const Fit& a, const Fit& b) { return cost(a) < cost(b); });
  return fits;
}

std::vector<Draw> draws(const Fit& fit, int count, uint64_t seed) {
  constexpr double freedom = 6;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(fit.curvature);
  const Eigen::Matrix4d scale = solver.eigenvectors() * solver.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  const Stream stream(combined(key_of("covariance draws"), seed));
  std::vector<Draw> result;
  for (int k = 0; k < count / 2; ++k) {
    const auto row = static_cast<uint64_t>(k);
    double chi_square = 0;
    for (uint64_t j = 0; j < 6; ++j) chi_square += std::pow(stream.normal(row, 4 + j), 2);
    Theta z;
    for (Eigen::Index j = 0; j < 4; ++j) z[j] = stream.normal(row, static_cast<uint64_t>(j));
    z *= std::sqrt(freedom / chi_square);
    const double log_density = -(freedom + 4) / 2 * std::log1p(z.squaredNorm() / freedom);
    for (const double sign : {1.0, -1.0}) result.push_back({fit.covariance.theta + sign * (scale * z), log_density});
  }
  return result;
}

}  // namespace muster::noise
