#include "diagnosis/data/recorded_time.hpp"

#include <algorithm>
#include <numeric>

#include "diagnosis/data/thresholds.hpp"

namespace muster::diagnosis {
namespace {

// Length of the shortest pause and recorded time without pauses. No pause: longer than any step.
struct Pauses {
  double least, recorded;
  std::size_t count;
};

// True if the steps from the k-th of the sorted ones on are those from one snapshot to the next.
bool is_schedule(const std::vector<double>& steps, std::size_t k) {
  return steps.size() - k >= thresholds::fewest_snapshots && steps.back() <= thresholds::regular_steps * steps[k];
}

Pauses pauses_of(std::vector<double> steps) {
  std::sort(steps.begin(), steps.end());
  double sum = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const bool most_are_shorter = steps.size() >= thresholds::fewest_steps && 2 * k >= steps.size();
    if (most_are_shorter && steps[k] > thresholds::shortest_pause && steps[k] > sum) {
      if (is_schedule(steps, k)) break;
      return {steps[k], sum, steps.size() - k};
    }
    sum += steps[k];
  }
  const double all = std::accumulate(steps.begin(), steps.end(), 0.0);
  return {all + 1, all, 0};
}

}  // namespace

RecordedTime::RecordedTime(std::vector<double> times) {
  if (times.empty()) return;
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
  const Pauses pauses = pauses_of(steps);
  knots_.push_back({times.front(), 0});
  for (std::size_t k = 0; k < steps.size() && pauses.count > 0; ++k) {
    if (steps[k] < pauses.least) continue;
    const double end = knots_.back().shortened + (times[k] - knots_.back().time);
    knots_.push_back({times[k], end});
    knots_.push_back(
        {times[k + 1], end + thresholds::share_of_pauses * pauses.recorded / static_cast<double>(pauses.count)});
  }
  knots_.push_back({times.back(), knots_.back().shortened + (times.back() - knots_.back().time)});
}

double RecordedTime::shortened(double time) const {
  if (knots_.empty()) return 0;
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, time,
                                      [](double sought, const Knot& k) { return sought < k.time; });
  const Knot &a = *(after - 1), &b = *after;
  if (b.time <= a.time) return a.shortened;
  return a.shortened + (time - a.time) * ((b.shortened - a.shortened) / (b.time - a.time));
}

double RecordedTime::at(double share) const {
  if (!has_pauses()) return low() + share * length();
  const double sought = share * length();
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, sought,
                                      [](double share_of, const Knot& k) { return share_of < k.shortened; });
  const Knot &a = *(after - 1), &b = *after;
  if (b.shortened <= a.shortened) return a.time;
  return a.time + (sought - a.shortened) * ((b.time - a.time) / (b.shortened - a.shortened));
}

}  // namespace muster::diagnosis
