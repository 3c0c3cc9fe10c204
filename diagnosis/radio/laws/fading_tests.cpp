#include "diagnosis/radio/laws/fading_tests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/radio/laws/law_likelihood.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

constexpr std::array averages{1, 2, 3, 4, 6};  // fades in one reading
// Factor by which gains of clean worlds are wider than chi-square. Neighbouring readings share the error of their
// level, which a skewed law absorbs. In simulated fields of known shape a fading law's gain is 1.7 to 3.3 times as
// wide. Besides, no family of correlations matches the true field exactly. The misfit resembles fading of another
// strength most, and outliers least (346 clean worlds of 2,000 to 20,000 readings). A factor of 1.5 was too small:
// with readings of six averaged fades, gains of 22 and 23 were false in 55 further clean worlds.
double wider(const std::string& cause) {
  return cause == "effect.fading_law" ? thresholds::fading_dispersion : thresholds::other_law_dispersion;
}
const double averaged_cost = std::log(thresholds::averaged_choices);  // nats: the stated law is of single fades

ReadingDistribution averaged_over(ReadingDistribution law, int n) {
  const double variance = fading_variance(law.rician_k, law.averaged);
  law.averaged = n;
  if (n > 1) law.rician_k = rician_k_of(variance, n);
  return law;
}

bool possible(const ReadingDistribution& law) { return !std::isnan(law.rician_k); }

double cost_of(const ReadingDistribution& law) { return law.averaged > 1 ? averaged_cost : 0; }

// A law with one strength parameter.
struct Family {
  std::string cause, name;
  std::vector<double> strengths;
  std::function<ReadingDistribution(ReadingDistribution, double)> with;
  std::function<double(double)> reported;  // the reported value of a strength
  std::vector<LawValue> beside;
};

struct Fitted {
  Peak peak;
  ReadingDistribution base, law;  // without and with the effect
  double strength = 0;
};

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
    for (const int n : averages) {
      const ReadingDistribution law = averaged_over(stated, n);
      if (possible(law)) bases_.push_back(law);
    }
    starts_ = judge_.shapes(stated, fit);
    const double most = std::max_element(starts_.begin(), starts_.end(), lower)->value;
    starts_.erase(std::remove_if(starts_.begin(), starts_.end(),
                                 [&](const Peak& p) { return p.value < most - thresholds::unlikely_shape_nats; }),
                  starts_.end());
    for (Peak& start : starts_) start = judge_.closer_distance(stated, start);
    for (const ReadingDistribution& law : bases_) {
      for (const Peak& start : starts_) take_for_null(law, judge_.best(law, start));
    }
  }

  Fitted fitted(const Family& family) {
    Fitted best;
    for (const ReadingDistribution& base : bases_) {  // coarse grid, at the null's field
      for (const double strength : family.strengths) {
        const ReadingDistribution law = family.with(base, strength);
        if (!possible(law)) continue;
        const double ratio = std::log(variance_of(law, judge_.step()) / variance_of(base, judge_.step()));
        Peak there = null_;
        there.place += LawLikelihood::places * static_cast<int>(std::lround(1e3 * ratio / LawLikelihood::places));
        there.value = judge_.about(law, there) - cost_of(law);
        if (there.value > best.peak.value) best = {there, base, law, strength};
      }
    }
    return refined(family, best);
  }

  // Maximises over all fields. The first fields were fitted under the stated law, which holds the strength near the
  // stated one. Field and strength are now alternated until they converge. A gain for the stated law as well counts
  // for the null.
  Fitted settled(const Family& family, Fitted best) {
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
      if (best.peak.value < before + no_more) break;
    }
    for (const ReadingDistribution& law : bases_) take_for_null(law, judge_.best_distance(law, best.peak));
    return best;
  }

  const ReadingDistribution& stated() const { return null_law_; }
  double gain(const Fitted& fitted) const { return std::max(0.0, 2 * (fitted.peak.value - null_.value)); }

  // A mismatch of the field's family biases the fitted law. Differences of adjacent readings are free of the field,
  // and must not contradict the law.
  bool borne_out(const Fitted& fitted) {
    const CloseReadings close = judge_.field().close_readings();
    const auto off = [&](const ReadingDistribution& law) {
      return std::pow((close.variance - variance_of(law, judge_.step())) / close.standard_error, 2) / 2;
    };
    return off(fitted.law) - off(null_law_) < thresholds::contradiction_nats;
  }

  // The strength with its 95 % interval by profile likelihood, wider by the gain's factor.
  LawValue value(const Family& family, const Fitted& best) {
    const double fall = thresholds::interval_nats * wider(family.cause);
    const auto value = [&](double x) {
      const ReadingDistribution law = family.with(best.base, x);
      return possible(law) ? judge_.best(law, best.peak).value - cost_of(law) : -1e300;
    };
    const double least = best.peak.value - fall;
    const double a = family.reported(crossing(value, best.strength, best.strength / 3, least));
    const double b = family.reported(crossing(value, best.strength, best.strength * 3, least));
    return {family.name, family.reported(best.strength), std::min(a, b), std::max(a, b)};
  }

 private:
  static bool lower(const Peak& a, const Peak& b) { return a.value < b.value; }

  void take_for_null(const ReadingDistribution& law, Peak peak) {
    peak.value -= cost_of(law);
    if (peak.value > null_.value) null_ = peak, null_law_ = law;
  }

  // Accepts the law and the field if they are jointly likelier.
  void try_one(const Family& family, Fitted& best, double strength, const ReadingDistribution& base, const Peak& from) {
    const ReadingDistribution law = family.with(base, strength);
    if (!possible(law)) return;
    Peak peak = judge_.best(law, from);
    peak.value -= cost_of(law);
    if (peak.value > best.peak.value) best = {peak, base, law, strength};
  }

  // Refines the strength by halving the grid's step.
  Fitted narrowed(const Family& family, Fitted best, double step) {
    for (int round = 0; round < 4; ++round) {
      step /= 2;
      const Fitted here = best;
      for (const double by : {-step, step}) try_one(family, best, here.strength * std::exp(by), here.base, here.peak);
    }
    return best;
  }

  // Refines at the best field of each shape.
  Fitted refined(const Family& family, Fitted best) {
    const auto at = std::find(family.strengths.begin(), family.strengths.end(), best.strength);
    const double step = at + 1 != family.strengths.end() ? std::log(*(at + 1) / *at) : std::log(*at / *(at - 1));
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

std::vector<Family> families_of(const ReadingDistribution& stated) {
  const double variance = std::max(fading_variance(stated.rician_k, stated.averaged), 0.05);
  std::vector<double> variances;
  for (const double f : {0.2, 0.35, 0.5, 0.65, 0.78, 0.88, 1.13, 1.28, 1.5, 1.8, 2.3, 3.2, 5.0})
    variances.push_back(variance * f);
  std::vector<Family> result;
  result.push_back({"effect.fading_law",
                    "rician_k",
                    variances,
                    [](ReadingDistribution law, double v) {
                      law.rician_k = rician_k_of(v, law.averaged);
                      return law;
                    },
                    [](double v) {
                      const double k = rician_k_of(v, 1);
                      return std::isnan(k) ? (v > 20 ? -40 : 60) : k;
                    },
                    {}});
  for (const double width : {12.0, 20.0, 30.0}) {
    result.push_back({"effect.outliers",
                      "share",
                      {0.001, 0.003, 0.006, 0.012, 0.025, 0.05, 0.1},
                      [width](ReadingDistribution law, double share) {
                        law.outliers = std::min(share, 0.9);
                        law.half_width = width;
                        return law;
                      },
                      [](double share) { return share; },
                      {{"half_width", width, width / 1.4, width * 1.3}}});
  }
  for (const int channels : {2, 3, 4}) {
    const double count = channels;
    result.push_back({"effect.channel_mixture",
                      "sd",
                      {0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5.6},
                      [channels](ReadingDistribution law, double sd) {
                        law.channel_sd = sd;
                        law.channels = channels;
                        return law;
                      },
                      [](double sd) { return sd; },
                      {{"channels", count, count, count}}});
  }
  return result;
}

// The gain without winsorising. Predictions use winsorised readings, so that an outlier affects no other reading.
// With rare deep fades their errors then vary less than under the law: by 6 to 8 % at K of 3 to 7 dB, where readings
// lie dense. A weaker law in a rougher field then fits better. A gain from this alone does not count.
double gain_untamed(const KrigedReadings& field, double step, const ReadingDistribution& stated,
                    const noise::Covariance& fit, const Family& family) {
  KrigedReadings untamed = field.untamed();
  Tests tests(untamed, step, stated, fit);
  return tests.gain(tests.fitted(family));
}

}  // namespace

LawTests law_tests(KrigedReadings& field, double step, const ReadingDistribution& stated,
                   const noise::Covariance& fit) {
  Tests tests(field, step, stated, fit);
  const std::vector<Family> families = families_of(stated);
  std::map<std::string, std::pair<const Family*, Fitted>> best;  // by cause
  std::vector<std::pair<const Family*, double>> values;
  for (const Family& family : families) {
    const Fitted fitted = tests.fitted(family);
    values.emplace_back(&family, fitted.peak.value);
    const auto [entry, is_new] = best.try_emplace(family.cause, &family, fitted);
    if (!is_new && fitted.peak.value > entry->second.second.peak.value) entry->second = {&family, fitted};
  }
  std::map<std::string, std::vector<const Family*>> as_likely;
  for (const auto& [family, value] : values) {
    if (value > best.at(family->cause).second.peak.value - thresholds::interval_nats)
      as_likely[family->cause].push_back(family);
  }
  for (auto& [cause, found] : best) {
    if (tests.gain(found.second) > thresholds::closer_look_gain)
      found.second = tests.settled(*found.first, found.second);
  }
  const auto weigh = [&](LawTest& test, double gain) {  // p-value of a gain, over the tried forms
    const auto forms = static_cast<double>(
        std::count_if(families.begin(), families.end(), [&](const Family& f) { return f.cause == test.cause; }));
    test.gain = gain;
    test.log_p = std::log(forms) + inference::log_tail(gain / wider(test.cause), 1);
    test.evidence = gain / 2 - std::log(static_cast<double>(field.size())) / 2 - std::log(forms);
  };
  std::vector<LawTest> result;
  for (const auto& [cause, found] : best) {
    const auto& [family, fitted] = found;
    LawTest test{cause, {}, 0, 0, 0, fitted.law};
    weigh(test, tests.borne_out(fitted) ? tests.gain(fitted) : 0);
    result.push_back(std::move(test));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const LawTest& a, const LawTest& b) { return a.evidence > b.evidence; });
  const auto& [family, fitted] = best.at(result.front().cause);
  // The second test, without winsorising, only raises log p.
  if (result.front().log_p < std::log(thresholds::may_be_named) && family->cause != "effect.outliers") {
    const double untamed = gain_untamed(field, step, stated, fit, *family);
    const double over = std::max(0.0, result.front().gain - untamed);
    for (LawTest& test : result) weigh(test, std::max(0.0, test.gain - over));  // differences are kept
  }
  result.front().values = family->beside;
  for (LawValue& value : result.front().values) {  // over equally likely forms
    for (const Family* form : as_likely[family->cause]) {
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
