#include "diagnosis/report/advice.hpp"

#include <algorithm>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::report {
namespace {

// "of wall/w1"; "of stations" is so already.
std::string with_of(const std::string& label) { return label.starts_with("of ") ? label : "of " + label; }

}  // namespace

std::vector<Question> open_questions(const Diagnosis& d) {
  std::vector<Question> out;
  for (const CauseEstimate& c : d.causes) {
    if (confidence_of(c) == Confidence::set_aside) continue;
    for (const inference::Alternative& r : c.alternatives) {
      if (r.separability >= inference::thresholds::decided) continue;
      std::string pair = short_name(c.id) + " or " + short_name(r.id);
      if (r.id == c.id) pair = short_name(c.id) + ' ' + with_of(c.label) + " or " + with_of(r.label);
      Question question{c.id, r.id, std::move(pair), r.separability, c.tell_apart, {}};
      for (const diagnosis::Advice& a : d.advice) {
        if (a.cause != c.id || a.alternative != r.id || !a.predicted) continue;
        question.plans.push_back({a.say, *a.predicted, d.advised && d.advised->say == a.say});
      }
      std::stable_sort(question.plans.begin(), question.plans.end(),
                       [](const auto& a, const auto& b) { return a.predicted > b.predicted; });
      out.push_back(std::move(question));
    }
  }
  for (const auto& u : d.unexplained) {
    const std::string what = covariate_in_words(u.covariate);
    for (const inference::Alternative& r : u.alternatives) {
      if (r.separability >= inference::thresholds::decided) continue;
      out.push_back({"~" + u.covariate,
                     r.id,
                     what + " or " + short_name(r.id),
                     r.separability,
                     "measure with " + what + " changed and all else as it was",
                     {}});
    }
  }
  return out;
}

std::string name_of_step(const Diagnosis& d, std::size_t k) {
  const std::string& with = d.stairs[k].with;
  if (with.empty()) return "the world, fitted";
  if (with[0] != '~') {
    const auto cause =
        std::find_if(d.causes.begin(), d.causes.end(), [&](const CauseEstimate& c) { return c.sought_as == with; });
    return "+ " + short_name(cause == d.causes.end() ? with : cause->id);
  }
  const std::string covariate = with.substr(1);
  const bool people = std::any_of(d.of_people.begin(), d.of_people.end(),
                                  [&](const diagnosis::Unexplained& u) { return u.covariate == covariate; });
  return "+ " + covariate_in_words(covariate) + (people ? " (people)" : " (unexplained)");
}

}  // namespace muster::report
