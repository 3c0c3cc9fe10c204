#include "scene/wall_columns.hpp"

#include <algorithm>
#include <numeric>

#include "scene/curve.hpp"

namespace muster::scene {
namespace {

constexpr float nowhere = 1e9f;  // lattice steps

std::vector<int> along_curve(const std::vector<WallColumns::Source>& walls) {
  std::vector<std::uint32_t> place;
  for (const auto& wall : walls) {
    place.push_back(place_on_curve({(wall.a.x + wall.b.x) / 2, (wall.a.y + wall.b.y) / 2}));
  }
  std::vector<int> order(walls.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return place[a] < place[b]; });
  return order;
}

WallBlock empty_walls() {
  WallBlock result = {};
  std::fill_n(result.base, block, nowhere);
  std::fill_n(result.top, block, -nowhere);
  std::fill_n(result.plain_top, block, -nowhere);
  return result;
}

void set(WallBlock& in, std::size_t i, const WallColumns::Source& wall) {
  in.ax[i] = static_cast<float>(wall.a.x), in.ay[i] = static_cast<float>(wall.a.y);
  in.bx[i] = static_cast<float>(wall.b.x), in.by[i] = static_cast<float>(wall.b.y);
  in.base[i] = static_cast<float>(wall.base), in.top[i] = static_cast<float>(wall.top);
  in.plain_top[i] = wall.has_doors ? -nowhere : in.top[i];
  in.material[i] = wall.material;
}

BoxBlock empty_boxes() {
  BoxBlock result;
  std::fill_n(result.west, block, nowhere), std::fill_n(result.south, block, nowhere);
  std::fill_n(result.east, block, -nowhere), std::fill_n(result.north, block, -nowhere);
  return result;
}

void widen(BoxBlock& in, std::size_t i, float west, float east, float south, float north) {
  in.west[i] = std::min(in.west[i], west), in.east[i] = std::max(in.east[i], east);
  in.south[i] = std::min(in.south[i], south), in.north[i] = std::max(in.north[i], north);
}

std::size_t blocks_of(std::size_t items) { return (items + block - 1) / block; }

}  // namespace

WallColumns::WallColumns(const std::vector<Source>& walls, int materials)
    : row_(along_curve(walls)), materials_(materials) {
  walls_.resize(std::max<std::size_t>(blocks_of(walls.size()), 1), empty_walls());
  for (std::size_t i = 0; i < walls.size(); ++i) set(walls_[i / block], i % block, walls[row_[i]]);
  row_.resize(walls_.size() * block, -1);
  add_boxes();
}

void WallColumns::add_boxes() {
  levels_.emplace_back(blocks_of(walls_.size()), empty_boxes());
  for (std::size_t i = 0; i < row_.size() && row_[i] >= 0; ++i) {
    const WallBlock& wall = walls_[i / block];
    const std::size_t k = i % block, box = i / block;
    widen(levels_[0][box / block], box % block, std::min(wall.ax[k], wall.bx[k]), std::max(wall.ax[k], wall.bx[k]),
          std::min(wall.ay[k], wall.by[k]), std::max(wall.ay[k], wall.by[k]));
  }
  while (levels_.back().size() > 1) {
    const std::vector<BoxBlock>& inner = levels_.back();
    std::vector<BoxBlock> outer(blocks_of(inner.size()), empty_boxes());
    for (std::size_t i = 0; i < inner.size() * block; ++i) {
      const BoxBlock& box = inner[i / block];
      const std::size_t k = i % block, into = i / block;
      widen(outer[into / block], into % block, box.west[k], box.east[k], box.south[k], box.north[k]);
    }
    levels_.push_back(std::move(outer));
  }
}

WallTable WallColumns::table() const {
  WallTable result;
  result.blocks = static_cast<int>(walls_.size());
  result.materials = materials_;
  result.walls = walls_.data();
  for (const auto& boxes : levels_) result.boxes[result.levels++] = boxes.data();
  return result;
}

}  // namespace muster::scene
