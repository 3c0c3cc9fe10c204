#include "diagnosis/data/time_stamp.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "diagnosis/data/clock.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::int64_t day = 86400;  // s

// Reads a text from its start.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : left_(text) {}

  bool at_end() const { return left_.empty(); }
  bool take(std::string_view one_of) {
    if (left_.empty() || one_of.find(left_[0]) == one_of.npos) return false;
    taken_ = left_[0];
    left_.remove_prefix(1);
    return true;
  }
  char taken() const { return taken_; }
  // A number of `least` to `most` digits.
  std::optional<int> digits(std::size_t least, std::size_t most) {
    std::size_t count = 0;
    int value = 0;
    for (; count < most && count < left_.size() && left_[count] >= '0' && left_[count] <= '9'; ++count)
      value = 10 * value + (left_[count] - '0');
    if (count < least) return std::nullopt;
    left_.remove_prefix(count);
    return value;
  }
  // The digits after a point or comma.
  double fraction() {
    double value = 0;
    for (double unit = 0.1; !left_.empty() && left_[0] >= '0' && left_[0] <= '9'; unit /= 10, left_.remove_prefix(1))
      value += unit * (left_[0] - '0');
    return value;
  }

 private:
  std::string_view left_;
  char taken_ = 0;
};

std::optional<std::int64_t> days_since_1970(int year, int month, int date) {
  const std::chrono::year_month_day d{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                      std::chrono::day(static_cast<unsigned>(date))};
  if (!d.ok()) return std::nullopt;
  return std::chrono::sys_days(d).time_since_epoch().count();
}

// YEAR-MONTH-DAY or YEAR/MONTH/DAY, DAY.MONTH.YEAR, YEARMONTHDAY before a 'T'.
std::optional<std::int64_t> parse_date(Cursor& at, bool basic) {
  if (basic) {
    const auto year = at.digits(4, 4), month = at.digits(2, 2), date = at.digits(2, 2);
    return year && month && date ? days_since_1970(*year, *month, *date) : std::nullopt;
  }
  const auto first = at.digits(1, 4);
  if (!first || !at.take("-/.")) return std::nullopt;
  const char mark = at.taken();
  const auto month = at.digits(1, 2);
  if (!month || !at.take(std::string_view(&mark, 1))) return std::nullopt;
  const auto last = at.digits(1, 4);
  if (!last) return std::nullopt;
  if (*first >= 1000 && *last <= 31) return days_since_1970(*first, *month, *last);
  if (mark == '.' && *first <= 31 && *last >= 1000) return days_since_1970(*last, *month, *first);
  return std::nullopt;
}

// HOUR:MINUTE[:SECOND[.FRACTION]], or HOURMINUTESECOND. Adds to the stamp.
bool parse_clock(Cursor& at, bool basic, Stamp& stamp) {
  const auto hour = at.digits(basic ? 2 : 1, 2);
  if (!hour || *hour > 23 || (!basic && !at.take(":"))) return false;
  const auto minute = at.digits(2, 2);
  if (!minute || *minute > 59) return false;
  stamp.whole += 3600 * *hour + 60 * *minute;
  if (!basic && !at.take(":")) return true;
  const auto second = at.digits(2, 2);
  if (!second || *second > 60) return false;  // 60: a leap second
  stamp.whole += *second;
  if (at.take(".,")) stamp.fraction = at.fraction();
  return true;
}

// Z, +02:00, +0200 or +02.
bool parse_zone(Cursor& at, Stamp& stamp) {
  if (at.take("Zz")) return stamp.has_zone = true;
  if (!at.take("+-")) return true;
  const int sign = at.taken() == '-' ? -1 : 1;
  const auto hours = at.digits(2, 2);
  if (!hours || *hours > 14) return false;
  at.take(":");
  const auto minutes = at.digits(2, 2);
  if (minutes && *minutes > 59) return false;
  stamp.whole -= sign * (3600 * *hours + 60 * minutes.value_or(0));
  return stamp.has_zone = true;
}

std::optional<Stamp> parse_count(std::string_view text) {
  if (const auto whole = parse_integer(text)) return Stamp{StampKind::count, *whole, 0, false};
  const auto value = parse_real(text);
  if (!value || std::abs(*value) > 9e18) return std::nullopt;
  const double whole = std::floor(*value);
  return Stamp{StampKind::count, static_cast<std::int64_t>(whole), *value - whole, false};
}

std::string name_of(StampKind kind) {
  return kind == StampKind::date ? "a date" : kind == StampKind::clock ? "a clock time" : "a number";
}

double difference(const Stamp& a, const Stamp& b) {
  return static_cast<double>(a.whole - b.whole) + (a.fraction - b.fraction);
}

// Turns counts in smaller units into seconds.
void in_seconds(std::vector<std::optional<Stamp>>& stamps, std::vector<std::string>& assumed) {
  std::vector<double> sizes;
  for (const auto& s : stamps) {
    if (s) sizes.push_back(static_cast<double>(s->whole));
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double seconds = unit_of_clock(*middle);
  const auto units = static_cast<std::int64_t>(std::llround(1 / seconds));
  for (auto& s : stamps) {
    if (!s || units == 1) continue;
    std::int64_t rest = s->whole % units;
    if (rest < 0) rest += units;
    s->fraction = (static_cast<double>(rest) + s->fraction) * seconds;
    s->whole = (s->whole - rest) / units;
  }
  assumed.push_back(std::abs(*middle) < 1e8 ? "times are taken to be in seconds: no count since 1970 is so small"
                                            : "times are " + name_of_unit(seconds) + " since 1970, by their size");
}

// Adds a day where a clock without a date falls by more than half a day.
void pass_midnights(const std::vector<StampCell>& cells, std::vector<std::optional<Stamp>>& stamps,
                    std::vector<std::string>& assumed) {
  std::size_t midnights = 0;
  std::int64_t days = 0;
  const Stamp* last = nullptr;
  std::size_t file = 0;
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    if (!stamps[k]) continue;
    if (cells[k].file != file) {
      file = cells[k].file;
      days = 0;
      last = nullptr;
    }
    stamps[k]->whole += days * day;
    if (last && difference(*stamps[k], *last) < -day / 2.0) {
      stamps[k]->whole += day;
      ++days;
      ++midnights;
    }
    last = &*stamps[k];
  }
  assumed.push_back("clock times have no date: all begin on one day, and pass midnight " + std::to_string(midnights) +
                    " times");
}

std::vector<std::optional<Stamp>> parsed(const std::vector<StampCell>& cells) {
  std::vector<std::optional<Stamp>> stamps;
  const Stamp* first = nullptr;
  const StampCell* cell_of_first = nullptr;
  stamps.reserve(cells.size());  // `first` points into it
  for (const StampCell& cell : cells) {
    stamps.emplace_back();
    if (cell.text.empty()) continue;
    stamps.back() = parse_stamp(cell.text);
    if (!stamps.back()) throw invalid(cell.place, why_no_stamp(cell.text));
    if (!first) {
      first = &*stamps.back();
      cell_of_first = &cell;
    }
    if (stamps.back()->kind == first->kind && stamps.back()->has_zone == first->has_zone) continue;
    const bool kind = stamps.back()->kind != first->kind;
    throw invalid(cell.place, quote(cell.text) + " is " +
                                  (kind ? name_of(stamps.back()->kind) : "a time with another zone") + ", while line " +
                                  std::to_string(cell_of_first->place.line) + " has " + quote(cell_of_first->text) +
                                  "; expected one kind of time in the whole column");
  }
  if (!first && !cells.empty()) throw invalid(cells[0].place, "no cell of the column has a time");
  return stamps;
}

// The first stamp that is not wild, such as that of a clock that was not set yet.
const Stamp& first_of(const std::vector<std::optional<Stamp>>& stamps) {
  std::vector<const Stamp*> all;
  for (const auto& s : stamps) {
    if (s) all.push_back(&*s);
  }
  std::vector<double> t;
  for (const Stamp* s : all) t.push_back(difference(*s, *all[0]));
  const std::vector<std::size_t> wild = wild_stamps(t);
  std::size_t k = 0;
  while (k < wild.size() && wild[k] == k) ++k;
  return *all[k];
}

}  // namespace

std::optional<Stamp> parse_stamp(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const std::size_t t = text.find_first_of("Tt");
  const bool basic = t == 8 && text.find_first_not_of("0123456789") == 8;
  const bool dated = basic || text.find_first_of("/.-", 1) < text.find(':');
  if (!basic && text.find(':') == text.npos) {
    if (auto count = parse_count(text)) return count;
  }
  Stamp stamp;
  Cursor at(text);
  if (dated) {
    const auto days = parse_date(at, basic);
    if (!days) return std::nullopt;
    stamp.kind = StampKind::date;
    stamp.whole = *days * day;
    if (at.at_end()) return stamp;
    if (!at.take("Tt ")) return std::nullopt;
    while (at.take(" ")) {
    }
  } else {
    stamp.kind = StampKind::clock;
  }
  if (!parse_clock(at, basic && text.find(':') == text.npos, stamp)) return std::nullopt;
  while (at.take(" ")) {
  }
  if (dated && !parse_zone(at, stamp)) return std::nullopt;
  return at.at_end() ? std::optional(stamp) : std::nullopt;
}

std::string why_no_stamp(std::string_view text) {
  Cursor at(text);
  const auto first = at.digits(1, 2);
  if (first && at.take("/") && at.digits(1, 2) && at.take("/") && at.digits(4, 4))
    return quote(text) + " may begin with the day or with the month; expected 2024-05-03";
  return quote(text) +
         " is no time; expected such as 2024-05-03T12:34:56.789, 2024-05-03 12:34:56, 12:34:56, or a number of "
         "seconds, "
         "milli-, micro- or nanoseconds";
}

std::string print_date(std::int64_t whole, double fraction) {
  const std::chrono::sys_seconds at{std::chrono::seconds(whole)};
  const auto days = std::chrono::floor<std::chrono::days>(at);
  const std::chrono::year_month_day date(days);
  const std::chrono::hh_mm_ss clock(at - days);
  const auto padded = [](auto number, std::size_t width) {
    const std::string text = std::to_string(number);
    return std::string(width > text.size() ? width - text.size() : 0, '0') + text;
  };
  std::string text = padded(static_cast<int>(date.year()), 4) + '-' + padded(static_cast<unsigned>(date.month()), 2) +
                     '-' + padded(static_cast<unsigned>(date.day()), 2) + 'T' + padded(clock.hours().count(), 2) + ':' +
                     padded(clock.minutes().count(), 2) + ':' + padded(clock.seconds().count(), 2);
  const auto milliseconds = static_cast<int>(fraction * 1000);
  if (milliseconds > 0) text += '.' + padded(milliseconds, 3);
  return text + 'Z';
}

std::vector<double> seconds_of(const std::vector<StampCell>& cells, const std::optional<Stamp>& since,
                               std::vector<std::string>& assumed) {
  std::vector<std::optional<Stamp>> stamps = parsed(cells);
  std::vector<double> seconds(cells.size(), std::nan(""));
  if (cells.empty()) return seconds;
  const Stamp& example = **std::find_if(stamps.begin(), stamps.end(), [](const auto& s) { return s.has_value(); });
  const StampKind kind = example.kind;
  if (kind == StampKind::count) in_seconds(stamps, assumed);
  if (kind == StampKind::clock) pass_midnights(cells, stamps, assumed);
  if (kind == StampKind::date && !example.has_zone) assumed.push_back("dates have no zone: taken as UTC");
  if (since && (since->kind == StampKind::clock) != (kind == StampKind::clock))
    throw invalid(cells[0].place, "times are " + name_of(kind) + ", and the map counts them since " +
                                      name_of(since->kind) + "; expected the same kind");
  const Stamp origin = since ? *since : first_of(stamps);
  const bool has_date = kind == StampKind::date || (kind == StampKind::count && std::abs(origin.whole) > 100'000'000);
  std::string from = print_date(origin.whole, origin.fraction);
  if (!has_date)
    from = kind == StampKind::clock ? from.substr(11, from.size() - 12)
                                    : print_real(static_cast<double>(origin.whole) + origin.fraction) + " s";
  assumed.push_back("times are counted from " + from + (since ? "" : ", the first one"));
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    if (stamps[k]) seconds[k] = difference(*stamps[k], origin);
  }
  return seconds;
}

}  // namespace muster::diagnosis
