// Dates, clock times and counts since 1970 as seconds. No locale, no time zone of the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"

namespace muster::diagnosis {

enum class StampKind {
  date,   // 2024-05-03T12:34:56.789+02:00, 2024-05-03 12:34, 2024/05/03, 03.05.2024 12:34:56, 20240503T123456Z
  clock,  // 12:34:56.789
  count   // a number
};

struct Stamp {
  StampKind kind = StampKind::count;
  std::int64_t whole = 0;  // s since 1970 (UTC) or since midnight; of a count in its own unit
  double fraction = 0;     // s, or of the count's unit
  bool has_zone = false;
};

// Nothing if the text is none of these, a date that the calendar lacks, or a day and month in an order that cannot be
// known.
std::optional<Stamp> parse_stamp(std::string_view text);
// Ends an error about a text that is no stamp.
std::string why_no_stamp(std::string_view text);
// "2024-05-03T12:34:56.789Z"
std::string print_date(std::int64_t whole, double fraction);

// A cell with a stamp.
struct StampCell {
  std::string text;
  Place place;
  std::size_t file = 0;  // clock times without a date begin anew in each
};

// Seconds of a column of stamps since `since`, or since the first one that is not wild; NaN for an empty cell. Counts
// since 1970 are in seconds, milli-, micro- or nanoseconds by their size. Throws Error at the first cell that is no
// stamp, or is of another kind than the others. Adds what was assumed.
std::vector<double> seconds_of(const std::vector<StampCell>& cells, const std::optional<Stamp>& since,
                               std::vector<std::string>& assumed);

}  // namespace muster::diagnosis
