// The verdict on a world in one line.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/report/checked.hpp"
#include "diagnosis/report/words.hpp"

namespace muster::report {
namespace {

// Each covariate once.
std::string covariates_of(const Diagnosis& d) {
  std::vector<std::string> words;
  for (const auto& u : d.unexplained) {
    std::string word = covariate_in_words(u.covariate);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(std::move(word));
  }
  std::string list;
  for (std::size_t k = 0; k < words.size(); ++k)
    list += (k == 0 ? "" : k + 1 == words.size() ? " and on " : ", on ") + words[k];
  return list;
}

std::string scatter_in_words(const diagnosis::OtherScatter& scatter) {
  return fmt::format("{}readings scatter by {:.1f} dB, where the world says {:.1f} to {:.1f} dB",
                     scatter.of_single ? "beside what neighbours share, single " : "", scatter.measured, scatter.least,
                     scatter.most);
}

std::string field_in_words(const diagnosis::UnstatedField& field) {
  return fmt::format(
      "readings within {:.2g} m share {:.1f} dB that the world does not state, where single ones scatter by {:.1f} dB",
      field.decorrelation, field.shadowing, field.reading_sd);
}

std::string stays_in_words(const diagnosis::Stays& stays) {
  return fmt::format(
      "levels change by {:.1f} dB from one stay to the next, where readings of a stay scatter by {:.1f} dB, and {} "
      "stays are too few to tell with what",
      stays.sd, stays.reading_sd, stays.count);
}

double lambda_of_names(const Diagnosis& d) {
  double most = 0;
  for (const CauseEstimate& c : d.causes)
    if (confidence_of(c) != Confidence::set_aside) most = std::max(most, c.lambda);
  return most;
}

double lambda_left(const Diagnosis& d) {
  double most = 0;
  for (const auto& u : d.unexplained) most = std::max(most, u.lambda);
  return most;
}

std::string causes_in_words(int count) {
  static const char* words[] = {"no cause", "one cause", "two causes", "three causes", "four causes", "five causes"};
  return count < 6 ? words[count] : std::to_string(count) + " causes";
}

// The check of the smallest p, where that is smaller than chance yields in a hundred diagnoses; null if none is.
const inference::Check* nearest_to_a_name(const Diagnosis& d) {
  const auto least =
      std::min_element(d.checks.begin(), d.checks.end(),
                       [](const inference::Check& a, const inference::Check& b) { return a.log_p < b.log_p; });
  return least != d.checks.end() && least->log_p < std::log(1e-4) ? &*least : nullptr;
}

// Why none of the names is confirmed.
std::string what_is_missing(const Diagnosis& d, bool is_one) {
  const auto any = [&](const auto& is) { return std::any_of(d.causes.begin(), d.causes.end(), is); };
  if (any([](const CauseEstimate& c) { return c.doubt.rfind(diagnosis::at_its_bound, 0) == 0; }))
    return "the fit ends at a bound, and no name is sure";
  return any([](const CauseEstimate& c) { return c.doubt.empty() && c.status == inference::Status::named; })
             ? fmt::format("what was held out does not confirm {} yet", is_one ? "it" : "them")
             : std::string(is_one ? "it is in doubt" : "they are in doubt");
}

std::string whole_verdict(const Diagnosis& d) {
  const int confirmed = count_of(d, Confidence::confirmed), unconfirmed = count_of(d, Confidence::unconfirmed);
  const std::string causes = causes_in_words(confirmed + unconfirmed);
  const std::string named = causes + (confirmed + unconfirmed == 1 ? " is named" : " are named");
  // The headline is what is larger: names that explain more than what is left unexplained.
  const bool led_by_names =
      !d.unexplained.empty() && confirmed + unconfirmed > 0 && lambda_of_names(d) > lambda_left(d);
  const std::string left = (led_by_names ? "; something depends on " + covariates_of(d) + " beside" : "") +
                           (d.stays            ? "; " + stays_in_words(*d.stays)
                            : d.unstated_field ? "; " + field_in_words(*d.unstated_field)
                                               : "");
  if (!d.unexplained.empty() && !led_by_names)
    return std::string("is wrong in a way that no known cause explains") +
           (d.unexplained[0].alternatives.empty() ? "" : " as well") + ": something depends on " + covariates_of(d) +
           (confirmed + unconfirmed ? "; " + named + " beside it" : "");
  if (confirmed + unconfirmed == 0 && d.interrupted)
    return "is not judged: the search was interrupted, and nothing had been found";
  if (confirmed + unconfirmed == 0 && d.stays) return "is not adequate: " + stays_in_words(*d.stays);
  if (confirmed + unconfirmed == 0 && d.unstated_field) return "is not adequate: " + field_in_words(*d.unstated_field);
  if (confirmed + unconfirmed == 0 && d.other_scatter) return "is not adequate: " + scatter_in_words(*d.other_scatter);
  if (confirmed + unconfirmed == 0 && count_of(d, Confidence::set_aside))
    return "is adequate: what stands out is not beyond chance, a suspicion remains";
  if (confirmed + unconfirmed == 0) {
    const inference::Check* const nearest = nearest_to_a_name(d);
    return nearest ? "is adequate: nothing was found beyond doubt; " + name_of(*nearest) + " came near (" +
                         chance(nearest->log_p) + ")"
                   : "is adequate: nothing was found beyond chance";
  }
  if (confirmed == 0) return "seems wrong: " + named + ", but " + what_is_missing(d, unconfirmed == 1) + left;
  return "is wrong: " + named + (unconfirmed ? ", not all confirmed by what was held out" : "") + left;
}

}  // namespace

std::string verdict_in_words(const Diagnosis& d) {
  const bool found = d.named() || !d.unexplained.empty();
  return whole_verdict(d) + (d.interrupted && found ? "; the search was interrupted, and more may be wrong" : "");
}

}  // namespace muster::report
