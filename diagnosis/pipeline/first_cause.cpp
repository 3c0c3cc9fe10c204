#include "diagnosis/pipeline/first_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

bool goes_first(const muster_cause& cause) {
  const bool has_flags = cause.size >= offsetof(muster_cause, flags) + sizeof cause.flags;
  return has_flags ? (cause.flags & MUSTER_FIRST) != 0
                   : cause.kind == MUSTER_WORLD_EDIT || cause.kind == MUSTER_INSTRUMENT;
}

bool something_changes_in_time(const Diagnosis& found) {
  return std::any_of(
             found.causes.begin(), found.causes.end(),
             [](const CauseEstimate& c) { return c.status == inference::Status::named && c.changes_in_time(); }) ||
         std::any_of(found.unexplained.begin(), found.unexplained.end(),
                     [](const Unexplained& u) { return u.changes_in_time(); });
}

namespace {

// What the wrong world hides, it need not hide whole.
bool something_comes_near(const Diagnosis& found) {
  return std::any_of(found.checks.begin(), found.checks.end(),
                     [](const inference::Check& check) { return check.log_p < std::log(thresholds::absorbed_alpha); });
}

}  // namespace

First first_in_company(const Diagnosis& found, const std::vector<Cause>& causes) {
  First first;
  std::size_t named = found.unexplained.size();
  for (const CauseEstimate& c : found.causes) {
    if (c.status != inference::Status::named) continue;
    ++named;
    const auto cause = std::find_if(causes.begin(), causes.end(), [&](const Cause& k) { return k.id == c.id; });
    if (first.found || cause == causes.end() || !goes_first(cause->meaning())) continue;
    const bool blockage = cause->plugin->burst != nullptr;
    if (!blockage || something_changes_in_time(found)) first = {&c, blockage};
  }
  return named > 1 || something_comes_near(found) ? first : First();
}

std::string doubt_by_imitator(const CauseEstimate& first, const std::vector<inference::Check>& checks,
                              const std::vector<Cause>& causes) {
  const auto cause = std::find_if(causes.begin(), causes.end(), [&](const Cause& c) { return c.id == first.id; });
  if (cause == causes.end() || !goes_first(cause->meaning())) return "";
  const std::string imitators = ' ' + std::string(cause->meaning().imitators) + ' ';
  for (const inference::Check& check : checks) {
    if (check.log_p < std::log(thresholds::absorbed_alpha) && imitators.find(' ' + check.id + ' ') != imitators.npos)
      return fmt::format("{} comes near beside it (p = {:.1g}): more than one may do the same",
                         check.id.substr(check.id.find('.') + 1), std::exp(check.log_p));
  }
  return "";
}

}  // namespace muster::diagnosis
