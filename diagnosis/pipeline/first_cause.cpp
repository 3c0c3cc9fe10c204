#include "diagnosis/pipeline/first_cause.hpp"

#include <algorithm>
#include <cstddef>

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
  return named > 1 ? first : First();
}

}  // namespace muster::diagnosis
