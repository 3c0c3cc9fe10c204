// Tree of bounding boxes around walls, to find the candidates that a link may cross. Misses none; reports each once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/lattice.hpp"

namespace muster::scene {

struct Box {
  Spot low, high;

  // False only if the link crosses nothing inside under the half-open rule.
  bool may_meet(const Span& link) const;
};

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes);

  // Calls report(i) for every box i that the link may meet, in no useful order.
  template <class Visit>
  void visit(const Span& link, const Visit& report) const;

 private:
  // Children are the next branch and `other`; a leaf holds the items [first, last) and has no children.
  struct Branch {
    Box box;
    std::size_t other = 0, first = 0, last = 0;
  };

  void build(const std::vector<Box>& boxes, std::size_t first, std::size_t last);

  std::vector<Branch> branches_;
  std::vector<std::size_t> items_;
};

template <class Visit>
void BoxTree::visit(const Span& link, const Visit& report) const {
  constexpr std::size_t max_depth = 64;  // halving: more boxes than any memory holds
  std::size_t waiting[max_depth];
  std::size_t count = 0;
  if (!branches_.empty()) waiting[count++] = 0;
  while (count > 0) {
    const std::size_t at = waiting[--count];
    const Branch& branch = branches_[at];
    if (!branch.box.may_meet(link)) continue;
    for (std::size_t i = branch.first; i < branch.last; ++i) report(items_[i]);
    if (branch.other == 0) continue;
    waiting[count++] = branch.other;
    waiting[count++] = at + 1;
  }
}

}  // namespace muster::scene
