// Times of a table that a run never comes to.
#pragma once

#include <charconv>
#include <cstdio>
#include <muster/plugin.hpp>
#include <string>

#include "plugins/table_rows.hpp"

namespace muster {

class TableTimes {
 public:
  // `param` is the parameter that names the table's file. For constructors of plugins.
  TableTimes(const Setup& s, const char* param) : rows_(s, param) {
    const std::string end = s.text("world/until");
    std::from_chars(end.data(), end.data() + end.size(), until_);
  }

  struct Span {
    double first, second, last;  // [s]
    std::size_t row;             // of the first, from 0
  };

  // Warns once of each call where rows do not meet the run, or only the first of them does. `what` is said of them,
  // such as "the rows of robot 'a' are", and `so` follows, such as "it never moves".
  void warn_of(const Step& k, const Span& span, const std::string& what, const std::string& so) const {
    const auto [first, second, last, row] = span;
    if (!(until_ > 0)) return;
    if (first >= 0 && first <= until_ && second > until_)
      return k.event("warning: " + rows_.at(row, "t") + what + " at t = " + print(first) + " s, " + print(second) +
                     " s and later, and the run ends at " + print(until_) +
                     " s, so that only the first of them counts; are these milliseconds? expected seconds of the run");
    if (first <= until_ && last >= 0) return;
    constexpr double since_1970 = 1e8;                     // [s] three years, which no run has
    constexpr double morning = 6 * 3600, day = 24 * 3600;  // s
    const bool is_of_day = first > until_ && first >= morning && last < day;
    const std::string unit = first > 1000 * since_1970 ? "; are these milliseconds or less since 1970? expected "
                             : first > since_1970      ? "; are these seconds since 1970? expected "
                             : is_of_day               ? "; are these seconds of the day? expected "
                                                       : "; expected ";
    k.event("warning: " + rows_.at(row, "t") + what + " from t = " + print(first) + " to " + print(last) +
            " s, and the run is from 0 to " + print(until_) + " s, so that " + so + unit + "seconds of the run" +
            (first > since_1970 || is_of_day ? ": the time less that of its start" : ""));
  }

  double until() const { return until_; }  // [s]; 0: without end
  const TableRows& rows() const { return rows_; }

  static std::string print(double value) {
    char text[32];
    return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.14g", value))};
  }

 private:
  double until_ = 0;  // [s]
  TableRows rows_;
};

}  // namespace muster
