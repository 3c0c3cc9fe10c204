#include "diagnosis/pipeline/own_world.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Least squares within bounds: a coefficient beyond one is held there.
VectorXd bounded_least_squares(const MatrixXd& design, VectorXd y, const VectorXd& lower, const VectorXd& upper) {
  VectorXd result = VectorXd::Zero(design.cols());
  std::vector<Index> free(static_cast<std::size_t>(design.cols()));
  for (std::size_t j = 0; j < free.size(); ++j) free[j] = static_cast<Index>(j);
  while (!free.empty()) {
    const VectorXd found = design(Eigen::all, free).colPivHouseholderQr().solve(y);
    std::vector<Index> inside;
    for (std::size_t j = 0; j < free.size(); ++j) {
      const Index k = free[j];
      result[k] = std::clamp(found[static_cast<Index>(j)], lower[k], upper[k]);
      if (result[k] == found[static_cast<Index>(j)]) inside.push_back(k);
    }
    if (inside.size() == free.size()) break;
    for (const Index k : free) {
      if (!std::count(inside.begin(), inside.end(), k)) y -= result[k] * design.col(k);
    }
    free = std::move(inside);
  }
  return result;
}

// Sum of squares about a multiple, not negative, of these levels; both are centred.
double rest_about(const VectorXd& x, const VectorXd& z) {
  const double slope = x.squaredNorm() > 0 ? std::max(0.0, x.dot(z) / x.squaredNorm()) : 0;
  return (z - slope * x).squaredNorm();
}

// Each less the mean of its group.
VectorXd centred(const VectorXd& values, const std::vector<std::size_t>& group) {
  std::map<std::size_t, std::pair<double, double>> sums;  // and counts
  for (Index i = 0; i < values.size(); ++i) {
    auto& [sum, count] = sums[group[static_cast<std::size_t>(i)]];
    sum += values[i];
    count += 1;
  }
  VectorXd result = values;
  for (Index i = 0; i < values.size(); ++i) {
    const auto& [sum, count] = sums[group[static_cast<std::size_t>(i)]];
    result[i] -= sum / count;
  }
  return result;
}

// A world with a hypothesis, linearised at its own fit.
struct OwnWorld {
  Hypothesis hypothesis;
  double squares = 0;   // left by least squares
  double levelled = 0;  // the same with a level of each radio
  VectorXd rest;        // measured less the mean at zero parameters
  MatrixXd design;
  std::vector<std::array<End, 2>> ends{};
  VectorXd values{};  // of the parameters, by least squares
};

struct Likelihood {
  double nats = -std::numeric_limits<double>::infinity();
  noise::Covariance noise{};
};

// Leaves so many of them, of which half at most are of one cause: a plan may be turned in fourteen ways.
template <class Each, class CauseOf>
void keep_first(std::vector<Each>& all, std::size_t most, const CauseOf& cause_of) {
  std::map<const Cause*, std::size_t> kept;
  std::erase_if(all, [&](const Each& each) { return ++kept[cause_of(each)] > most / 2; });
  if (all.size() > most) all.erase(all.begin() + static_cast<std::ptrdiff_t>(most), all.end());
}

// Numbers that a fault needs, beside choices and rows of the world.
std::ptrdiff_t numbers_of(const muster_plugin& plugin) {
  return std::count_if(plugin.params, plugin.params + plugin.param_count,
                       [](const muster_param& p) { return p.kind == MUSTER_REAL || p.kind == MUSTER_INTEGER; });
}

class Judge {
 public:
  Judge(DiagnosisSetup& setup, const Diagnosis& found) : s_(setup), found_(found), moved_(setup.model) {
    const ObservedLevels levels = observed_levels(s_.data, s_.receiver, s_.fitted.readings, s_.used.rows);
    std::vector<Index> known;
    for (std::size_t i = 0; i < s_.used.rows.size(); ++i) {
      if (levels.bounds.known.empty() || levels.bounds.known[i] == noise::Known::value)
        known.push_back(static_cast<Index>(i));
    }
    const std::size_t every = std::max<std::size_t>(1, known.size() / thresholds::own_world_readings);
    for (std::size_t i = 0; i < known.size(); i += every) {
      kept_.push_back(s_.used.rows[static_cast<std::size_t>(known[i])]);
      of_used_.push_back(known[i]);
    }
    y_ = levels.measured(of_used_);
    // What each radio sends, or each hears where one sends.
    const bool of_senders = s_.data.tx.levels.size() > 1;
    for (const Index row : kept_)
      radio_.push_back((of_senders ? s_.data.tx : s_.data.rx).level[static_cast<std::size_t>(row)]);
    radios_ = std::set(radio_.begin(), radio_.end());
  }

  OwnWorldVerdict verdict() {
    const Hypotheses hypotheses = hypotheses_of(s_, found_);
    OwnWorldVerdict out{{}, {}, hypotheses.searched, hypotheses.not_tested};
    if (kept_.size() < thresholds::own_world_fewest || hypotheses.searched.empty()) return out;
    set(s_.base.values);
    const OwnWorld as_it_is = world_with({});
    std::vector<OwnWorld> worlds;
    const auto left = [&](const OwnWorld& world) {
      return std::min(world.squares / as_it_is.squares, world.levelled / as_it_is.levelled);
    };
    for (const Hypothesis& h : promising(hypotheses.all)) {
      OwnWorld world = world_with(h);
      if (left(world) < thresholds::own_world_share) worlds.push_back(std::move(world));
    }
    std::stable_sort(worlds.begin(), worlds.end(),
                     [&](const OwnWorld& a, const OwnWorld& b) { return left(a) < left(b); });
    keep_first(worlds, thresholds::own_worlds_fitted, [](const OwnWorld& each) { return each.hypothesis.cause; });
    if (!worlds.empty()) name_likeliest(as_it_is, worlds, out);
    return out;
  }

 private:
  struct Judged {
    OwnWorld world;
    double nats = 0, evidence = 0;
    bool beside_found = false;  // with what was found in the world as it is
    bool levelled = false;      // with a level of each radio
    InPlan place_sd{};
  };

  double choice() const { return std::log(static_cast<double>(tried_)); }
  double price(double numbers) const { return numbers / 2 * std::log(static_cast<double>(kept_.size())); }

  double price_of_levels() const { return price(static_cast<double>(radios_.size()) - 1); }
  bool may_level() const { return radios_.size() > 1 && radios_.size() <= thresholds::own_world_levels; }

  // The hypotheses that are best by least squares about a multiple of the declared levels, one start of each: about one
  // level, or one of each radio, since a radio that is off besides would hide what the map has wrong.
  std::vector<Hypothesis> promising(const std::vector<Hypothesis>& all) {
    struct Scored {
      const Hypothesis* hypothesis;
      double squares;
    };
    ParameterGuard declared(s_.model);
    for (const FitParameter& p : s_.fitted.parameters) declared.set(p.path, p.start);
    const VectorXd plain = s_.model.expected()(kept_);
    const std::vector<std::size_t> one(kept_.size(), 0);
    const auto about = [&](const VectorXd& levels, const std::vector<std::size_t>& group) {
      return rest_about(centred(levels, group), centred(y_, group));
    };
    const double squares = about(plain, one), levelled = about(plain, radio_);
    std::vector<Scored> scored;  // as shares of those of the world as it is
    for (const Hypothesis& h : all) {
      const VectorXd levels = levels_with(h);
      if (levels.size() == 0 || (levels - plain).cwiseAbs().maxCoeff() < thresholds::own_world_change) continue;
      ++tried_;
      double left = about(levels, one) / squares;
      if (may_level()) left = std::min(left, about(levels, radio_) / levelled);
      const Scored now{&h, left};
      const auto same = std::find_if(scored.begin(), scored.end(), [&](const Scored& other) {
        return other.hypothesis->cause == h.cause && other.hypothesis->row == h.row &&
               other.hypothesis->words == h.words;
      });
      if (same == scored.end())
        scored.push_back(now);
      else if (now.squares < same->squares)
        *same = now;
    }
    std::erase_if(scored, [&](const Scored& each) { return each.squares > thresholds::own_world_hopeless; });
    std::stable_sort(scored.begin(), scored.end(),
                     [](const Scored& a, const Scored& b) { return a.squares < b.squares; });
    keep_first(scored, thresholds::own_worlds_built, [](const Scored& each) { return each.hypothesis->cause; });
    std::vector<Hypothesis> result;
    for (const Scored& each : scored) result.push_back(*each.hypothesis);
    return result;
  }

  // Empty if the hypothesis cannot run in this world.
  VectorXd levels_with(const Hypothesis& h) try {
    const Supposed supposed(s_.model, h);
    return s_.model.expected()(kept_);
  } catch (const Error&) {
    return {};
  }

  void set(const VectorXd& values) {
    for (std::size_t j = 0; j < s_.base.paths.size(); ++j) moved_.set(s_.base.paths[j], values[static_cast<Index>(j)]);
  }

  // Fits the parameters in the world with the hypothesis, its place and the parameters in turn.
  OwnWorld world_with(const Hypothesis& hypothesis) {
    set(s_.base.values);
    Supposed supposed(s_.model, hypothesis);
    OwnWorld world = linearised(hypothesis);
    for (int round = 0; round < 2 && world.hypothesis.place; ++round) {
      set_fitted(world);
      world.hypothesis.place = moved_to_best(supposed, *world.hypothesis.place);
      supposed.move(*world.hypothesis.place);
      world = linearised(world.hypothesis);
    }
    set(s_.base.values);
    return world;
  }

  void set_fitted(const OwnWorld& world) { set(world.values); }

  // At the parameters of the fit.
  OwnWorld linearised(const Hypothesis& hypothesis) {
    Sensitivities own = s_.base;
    own.slopes = slopes_at(s_.model, own);
    set(own.values);
    own.mean = s_.model.expected();
    OwnWorld world{hypothesis, 0, 0, y_ - own.offset()(kept_), own.slopes(kept_, Eigen::all)};
    world.values = bounded_least_squares(world.design, world.rest, own.lower, own.upper);
    world.squares = (world.rest - world.design * world.values).squaredNorm();
    world.levelled = world.squares;
    if (!may_level()) return with_ends(std::move(world));
    MatrixXd design = world.design;
    for (Index j = 0; j < design.cols(); ++j) design.col(j) = centred(world.design.col(j), radio_);
    const VectorXd rest = centred(world.rest, radio_);
    world.levelled = (rest - design * bounded_least_squares(design, rest, own.lower, own.upper)).squaredNorm();
    return with_ends(std::move(world));
  }

  OwnWorld with_ends(OwnWorld world) const {
    const auto ends = s_.model.ends_now();
    for (const Index row : kept_) world.ends.push_back(ends[static_cast<std::size_t>(row)]);
    return world;
  }

  InPlan moved_to_best(Supposed& supposed, const InPlan& start) {
    const auto value = [&](const VectorXd& theta) {
      supposed.move({theta[0], theta[1]});
      const VectorXd rest = y_ - s_.model.expected()(kept_);
      return -(rest.array() - rest.mean()).square().sum();
    };
    inference::Candidate place;
    const Eigen::Vector2d at(start[0], start[1]);
    place.refinement.lower = at.array() - thresholds::own_world_reach;
    place.refinement.upper = at.array() + thresholds::own_world_reach;
    place.refinement.step = Eigen::Vector2d::Ones();
    const VectorXd best = inference::local_search(place, at, 40, value).first;
    return {best[0], best[1]};
  }

  LinkReadings readings_of(const OwnWorld& world) const {
    LinkReadings r;
    const auto n = static_cast<Index>(kept_.size());
    r.tx_at.resize(3, n);
    r.rx_at.resize(3, n);
    for (Index i = 0; i < n; ++i) {
      const auto& [tx, rx] = world.ends[static_cast<std::size_t>(i)];
      r.tx.push_back(tx.radio);
      r.rx.push_back(rx.radio);
      r.tx_at.col(i) << tx.x, tx.y, tx.z;
      r.rx_at.col(i) << rx.x, rx.y, rx.z;
      if (!s_.data.t.empty()) r.t.push_back(s_.data.t[static_cast<std::size_t>(kept_[static_cast<std::size_t>(i)])]);
    }
    return r;
  }

  // Single readings are rows: what is averaged in one world is of several links in another.
  LinkLayout layout_of(const OwnWorld& world) const {
    LinkRowLimits limits;
    limits.way = -1;
    return {readings_of(world), limits, {}, true, drawn_correlation(s_.model)};
  }

  // Profile likelihood of the readings, with the noise fitted in this world.
  Likelihood likelihood_of(const OwnWorld& world) const {
    const LinkLayout layout = layout_of(world);
    const noise::Rows rows = layout.rows();
    const noise::Field field(layout.sites(rows), {.seed = s_.options.seed});
    const VectorXd y = rows.mean(world.rest);
    const MatrixXd design = rows.mean(world.design);
    const noise::Fit fit = noise::fit_families(field, y, design, s_.options.prior).front();
    return {fit.log_likelihood(), fit.covariance};
  }

  // Moves the place by generalised least squares; its standard errors.
  InPlan settle(OwnWorld& world, const noise::Covariance& covariance) {
    InPlan sd{};
    constexpr double step = 0.05;  // m
    const LinkLayout layout = layout_of(world);
    const noise::Rows rows = layout.rows();
    const noise::Field field(layout.sites(rows), {.seed = s_.options.seed});
    const noise::Whitener whitener(field, covariance);
    for (int round = 0; round < 2; ++round) {
      set_fitted(world);
      MatrixXd columns(static_cast<Index>(kept_.size()), 2);
      {
        Supposed supposed(s_.model, world.hypothesis);
        const InPlan at = *world.hypothesis.place;
        for (const std::size_t k : {0, 1}) {
          InPlan more = at, less = at;
          more[k] += step;
          less[k] -= step;
          supposed.move(more);
          columns.col(static_cast<Index>(k)) = s_.model.expected()(kept_);
          supposed.move(less);
          columns.col(static_cast<Index>(k)) -= s_.model.expected()(kept_);
        }
      }
      columns /= 2 * step;
      const noise::Whitened base =
          noise::whitened(whitener, rows.mean(world.rest), rows.mean(world.design), s_.options.prior);
      const noise::Basis place = noise::basis_of(base.basis.rest(whitener(rows.mean(columns))));
      const VectorXd by = place.coefficients(place.q.transpose() * base.residual, 2);
      const MatrixXd uncertainty = place.uncertainty(2);
      for (const std::size_t k : {0, 1}) {
        sd[k] = std::sqrt(uncertainty(static_cast<Index>(k), static_cast<Index>(k)));
        (*world.hypothesis.place)[k] += std::clamp(by[static_cast<Index>(k)], -1.0, 1.0);
      }
      Supposed supposed(s_.model, world.hypothesis);
      const Hypothesis here = world.hypothesis;
      world = linearised(here);
    }
    return sd;
  }

  Judged judged(const OwnWorld& given, const OwnWorld& as_it_is) {
    Judged result{given};
    Likelihood likelihood = likelihood_of(given);
    if (given.hypothesis.place) {
      OwnWorld settled = given;
      const InPlan sd = settle(settled, likelihood.noise);
      result.place_sd = sd;
      const Likelihood there = likelihood_of(settled);
      if (there.nats > likelihood.nats) {
        result.world = settled;
        likelihood = there;
      }
    }
    result.nats = likelihood.nats;
    result.evidence = likelihood.nats - choice() - price(given.hypothesis.sought());
    // Only where it explains more of what levels leave: a likelihood costs.
    if (may_level() && given.levelled / as_it_is.levelled < given.squares / as_it_is.squares) {
      const double nats = likelihood_of(with_levels(result.world)).nats,
                   evidence = nats - choice() - price(given.hypothesis.sought()) - price_of_levels();
      if (evidence > result.evidence) {
        result.nats = nats;
        result.evidence = evidence;
        result.levelled = true;
      }
    }
    if (price_of_found() == 0) return result;
    // A fault of the map leaves room for others: what was found may be true beside it, in another strength.
    OwnWorld both = result.world;
    both.design.conservativeResize(Eigen::NoChange, both.design.cols() + 1);
    both.design.rightCols(1) = effect_of_found();
    const double nats = likelihood_of(both).nats;
    const double evidence = nats - choice() - price(given.hypothesis.sought()) - price_of_found();
    if (evidence <= result.evidence) return result;
    result.nats = nats;
    result.evidence = evidence;
    result.beside_found = true;
    result.levelled = false;
    return result;
  }

  // With a level of each radio but one.
  OwnWorld with_levels(OwnWorld world) const {
    const Index own = world.design.cols();
    world.design.conservativeResize(Eigen::NoChange, own + static_cast<Index>(radios_.size()) - 1);
    world.design.rightCols(world.design.cols() - own).setZero();
    for (std::size_t i = 0; i < radio_.size(); ++i) {
      const auto at = std::distance(radios_.begin(), radios_.find(radio_[i]));
      if (at > 0) world.design(static_cast<Index>(i), own + at - 1) = 1;
    }
    return world;
  }

  // nats, of the choices and numbers of all that the search named in the world as it is; 0: nothing.
  double price_of_found() const {
    double prices = 0;
    for (const CauseEstimate& c : found_.causes) {
      if (c.status == inference::Status::named) prices += choice() + price(static_cast<double>(c.values.size()));
    }
    return prices;
  }

  // dB, by which all that was found moves the readings.
  VectorXd effect_of_found() const {
    VectorXd moved = -s_.base.values;
    for (std::size_t j = 0; j < s_.base.paths.size(); ++j)
      moved[static_cast<Index>(j)] += found_.parameters.at(s_.base.paths[j]);
    const VectorXd without = s_.base.mean + s_.base.slopes * moved;
    return (found_.mean - without)(kept_);
  }

  // What the search found in the world as it is, as one more world.
  Likelihood likelihood_of_found(const OwnWorld& as_it_is) const {
    if (price_of_found() == 0) return {};
    OwnWorld with_them = as_it_is;
    with_them.rest = y_ - found_.mean(kept_);
    return likelihood_of(with_them);
  }

  void name_likeliest(const OwnWorld& as_it_is, const std::vector<OwnWorld>& worlds, OwnWorldVerdict& out) {
    const double alone = likelihood_of(as_it_is).nats;
    std::vector<Judged> all;
    for (const OwnWorld& world : worlds) all.push_back(judged(world, as_it_is));
    const double most = std::max_element(all.begin(), all.end(), [](const Judged& a, const Judged& b) {
                          return a.evidence < b.evidence;
                        })->evidence;
    // Of those that the readings do not tell apart the simplest. What else is wrong with the world is in no hypothesis
    // yet, so that small shares of the lead say little.
    const double even = std::max(thresholds::own_world_even, thresholds::own_world_even_share * (most - alone));
    const auto simpler = [&](const Judged& a, const Judged& b) {
      const auto rank = [&](const Judged& j) {
        return std::tuple(j.evidence < most - even, j.world.hypothesis.cause->needs_own_world(),
                          numbers_of(*j.world.hypothesis.cause->plugin), j.world.hypothesis.number);
      };
      return rank(a) < rank(b);
    };
    const Judged& best = *std::min_element(all.begin(), all.end(), simpler);
    // Where it takes levels of the radios, too, against the world as it is with such levels.
    const double plain =
        best.levelled ? std::max(alone, likelihood_of(with_levels(as_it_is)).nats - price_of_levels()) : alone;
    const double of_found = likelihood_of_found(as_it_is).nats, worth = of_found - price_of_found();
    const double lead = best.evidence - (best.beside_found ? std::max(plain, worth) : plain);
    if (lead < thresholds::own_world_nats || best.evidence - worth < thresholds::own_world_beyond_found) return;
    CauseEstimate result = stated(best.world.hypothesis, best.place_sd);
    result.evidence = lead;
    result.log_p = -lead;
    result.lambda = 2 * (best.nats - (best.beside_found ? std::max(plain, of_found) : plain));
    for (const Judged& other : all) {
      const double gap = best.evidence - other.evidence;
      if (&other != &best && gap < thresholds::own_world_open)
        result.alternatives.push_back(
            {other.world.hypothesis.cause->id, other.world.hypothesis.label(), {}, gap, 0, best.nats - other.nats});
    }
    for (std::size_t j = 0; j < s_.base.paths.size(); ++j)
      out.parameters[s_.base.paths[j]] = best.world.values[static_cast<Index>(j)];
    out.cause = std::move(result);
  }

  DiagnosisSetup& s_;
  const Diagnosis& found_;
  ParameterGuard moved_;
  std::vector<Index> kept_, of_used_;  // rows of the table; the same among those of the search
  std::vector<std::size_t> radio_;     // of each reading: which sends, or hears where one sends
  std::set<std::size_t> radios_;
  VectorXd y_;     // dBm, measured there
  int tried_ = 0;  // hypotheses that change the expected levels
};

}  // namespace

OwnWorldVerdict judged_in_own_worlds(DiagnosisSetup& setup, const Diagnosis& found) {
  return Judge(setup, found).verdict();
}

}  // namespace muster::diagnosis
