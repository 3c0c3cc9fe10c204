#include "diagnosis/radio/laws/clip_causes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "diagnosis/calibration/truncation.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/radio/laws/testable_readings.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/links/stated_clip.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::VectorXd;

std::vector<const Cause*> clips_of(const LawSources& s, uint32_t side, bool silent) {
  return causes_that(s, [&](const Cause& cause) { return clips(*cause.plugin, side, silent); });
}

std::optional<double> stated_floor_of(const LawSources& s) {
  return silent_below(s.model.simulation(), weakest_of_some(s.fit.readings.received(s.fit.readings.rssi)));
}

// True if an instance of the world already clips there, or keeps silent even above. A default does as far as readings
// agree with it: weaker ones are what the world's receiver would not have heard.
bool clips_at(const LawSources& s, uint32_t side, bool silent, double level, double step) {
  if (const auto stated = stated_floor_of(s); silent && stated && level <= *stated) return true;
  const auto& all = s.model.simulation().instances();
  return std::any_of(all.begin(), all.end(), [&](const auto& instance) {
    if (!clips(instance->plugin(), side, silent)) return false;
    const double there = clip_level(*instance);
    const bool holds = instance->plugin().cause || is_stated(*instance) || level >= there - step / 2;
    return holds && std::abs(there - level) <= std::max(step, thresholds::same_clip);
  });
}

void add_clip(const LawSources& s, const std::vector<const Cause*>& causes, double level, double half, bool silent,
              LawTest test, Diagnosis& found) {
  const muster_clip& clip = *causes.front()->plugin->clip;
  test.values = {{clip.level, level, level - half, level + half}};
  CauseEstimate& named = add_named(s, causes, test, found);
  if (clip.choice) named.words[clip.choice] = silent ? "true" : "false";
}

// Monte Carlo test: true if readings pile up as strongly at that end of one of the fitted world's own draws. Where a
// robot turns, in a trough of smooth shadowing or where levels hardly vary, neighbours are no independent readings.
bool piles_by_itself(const LawSources& s, uint32_t side, const Clip& pile, const Diagnosis& found) {
  Dataset drawn = s.data;
  for (uint64_t k = 0; k < thresholds::pile_draws; ++k) {
    const VectorXd levels = s.draws.draw(k, found.parameters, {}).drawn;
    for (std::size_t i = 0; i < drawn.rssi.size(); ++i) {
      if (!std::isnan(drawn.rssi[i])) drawn.rssi[i] = levels[static_cast<Eigen::Index>(i)];
    }
    const ReceiverChecks checks = receiver_checks(drawn);
    const std::optional<Clip>& there = side == MUSTER_ABOVE ? checks.top : checks.bottom;
    if (there && there->log_p <= pile.log_p) return true;
  }
  return false;
}

// True if all readings of a pile come from one extreme of the shadowing, which few radios see: neighbours there are at
// one level, for the slope of a smooth field vanishes at its extremes.
bool at_one_extreme(const LawSources& s, const Clip& pile) {
  const noise::StatedField field = noise::stated_by(s.state.fit.covariance, s.state.within()),
                           stated = drawn_field(s.model);
  // A clip makes the fitted field wide: the stated one is, where there is one.
  const double extreme =
      stated.shadowing > 0 ? std::min(field.decorrelation, stated.decorrelation) : field.decorrelation;
  return s.state.time_unit() == 0 && field.shadowing >= thresholds::field_of_extremes &&
         links_at_level(s.data, pile.level) < thresholds::links_beyond_an_extreme &&
         extent_at_level(s.data, pile.level) < extreme;
}

void add_pile(const LawSources& s, uint32_t side, const Clip& pile, double step, Diagnosis& found) {
  const std::vector<const Cause*> causes = clips_of(s, side, false);
  if (causes.empty() || clips_at(s, side, false, pile.level, step) || at_one_extreme(s, pile) ||
      piles_by_itself(s, side, pile, found))
    return;
  add_clip(s, causes, pile.level, std::max(step, 0.02) / 2, false,
           {causes.front()->id, {}, -2 * pile.log_p, -pile.log_p, pile.log_p}, found);
}

// True if the world's own receiver hears nothing that is about as weak: a reading in a shadow that is deeper than the
// model knows is lost to that. Only where levels also end abruptly is the floor another one.
bool lost_below_the_stated_floor(const LawSources& s, double floor) {
  const std::optional<double> stated = stated_floor_of(s);
  const noise::Covariance& noise = s.state.fit.covariance;
  const double scatter = std::sqrt(noise.field_variance() + noise.reading_variance());
  const double below = stated ? floor - *stated : 0;
  return below > 0 && below < thresholds::deep_shadow * scatter;
}

// Tests for readings missing at low levels only. True if the cause is named.
bool add_silence(const LawSources& s, const MissingData& missing, Diagnosis& found) {
  const double step = found.receiver.step;
  const std::vector<const Cause*> causes = clips_of(s, MUSTER_BELOW, true);
  const double least = std::log(s.state.options().further_alpha / static_cast<double>(s.state.entries().size()));
  const double independent = missing.censored ? 1 : thresholds::joint_loss;  // neighbours are lost jointly
  const double gain = independent * missing.beyond_stated;
  LawTest test{"", {}, gain, gain / 2, inference::log_tail(gain, 1)};
  if (missing.cut_off && !missing.censored)
    test.log_p = inference::log_p_of_both(test.log_p, independent * std::log(std::max(missing.none_below, 1e-300)));
  if (causes.empty() || !(missing.censored || missing.cut_off) || test.log_p > least) return false;
  if (clips_at(s, MUSTER_BELOW, true, missing.floor, step)) return false;
  if (!missing.cut_off && lost_below_the_stated_floor(s, missing.floor)) return false;
  add_clip(s, causes, missing.floor, std::max(step, 0.02), true, test, found);
  return true;
}

// Of each reading, the cell of both its ends whose readings share their shadowing. Both directions are one link, but
// over time, where each stream may have a level of its own.
std::vector<int> cells_of(const LawSources& s) {
  const bool of_places = s.state.time_unit() == 0;
  const double alike = of_places ? noise::stated_by(s.state.fit.covariance, s.state.within()).decorrelation : 0;
  const double side = std::max(alike / 2, 0.1);  // m
  const LinkReadings& r = s.readings;
  std::map<std::vector<long>, int> number;
  std::vector<int> result;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool as_it_is = !of_places || r.tx[k] < r.rx[k];
    std::vector<long> place{as_it_is ? r.tx[k] : r.rx[k], as_it_is ? r.rx[k] : r.tx[k]};
    for (const Eigen::Matrix3Xd* ends : {as_it_is ? &r.tx_at : &r.rx_at, as_it_is ? &r.rx_at : &r.tx_at}) {
      for (const double at : ends->col(i)) place.push_back(std::lround(at / side));
    }
    result.push_back(number.try_emplace(std::move(place), static_cast<int>(number.size())).first->second);
  }
  return result;
}

// Share of the field's variance that readings of a cell have in common. On the way they are a quarter of the
// decorrelation distance apart; what wanders over time tells nothing after a while.
double share_of_cells(const LawSources& s) {
  const double fixed = noise::fixed_share(s.state.fit.covariance.family);
  if (s.state.time_unit() > 0) return fixed;
  return fixed + (1 - fixed) * (repeat_places(s.readings) ? 1 : std::exp(-0.25));
}

// Levels as the model with its noise lets expect them.
struct Levels {
  VectorXd mean;               // of each reading, dBm
  std::vector<int> cell;       // of each
  double shared = 0, own = 0;  // variances of a cell, and of readings within it, dB^2
};

// Scatter of the readings whose mean is near the weakest one: less than that of all, where only those above a floor
// are, or where they are of one place.
double scatter_near(double floor, const VectorXd& heard, const Levels& levels, double of_all) {
  double count = 0, sum = 0, squares = 0;
  std::set<int> independent;
  for (Eigen::Index i = 0; i < heard.size(); ++i) {
    if (levels.mean[i] - floor > thresholds::near_clip * of_all) continue;
    const double error = heard[i] - levels.mean[i];
    count += 1;
    independent.insert(levels.cell[static_cast<std::size_t>(i)]);
    sum += error;
    squares += error * error;
  }
  return independent.size() < thresholds::independent_near
             ? of_all
             : std::min(of_all, std::sqrt((squares - sum * sum / count) / (count - 1)));
}

// Each reading is expected as those before it in its cell tell, so that all are the product of their chances.
Truncation truncation_at_the_end(const VectorXd& heard, const Levels& levels, double step) {
  const double of_all =
      std::max(std::sqrt((heard - levels.mean).squaredNorm() / static_cast<double>(heard.size())), 0.1);
  const double near = std::max(scatter_near(heard.minCoeff(), heard, levels, of_all), 0.1);
  const double scale = near * near / (levels.shared + levels.own), shared = scale * levels.shared,
               own = scale * levels.own;
  std::map<int, std::pair<double, double>> before;  // number and sum of the errors in a cell
  VectorXd mean(heard.size()), sigma(heard.size());
  for (Eigen::Index i = 0; i < heard.size(); ++i) {
    auto& [count, sum] = before[levels.cell[static_cast<std::size_t>(i)]];
    const double whole = own + count * shared;
    mean[i] = levels.mean[i] + shared * sum / whole;
    sigma[i] = std::sqrt(own + shared * own / whole);
    count += 1;
    sum += heard[i] - levels.mean[i];
  }
  return truncation_of(heard, mean, sigma, step / 2);
}

// Monte Carlo test: true if one of the fitted world's own draws ends as abruptly: its receiver may hear no less. The
// model is fitted to each: where a field is smooth and exact, that leaves whole regions off by as much as the field is.
bool ends_by_itself(const LawSources& s, double evidence, const Levels& levels, const Diagnosis& found) {
  const Eigen::MatrixXd design = s.state.design();
  const noise::Whitener whitener = s.state.whitened_model(design).whitener;
  for (uint64_t k = 0; k < thresholds::pile_draws; ++k) {
    const WorldDraw draw = s.draws.draw(k, found.parameters, {});
    const VectorXd drawn = s.fit.readings.received(draw.drawn)(s.used),
                   expected = s.fit.readings.received(draw.expected)(s.used), error = drawn - expected;
    const noise::Whitened fitted =
        noise::whitened(whitener, s.state.rows().mean(error.array().isFinite().select(error, 0).matrix()), design,
                        s.state.options().prior);
    const VectorXd moved = design * fitted.basis.coefficients(fitted.basis.q.transpose() * fitted.y, design.cols());
    const VectorXd mean = expected + s.state.rows().at_readings(moved);
    std::vector<Eigen::Index> heard;
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
      if (std::isfinite(drawn[i]) && std::isfinite(mean[i])) heard.push_back(i);
    }
    if (heard.empty()) continue;
    Levels of_draw{mean(heard), {}, levels.shared, levels.own};
    for (const Eigen::Index i : heard) of_draw.cell.push_back(levels.cell[static_cast<std::size_t>(i)]);
    const Truncation end = truncation_at_the_end(drawn(heard), of_draw, found.receiver.step);
    if (end.evidence * thresholds::beyond_drawn >= evidence) return true;
  }
  return false;
}

}  // namespace

bool add_truncation(const LawSources& s, Diagnosis& found) {
  const std::vector<const Cause*> causes = clips_of(s, MUSTER_BELOW, true);
  if (causes.empty() || s.fit.missing.count > 0 || found.receiver.bottom) return false;
  const VectorXd heard = s.fit.readings.received(s.fit.readings.rssi)(s.used);
  const noise::Covariance& noise = s.state.fit.covariance;
  const double shared = noise.field_variance() * share_of_cells(s);
  const Levels levels{heard - (s.state.problem().measured - s.state.mean_of_readings()), cells_of(s), shared,
                      noise.field_variance() + noise.reading_variance() - shared};
  const double step = found.receiver.step;
  const Truncation end = truncation_at_the_end(heard, levels, step);
  const double least = std::log(s.state.options().further_alpha / static_cast<double>(s.state.entries().size()));
  const double evidence = thresholds::joint_loss * end.evidence;
  const bool by_the_world = clips_at(s, MUSTER_BELOW, true, end.floor, step);
  if (by_the_world && stated_floor_of(s)) return false;
  if (-evidence > least || !end.is_abrupt() || ends_by_itself(s, end.evidence, levels, found)) return false;
  found.end = end.floor;
  found.end_of_default = by_the_world;
  if (by_the_world) return false;
  add_clip(s, causes, end.floor, std::max(step, 0.02), true, {"", {}, 2 * evidence, evidence, -evidence}, found);
  return true;
}

void add_clips(const LawSources& s, Diagnosis& found) {
  const double step = found.receiver.step;
  for (const Cause* cause : causes_that(s, [](const Cause& c) { return c.plugin->clip != nullptr; }))
    found.searched.push_back(cause->id);
  if (found.receiver.top) add_pile(s, MUSTER_ABOVE, *found.receiver.top, step, found);
  if (found.receiver.bottom) add_pile(s, MUSTER_BELOW, *found.receiver.bottom, step, found);
  if (!found.receiver.bottom) add_silence(s, s.fit.missing, found);
}

bool add_silence_beside(const LawSources& s, const VectorXd& mean, Diagnosis& found) {
  const std::vector<const Cause*> floors = clips_of(s, MUSTER_BELOW, true);
  const auto is_floor = [&](const CauseEstimate& c) {
    return std::any_of(floors.begin(), floors.end(), [&](const Cause* floor) { return floor->id == c.id; });
  };
  if (s.fit.missing.count == 0 || found.receiver.bottom || !found.named() ||
      std::any_of(found.causes.begin(), found.causes.end(), is_floor))
    return false;
  const VectorXd& rssi = s.fit.readings.rssi;
  const Eigen::Array<bool, Eigen::Dynamic, 1> heard = !rssi.array().isNaN();
  const double squares = heard.select((rssi - mean).array().square(), 0).sum();
  const double sigma = std::sqrt(squares / static_cast<double>(heard.count()));
  const Readings& readings = s.fit.readings;
  return add_silence(s, missing_data(readings.received(rssi), readings.received(mean), sigma, stated_floor_of(s)),
                     found);
}

}  // namespace muster::diagnosis
