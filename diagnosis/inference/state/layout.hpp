// Rows of a search and their sites, as a kind of measurement lays them out.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/inference/noise/rows.hpp"

namespace muster::inference {

using Eigen::Index;

// Rows that may be left out together, beside blocks of sites: a number from 0 on for each.
struct Grouping {
  std::string name;  // in the plural, as a report prints it
  std::vector<int> of_row;
};

class Layout {
 public:
  virtual ~Layout() = default;
  virtual Index size() const = 0;  // readings
  virtual noise::Rows rows() const = 0;
  // Of the usual length or longer, on which effects that vary slowly are judged.
  virtual noise::Rows long_rows() const { return rows(); }
  virtual noise::Sites sites(const noise::Rows& rows) const = 0;
  // `sites`: of these rows.
  virtual std::vector<Grouping> groupings(const noise::Rows& /*rows*/, const noise::Sites& /*sites*/) const {
    return {};
  }
  // False where sites stand for something else, so that a gain's place means nothing.
  virtual bool sites_known() const { return true; }
};

// Numbers from 0 on, in the order of the keys' own values.
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
