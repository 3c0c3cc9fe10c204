// A column of measured data that belongs to a radio and changes in time.
#pragma once

#include <algorithm>
#include <muster/plugin.hpp>
#include <tuple>
#include <vector>

namespace muster {

// A row of the table: when, of which radio (or other number), and the value from then on.
struct Setting {
  double t, radio, value;
};

class Settings {
 public:
  // The file does not change: it is put in order once. `setting_of` makes a Setting of a row.
  template <class Row, class Of>
  void read(Rows<const Row> rows, Of setting_of) {
    if (!by_radio_.empty()) return;
    for (const Row& row : rows) by_radio_.push_back(setting_of(row));
    std::sort(by_radio_.begin(), by_radio_.end(), [](const Setting& a, const Setting& b) {
      return std::tie(a.radio, a.t, a.value) < std::tie(b.radio, b.t, b.value);
    });
  }

  // What was last set for the radio at the time, or first where it is earlier; null for a radio that is not in the
  // file.
  double at(double radio, double t) const {
    const auto after = std::upper_bound(
        by_radio_.begin(), by_radio_.end(), Setting{t, radio, 0},
        [](const Setting& a, const Setting& b) { return std::tie(a.radio, a.t) < std::tie(b.radio, b.t); });
    if (after != by_radio_.begin() && (after - 1)->radio == radio) return (after - 1)->value;
    return after != by_radio_.end() && after->radio == radio ? after->value : null();
  }

  std::vector<double> values() const {
    std::vector<double> result;
    for (const Setting& s : by_radio_) result.push_back(s.value);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

 private:
  std::vector<Setting> by_radio_;
};

}  // namespace muster
