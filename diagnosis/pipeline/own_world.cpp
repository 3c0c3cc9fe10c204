#include "diagnosis/pipeline/own_world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "diagnosis/pipeline/own_world_fits.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Sum of squares about a multiple, not negative, of these levels; both are centred.
double rest_about(const VectorXd& x, const VectorXd& z) {
  const double slope = x.squaredNorm() > 0 ? std::max(0.0, x.dot(z) / x.squaredNorm()) : 0;
  return (z - slope * x).squaredNorm();
}

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
  Judge(DiagnosisSetup& setup, const Diagnosis& found, std::size_t readings)
      : s_(setup), found_(found), worlds_(setup, found.time_unit, found.levels, readings) {}

  // By these readings a hypothesis leads, and by more of them it may be named.
  bool leaves_open() const { return leaves_open_; }

  OwnWorldVerdict verdict() {
    const Hypotheses hypotheses = hypotheses_of(s_, found_);
    OwnWorldVerdict out{{}, {}, hypotheses.searched, hypotheses.not_tested};
    if (worlds_.rows().size() < thresholds::own_world_fewest || hypotheses.searched.empty()) return out;
    const std::vector<Hypothesis> first = promising(hypotheses.all);
    const OwnWorld as_it_is = worlds_.world_with({});
    std::vector<OwnWorld> worlds;
    const auto left = [&](const OwnWorld& world) {
      return std::min(world.squares / as_it_is.squares, world.levelled / as_it_is.levelled);
    };
    for (const Hypothesis& h : first) {
      OwnWorld world = worlds_.world_with(h);
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
  double price(double numbers) const { return numbers / 2 * std::log(static_cast<double>(worlds_.rows().size())); }

  double price_of_levels() const { return price(worlds_.numbers_of_levels()); }

  // The hypotheses that are best by least squares about a multiple of the declared levels, one start of each: about one
  // level, or one of each radio, since a radio that is off besides would hide what the map has wrong.
  std::vector<Hypothesis> promising(const std::vector<Hypothesis>& all) {
    struct Scored {
      const Hypothesis* hypothesis;
      double squares;
    };
    const auto [plain, with] = worlds_.declared_levels(all);
    const std::vector<std::size_t> one(worlds_.rows().size(), 0);
    const auto about = [&](const VectorXd& levels, const std::vector<std::size_t>& group) {
      return rest_about(centred(levels, group), centred(worlds_.measured(), group));
    };
    const double squares = about(plain, one), levelled = about(plain, worlds_.radio());
    std::vector<Scored> scored;  // as shares of those of the world as it is
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Hypothesis& h = all[k];
      const VectorXd& levels = with[k];
      if (levels.size() == 0 || (levels - plain).cwiseAbs().maxCoeff() < thresholds::own_world_change) continue;
      ++tried_;
      double left = about(levels, one) / squares;
      if (worlds_.may_level()) left = std::min(left, about(levels, worlds_.radio()) / levelled);
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

  // Of a world whose numbers and choices cost as much: by all families of the noise where it may be named or told
  // beside the one that is.
  Likelihood likelihood_of(const OwnWorld& world, double prices) const {
    return worlds_.likelihood_of(world, as_it_is_.noise, worth_a_look_ + prices - thresholds::own_world_other_noise);
  }

  Judged judged(const OwnWorld& given, const OwnWorld& as_it_is) {
    Judged result{given};
    const double sought = choice() + price(given.hypothesis.sought());
    Likelihood likelihood = likelihood_of(given, sought);
    if (given.hypothesis.place) {
      OwnWorld settled = given;
      const InPlan sd = worlds_.settle(settled, likelihood.noise);
      result.place_sd = sd;
      const Likelihood there = likelihood_of(settled, sought);
      if (there.nats > likelihood.nats) {
        result.world = settled;
        likelihood = there;
      }
    }
    result.nats = likelihood.nats;
    result.evidence = likelihood.nats - sought;
    // Only where it explains more of what levels leave: a likelihood costs.
    if (worlds_.may_level() && given.levelled / as_it_is.levelled < given.squares / as_it_is.squares) {
      const double prices = sought + price_of_levels(),
                   nats = likelihood_of(worlds_.with_levels(result.world), prices).nats, evidence = nats - prices;
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
    const double prices = sought + price_of_found(), nats = likelihood_of(both, prices).nats, evidence = nats - prices;
    if (evidence <= result.evidence) return result;
    result.nats = nats;
    result.evidence = evidence;
    result.beside_found = true;
    result.levelled = false;
    return result;
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
    return (found_.mean - without)(worlds_.rows());
  }

  // What the search found in the world as it is, as one more world.
  Likelihood likelihood_of_found(const OwnWorld& as_it_is) const {
    if (price_of_found() == 0) return {};
    OwnWorld with_them = as_it_is;
    with_them.rest = worlds_.measured() - found_.mean(worlds_.rows());
    return worlds_.likelihood_of(with_them);
  }

  // nats, behind a lead, that the readings do not tell: what else is wrong with the world is in no hypothesis yet, so
  // that small shares of the lead say little.
  static double even_with(double lead) {
    return std::max(thresholds::own_world_even, thresholds::own_world_even_share * lead);
  }

  void name_likeliest(const OwnWorld& as_it_is, const std::vector<OwnWorld>& worlds, OwnWorldVerdict& out) {
    as_it_is_ = worlds_.likelihood_of(as_it_is);
    const double alone = as_it_is_.nats;
    worth_a_look_ = alone + thresholds::own_world_nats;
    std::vector<Judged> all;
    for (const OwnWorld& world : worlds) {
      all.push_back(judged(world, as_it_is));
      const double most = all.back().evidence;
      worth_a_look_ = std::max(worth_a_look_, most - std::max(thresholds::own_world_open, even_with(most - alone)));
    }
    const double most = std::max_element(all.begin(), all.end(), [](const Judged& a, const Judged& b) {
                          return a.evidence < b.evidence;
                        })->evidence;
    // Of those that the readings do not tell apart the simplest.
    const double even = even_with(most - alone);
    const auto simpler = [&](const Judged& a, const Judged& b) {
      const auto rank = [&](const Judged& j) {
        return std::tuple(j.evidence < most - even, j.world.hypothesis.cause->needs_own_world(),
                          numbers_of(*j.world.hypothesis.cause->plugin), j.world.hypothesis.number);
      };
      return rank(a) < rank(b);
    };
    const Judged& best = *std::min_element(all.begin(), all.end(), simpler);
    // Where it takes levels of the radios, too, against the world as it is with such levels.
    const double levelled = best.levelled ? worlds_.likelihood_of(worlds_.with_levels(as_it_is)).nats : 0,
                 plain = best.levelled ? std::max(alone, levelled - price_of_levels()) : alone,
                 same_numbers = best.levelled ? levelled : alone;
    const double of_found = likelihood_of_found(as_it_is).nats, worth = of_found - price_of_found();
    const double lead = best.evidence - (best.beside_found ? std::max(plain, worth) : plain),
                 beyond_found = best.evidence - worth;
    if (lead < thresholds::own_world_nats || beyond_found < thresholds::own_world_beyond_found) {
      leaves_open_ = std::min(lead, beyond_found) > thresholds::own_world_leads;
      return;
    }
    CauseEstimate result = stated(best.world.hypothesis, best.place_sd);
    result.evidence = lead;
    result.log_p = -lead;
    result.lambda = 2 * (best.nats - (best.beside_found ? std::max(same_numbers, of_found) : same_numbers));
    for (const Judged& other : all) {
      const double gap = best.evidence - other.evidence;
      if (&other != &best && gap < thresholds::own_world_open)
        result.alternatives.push_back({other.world.hypothesis.cause->id,
                                       other.world.hypothesis.label(),
                                       {},
                                       gap,
                                       std::nan(""),
                                       best.nats - other.nats});
    }
    for (std::size_t j = 0; j < s_.base.paths.size(); ++j)
      out.parameters[s_.base.paths[j]] = best.world.values[static_cast<Index>(j)];
    out.cause = std::move(result);
  }

  DiagnosisSetup& s_;
  const Diagnosis& found_;
  OwnWorldFits worlds_;
  int tried_ = 0;  // hypotheses that change the expected levels
  Likelihood as_it_is_;
  double worth_a_look_ = 0;  // nats, from which the evidence of a hypothesis matters
  bool leaves_open_ = false;
};

}  // namespace

OwnWorldVerdict judged_in_own_worlds(DiagnosisSetup& setup, const Diagnosis& found) {
  OwnWorldVerdict verdict;
  for (const std::size_t readings : {thresholds::own_world_readings, thresholds::own_world_more_readings}) {
    Judge judge(setup, found, readings);
    verdict = judge.verdict();
    if (!judge.leaves_open() || setup.used.rows.size() < 2 * readings) break;
  }
  return verdict;
}

}  // namespace muster::diagnosis
