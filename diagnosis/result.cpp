#include "diagnosis/result.hpp"

#include <algorithm>

namespace muster::diagnosis {

bool Diagnosis::named() const {
  return std::any_of(causes.begin(), causes.end(),
                     [](const CauseEstimate& c) { return c.status == inference::Status::named; });
}

std::vector<NamedCause> named_causes(const Diagnosis& d) {
  std::vector<NamedCause> result;
  for (const CauseEstimate& c : d.causes) {
    if (c.status == inference::Status::named) result.push_back({c.id, c.label});
  }
  for (const Unexplained& u : d.unexplained) result.push_back({"~" + u.covariate, ""});
  return result;
}

std::string names_in_words(const std::vector<NamedCause>& told) {
  std::string result;
  for (const NamedCause& t : told)
    result += (result.empty() ? "" : ", ") + t.id + (t.label.empty() ? "" : " ") + t.label;
  return result.empty() ? "silent" : result;
}

bool CauseEstimate::changes_in_time() const {
  return std::find(covariates.begin(), covariates.end(), "time") != covariates.end();
}

bool Unexplained::changes_in_time() const { return inference::is_time(covariate); }

const char* Diagnosis::verdict() const {
  if (!unexplained.empty()) return "unexplained";
  if (named()) return "extended";
  if (interrupted) return "interrupted";
  return unstated_field || stays || other_scatter ? "unexplained" : "adequate";
}

}  // namespace muster::diagnosis
