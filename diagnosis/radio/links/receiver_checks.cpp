#include "diagnosis/radio/links/receiver_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "diagnosis/data/thresholds.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Codes = std::map<double, std::size_t>;  // readings at each level

Codes codes_of(const Dataset& data) {
  Codes codes;
  for (const double v : data.rssi) {
    if (!std::isnan(v)) ++codes[v];
  }
  return codes;
}

// Moments at each level: of a link that is the same both ways, what stands in both rows of one moment is one.
Codes moments_of(const Dataset& data) {
  if (data.t.empty()) return codes_of(data);
  const auto& senders = data.tx.levels;
  std::vector<std::size_t> number;  // of each receiver, that of the sender of its name if there is one
  for (const std::string& name : data.rx.levels) {
    const auto at = static_cast<std::size_t>(std::find(senders.begin(), senders.end(), name) - senders.begin());
    number.push_back(at < senders.size() ? at : senders.size() + number.size());
  }
  Codes moments;
  std::set<std::tuple<std::size_t, std::size_t, double, double>> known;  // sender, receiver, time and level
  for (std::size_t row = 0; row < data.rows(); ++row) {
    const double level = data.rssi[row], t = data.t[row];
    if (std::isnan(level)) continue;
    const std::size_t tx = data.tx.level[row], rx = number[data.rx.level[row]];
    if (!known.count({rx, tx, t, level})) ++moments[level];
    known.insert({tx, rx, t, level});
  }
  return moments;
}

// Step of the grid of all levels: their least difference; 0 if there is no grid.
double step_of(const Codes& codes, std::size_t readings) {
  if (codes.size() < thresholds::fewest_codes || codes.size() > readings / thresholds::readings_of_code) return 0;
  double least = 1e300;
  for (auto it = std::next(codes.begin()); it != codes.end(); ++it)
    least = std::min(least, it->first - std::prev(it)->first);
  const double first = codes.begin()->first;
  const bool all = std::all_of(codes.begin(), codes.end(), [&](const auto& code) {
    return std::abs(std::remainder(code.first - first, least)) < 1e-6 * least + 1e-9;
  });
  return all ? least : 0;
}

// log P(X >= k) of a binomial with n trials of this probability.
double log_binomial_tail(std::size_t k, std::size_t n, double chance) {
  double most = -1e300;
  std::vector<double> terms;
  const auto count = static_cast<double>(n);
  for (std::size_t i = k; i <= n; ++i) {
    const auto x = static_cast<double>(i);
    terms.push_back(std::lgamma(count + 1) - std::lgamma(x + 1) - std::lgamma(count - x + 1) + x * std::log(chance) +
                    (count - x) * std::log1p(-chance));
    most = std::max(most, terms.back());
  }
  double sum = 0;
  for (const double t : terms) sum += std::exp(t - most);
  return std::min(most + std::log(sum), 0.0);
}

// Greatest extent of these places along an axis, m.
double extent(const std::vector<Point>& places) {
  double most = 0;
  for (const std::size_t axis : {0u, 1u}) {
    const auto [low, high] = std::minmax_element(places.begin(), places.end(),
                                                 [&](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    most = std::max(most, (*high)[axis] - (*low)[axis]);
  }
  return most;
}

using Link = std::pair<std::string, std::string>;

Link link_of(const Dataset& data, std::size_t row) {
  return std::minmax(data.tx.levels[data.tx.level[row]], data.rx.levels[data.rx.level[row]]);
}

// True if the readings at a level are of one pair of radios, and either the data have many pairs or these readings lie
// close together: the level of a link that hardly changes, and no end of the receiver's range.
bool of_one_link(const Dataset& data, double level) {
  if (links_at_level(data, level) != 1) return false;
  std::set<Link> all;
  for (std::size_t row = 0; row < data.rows(); ++row) all.insert(link_of(data, row));
  return all.size() >= thresholds::many_links || extent_at_level(data, level) < thresholds::one_place;
}

// Binomial test for a pile at the last code: a density that falls towards its end has no more moments there than at
// the codes before. `before`: moments at these, nearest first.
std::optional<Clip> pile(const Dataset& data, double level, std::size_t count, const std::vector<std::size_t>& before) {
  if (count < thresholds::fewest_piled || count <= thresholds::piled_times * before[0]) return {};
  if (of_one_link(data, level)) return {};
  const std::size_t all = std::accumulate(before.begin(), before.end(), count);
  Clip clip{level, count, before[0], log_binomial_tail(count, all, 1 / (1.0 + static_cast<double>(before.size()))), 0};
  if (clip.log_p > std::log(thresholds::pile_alpha)) return {};
  clip.row = static_cast<std::size_t>(std::find(data.rssi.begin(), data.rssi.end(), level) - data.rssi.begin());
  return clip;
}

std::size_t at(const Codes& codes, double level) {
  const auto found = codes.lower_bound(level - 1e-6);
  return found != codes.end() && found->first < level + 1e-6 ? found->second : 0;
}

ReceiverCheck pile_check(const std::string& end, const std::optional<Clip>& clip, double level, std::size_t count) {
  ReceiverCheck check{"readings that pile up at the " + end + " level", "", !clip, {}};
  check.found = fmt::format("{} at {:.6g} dBm", count, level);
  if (!clip) return check;
  check.found = fmt::format("{} at {:.6g} dBm, {} beside it: clipped", clip->count, level, clip->beside);
  check.row = clip->row + 1;
  return check;
}

std::string step_in_words(double step, std::size_t levels, std::size_t readings) {
  if (step > 0) return fmt::format("{:.6g} dB", step);
  if (levels >= thresholds::fewest_codes && levels <= readings / thresholds::readings_of_code)
    return "none: no common step";
  return fmt::format(
      "not known: {} readings of {} levels are too few to tell; three levels and four readings a level would do",
      readings, levels);
}

// Levels of the few readings at one end that a gap of 30 dB separates from all others. In Rayleigh fading the lowest of
// many readings lies 20 dB below the next in one record of 100, 30 dB in one of 1,000.
template <class It>
std::vector<double> parted(It from, const It& end) {
  std::vector<double> levels;
  std::size_t count = 0;
  for (; from != end && std::next(from) != end && count + from->second <= thresholds::most_outliers; ++from) {
    count += from->second;
    levels.push_back(from->first);
    if (std::abs(std::next(from)->first - from->first) >= thresholds::outlier_gap) return levels;
  }
  return {};
}

ReceiverCheck outliers_check(const Dataset& data, const Codes& codes, const std::string& none) {
  ReceiverCheck check{"one to three readings 30 dB or more from all others", none, true, {}};
  std::vector<double> levels = parted(codes.begin(), codes.end());
  if (levels.empty()) levels = parted(codes.rbegin(), codes.rend());
  if (levels.empty()) return check;
  check.fine = false;
  check.found = fmt::format("{:.6g} dBm", levels[0]);
  check.row =
      static_cast<std::size_t>(std::find(data.rssi.begin(), data.rssi.end(), levels[0]) - data.rssi.begin()) + 1;
  return check;
}

std::string marks_in_words(const Dataset& data, const std::string& none) {
  if (data.marks.empty()) return none;
  std::string words;
  for (const std::string& mark : data.marks) words += (words.empty() ? "" : " and ") + mark;
  return words + ", taken as not received";
}

// Counts levels above 0 dBm, implausible for more than a few readings; check_readings() refuses a majority.
ReceiverCheck unit_check(const Dataset& data, const std::string& none) {
  const auto above = [](double v) { return v > 0; };
  const auto count = static_cast<std::size_t>(std::count_if(data.rssi.begin(), data.rssi.end(), above));
  ReceiverCheck check{"levels above 0 dBm, a milliwatt at the receiver", none, true, {}};
  if (count == 0) return check;
  check.found = fmt::format("{} of {} readings", count, data.heard());
  check.row = static_cast<std::size_t>(std::find_if(data.rssi.begin(), data.rssi.end(), above) - data.rssi.begin()) + 1;
  return check;
}

}  // namespace

ReceiverChecks receiver_checks(const Dataset& data) {
  ReceiverChecks result;
  const Codes codes = codes_of(data), moments = moments_of(data);
  result.step = step_of(codes, data.heard());
  const auto low = codes.begin(), high = std::prev(codes.end());
  const auto before = [&](double level, double inward, double next) -> std::vector<std::size_t> {
    if (result.step <= 0) return {at(moments, next)};
    std::vector<std::size_t> counts;
    for (const int steps : {1, 2, 3}) counts.push_back(at(moments, level + inward * steps * result.step));
    return counts;
  };
  if (codes.size() > 2) {
    result.top = pile(data, high->first, at(moments, high->first), before(high->first, -1, std::prev(high)->first));
    result.bottom = pile(data, low->first, at(moments, low->first), before(low->first, 1, std::next(low)->first));
  }
  result.checks.push_back(
      {"the step between readings", step_in_words(result.step, codes.size(), data.heard()), true, {}});
  result.checks.push_back(pile_check("highest", result.top, high->first, high->second));
  result.checks.push_back(pile_check("lowest", result.bottom, low->first, low->second));
  const std::string rows = "none in " + std::to_string(data.rows()) + " rows";
  if (data.t.empty()) {
    result.checks.push_back({"readings that stand twice, time that runs backwards", "not testable: no t", true, {}});
  } else {
    result.checks.push_back({"readings that stand twice (t, tx, rx)", rows, true, {}});
    result.checks.push_back({"time that runs backwards within a pair", rows, true, {}});
  }
  result.checks.push_back(
      {"marks for none (0, -128), apart from all other levels", marks_in_words(data, rows), true, {}});
  result.checks.push_back({"levels that cannot be (over 30, under -174 dBm)", rows, true, {}});
  result.checks.push_back(outliers_check(data, codes, rows));
  result.checks.push_back(unit_check(data, rows));
  result.checks.push_back({"rows in another unit than their column", rows, true, {}});
  const std::size_t missing = data.rows() - data.heard();
  result.checks.push_back({"readings that are missing", missing ? std::to_string(missing) : rows, true, {}});
  return result;
}

double extent_at_level(const Dataset& data, double level) {
  if (!data.has_places()) return std::numeric_limits<double>::infinity();
  std::map<std::string, std::vector<Point>> places;  // by radio
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (data.rssi[row] != level) continue;
    places[data.tx.levels[data.tx.level[row]]].push_back(data.tx_at[row]);
    places[data.rx.levels[data.rx.level[row]]].push_back(data.rx_at[row]);
  }
  double most = 0;
  for (const auto& [radio, all] : places) most = std::max(most, extent(all));
  return most;
}

std::size_t links_at_level(const Dataset& data, double level) {
  std::set<Link> links;
  for (std::size_t row = 0; row < data.rows(); ++row)
    if (data.rssi[row] == level) links.insert(link_of(data, row));
  return links.size();
}

}  // namespace muster::diagnosis
