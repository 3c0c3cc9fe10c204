// A column of measured data that belongs to a radio, or a pair of radios, and changes in time. In a file without times
// each row is of the reading in the same row of the measured data.
#pragma once

#include <algorithm>
#include <muster/plugin.hpp>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace muster {

// A row of the table: time, owner, and the value from then on.
template <class Owner>
struct Setting {
  double t;
  Owner owner;
  double value;
};

template <class Owner>
class Settings {
 public:
  // The file does not change, so it is sorted once. `setting_of` makes a Setting of a row.
  template <class Row, class Of>
  void read(Rows<const Row> rows, Of setting_of) {
    if (!by_row_.empty()) return;
    for (const Row& row : rows) {
      settings_.push_back(setting_of(row));
      by_row_.push_back(settings_.back().value);
      if (!is_null(settings_.back().t)) timed_ = true;
    }
    if (!timed_) return;
    settings_.erase(std::remove_if(settings_.begin(), settings_.end(), [](const auto& s) { return is_null(s.t); }),
                    settings_.end());
    std::sort(settings_.begin(), settings_.end(), [](const Setting<Owner>& a, const Setting<Owner>& b) {
      return std::tie(a.owner, a.t, a.value) < std::tie(b.owner, b.t, b.value);
    });
  }

  // The last value set for the owner at the time, or its first if the time is earlier; null for an owner not in the
  // file. Without times that of the row `reading`, of `readings`.
  double at(const Owner& owner, double t, std::size_t reading, std::size_t readings) const {
    if (timed_) return at(owner, t);
    if (readings == by_row_.size()) return by_row_[reading];
    throw std::runtime_error("without a column t the file's rows are those of the readings: expected " +
                             std::to_string(readings) + " rows, found " + std::to_string(by_row_.size()));
  }

  double at(const Owner& owner, double t) const {
    const auto after =
        std::upper_bound(settings_.begin(), settings_.end(), std::tie(owner, t),
                         [](const auto& sought, const Setting<Owner>& s) { return sought < std::tie(s.owner, s.t); });
    if (after != settings_.begin() && (after - 1)->owner == owner) return (after - 1)->value;
    return after != settings_.end() && after->owner == owner ? after->value : null();
  }

  std::vector<double> values() const {
    std::vector<double> result;
    for (const Setting<Owner>& s : settings_) result.push_back(s.value);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

 private:
  std::vector<Setting<Owner>> settings_;
  std::vector<double> by_row_;  // of the file
  bool timed_ = false;
};

}  // namespace muster
