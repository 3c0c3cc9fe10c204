#include "exam/effect_sizing.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "exam/reading_law.hpp"
#include "exam/true_whitener.hpp"

namespace muster::exam {
namespace {

constexpr double loudest = -22, weakest = -118;  // dBm, mean; the first one has priority
constexpr int redraws = 8;                       // of an effect's shape that cannot reach the requested lambda
constexpr double near_enough = 1.1;              // factor of the requested lambda

// The strength within the effect's limits with the requested lambda, which grows with strength.
template <class Lambda>
double strength_for(const Effect& e, double wanted, Lambda lambda) {
  if (e.linear) return std::clamp(std::sqrt(wanted / std::max(lambda(1.0), 1e-9)), e.least, e.most);
  double low = e.least, high = e.most;
  if (lambda(high) <= wanted) return high;
  if (lambda(low) >= wanted) return low;
  for (int i = 0; i < 14 && high / low > 1.002; ++i) {
    const double middle = std::sqrt(low * high);
    (lambda(middle) < wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& base, const std::vector<Eigen::VectorXd>& others) {
  Eigen::MatrixXd result(base.rows(), base.cols() + static_cast<Eigen::Index>(others.size()));
  result.leftCols(base.cols()) = base;
  for (std::size_t i = 0; i < others.size(); ++i) result.col(base.cols() + static_cast<Eigen::Index>(i)) = others[i];
  return result;
}

double heard_count(const std::vector<char>& use) { return static_cast<double>(std::count(use.begin(), use.end(), 1)); }

// Twice the expected log-likelihood ratio of passages with known shape and rate at unknown times; columns are
// whitened. Passages begin at each second with the same probability. The log ratio for a passage of energy e is
// normal with variance e and mean e/2, or -e/2 where none begins.
double lambda_of_passages(const Eigen::MatrixXd& whitened, double duration) {
  const auto count = static_cast<double>(whitened.cols());
  const double chance = count / duration;
  const auto expected = [&](double energy, double side) {
    double weights = 0, sum = 0;
    for (double z = -6; z < 6.05; z += 0.1) {
      const double w = std::exp(-z * z / 2), log_ratio = side * energy / 2 + std::sqrt(energy) * z;
      const double more = log_ratio + std::log(chance), rest = std::log1p(-chance), high = std::max(more, rest);
      weights += w;
      sum += w * (high + std::log(std::exp(more - high) + std::exp(rest - high)));
    }
    return sum / weights;
  };
  double sum = (duration - count) * expected(whitened.squaredNorm() / count, -1);
  for (Eigen::Index k = 0; k < whitened.cols(); ++k) sum += expected(whitened.col(k).squaredNorm(), 1);
  return std::max(0.0, 2 * sum);
}

class EffectHider {
 public:
  EffectHider(Case& made, const std::vector<char>& use) : made_(made), use_(use), random_(made.seed, "effects") {}

  // Laws first, since lambdas of mean effects depend on the noise; receivers last, since all else precedes them.
  void run() {
    for (const Acts acts : {Acts::reading_law, Acts::field_law, Acts::mean, Acts::receiver}) {
      if (acts == Acts::receiver) keep_audible();
      for (std::size_t i = 0; i < made_.order.effects.size(); ++i) {
        const Recipe& r = recipe(made_.order.effects[i]);
        const Scene scene{*made_.site, made_.measured, made_.second};
        Effect first = r.draw(scene, random_);
        if (first.acts != acts) continue;
        made_.hidden.push_back(fitted(r, first, made_.order.lambdas[i]));
        adopt(made_.hidden.back());
      }
    }
  }

 private:
  // Sets the transmit power so that levels, with all effects, stay within the receivers' limits.
  void keep_audible() {
    const Eigen::VectorXd mean = made_.measured.design * coefficients(*made_.site) + sum();
    double more = std::max(0.0, std::ceil(weakest - mean.minCoeff()));
    more = std::min(more, std::floor(loudest - mean.maxCoeff()));
    made_.site->base.tx_power += more;
    made_.site->base.level_at_1m += more;
  }

  Hidden fitted(const Recipe& r, Effect effect, double wanted) {
    std::optional<Hidden> best;
    for (int attempt = 0; attempt < redraws; ++attempt) {
      Hidden h{std::move(effect), r.in_vocabulary, 0, wanted, 0};
      h.strength = strength_for(h.effect, wanted, [&](double x) { return lambda(h.effect, x); });
      h.lambda = lambda(h.effect, h.strength);
      const auto miss = [&](const Hidden& v) { return std::abs(std::log(std::max(v.lambda, 1e-6) / wanted)); };
      if (!best || miss(h) < miss(*best)) best = h;
      if (miss(*best) < std::log(near_enough) || h.effect.acts != Acts::mean) break;
      effect = r.draw({*made_.site, made_.measured, made_.second}, random_);
    }
    return *best;
  }

  double lambda(const Effect& e, double x) {
    switch (e.acts) {
      case Acts::reading_law: {
        ReadingLaw changed = made_.site->noise.reading;
        e.change_reading(changed, x);
        return reading_lambda(changed, made_.site->stated_reading, whitener().level_deviations());
      }
      case Acts::field_law: {
        FieldLaw changed = made_.site->noise.field;
        e.change_field(changed, x);
        return of_field(changed);
      }
      case Acts::receiver: {
        const ReceivedShift s = received_shift(*made_.site, e, x, made_.measured, sum());
        return energy(whitener(), s.shift, beside(made_.measured.design, shifts_)) + s.missing_lambda;
      }
      case Acts::mean:
        break;
    }
    if (e.passages) return lambda_of_passages(whitener()(e.passages(made_.measured, x)), made_.site->duration());
    return energy(whitener(), e.shift(made_.measured, x), beside(made_.measured.design, shifts_));
  }

  // Least divergence over families: worlds state the size and decorrelation distance of shadowing, and no family.
  double of_field(const FieldLaw& truth) {
    if (!divergence_) {
      std::vector<FieldLaw> stated;
      for (const Family family : {Family::exponential, Family::gaussian, Family::two_scale}) {
        stated.push_back(made_.site->stated_field);
        stated.back().family = family;
      }
      divergence_.emplace(whitener(), stated);
    }
    return (*divergence_)(truth);
  }

  void adopt(const Hidden& h) {
    if (h.effect.acts == Acts::reading_law) h.effect.change_reading(made_.site->noise.reading, h.strength);
    if (h.effect.acts == Acts::field_law) h.effect.change_field(made_.site->noise.field, h.strength);
    if (h.effect.acts == Acts::mean) shifts_.push_back(h.effect.shift(made_.measured, h.strength));
    if (h.effect.acts == Acts::reading_law || h.effect.acts == Acts::field_law) {
      divergence_.reset();
      whitener_.reset();
    }
    if (h.effect.id == "noise_floor_rssi") made_.site->noise_swing = h.strength;
  }

  Eigen::VectorXd sum() const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(made_.measured.design.rows());
    for (const Eigen::VectorXd& s : shifts_) result += s;
    return result;
  }

  const Whitener& whitener() {
    if (!whitener_) whitener_.emplace(made_.measured, made_.site->noise, use_);
    return *whitener_;
  }

  Case& made_;
  const std::vector<char>& use_;
  Random random_;
  std::vector<Eigen::VectorXd> shifts_;  // of all effects so far
  std::optional<Whitener> whitener_;
  std::optional<FieldDivergence> divergence_;
};

// Folds of spatial blocks, so that held-out places do not share the training places' shadowing.
std::vector<int> folds_of(const Case& made, int folds) {
  const double side = std::max(3.0, 3 * made.site->noise.field.decorrelation);
  std::vector<int> result;
  for (const Reading& r : made.measured.readings) {
    const Vec2 own = made.site->plan.to_own({r.at.x, r.at.y});
    const int column = static_cast<int>(own.x / side), row = static_cast<int>(own.y / side);
    Random block(made.seed, "block " + std::to_string(column) + " " + std::to_string(row));
    result.push_back(block.below(folds));
  }
  return result;
}

Eigen::VectorXd generalised_least_squares(const Whitener& whiten, const Eigen::MatrixXd& design,
                                          const Eigen::VectorXd& y) {
  Eigen::MatrixXd all(design.rows(), design.cols() + 1);
  all << design, y;
  const Eigen::MatrixXd white = whiten(all);
  return white.leftCols(design.cols()).colPivHouseholderQr().solve(white.rightCols(1));
}

Oracle held_out(const Case& made, const Eigen::VectorXd& effect) {
  constexpr int folds = 5;
  const std::vector<int> fold = folds_of(made, folds);
  const std::vector<char> all = heard(made.measured);
  // Missing readings are in no fold; zeros keep NaN out of sums.
  const Eigen::VectorXd y = made.measured.rssi.unaryExpr([](double v) { return std::isnan(v) ? 0 : v; });
  Oracle sum;
  for (int k = 0; k < folds; ++k) {
    std::vector<char> train = all;
    for (std::size_t i = 0; i < train.size(); ++i) train[i] = static_cast<char>(train[i] && fold[i] != k);
    if (heard_count(train) == heard_count(all) || heard_count(train) < 20) continue;
    const Whitener whiten(made.measured, made.site->noise, train, Detail::rows);
    const Eigen::VectorXd base = y - made.measured.design * generalised_least_squares(whiten, made.measured.design, y);
    const Eigen::VectorXd rest = y - effect;
    const Eigen::VectorXd full =
        rest - made.measured.design * generalised_least_squares(whiten, made.measured.design, rest);
    for (std::size_t i = 0; i < train.size(); ++i) {
      if (!all[i] || fold[i] != k) continue;
      const auto at = static_cast<Eigen::Index>(i);
      sum.without += base[at] * base[at] / heard_count(all);
      sum.with += full[at] * full[at] / heard_count(all);
    }
  }
  return sum;
}

}  // namespace

std::vector<char> informative_rows(const Case& made, const Data& data) {
  std::vector<char> result = heard(data);
  for (const Hidden& h : made.hidden) {
    if (h.effect.acts != Acts::receiver) continue;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double code = data.rssi[static_cast<Eigen::Index>(i)];
      for (const double other : {code - 1, code + 1}) result[i] &= h.effect.receive(other, h.strength) != code;
    }
  }
  return result;
}

ReceivedShift received_shift(const GroundTruth& site, const Effect& effect, double strength, const Data& data,
                             const Eigen::VectorXd& before) {
  const double deviation =
      std::sqrt(site.noise.field.sigma * site.noise.field.sigma + reading_variance(site.noise.reading));
  const Eigen::VectorXd mean = data.design * coefficients(site) + before;
  ReceivedShift result{Eigen::VectorXd::Zero(mean.size()), 0};
  std::vector<double> chance(data.size());
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    double weights = 0, seen = 0, sum = 0;
    for (double z = -3.2; z < 3.3; z += 0.2) {  // normal density, by the trapezoidal rule
      const double w = std::exp(-z * z / 2), level = effect.receive(mean[i] + z * deviation, strength);
      weights += w;
      if (std::isnan(level)) continue;
      seen += w;
      sum += w * (level - mean[i]);
    }
    result.shift[i] = sum / weights;
    chance[static_cast<std::size_t>(i)] = seen / weights;
  }
  double average = 0;
  for (const double c : chance) average += c / static_cast<double>(chance.size());
  const auto term = [](double p, double q) { return p > 0 ? 2 * p * std::log(p / q) : 0; };
  if (average < 1)
    for (const double c : chance) result.missing_lambda += term(c, average) + term(1 - c, 1 - average);
  return result;
}

void hide(Case& made, const std::vector<char>& use) { EffectHider(made, use).run(); }

void weigh(Case& made) {
  const Eigen::VectorXd effect = expected_shift(*made.site, made.hidden, made.measured);
  made.oracle = held_out(made, effect);
  if (made.hidden.size() < 2) return;
  const Whitener whiten(made.measured, made.site->noise, informative_rows(made, made.measured));
  for (std::size_t i = 0; i < made.hidden.size(); ++i) {
    Hidden& h = made.hidden[i];
    if (h.effect.acts != Acts::mean || h.effect.passages) continue;
    std::vector<Eigen::VectorXd> others;
    for (std::size_t j = 0; j < made.hidden.size(); ++j)
      if (j != i && made.hidden[j].effect.acts == Acts::mean)
        others.push_back(made.hidden[j].effect.shift(made.measured, made.hidden[j].strength));
    h.lambda = energy(whiten, h.effect.shift(made.measured, h.strength), beside(made.measured.design, others));
  }
}

}  // namespace muster::exam
