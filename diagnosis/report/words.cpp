#include "diagnosis/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::report {
namespace {

constexpr double degrees = 180 / M_PI;

double half_of(const CauseValue& v) { return (v.upper95 - v.lower95) / 2; }

// Decimals that show the first digit of the half interval, and the second if the first is 1 or 2.
int decimals_for(double half) {
  if (!(half > 0) || !std::isfinite(half)) return -1;
  const int first = -static_cast<int>(std::floor(std::log10(half)));
  return std::clamp(first + (half * std::pow(10, first) < 3 ? 1 : 0), 0, 6);
}

std::string plain(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_not_of("-0.") == text.npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

const std::string all_radios = "all radios";

// What stands in a sentence for `slot`: "offset", or "offset|too high|too low", of which one is said by the sign.
std::string slot_value(const CauseEstimate& cause, const std::string& slot) {
  const auto bar = slot.find('|'), next = slot.find('|', bar + 1);
  for (CauseValue v : cause.values) {
    if (v.name != slot.substr(0, bar)) continue;
    if (bar == slot.npos) return quantity(v);
    const bool less = v.value < 0;
    v.value = std::abs(v.value);
    return quantity(v) + ' ' + (less ? slot.substr(next + 1) : slot.substr(bar + 1, next - bar - 1));
  }
  if (const auto other = cause.words.find(slot); other != cause.words.end()) return other->second;
  return cause.row.empty() ? all_radios : cause.row;
}

std::string with_label(const std::string& id, const std::string& label) {
  return short_name(id) + (label.empty() || label == id || label == "all" ? "" : " " + label);
}

// True for a cause without a level shift.
bool is_law(const CauseEstimate& cause) { return cause.covariates == std::vector<std::string>{"reading"}; }

}  // namespace

Confidence confidence_of(const CauseEstimate& cause) {
  if (cause.status != inference::Status::named) return Confidence::set_aside;
  if (!cause.doubt.empty()) return Confidence::unconfirmed;
  // A law has no level error at places to confirm it: its evidence is the distribution of readings itself.
  if (is_law(cause)) return Confidence::confirmed;
  const bool gains = cause.held_out && cause.held_out->lower95 > 0 && cause.held_out->blocks >= fewest_blocks;
  return gains ? Confidence::confirmed : Confidence::unconfirmed;
}

std::string why_unconfirmed(const CauseEstimate& cause) {
  if (!cause.held_out) return "no data could be held out";
  if (is_refuted(*cause.held_out)) return "the error at what was held out is larger with it";
  if (cause.held_out->blocks >= fewest_blocks && !(cause.held_out->lower95 > 0))
    return "the interval of the gain includes 0";
  return fmt::format("the gain in {} blocks of space may be chance", cause.held_out->blocks);
}

std::string why_no_gain(const CauseEstimate& cause) {
  if (cause.status != inference::Status::named) return "not measured: not significant beside the other causes";
  return is_law(cause) ? "none: judged by how readings are distributed, not by their mean" : too_few_blocks;
}

std::string why_no_gain_of_rest(const Diagnosis& d) {
  return d.held_out ? "not measured: stronger findings may leave as much behind" : too_few_blocks;
}

int count_of(const Diagnosis& d, Confidence confidence) {
  return static_cast<int>(std::count_if(d.causes.begin(), d.causes.end(),
                                        [&](const CauseEstimate& c) { return confidence_of(c) == confidence; }));
}

double tenths(double value) { return std::round(10 * value) / 10 + 0.0; }

std::string judged(double separability) {
  return separability < inference::thresholds::inseparable ? "not distinguishable"
         : separability < inference::thresholds::decided   ? "weakly distinguishable"
                                                           : "distinguishable";
}

std::string d_in_words(double separability) {
  return std::isnan(separability) ? "not worked out" : fmt::format("{:.0f}", separability);
}

std::string rounded(double value, double half) {
  const int decimals = decimals_for(half);
  return decimals < 0 ? fmt::format("{:.4g}", value) : plain(value, decimals);
}

std::string quantity(double value, double half, const std::string& unit) {
  if (unit == "rad") return rounded(value * degrees, half * degrees) + " deg";
  return rounded(value, half) + (unit.empty() ? "" : " " + unit);
}

std::string quantity(const CauseValue& v) { return quantity(v.value, half_of(v), v.unit); }

std::string interval(const CauseValue& v) {
  if (!(half_of(v) > 0)) return "no interval";
  const double scale = v.unit == "rad" ? degrees : 1;
  const int decimals = decimals_for(half_of(v) * scale);
  const std::string unit = v.unit == "rad" ? "deg" : v.unit;
  return plain(v.lower95 * scale, decimals) + " to " + plain(v.upper95 * scale, decimals) +
         (unit.empty() ? "" : " " + unit);
}

std::string with_sign(double value, int decimals) { return (value < 0 ? "" : "+") + plain(value, decimals); }

std::string sentence(const CauseEstimate& cause) {
  std::string text;
  for (std::size_t k = 0; k < cause.title.size(); ++k) {
    const auto end = cause.title[k] == '{' ? cause.title.find('}', k) : std::string::npos;
    if (end == std::string::npos) {
      text += cause.title[k];
      continue;
    }
    const std::string value = slot_value(cause, cause.title.substr(k + 1, end - k - 1));
    text += value == all_radios && text.find(value) != text.npos ? "each other" : value;
    k = end;
  }
  return text;
}

std::string short_name(const std::string& id) {
  std::string name = id.substr(id.find('.') + 1);
  if (!id.empty() && id[0] == '~') return "something along " + covariate_in_words(id.substr(1));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string covariate_in_words(const std::string& name) {
  static const std::map<std::string, std::string> words = {
      {"logd", "distance"},
      {"bearing", "the other radio's bearing, seen from the heading of the one that moves"},
      {"heading", "the heading of the radio that moves"},
      {"height", "the height of the radio that moves"},
      {"txbearing", "the direction from each transmitter"},
      {"position", "the place in the plan"},
      {"map", "the place in the plan"},
      {"time", "time"},
      {"time_per_tx", "time, for each transmitter by itself"},
      {"link", "the link"},
      {"level", "the level itself"}};
  if (const auto known = words.find(name); known != words.end()) return known->second;
  const auto star = name.find('*');
  if (star == name.npos) return "the column " + name;
  const std::string first = name.substr(0, star), second = name.substr(star + 1);
  return (words.count(first) ? words.at(first) : "the column " + first) + " together with " +
         (words.count(second) ? words.at(second) : second);
}

namespace {

// "as likely", "5.0 times less likely (1.6 nats)"; `gap`: nats that it is behind.
std::string likelihood_in_words(double gap) {
  const double nats = std::abs(tenths(gap)), times = std::exp(nats);
  if (nats == 0) return "as likely";
  const std::string factor = times < 10     ? fmt::format("{:.1f}", times)
                             : times < 1000 ? fmt::format("{:.0f}", times)
                                            : "over 1000";
  return fmt::format("{} times {} ({:.1f} nats)", factor, gap < 0 ? "likelier" : "less likely", nats);
}

}  // namespace

std::string rivals_in_words(const CauseEstimate& cause) {
  return is_law(cause) && cause.alternatives.empty()
             ? "none of its kind; a law of scatter is not compared with what shifts levels"
             : rivals_in_words(cause.alternatives);
}

namespace {

// Where the price of places and strengths alone decides, the readings had no part in it.
std::string judged(const inference::Alternative& r) {
  const bool by_price = r.separability < inference::thresholds::inseparable &&
                        r.evidence_gap >= inference::thresholds::open_nats &&
                        r.by_readings < inference::thresholds::open_nats;
  return report::judged(r.separability) + (by_price ? " by the readings, but less likely before them" : "");
}

}  // namespace

std::string rivals_in_words(const std::vector<inference::Alternative>& alternatives) {
  if (alternatives.empty()) return "none: the readings exclude all other causes";
  std::string out;
  for (const inference::Alternative& r : alternatives)
    out += fmt::format("{}{}, {}{}", out.empty() ? "" : "; ", with_label(r.id, r.label),
                       likelihood_in_words(r.evidence_gap),
                       std::isnan(r.separability) ? "" : fmt::format(", D {:.0f}: {}", r.separability, judged(r)));
  return out;
}

std::string noise_in_words(const noise::Covariance& noise, double time_unit) {
  static const std::map<noise::Family, std::string> shapes{
      {noise::Family::exponential, "exponential correlation"},
      {noise::Family::matern32, "Matern correlation of 3/2"},
      {noise::Family::matern52, "Matern correlation of 5/2"},
      {noise::Family::two_scale, "a correlation of two scales"},
      {noise::Family::gaussian, "Gaussian correlation"},
      {noise::Family::stated, "the correlation that the world states"}};
  const double fixed = noise::fixed_share(noise.family);
  std::string kept;
  if (time_unit > 0)
    return fmt::format(
        "Noise: levels of links, {} apart ({} between both ways of one); each wanders by {}, which decorrelates "
        "over {:.3g} s ({}); and {} a reading.",
        db(std::sqrt(fixed * noise.field_variance())),
        db(std::sqrt(2 * noise::stream_part(noise.family) * fixed * noise.field_variance())),
        db(std::sqrt((1 - fixed) * noise.field_variance())), noise.decorrelation() * time_unit,
        shapes.at(noise::without_fixed(noise.family)), db(std::sqrt(noise.reading_variance())));
  if (fixed > 0)
    kept = fmt::format(", {:.0f} % of its variance kept at a place{}", 100 * fixed,
                       noise::stream_part(noise.family) == 1 ? ", each way of a link by itself" : "");
  return fmt::format("Noise: shadowing of {} that decorrelates over {:.2f} m ({}{}), and {} a reading.",
                     db(std::sqrt(noise.field_variance())), noise.decorrelation(),
                     shapes.at(noise::without_fixed(noise.family)), kept, db(std::sqrt(noise.reading_variance())));
}

bool is_in_headline(const inference::Alternative& r) {
  return !(r.separability >= inference::thresholds::inseparable) && r.evidence_gap < inference::thresholds::open_nats &&
         r.id[0] != '~';
}

std::string names_of(const CauseEstimate& cause) {
  std::string names = cause.id;
  std::set<std::string> said{cause.id};
  for (const inference::Alternative& r : cause.alternatives) {
    if (is_in_headline(r) && said.insert(r.id).second) names += " or " + r.id;
  }
  return said.size() == 1 ? names : names + " (the readings do not tell which)";
}

std::string what_is_unexplained(const diagnosis::Unexplained& what) {
  const std::string won = fmt::format("evidence {:.1f} nats, lambda {:.0f}.", what.evidence, what.lambda);
  const std::string on = "The residual depends on " + covariate_in_words(what.covariate) +
                         (what.reach > 0 ? fmt::format(", by up to {:.1f} dB", what.reach) : "");
  if (what.alternatives.empty()) return on + ", and no cause on the plugin path explains it: " + won;
  return on + ": " + won + " Causes that explain it nearly as well: " + rivals_in_words(what.alternatives) + ".";
}

std::string rediagnosis_in_words(const std::vector<diagnosis::NamedCause>& told) {
  if (told.empty()) return "shows nothing more";
  std::string list;
  for (const diagnosis::NamedCause& t : told) list += (list.empty() ? "" : ", ") + with_label(t.id, t.label);
  return "still shows " + list;
}

std::string chance(double log_p) {
  const double p = std::exp(std::min(log_p, 0.0));
  if (p < 1e-9) return "p < 1e-9";
  return p >= 0.995 ? "p = 1" : fmt::format("p = {:.2g}", p);
}

std::string one_station_in_words(const diagnosis::OneStation& seen) {
  std::string text =
      fmt::format("only {0} sees it, which shows its width but not its distance: {1:.1f} to {2:.1f} m from {0}",
                  seen.radio, seen.nearest, seen.farthest);
  if (!seen.second) return text + ". Measure from a second station.";
  return text + fmt::format(". Put a second station at ({:.1f}, {:.1f}), which sees that range from the side.",
                            seen.second->x(), seen.second->y());
}

double noise_floor(const Diagnosis& d) {
  if (d.seen.count.size() == 0) return std::nan("");
  return std::sqrt(d.seen.noise_variance);
}

std::string held_out_in_words(const inference::HeldOutGain& h, const std::string& left_out) {
  return fmt::format("{} {}", h.blocks, left_out);
}

std::string no_gain_in_words(const std::string& held_out) {
  return "none to be seen: held-out data neither confirm nor refute it (" + held_out + ")";
}

bool is_refuted(const inference::HeldOutGain& h) { return h.blocks >= fewest_blocks && h.upper95 < 0; }

std::string loss_in_words(const std::string& held_out) {
  return "none: the error at what was held out is larger with it, beyond chance (" + held_out + ")";
}

std::string gain_in_words(const inference::HeldOutGain& h, const std::string& left_out) {
  if (is_refuted(h)) return loss_in_words(held_out_in_words(h, left_out));
  if (h.gain < 0) return no_gain_in_words(held_out_in_words(h, left_out));
  return fmt::format("{:.2f} -> {} on held-out data; squared error falls by {:.2f} dB2 (95 %: {:.2f} to {:.2f}, {} {})",
                     h.rmse_before, db(h.rmse_after), h.gain, h.lower95, h.upper95, h.blocks, left_out);
}

std::string what_is_held_out(const Diagnosis& d) { return d.seen.places_known ? "places" : "distances"; }

std::string db(double value) { return fmt::format("{:.2f} dB", value); }

std::string what_was_found(const Diagnosis& d) { return d.named() ? "the causes below" : "what is found below"; }

std::string errors_elsewhere(const Diagnosis& d) {
  std::string text;
  for (const inference::Elsewhere& e : d.elsewhere) {
    const inference::HeldOutGain& h = e.held_out;
    text += fmt::format("{}With {} held out in turn ({}): {}", text.empty() ? "" : " ", e.left_out, h.blocks,
                        db(h.rmse_before));
    const bool improved = d.named() || !d.unexplained.empty();
    text += improved ? fmt::format(", {} with {}.", db(h.rmse_after), what_was_found(d)) : ".";
  }
  return text;
}

std::string rows_in_words(const Diagnosis& d) {
  if (static_cast<std::size_t>(d.rows) == d.readings) return "one row each";
  return fmt::format(
      "averaged to {} rows (neighbours on one link: at most {:.3g} s, {:.3g} m, {:.0f} degrees and {:.3g} dB apart)",
      d.rows, d.row_limits.time, std::max(d.row_limits.way, 0.0), d.row_limits.turn * 180 / M_PI, d.row_limits.level);
}

std::string words_explained() {
  return "95 % and +-: an interval that contains the true value in 95 of 100 such reports. Nats: the natural "
         "logarithm of a likelihood ratio; 3 nats are 20 to 1. Lambda: the likelihood-ratio statistic of a cause, "
         "twice "
         "the logarithm; below 20 a cause is often missed, above 50 rarely. D: how far, in standard deviations of the "
         "noise, squared, one cause is from the best imitation by another; below 12 the two are not distinguishable, "
         "above 25 they are. More: docs/how-to/read_a_report.md.";
}

std::string why_no_blocks(const Diagnosis& d) {
  return fmt::format(
      "All readings lie in one block of {:.1f} m{}: none could be "
      "held out, so no gain can be measured. Readings from a wider area would allow it.",
      3 * (d.time_unit > 0 ? std::exp(inference::thresholds::prior_log_decorrelation) : d.noise.decorrelation()),
      d.time_unit > 0 ? "" : " (three decorrelation distances)");
}

}  // namespace muster::report
