// A diagnosis in words: what each figure is called, how many digits it bears, and what may be said of a cause.
#pragma once

#include <string>

#include "diagnosis/result.hpp"

namespace muster::report {

using diagnosis::CauseEstimate;
using diagnosis::CauseValue;
using diagnosis::Diagnosis;

// How sure a cause is. "Is" is said of a confirmed one only.
enum class Standing {
  confirmed = 1,  // named, and its gain at places not seen is above zero with 95 %
  unconfirmed,    // named, but places not seen do not show it, or there are too few
  set_aside       // found, and not beyond chance beside the others
};
Standing standing_of(const CauseEstimate& cause);
// Blocks that all gain by chance alone in one of 32 cases: an interval over fewer is none of 95 %.
constexpr int fewest_blocks = 5;
// Of a cause that what was held out does not confirm.
std::string why_unconfirmed(const CauseEstimate& cause);
// Why no gain stands beside a cause that has none.
std::string why_no_gain(const CauseEstimate& cause);
constexpr const char* too_few_blocks = "not measured: too few blocks of space";

double tenths(double value);              // to one decimal, without a zero's sign
std::string judged(double separability);  // "cannot be told apart", "weakly told apart", "told apart"

// With as many digits as its half interval gives a meaning to; without one, four.
std::string rounded(double value, double half_interval);
// "8.56 dB"; radians as degrees.
std::string quantity(double value, double half_interval, const std::string& unit);
std::string quantity(const CauseValue& value);
// "8.25 to 8.87 dB", or "no interval".
std::string interval(const CauseValue& value);
std::string with_sign(double value, int decimals);

// The cause's title with its slots filled.
std::string sentence(const CauseEstimate& cause);
// "effect.drift" as people say it: "drift"; "unmapped wall".
std::string short_name(const std::string& id);
// What a covariate's name stands for: "logd" is "distance".
std::string covariate_in_words(const std::string& name);
// "obstacle (2.0, 1.5), 1.5 nats behind, D 6: cannot be told apart", one after the other; or that there are none.
std::string rivals_in_words(const std::vector<inference::Alternative>& alternatives);
// "Something depends on the column battery ...", with what it wins and the causes that explain it nearly as well.
std::string what_is_unexplained(const diagnosis::Unexplained& what);
// "finds nothing more"; "still finds drift tx1, something along the column battery".
std::string what_is_found_again(const std::vector<diagnosis::Told>& told);
// "p < 1e-9", "p = 0.03", from a logarithm.
std::string chance(double log_p);

// One line, without the world's name: "is adequate: ...".
std::string verdict_in_words(const Diagnosis& diagnosis);
// dB that noise alone leaves of one row's mean, wherever it lies.
double noise_floor(const Diagnosis& diagnosis);
// "6.28 dB"
std::string db(double value);
// "places", or "distances" where the data have no places.
std::string what_is_held_out(const Diagnosis& diagnosis);
// What the world errs by with radios and runs not seen; empty where there are not several.
std::string errors_elsewhere(const Diagnosis& diagnosis);
// How readings were gathered to rows.
std::string rows_in_words(const Diagnosis& diagnosis);
// What the report counts in, for who has not read docs/how-to/read_a_report.md.
std::string words_explained();
// Without held-out blocks: why there are none.
std::string why_no_blocks(const Diagnosis& diagnosis);

int count_of(const Diagnosis& diagnosis, Standing standing);

}  // namespace muster::report
