#include "scene/box_tree.hpp"

#include <algorithm>

namespace muster::scene {
namespace {

constexpr std::size_t leaf_size = 4;

Box around(const std::vector<Box>& boxes, const std::vector<std::size_t>& items, std::size_t first, std::size_t last) {
  Box all = boxes[items[first]];
  for (std::size_t i = first + 1; i < last; ++i) {
    const Box& box = boxes[items[i]];
    all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y)};
    all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y)};
  }
  return all;
}

}  // namespace

bool Box::may_meet(const Span& link) const {
  const Spot &p = link.from, &q = link.to;
  if (q.y < low.y || p.y > high.y) return false;  // links run northward
  if (std::max(p.x, q.x) < low.x || std::min(p.x, q.x) > high.x) return false;
  // A crossed wall has an end on either side of the link, so the box's leftmost and rightmost corners are on either
  // side too.
  const bool runs_east = q.x >= p.x;
  const Spot leftmost{low.x, runs_east ? high.y : low.y};
  const Spot rightmost{high.x, runs_east ? low.y : high.y};
  return !is_right(orientation(p, q, leftmost)) && is_right(orientation(p, q, rightmost));
}

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) items_.push_back(i);
  if (!boxes.empty()) build(boxes, 0, boxes.size());
}

void BoxTree::build(const std::vector<Box>& boxes, std::size_t first, std::size_t last) {
  const std::size_t at = branches_.size();
  branches_.push_back({});
  const Box box = around(boxes, items_, first, last);
  branches_[at].box = box;
  if (last - first <= leaf_size) {
    branches_[at].first = first;
    branches_[at].last = last;
    return;
  }
  const bool wide = box.high.x - box.low.x > box.high.y - box.low.y;
  const auto centre = [&](std::size_t i) {
    return wide ? boxes[i].low.x + boxes[i].high.x : boxes[i].low.y + boxes[i].high.y;
  };
  const std::size_t middle = first + (last - first) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last,
                   [&](std::size_t a, std::size_t b) { return centre(a) < centre(b); });
  build(boxes, first, middle);
  branches_[at].other = branches_.size();
  build(boxes, middle, last);
}

}  // namespace muster::scene
