// A column of measured data that belongs to a radio, or a pair of radios, and changes in time.
#pragma once

#include <algorithm>
#include <muster/plugin.hpp>
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
    if (!settings_.empty()) return;
    for (const Row& row : rows) settings_.push_back(setting_of(row));
    std::sort(settings_.begin(), settings_.end(), [](const Setting<Owner>& a, const Setting<Owner>& b) {
      return std::tie(a.owner, a.t, a.value) < std::tie(b.owner, b.t, b.value);
    });
  }

  // The last value set for the owner at the time, or its first if the time is earlier; null for an owner not in the
  // file.
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
};

}  // namespace muster
