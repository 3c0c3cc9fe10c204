// The whitener by columns: for each row the whitened rows that it enters, and by what weight. A column that is zero
// at most rows is whitened only where it is not.
#pragma once

#include <vector>

#include "diagnosis/inference/noise/vecchia.hpp"

namespace muster::noise {

class Reach {
 public:
  Reach(const Field& field, const Whitener& whitener);

  struct Entry {
    Index row;  // of what is whitened
    double weight;
  };
  struct Entries {
    const Entry *first, *last;
    const Entry* begin() const { return first; }
    const Entry* end() const { return last; }
  };
  Entries of(Index row) const {
    const auto k = static_cast<std::size_t>(row);
    return {entries_.data() + first_[k], entries_.data() + first_[k + 1]};
  }

  // Product with the whitener's transpose: each row's whitened unit column times a whitened column.
  Eigen::VectorXd transposed(const Eigen::VectorXd& whitened) const;

 private:
  std::vector<std::size_t> first_;  // in entries_, one a row and one past the last
  std::vector<Entry> entries_;
};

}  // namespace muster::noise
