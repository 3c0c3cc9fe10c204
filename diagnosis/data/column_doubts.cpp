#include "diagnosis/data/column_doubts.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "diagnosis/data/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using InTime = std::vector<std::pair<double, double>>;  // time and value

// Whole numbers that rise by one or a few from reading to reading, or stay: those of runs stay too often.
bool counts(const InTime& values) {
  std::size_t whole = 0, up = 0, stays = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].second == std::round(values[i].second)) ++whole;
    const double step = i == 0 ? 1 : values[i].second - values[i - 1].second;
    if (step >= 0 && step <= thresholds::largest_count) ++up;
    if (step == 0) ++stays;
  }
  const double enough = thresholds::counted_share * static_cast<double>(values.size());
  return static_cast<double>(whole) >= enough && static_cast<double>(up) >= enough && 2 * stays <= values.size();
}

// On a line that rises with time (squared correlation).
bool rises_steadily(const InTime& values) {
  const auto n = static_cast<double>(values.size());
  double t = 0, v = 0;
  for (const auto& [time, value] : values) t += time / n, v += value / n;
  double tt = 0, tv = 0, vv = 0;
  for (const auto& [time, value] : values) {
    tt += (time - t) * (time - t);
    tv += (time - t) * (value - v);
    vv += (value - v) * (value - v);
  }
  return tv > 0 && tv * tv >= thresholds::steady_rise * tt * vv;
}

// Parts of a name in small letters: "rx-LQI[1]" has rx and lqi.
std::vector<std::string> words_of(const std::string& name) {
  std::string spaced = name.substr(0, name.find('['));
  for (char& c : spaced) {
    const auto letter = static_cast<unsigned char>(c);
    c = std::isalnum(letter) ? static_cast<char>(std::tolower(letter)) : ' ';
  }
  std::istringstream parts(spaced);
  return {std::istream_iterator<std::string>(parts), {}};
}

bool has_word_of(const std::string& name, const std::set<std::string>& words) {
  const std::vector<std::string> own = words_of(name);
  return std::any_of(own.begin(), own.end(), [&](const std::string& word) { return words.count(word) > 0; });
}

}  // namespace

bool measures_reception(const std::string& name) {
  static const std::set<std::string> words = {"snr",  "sinr", "lsnr",  "esnr", "lqi", "cqi", "rsrp", "rsrq",
                                              "rssi", "rscp", "rxlev", "prr",  "pdr", "ber", "fer"};
  return has_word_of(name, words);
}

bool is_signal_to_noise(const std::string& name) {
  static const std::set<std::string> words = {"snr", "sinr", "lsnr", "esnr"};
  return has_word_of(name, words);
}

bool goes_with_time(const std::string& name, const std::vector<double>& values, const std::vector<double>& t,
                    const std::vector<std::size_t>& stream) {
  static const std::set<std::string> counters = {
      "seq",     "seqno",   "sequence", "packet", "pkt",    "packetid", "count",   "cnt",   "fcnt",
      "counter", "frame",   "index",    "idx",    "number", "num",      "nr",      "no",    "id",
      "msg",     "message", "msgid",    "sample", "row",    "line",     "reading", "entry", "record"};
  static const std::set<std::string> clocks = {"time",   "timestamp", "stamp", "clock", "uptime", "millis",
                                               "micros", "elapsed",   "epoch", "unix",  "tick",   "ticks"};
  const bool may_count = has_word_of(name, counters), may_tell_time = has_word_of(name, clocks);
  if (!may_count && !may_tell_time) return false;
  std::map<std::size_t, InTime> of;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && std::isfinite(t[i])) of[stream[i]].emplace_back(t[i], values[i]);
  std::size_t looked = 0;
  for (auto& [who, own] : of) {
    if (own.size() < thresholds::fewest_counted) continue;
    ++looked;
    std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    // A value that stays says nothing of time.
    if (own.front().second == own.back().second ||
        !((may_count && counts(own)) || (may_tell_time && rises_steadily(own))))
      return false;
  }
  return looked > 0;
}

}  // namespace muster::diagnosis
