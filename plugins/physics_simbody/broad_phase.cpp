#include "broad_phase.hpp"

#include <algorithm>
#include <numeric>

namespace muster::simbody {

namespace {

void sort_by_begin(const std::vector<Extent>& extents, std::vector<int>& order) {
  if (order.size() != extents.size()) {
    order.resize(extents.size());
    std::iota(order.begin(), order.end(), 0);
  }
  const auto before = [&](int a, int b) {
    const double x = extents[a].low.x(), y = extents[b].low.x();
    return x != y ? x < y : a < b;
  };
  if (!std::is_sorted(order.begin(), order.end(), before)) std::sort(order.begin(), order.end(), before);
}

}  // namespace

void BroadPhase::set_standing(std::vector<Extent> standing) {
  standing_ = std::move(standing);
  standing_order_.clear();
  sort_by_begin(standing_, standing_order_);
}

void BroadPhase::find(const std::vector<Extent>& moving) {
  sort_by_begin(moving, order_);
  among_.clear(), with_standing_.clear(), open_.clear(), open_standing_.clear();
  std::size_t next = 0;
  for (const int i : order_) {
    const Extent& now = moving[i];
    const auto ended = [&](const Extent& e) { return e.high.x() < now.low.x(); };
    open_.erase(std::remove_if(open_.begin(), open_.end(), [&](int j) { return ended(moving[j]); }), open_.end());
    for (const int j : open_) {
      if (now.overlaps(moving[j])) among_.push_back(std::minmax(i, j));
    }
    open_.push_back(i);
    for (; next < standing_order_.size() && standing_[standing_order_[next]].low.x() <= now.high.x(); ++next)
      open_standing_.push_back(standing_order_[next]);
    open_standing_.erase(
        std::remove_if(open_standing_.begin(), open_standing_.end(), [&](int j) { return ended(standing_[j]); }),
        open_standing_.end());
    for (const int j : open_standing_) {
      if (now.overlaps(standing_[j])) with_standing_.push_back({i, j});
    }
  }
  std::sort(among_.begin(), among_.end());
  std::sort(with_standing_.begin(), with_standing_.end());
}

}  // namespace muster::simbody
