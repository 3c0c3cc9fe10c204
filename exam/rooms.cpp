#include "exam/rooms.hpp"

#include <algorithm>

#include "exam/trajectory.hpp"

namespace muster::exam {
namespace {

constexpr double pitch = 0.1;      // m
constexpr double narrowest = 1.3;  // m, a room's shorter side
constexpr double smallest = 4;     // m^2
constexpr std::size_t most = 100;

struct Box {
  int left = 0, right = 0, low = 0, high = 0;  // cells, half-open
  int area() const { return (right - left) * (high - low); }
  int shorter() const { return std::min(right - left, high - low); }
};

class Cells {
 public:
  explicit Cells(const Plan& plan)
      : columns_(static_cast<int>(plan.whole.high.x / pitch) + 1),
        rows_(static_cast<int>(plan.whole.high.y / pitch) + 1),
        taken_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (const auto& [a, b] : solid_pieces(plan)) wall(a, b);
  }

  // The largest free rectangle that is wide enough; of zero area if there is none.
  Box largest() const {
    Box best;
    std::vector<int> free(static_cast<std::size_t>(columns_) + 1);  // free cells up to this row; the last one stays 0
    std::vector<Box> open;  // rectangles that may extend to the right, lowest first
    for (int y = 0; y < rows_; ++y) {
      open.clear();
      for (int x = 0; x <= columns_; ++x) {
        int& height = free[static_cast<std::size_t>(x)];
        if (x < columns_) height = taken_[index(x, y)] ? 0 : height + 1;
        int left = x;
        while (!open.empty() && open.back().high - open.back().low >= height) {
          Box closed = open.back();
          open.pop_back();
          left = closed.left;
          closed.right = x;
          if (closed.shorter() * pitch >= narrowest && closed.area() > best.area()) best = closed;
        }
        if (height > 0) open.push_back({left, x, y + 1 - height, y + 1});
      }
    }
    return best;
  }

  void take(const Box& box) {
    for (int y = box.low; y < box.high; ++y)
      for (int x = box.left; x < box.right; ++x) taken_[index(x, y)] = 1;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }

  void wall(Vec2 a, Vec2 b) {
    const auto cell = [](double v, int count) { return std::clamp(static_cast<int>(v / pitch), 0, count - 1); };
    const int left = cell(std::min(a.x, b.x) - 2 * pitch, columns_),
              right = cell(std::max(a.x, b.x) + 2 * pitch, columns_);
    const int low = cell(std::min(a.y, b.y) - 2 * pitch, rows_), high = cell(std::max(a.y, b.y) + 2 * pitch, rows_);
    for (int y = low; y <= high; ++y)
      for (int x = left; x <= right; ++x)
        if (distance_to({(x + 0.5) * pitch, (y + 0.5) * pitch}, a, b) < pitch) taken_[index(x, y)] = 1;
  }

  int columns_, rows_;
  std::vector<char> taken_;
};

}  // namespace

std::vector<Room> rooms_between(const Plan& plan) {
  Cells cells(plan);
  std::vector<Room> result;
  while (result.size() < most) {
    const Box box = cells.largest();
    if (box.area() * pitch * pitch < smallest) break;
    cells.take(box);
    result.push_back({{box.left * pitch, box.low * pitch}, {box.right * pitch, box.high * pitch}});
  }
  return result;
}

}  // namespace muster::exam
