// Wording of a diagnosis: names of figures, significant digits, and statements on a cause.
#pragma once

#include <string>

#include "diagnosis/result.hpp"

namespace muster::report {

using diagnosis::CauseEstimate;
using diagnosis::CauseValue;
using diagnosis::Diagnosis;

// Certainty of a cause. The report uses "is" only for a confirmed one.
enum class Confidence {
  confirmed = 1,  // named, and its held-out gain is above zero with 95 %
  unconfirmed,    // named, but held-out places do not confirm it, or are too few
  set_aside       // found, but not significant beside the others
};
Confidence confidence_of(const CauseEstimate& cause);
// All of five blocks gain by chance in one of 32 cases: fewer give no 95 % interval.
constexpr int fewest_blocks = 5;
// Reason why a cause is not confirmed by held-out data.
std::string why_unconfirmed(const CauseEstimate& cause);
// Reason why a cause has no gain.
std::string why_no_gain(const CauseEstimate& cause);
// Reason why something unexplained has no gain.
std::string why_no_gain_of_rest(const Diagnosis& diagnosis);
constexpr const char* too_few_blocks = "not measured: too few blocks of space";

double tenths(double value);                  // to one decimal, never -0.0
std::string judged(double separability);      // "not distinguishable", "weakly distinguishable", "distinguishable"
std::string d_in_words(double separability);  // "6", or "not worked out"

// Rounded to the digits justified by its half interval; without one, to four.
std::string rounded(double value, double half_interval);
// "8.56 dB"; radians as degrees.
std::string quantity(double value, double half_interval, const std::string& unit);
std::string quantity(const CauseValue& value);
// "8.25 to 8.87 dB", or "no interval".
std::string interval(const CauseValue& value);
std::string with_sign(double value, int decimals);

// The cause's title with its slots filled.
std::string sentence(const CauseEstimate& cause);
// Short name for readers, "drift" for "effect.drift"; "unmapped wall".
std::string short_name(const std::string& id);
// Name of a covariate for readers: "distance" for "logd".
std::string covariate_in_words(const std::string& name);
// "obstacle (2.0, 1.5), 1.5 nats behind, D 6: not distinguishable", for each alternative ("ahead" where it is
// likelier); or that there are none.
std::string rivals_in_words(const std::vector<inference::Alternative>& alternatives);
// The same of a named cause, of which a law of scatter has none that were compared with it.
std::string rivals_in_words(const CauseEstimate& cause);
// True for an alternative that is named beside the cause: the readings tell neither from the other.
bool is_in_headline(const inference::Alternative& alternative);
// "effect.dual_slope", or with the causes that these readings cannot tell from it:
// "effect.dual_slope or effect.rssi_compression (the readings do not tell which)".
std::string names_of(const CauseEstimate& cause);

// "Noise: shadowing of 3.10 dB that decorrelates over 2.40 m (exponential correlation), and 1.20 dB a reading."
// `time_unit`: that of the diagnosis.
std::string noise_in_words(const noise::Covariance& noise, double time_unit);
// "Something depends on the column battery ...", with its gain and the causes that explain it nearly as well.
std::string what_is_unexplained(const diagnosis::Unexplained& what);
// "shows nothing more"; "still shows drift tx1, something along the column battery".
std::string rediagnosis_in_words(const std::vector<diagnosis::NamedCause>& told);
// "p < 1e-9", "p = 0.03", from a logarithm.
std::string chance(double log_p);

// "34 blocks".
std::string held_out_in_words(const inference::HeldOutGain& gain, const std::string& left_out);

// Of gains below 0, on what was held out.
std::string no_gain_in_words(const std::string& held_out);

// True of a gain below 0 beyond chance: with 95 %.
bool is_refuted(const inference::HeldOutGain& gain);
// Of such ones, on what was held out.
std::string loss_in_words(const std::string& held_out);

// A gain on held-out data; of one below 0 that it is none.
std::string gain_in_words(const inference::HeldOutGain& gain, const std::string& left_out);

// One line, without the world's name: "is adequate: ...".
std::string verdict_in_words(const Diagnosis& diagnosis);
// What one station cannot see, and where a second one would.
std::string one_station_in_words(const diagnosis::OneStation& seen);
// dB: error of a reading from noise alone, in data to which this world was fitted. Not a number where no search was
// made.
double noise_floor(const Diagnosis& diagnosis);
// "6.28 dB"
std::string db(double value);
// "places", or "distances" for data without places.
std::string what_is_held_out(const Diagnosis& diagnosis);
// "the causes below", or other words where none of it is a cause.
std::string what_was_found(const Diagnosis& diagnosis);
// Errors of the world on held-out radios and runs; empty unless there are several.
std::string errors_elsewhere(const Diagnosis& diagnosis);
// The averaging of readings to rows, as text.
std::string rows_in_words(const Diagnosis& diagnosis);
// The report's units, for readers without docs/how-to/read_a_report.md.
std::string words_explained();
// Reason why there are no held-out blocks.
std::string why_no_blocks(const Diagnosis& diagnosis);

int count_of(const Diagnosis& diagnosis, Confidence confidence);

}  // namespace muster::report
