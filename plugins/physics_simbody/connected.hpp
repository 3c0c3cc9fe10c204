// Connected components by union-find. The smallest member is the root, so the result does not depend on the order.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace muster::simbody {

class Connected {
 public:
  // Resets to `count` separate members.
  void begin(int count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) {
    i = root(i), j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace muster::simbody
