// Layout of a kind of measurement: rows of the search and their sites.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/inference/noise/rows.hpp"

namespace muster::inference {

using Eigen::Index;

// Groups of rows that cross-validation may leave out together, beside blocks of sites; numbered from 0.
struct Grouping {
  std::string name;  // in the plural, as a report prints it
  std::vector<int> of_row;
};

class Layout {
 public:
  virtual ~Layout() = default;
  virtual Index size() const = 0;  // readings
  virtual noise::Rows rows() const = 0;
  // Rows of the usual length or longer, for tests of slowly varying effects.
  virtual noise::Rows long_rows() const { return rows(); }
  virtual noise::Sites sites(const noise::Rows& rows) const = 0;
  // Times of the rows, s, to which errors of what stands still may be correlated; empty without time.
  virtual std::vector<double> times(const noise::Rows& /*rows*/) const { return {}; }
  // `sites`: of these rows.
  virtual std::vector<Grouping> groupings(const noise::Rows& /*rows*/, const noise::Sites& /*sites*/) const {
    return {};
  }
  // Parts of the time span that cross-validation may leave out, one a row, numbered from 0; empty without time.
  virtual std::vector<int> parts_of_time(const noise::Rows& /*rows*/) const { return {}; }
  // Stays, one a row, numbered from 0: readings of one stream at one site without a pause. -1: of rows of several
  // sites, and of differences. Empty without time.
  virtual std::vector<int> stays(const noise::Rows& /*rows*/) const { return {}; }
  // False where sites are not places, so that the place of a gain has no meaning.
  virtual bool sites_known() const { return true; }
};

// Ranks of the keys, from 0.
template <class Key>
std::vector<int> numbered(const std::vector<Key>& keys) {
  std::map<Key, int> number;
  for (const Key& key : keys) number[key] = 0;
  int next = 0;
  for (auto& [key, k] : number) k = next++;
  std::vector<int> result;
  result.reserve(keys.size());
  for (const Key& key : keys) result.push_back(number.at(key));
  return result;
}

}  // namespace muster::inference
