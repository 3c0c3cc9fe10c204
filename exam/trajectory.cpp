#include "exam/trajectory.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

namespace muster::exam {
namespace {

constexpr double pitch = 0.15;      // m, of the grid of the path search
constexpr double clearance = 0.28;  // m, to walls: a door of 0.9 m leaves two cells

double wrapped(double a) { return std::remainder(a, 2 * std::numbers::pi); }

}  // namespace

double distance_to(Vec2 p, Vec2 a, Vec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double u = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - a.x - u * dx, p.y - a.y - u * dy);
}

std::vector<std::pair<Vec2, Vec2>> solid_pieces(const Plan& plan) {
  std::vector<std::pair<Vec2, Vec2>> pieces;
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    const Vec2 a = plan.to_own(plan.walls[i].a), b = plan.to_own(plan.walls[i].b);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const auto at = [&](double s) { return Vec2{a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length}; };
    double from = 0;
    for (const Door& d : plan.doors) {  // at most one in each wall
      if (d.wall != static_cast<int>(i) || !d.open) continue;
      pieces.push_back({at(from), at(d.at)});
      from = d.at + d.width;
    }
    pieces.push_back({at(from), b});
  }
  return pieces;
}

Floor::Floor(const Plan& plan)
    : plan_(plan),
      columns_(static_cast<int>(plan.whole.high.x / pitch) + 1),
      rows_(static_cast<int>(plan.whole.high.y / pitch) + 1),
      blocked_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  const auto block = [&](Vec2 low, Vec2 high, auto near) {
    const Cell first = cell({low.x - 0.5, low.y - 0.5}), last = cell({high.x + 0.5, high.y + 0.5});
    for (int y = std::max(0, first.y); y <= std::min(rows_ - 1, last.y); ++y)
      for (int x = std::max(0, first.x); x <= std::min(columns_ - 1, last.x); ++x)
        if (near(centre({x, y}))) blocked_[index({x, y})] = 1;
  };
  for (const auto& piece : solid_pieces(plan)) {
    const Vec2 a = piece.first, b = piece.second;
    block({std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)},
          [&](Vec2 p) { return distance_to(p, a, b) < clearance; });
  }
  for (const Station& s : plan.stations) {
    const Vec2 at = plan.to_own({s.at.x, s.at.y});
    block(at, at, [&](Vec2 p) { return std::hypot(p.x - at.x, p.y - at.y) < 0.3; });
  }
}

Vec2 Floor::centre(Cell c) const { return {(c.x + 0.5) * pitch, (c.y + 0.5) * pitch}; }

Floor::Cell Floor::cell(Vec2 own) const {
  return {static_cast<int>(std::floor(own.x / pitch)), static_cast<int>(std::floor(own.y / pitch))};
}

bool Floor::is_free(Cell c) const {
  return c.x >= 0 && c.y >= 0 && c.x < columns_ && c.y < rows_ && !blocked_[index(c)];
}
bool Floor::is_free(Vec2 own) const { return is_free(cell(own)); }

bool Floor::sees(Vec2 from, Vec2 to) const {
  const int steps = 1 + static_cast<int>(std::hypot(to.x - from.x, to.y - from.y) / 0.04);
  for (int i = 0; i <= steps; ++i) {
    const double u = static_cast<double>(i) / steps;
    if (!is_free(Vec2{from.x + u * (to.x - from.x), from.y + u * (to.y - from.y)})) return false;
  }
  return true;
}

Vec2 Floor::place_in(Random& random, const Room& room) const {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const Vec2 p{random.uniform(room.low.x, room.high.x), random.uniform(room.low.y, room.high.y)};
    if (is_free(p)) return p;
  }
  throw std::runtime_error("a room of the plan has no free place");
}

std::vector<int> Floor::parts() const {
  std::vector<int> part(blocked_.size(), -1);
  int next = 0;
  std::vector<Cell> queue;
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      if (!is_free(Cell{x, y}) || part[index({x, y})] >= 0) continue;
      queue.assign(1, {x, y});
      part[index({x, y})] = next;
      while (!queue.empty()) {
        const Cell c = queue.back();
        queue.pop_back();
        for (const Cell n : neighbours(c)) {
          if (!is_free(n) || part[index(n)] >= 0) continue;
          part[index(n)] = next;
          queue.push_back(n);
        }
      }
      ++next;
    }
  }
  return part;
}

std::vector<Room> Floor::connected(const std::vector<Room>& rooms) const {
  const std::vector<int> part = parts();
  std::map<int, std::vector<Room>> by_part;
  for (const Room& room : rooms) {
    const Cell middle = cell({(room.low.x + room.high.x) / 2, (room.low.y + room.high.y) / 2});
    if (is_free(middle)) by_part[part[index(middle)]].push_back(room);
  }
  const auto area = [](const std::vector<Room>& some) {
    double sum = 0;
    for (const Room& r : some) sum += (r.high.x - r.low.x) * (r.high.y - r.low.y);
    return sum;
  };
  std::vector<Room> most;
  for (const auto& [number, some] : by_part)
    if (area(some) > area(most)) most = some;
  return most;
}

// Breadth-first search from the goal, then shortcuts by line of sight, so that paths run at any angle.
std::vector<Vec2> Floor::way(Vec2 from, Vec2 to) const {
  std::vector<int> steps(blocked_.size(), -1);
  std::vector<Cell> queue{cell(to)};
  steps[index(queue[0])] = 0;
  const Cell start = cell(from);
  for (std::size_t head = 0; head < queue.size() && steps[index(start)] < 0; ++head) {
    const Cell c = queue[head];
    for (const Cell n : neighbours(c)) {
      if (!is_free(n) || steps[index(n)] >= 0) continue;
      steps[index(n)] = steps[index(c)] + 1;
      queue.push_back(n);
    }
  }
  if (steps[index(start)] < 0) return {};
  std::vector<Vec2> cells;
  for (Cell c = start; steps[index(c)] > 0;) {
    for (const Cell n : {Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}, Cell{c.x - 1, c.y}, Cell{c.x, c.y - 1}}) {
      if (!is_free(n) || steps[index(n)] != steps[index(c)] - 1) continue;
      c = n;
      break;
    }
    cells.push_back(centre(c));
  }
  cells.push_back(to);
  std::vector<Vec2> result{from};
  for (std::size_t next = 0; next < cells.size(); ++next) {
    std::size_t last = next;
    for (std::size_t k = next + 1; k < cells.size() && (k < next + 8 || sees(result.back(), cells[k])); ++k)
      if (sees(result.back(), cells[k])) last = k;
    result.push_back(cells[last]);
    next = last;
  }
  return result;
}

std::vector<Stop> Floor::wander(Random& random, int ticks, double period) const {
  std::vector<Stop> result;
  std::vector<Vec2> ahead;  // corners left on the path, the next one last
  const Room* room = &random.pick(plan_.rooms);
  Vec2 at = place_in(random, *room);
  double pace = random.uniform(0.3, 0.6), yaw = random.uniform(-3, 3), weave = random.uniform(0, 6);
  int visits = 0;  // places left to visit in this room
  for (int i = 0; i < ticks; ++i) {
    while (ahead.empty()) {
      if (visits-- <= 0) {
        room = random.chance(0.25) ? &plan_.corridor : &random.pick(plan_.rooms);
        visits = 1 + random.below(4);
      }
      ahead = way(at, place_in(random, *room));
      std::reverse(ahead.begin(), ahead.end());
    }
    const Vec2 before = at;
    pace = std::clamp(pace + 0.05 * random.normal(), 0.2, 0.75);
    for (double left = pace * period; left > 0 && !ahead.empty();) {
      const double gap = std::hypot(ahead.back().x - at.x, ahead.back().y - at.y), u = gap > left ? left / gap : 1;
      at = {at.x + u * (ahead.back().x - at.x), at.y + u * (ahead.back().y - at.y)};
      left -= gap;
      if (u == 1) ahead.pop_back();
    }
    const double gone = std::hypot(at.x - before.x, at.y - before.y);
    if (gone > 1e-6)
      yaw += std::min(1.0, 2.5 * period) * wrapped(std::atan2(at.y - before.y, at.x - before.x) + plan_.angle - yaw);
    weave += period;
    result.push_back({i * period, plan_.to_world(at), to_millimetres(wrapped(yaw + 0.12 * std::sin(0.9 * weave))),
                      to_millimetres(gone / period)});
  }
  return result;
}

}  // namespace muster::exam
