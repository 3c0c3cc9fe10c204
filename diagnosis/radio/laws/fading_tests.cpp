#include "diagnosis/radio/laws/fading_tests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/radio/laws/law_families.hpp"
#include "diagnosis/radio/laws/law_likelihood.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

constexpr std::array<uint32_t, 5> averages{1, 2, 3, 4, 6};  // fades in one reading
// Factor by which gains of clean worlds are wider than chi-square. Neighbouring readings share the error of their
// level, which a skewed law absorbs. In simulated fields of known shape a fading law's gain is 1.7 to 3.3 times as
// wide. Besides, no family of correlations matches the true field exactly. The misfit resembles fading of another
// strength most, and outliers least (346 clean worlds of 2,000 to 20,000 readings). A factor of 1.5 was too small:
// with readings of six averaged fades, gains of 22 and 23 were false in 55 further clean worlds.
double wider(const ReadingLaw& law) {
  return law.replaces() ? thresholds::fading_dispersion : thresholds::other_law_dispersion;
}
constexpr std::array<double, 3> noise_steps{0.1, 0.05, 0.025};        // of its logarithm
const double averaged_cost = std::log(thresholds::averaged_choices);  // nats: the stated law is of single fades

double cost_of(const ReadingDistribution& law) { return law.draws > 1 ? averaged_cost : 0; }

struct Fitted {
  Peak peak;
  ReadingDistribution base, law;  // without and with the effect
  double strength = 0;
};

// nats by which a count is off its Poisson mean.
double off_count(double seen, double expected) {
  expected = std::max(expected, 1e-3);
  return (seen > 0 ? seen * std::log(seen / expected) : 0) - (seen - expected);
}

double crossing(const std::function<double(double)>& value, double from, double to, double least) {
  for (int round = 0; round < 7; ++round) {
    const double middle = (from + to) / 2;
    (value(middle) > least ? from : to) = middle;
  }
  return (from + to) / 2;
}

class Tests {
 public:
  Tests(KrigedReadings& field, double step, const ReadingDistribution& stated, const noise::Covariance& fit)
      : judge_(field, step), stated_(stated), fit_(fit) {
    for (const uint32_t n : averages) {
      if (const auto law = averaged_over(stated, n)) bases_.push_back(*law);
    }
    starts_ = likely(judge_.shapes(stated, fit), thresholds::unlikely_shape_nats);
    take_bases_for_null();
    if (variance_of(stated, 0) < thresholds::steady_variance) add_noise();
    if (null_law_.noise > 0) return;
    for (Peak& start : starts_) start = judge_.closer_distance(stated, start);
    take_bases_for_null();
  }

  Fitted fitted(const LawFamily& family) {
    Fitted best;
    for (const ReadingDistribution& base : bases_) {  // coarse grid, at the null's field
      for (const double strength : family.strengths) {
        const auto law = family.with(base, strength);
        if (!law) continue;
        const double ratio = judge_.log_variance_of(*law) - judge_.log_variance_of(null_law_);
        Peak there = null_;
        there.place += LawLikelihood::places * static_cast<int>(std::lround(1e3 * ratio / LawLikelihood::places));
        there.value = judge_.about(*law, there) - cost_of(*law);
        if (there.value > best.peak.value) best = {there, base, *law, strength};
      }
    }
    return refined(family, best);
  }

  // Maximises over all fields. The first fields were fitted under the stated law, which holds the strength near the
  // stated one. Field and strength are now alternated until they converge. A gain for the stated law as well counts
  // for the null.
  Fitted settled(const LawFamily& family, Fitted best) {
    constexpr int rounds = 8;
    constexpr double no_more = 0.1;  // nats
    for (int round = 0; round < rounds; ++round) {
      const double before = best.peak.value;
      const auto likelier = [&](Peak peak) {
        peak.value -= cost_of(best.law);
        if (peak.value > best.peak.value) best.peak = peak;
      };
      for (const Peak& peak : judge_.shapes(best.law, fit_)) likelier(peak);
      likelier(judge_.closer_distance(best.law, best.peak));
      best = narrowed(family, best, 0.3);
      const Fitted here = best;
      for (const ReadingDistribution& base : bases_) try_one(family, best, here.strength, base, here.peak);
      best = with_its_noise(family, best);
      if (best.peak.value < before + no_more) break;
    }
    for (const ReadingDistribution& law : bases_) take_for_null(law, judge_.best_distance(law, best.peak));
    if (best.base.noise > 0) {
      const auto [law, peak] = with_likeliest_noise(best.base, judge_.best_distance(best.base, best.peak));
      take_for_null(law, peak);
    }
    return best;
  }

  const ReadingDistribution& stated() const { return null_law_; }
  // The stated law with the noise of the data, where the world states none.
  const ReadingDistribution& scattering() const { return bases_.back().noise > 0 ? bases_.back() : stated_; }
  double gain(const Fitted& fitted) const { return std::max(0.0, 2 * (fitted.peak.value - null_.value)); }

  // A mismatch of the field's family biases the fitted law. Differences of adjacent readings are free of the field,
  // and must not contradict the law.
  bool borne_out(const Fitted& fitted) {
    const CloseReadings close = judge_.field().close_readings();
    for (const LawPart& part : fitted.law.added) {
      if (part.law->is_heavy_tailed(part.params)) return has_its_far_ones(close, fitted.law, part);
    }
    const auto off = [&](const ReadingDistribution& law) {
      return std::pow((close.variance - variance_of(law, judge_.step())) / close.standard_error, 2) / 2;
    };
    return off(fitted.law) - off(null_law_) < thresholds::contradiction_nats;
  }

  // nats, of each reading.
  Eigen::VectorXd won(const Fitted& fitted) {
    return judge_.each(fitted.law, fitted.peak) - judge_.each(null_law_, null_);
  }

  // True if one reading carries most of the gain, or two that may be on the other side of a wall's end than said: these
  // are no law. Outliers that can just be told (lambda 60) are some ten readings.
  bool rests_on_few(const Fitted& fitted, const std::vector<bool>& unsure) {
    const Eigen::VectorXd won = this->won(fitted);
    std::vector<double> of_unsure{0, 0};
    for (Eigen::Index i = 0; i < won.size(); ++i) {
      if (!unsure.empty() && unsure[static_cast<std::size_t>(i)]) of_unsure.push_back(won[i]);
    }
    const auto few = of_unsure.begin() + thresholds::law_few;
    std::partial_sort(of_unsure.begin(), few, of_unsure.end(), std::greater<>());
    const double most = std::max(won.maxCoeff(), std::accumulate(of_unsure.begin(), few, 0.0));
    return most > thresholds::law_few_share * won.sum();
  }

  // The strength with its 95 % interval by profile likelihood, wider by the gain's factor.
  LawValue value(const LawFamily& family, const Fitted& best) {
    const double fall = thresholds::interval_nats * wider(*family.part.law);
    const auto value = [&](double x) {
      Fitted there{{}, best.base, best.law, x};
      try_one(family, there, x, best.base, best.peak);
      for (const ReadingDistribution& base : bases_) {
        if (base.draws == best.base.draws) try_one(family, there, x, base, best.peak);
      }
      return with_its_noise(family, there).peak.value;
    };
    const double least = best.peak.value - fall;
    const double a = family.reported(crossing(value, best.strength, best.strength / 3, least));
    const double b = family.reported(crossing(value, best.strength, best.strength * 3, least));
    return {family.name(), family.reported(best.strength), std::min(a, b), std::max(a, b)};
  }

 private:
  // Those at most that far behind the best.
  static std::vector<Peak> likely(std::vector<Peak> peaks, double nats) {
    const double most = std::max_element(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) {
                          return a.value < b.value;
                        })->value;
    std::erase_if(peaks, [&](const Peak& p) { return p.value < most - nats; });
    return peaks;
  }

  void take_bases_for_null() {
    for (const ReadingDistribution& law : bases_) {
      for (const Peak& start : starts_) take_for_null(law, judge_.best(law, start));
    }
  }

  // A few readings make up the variance of heavy tails, so that it says little. Where adjacent readings are seldom as
  // far apart as the law would have them, and as often as without it, its tails are the field's. Asked at the distance
  // that tells the two laws apart best, and beyond what a steep field does.
  bool has_its_far_ones(const CloseReadings& close, const ReadingDistribution& law, const LawPart& tails) const {
    const auto pairs = static_cast<double>(close.pairs);
    const ReadingsApart by_law(law, judge_.step(), close.apart), by_null(null_law_, judge_.step(), close.apart);
    const double extent = std::sqrt(tails.law->variance(tails.params, 1) / tails.law->beyond(tails.params, 0));
    double far = thresholds::far_in_tails * extent, most = 0;
    for (double db = far; db < thresholds::far_most; db += 1) {
      const double nats = off_count(pairs * by_law.beyond(db), pairs * by_null.beyond(db));
      if (by_law.beyond(db) > by_null.beyond(db) && nats > most) most = nats, far = db;
    }
    const auto seen = static_cast<double>((close.apart.array() > far).count());
    return off_count(seen, pairs * by_law.beyond(far)) - off_count(seen, pairs * by_null.beyond(far)) <
           thresholds::far_contradiction_nats;
  }

  void take_for_null(const ReadingDistribution& law, Peak peak) {
    peak.value -= cost_of(law);
    if (peak.value > null_.value) null_ = peak, null_law_ = law;
  }

  // Another null: the stated law with normal noise, of the likeliest size: sought about the one that differences of
  // adjacent readings say, or without such readings the one that was fitted to rows.
  void add_noise() {
    const CloseReadings told = judge_.field().close_readings();
    const double close = std::isfinite(told.standard_error) ? told.variance - judge_.step() * judge_.step() / 12
                                                            : fit_.reading_variance();
    if (!(close > thresholds::steady_variance)) return;
    ReadingDistribution noisy = stated_;
    noisy.noise = std::sqrt(close);
    const std::vector<Peak> starts = likely(judge_.shapes(noisy, fit_), thresholds::hopeless_shape_nats);
    Peak best;
    ReadingDistribution likeliest = noisy;
    for (const double factor : {0.35, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.35, 1.5, 1.8, 2.2}) {
      noisy.noise = std::sqrt(factor * close);
      for (const Peak& start : starts) {
        const Peak peak = judge_.best(noisy, start);
        if (peak.value > best.value) best = peak, likeliest = noisy;
      }
    }
    std::tie(likeliest, best) = with_likeliest_noise(likeliest, best);
    take_for_null(likeliest, best);
    if (null_law_.noise == 0) return;
    for (const double less : {0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {  // what is added takes a part of the noise
      bases_.push_back(likeliest);
      bases_.back().noise *= less;
    }
    starts_ = judge_.shapes(likeliest, fit_);
    for (const Peak& start : starts_) take_for_null(likeliest, start);
    starts_ = likely(std::move(starts_), thresholds::unlikely_shape_nats);
  }

  // A law's normal noise between the sizes that were tried and beyond them, with the field refitted. A law that is
  // tested has its noise refined, too, and what it gained by that alone would be false.
  std::pair<ReadingDistribution, Peak> with_likeliest_noise(ReadingDistribution law, Peak peak) {
    constexpr double no_more = 0.01;  // nats
    for (const double step : noise_steps) {
      for (const double by : {-step, step}) {
        for (bool gains = true; gains;) {
          ReadingDistribution next = law;
          next.noise *= std::exp(by);
          const Peak there = judge_.best(next, peak);
          gains = there.value > peak.value + no_more;
          if (gains) law = next, peak = there;
        }
      }
    }
    return {law, peak};
  }

  // Accepts the law and the field if they are jointly likelier.
  void try_one(const LawFamily& family, Fitted& best, double strength, const ReadingDistribution& base,
               const Peak& from) {
    const auto law = family.with(base, strength);
    if (!law) return;
    Peak peak = judge_.best(*law, from);
    peak.value -= cost_of(*law);
    if (peak.value > best.peak.value) best = {peak, base, *law, strength};
  }

  // Refines the strength by halving the grid's step.
  Fitted narrowed(const LawFamily& family, Fitted best, double step) {
    for (int round = 0; round < 4; ++round) {
      step /= 2;
      const Fitted here = best;
      for (const double by : {-step, step}) try_one(family, best, here.strength * std::exp(by), here.base, here.peak);
    }
    return best;
  }

  // Refines the noise beside the law: what is off by much is the rarer, the more scatters by itself.
  Fitted with_its_noise(const LawFamily& family, Fitted best) {
    if (best.base.noise == 0) return best;
    for (const double step : noise_steps) {
      const Fitted here = best;
      for (const double by : {-step, step}) {
        ReadingDistribution base = here.base;
        base.noise *= std::exp(by);
        try_one(family, best, here.strength, base, here.peak);
      }
    }
    return best;
  }

  // Refines at the best field of each shape.
  Fitted refined(const LawFamily& family, Fitted best) {
    const std::vector<double>& all = family.strengths;
    const auto at = std::find(all.begin(), all.end(), best.strength);
    if (at == all.end()) return best;  // the law has none of these strengths
    const double step = all.size() == 1       ? std::log(2)
                        : at + 1 != all.end() ? std::log(*(at + 1) / *at)
                                              : std::log(*at / *(at - 1));
    const int moved = best.peak.place - null_.place;
    best.peak.value = -1e300;
    for (const Peak& start : starts_) {
      Peak from = start;
      from.place += moved;
      try_one(family, best, best.strength, best.base, from);
    }
    return narrowed(family, best, step);
  }

  LawLikelihood judge_;
  ReadingDistribution stated_;
  noise::Covariance fit_;
  std::vector<ReadingDistribution> bases_;
  std::vector<Peak> starts_;
  Peak null_;
  ReadingDistribution null_law_;
};

// The gain without winsorising. Predictions use winsorised readings, so that an outlier affects no other reading.
// With rare deep fades their errors then vary less than under the law: by 6 to 8 % at K of 3 to 7 dB, where readings
// lie dense. A weaker law in a rougher field then fits better. A gain from this alone does not count. `null`: families
// that belong to the null, as there.
double gain_untamed(const KrigedReadings& field, double step, const ReadingDistribution& stated,
                    const noise::Covariance& fit, const LawFamily& family, const std::vector<const LawFamily*>& null) {
  KrigedReadings untamed = field.untamed();
  Tests tests(untamed, step, stated, fit);
  double of_null = 0;
  for (const LawFamily* other : null) of_null = std::max(of_null, tests.gain(tests.fitted(*other)));
  return std::max(0.0, tests.gain(tests.fitted(family)) - of_null);
}

}  // namespace

LawTests law_tests(KrigedReadings& field, double step, const std::vector<std::shared_ptr<const ReadingLaw>>& laws,
                   const ReadingDistribution& stated, const noise::Covariance& fit, const std::vector<bool>& unsure) {
  Tests tests(field, step, stated, fit);
  const std::vector<LawFamily> families = families_of(laws, tests.scattering());
  if (families.empty()) return {{}, tests.stated()};
  std::map<std::string, std::pair<const LawFamily*, Fitted>> best;  // by cause
  std::vector<std::pair<const LawFamily*, double>> values;
  for (const LawFamily& family : families) {
    const Fitted fitted = tests.fitted(family);
    values.emplace_back(&family, fitted.peak.value);
    const auto [entry, is_new] = best.try_emplace(family.cause(), &family, fitted);
    if (!is_new && fitted.peak.value > entry->second.second.peak.value) entry->second = {&family, fitted};
  }
  std::map<std::string, std::vector<const LawFamily*>> as_likely;
  for (const auto& [family, value] : values) {
    if (value > best.at(family->cause()).second.peak.value - thresholds::interval_nats)
      as_likely[family->cause()].push_back(family);
  }
  for (auto& [cause, found] : best) {
    if (tests.gain(found.second) > thresholds::closer_look_gain)
      found.second = tests.settled(*found.first, found.second);
  }
  const auto weigh = [&](LawTest& test, double gain) {  // p-value of a gain, over the tried forms
    const auto forms = static_cast<double>(
        std::count_if(families.begin(), families.end(), [&](const LawFamily& f) { return f.cause() == test.cause; }));
    test.gain = gain;
    test.log_p = std::log(forms) + inference::log_tail(gain / wider(*best.at(test.cause).first->part.law), 1);
    test.evidence = gain / 2 - std::log(static_cast<double>(field.judged().size())) / 2 - std::log(forms);
  };
  // Where no law is stated, any that could replace it belongs to the null.
  double of_null = 0;
  std::vector<const LawFamily*> null;
  for (const auto& [cause, found] : best) {
    if (stated.base.law || !found.first->part.law->replaces()) continue;
    of_null = std::max(of_null, tests.gain(found.second));
    null.push_back(found.first);
  }
  std::vector<LawTest> result;
  for (const auto& [cause, found] : best) {
    const auto& [family, fitted] = found;
    LawTest test{cause, {}, 0, 0, 0, fitted.law};
    const double beyond = family->part.law->replaces() ? 0 : of_null;
    weigh(test, tests.borne_out(fitted) && !tests.rests_on_few(fitted, unsure)
                    ? std::max(0.0, tests.gain(fitted) - beyond)
                    : 0);
    result.push_back(std::move(test));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const LawTest& a, const LawTest& b) { return a.evidence > b.evidence; });
  const auto& [family, fitted] = best.at(result.front().cause);
  result.front().won = tests.won(fitted);
  // The second test, without winsorising, only raises log p. What a law with heavy tails adds needs winsorising, and is
  // no weaker fading.
  const ReadingLaw& likeliest = *family->part.law;
  const bool heavy =
      !likeliest.replaces() && likeliest.is_heavy_tailed(likeliest.at_strength(family->part.params, fitted.strength));
  if (result.front().log_p < std::log(thresholds::may_be_named) && !heavy) {
    if (likeliest.replaces()) null.clear();
    const double untamed = gain_untamed(field, step, stated, fit, *family, null);
    const double over = std::max(0.0, result.front().gain - untamed);
    for (LawTest& test : result) weigh(test, std::max(0.0, test.gain - over));  // differences are kept
  }
  result.front().values = family->beside;
  for (LawValue& value : result.front().values) {  // over equally likely forms
    for (const LawFamily* form : as_likely[family->cause()]) {
      const LawValue& other = form->beside[static_cast<std::size_t>(&value - result.front().values.data())];
      value.lower95 = std::min(value.lower95, other.lower95);
      value.upper95 = std::max(value.upper95, other.upper95);
    }
  }
  if (result.front().gain > 0)
    result.front().values.insert(result.front().values.begin(), tests.value(*family, fitted));
  return {result, tests.stated()};
}

}  // namespace muster::diagnosis
