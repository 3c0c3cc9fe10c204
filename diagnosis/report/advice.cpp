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
  if (k == 0) return "the world, fitted";
  // Accepted causes and effects that have none, in one order of strength.
  std::vector<std::pair<double, std::string>> steps;
  for (const CauseEstimate& c : d.causes) {
    if (confidence_of(c) != Confidence::set_aside && !c.sought_as.empty())
      steps.emplace_back(-c.lambda, short_name(c.id));
  }
  for (const auto& u : d.unexplained) steps.emplace_back(-u.lambda, covariate_in_words(u.covariate) + " (unexplained)");
  for (const auto& u : d.of_people) steps.emplace_back(-u.lambda, covariate_in_words(u.covariate) + " (people)");
  std::stable_sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const CauseEstimate& c : d.causes) {
    if (c.put_right_first) steps.insert(steps.begin(), {0, short_name(c.id)});
  }
  return k <= steps.size() ? "+ " + steps[k - 1].second : "";
}

}  // namespace muster::report
