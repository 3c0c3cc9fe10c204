#include "diagnosis/result.hpp"

#include <algorithm>

namespace muster::diagnosis {

bool Diagnosis::named() const {
  return std::any_of(causes.begin(), causes.end(),
                     [](const FoundCause& c) { return c.status == inference::Status::named; });
}

std::vector<Told> told_by(const Diagnosis& d) {
  std::vector<Told> result;
  for (const FoundCause& c : d.causes) {
    if (c.status == inference::Status::named) result.push_back({c.id, c.label});
  }
  for (const Unexplained& u : d.unexplained) result.push_back({"~" + u.covariate, ""});
  return result;
}

std::string in_short(const std::vector<Told>& told) {
  std::string result;
  for (const Told& t : told) result += (result.empty() ? "" : ", ") + t.id + (t.label.empty() ? "" : " ") + t.label;
  return result.empty() ? "silent" : result;
}

bool FoundCause::changes_in_time() const {
  return std::find(covariates.begin(), covariates.end(), "time") != covariates.end();
}

bool Unexplained::changes_in_time() const { return covariate.find("time") != std::string::npos; }

const char* Diagnosis::verdict() const {
  return !unexplained.empty() ? "unexplained" : named() ? "extended" : "adequate";
}

}  // namespace muster::diagnosis
