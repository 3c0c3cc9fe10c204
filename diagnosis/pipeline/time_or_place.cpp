#include "diagnosis/pipeline/time_or_place.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::diagnosis {

std::string doubt_by_place(const CauseCandidate& cause, const std::vector<inference::Alternative>& alternatives,
                           const std::vector<CauseCandidate>& all) {
  if (!cause.candidate.role.time_like) return "";
  const auto is_place = [&](const std::string& id) {
    return std::any_of(all.begin(), all.end(), [&](const CauseCandidate& c) {
      return c.candidate.id == id && !c.candidate.role.pieces.empty();
    });
  };
  std::vector<std::string> places;
  for (const inference::Alternative& a : alternatives) {
    if (a.separability < inference::thresholds::inseparable && a.by_readings < inference::thresholds::open_nats &&
        is_place(a.id))
      places.push_back(a.id.substr(a.id.find('.') + 1) + ' ' + a.label);
  }
  if (places.empty()) return "";
  return fmt::format("time is one with place in these readings, and by them alone {} would do as well",
                     fmt::join(places, " or "));
}

}  // namespace muster::diagnosis
