#include "diagnosis/report/checked.hpp"

#include <algorithm>
#include <cmath>

namespace muster::report {

bool found(const Diagnosis& d, const std::string& id) {
  const auto is_cause = [&](const CauseEstimate& c) { return c.id == id; };
  const auto is_left = [&](const diagnosis::Unexplained& u) { return "~" + u.covariate == id; };
  return std::any_of(d.causes.begin(), d.causes.end(), is_cause) ||
         std::any_of(d.unexplained.begin(), d.unexplained.end(), is_left);
}

namespace {

bool is_doubtful(const inference::Check& c) { return c.log_p < std::log(1e-3); }

}  // namespace

std::string chance_of(const inference::Check& c) {
  return chance(c.log_p) + (is_doubtful(c) && !c.refused.empty() ? ", " + c.refused : "");
}

SortedChecks sorted_checks(const Diagnosis& d) {
  SortedChecks result;
  for (const inference::Check& c : d.checks) {
    if (found(d, c.id)) continue;
    auto& list = is_doubtful(c) ? result.doubtful : c.kind == inference::Kind::smooth ? result.along : result.causes;
    list.push_back(&c);
  }
  return result;
}

std::string name_of(const inference::Check& check) {
  return check.kind == inference::Kind::smooth ? covariate_in_words(check.id.substr(1)) : short_name(check.id);
}

std::string tested_separately(const Diagnosis& d) {
  std::string result;
  for (const std::string& id : d.searched) {
    const auto is_it = [&](const inference::Check& c) { return c.id == id; };
    if (!found(d, id) && std::none_of(d.checks.begin(), d.checks.end(), is_it))
      result += (result.empty() ? "" : ", ") + short_name(id);
  }
  return result;
}

}  // namespace muster::report
