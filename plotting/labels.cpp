#include "labels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

namespace muster::plotting {
namespace {

constexpr double label_size = 10.5;  // px

// Advance widths of ' ' to '~', thousandths of the size: the wider of Helvetica and of DejaVu Sans, its substitute on
// many machines.
constexpr std::array<std::uint16_t, 95> advances{
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 556, 1015, 684, 686, 722, 770, 667,
    611, 778, 752, 295, 500, 667, 557, 863, 748, 787, 667, 787, 722, 667,  611, 732, 684, 989, 685,
    667, 685, 390, 337, 390, 838, 556, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right(), b.right()) - std::max(a.x, b.x);
  const double height = std::min(a.bottom(), b.bottom()) - std::max(a.y, b.y);
  return width > 0 && height > 0 ? width * height : 0;
}

}  // namespace

double text_width(std::string_view text, double size) {
  double thousandths = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte <= '~')
      thousandths += advances[byte - ' '];
    else if (byte >= 0xC0)
      thousandths += byte < 0xE0 ? 620 : 840;  // the first byte of a non-ASCII letter, or of a sign such as a minus
  }
  return thousandths * size / 1000;
}

std::vector<std::string> wrapped(std::string_view text, double width, double size) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (!lines.empty() && text_width(lines.back() + ' ' + word, size) <= width)
      lines.back() += ' ' + word;
    else
      lines.push_back(word);
  }
  return lines;
}

std::vector<double> spread(const std::vector<double>& wanted, double gap, Range range) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  // Pool adjacent violators: neighbours that collide merge into a block around the mean of their wanted positions.
  struct Block {
    double start;
    double sum;  // of wanted positions, each less its offset in the block
    std::size_t count;
  };
  std::vector<Block> blocks;
  const auto settle = [&](Block& block) {
    const double length = gap * static_cast<double>(block.count - 1);
    const double start = std::min(block.sum / static_cast<double>(block.count), range.high - length);
    block.start = std::max(start, range.low);
  };
  for (const std::size_t i : order) {
    blocks.push_back({0, wanted[i], 1});
    settle(blocks.back());
    while (blocks.size() > 1) {
      Block& last = blocks.back();
      Block& before = blocks[blocks.size() - 2];
      const double length = gap * static_cast<double>(before.count);
      if (before.start + length <= last.start) break;
      before.sum += last.sum - static_cast<double>(last.count) * length;
      before.count += last.count;
      blocks.pop_back();
      settle(blocks.back());
    }
  }
  std::vector<double> result(wanted.size());
  std::size_t next = 0;
  for (const Block& block : blocks) {
    for (std::size_t k = 0; k < block.count; ++k) result[order[next++]] = block.start + gap * static_cast<double>(k);
  }
  return result;
}

void Labels::occupy(const Box& box, double weight) { occupied_.push_back({box, weight}); }

void Labels::occupy_line(Point a, Point b, double weight) {
  constexpr double piece = 8;  // px
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int pieces = static_cast<int>(std::min(length / piece, 1000.0)) + 1;
  for (int i = 0; i <= pieces; ++i) {
    const double f = static_cast<double>(i) / pieces;
    occupy({std::lerp(a.x, b.x, f) - piece / 4, std::lerp(a.y, b.y, f) - piece / 4, piece / 2, piece / 2}, weight);
  }
}

void Labels::beside(Point mark, double radius, std::string text, Colour colour) {
  if (text.empty()) return;
  const double dx = radius + 4 + text_width(text, label_size) / 2, dy = radius + 3 + label_size / 2;
  std::vector<Candidate> candidates;
  for (const double far : {1.0, 1.5}) {
    for (const Point way :
         {Point{1, 0}, {0, -1}, {-1, 0}, {0, 1}, {0.9, -0.8}, {-0.9, -0.8}, {0.9, 0.8}, {-0.9, 0.8}}) {
      const Point centre{mark.x + way.x * dx * far, mark.y + way.y * dy * far};
      candidates.push_back({centre, static_cast<double>(candidates.size())});
    }
  }
  requests_.push_back({std::move(text), colour, std::move(candidates), true});
}

void Labels::along(Point a, Point b, std::string text, Colour colour) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const double width = text_width(text, label_size);
  // Beside the line, its box touches the line from outside.
  const double nx = length > 0 ? (b.y - a.y) / length : 0, ny = length > 0 ? -(b.x - a.x) / length : 1;
  const double aside = std::abs(nx) * width / 2 + std::abs(ny) * label_size / 2 + 3;
  std::vector<Candidate> candidates;
  for (const double offset : {0.0, 1.0, -1.0, 2.2, -2.2}) {
    for (const double f : {0.5, 0.42, 0.58, 0.35, 0.65, 0.28, 0.72}) {
      const double away = std::abs(offset) > 1 ? 250 : 0;  // far from the line, a label is hard to match to it
      const Point centre{std::lerp(a.x, b.x, f) + nx * aside * offset, std::lerp(a.y, b.y, f) + ny * aside * offset};
      candidates.push_back({centre, away + static_cast<double>(candidates.size())});
    }
  }
  requests_.push_back({std::move(text), colour, std::move(candidates), false});
}

double Labels::cost(const Box& box, const Box& area) const {
  double sum = 10 * (box.width * box.height - overlap(box, area));
  for (const Occupied& other : occupied_) sum += other.weight * overlap(box, other.box);
  return sum;
}

void Labels::write(Svg& svg, const Box& area) {
  std::stable_partition(requests_.begin(), requests_.end(), [](const Request& request) { return request.mark; });
  for (const Request& request : requests_) {
    const double width = text_width(request.text, label_size);
    Box best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (const auto& [centre, penalty] : request.candidates) {
      const Box box{centre.x - width / 2, centre.y - label_size / 2, width, label_size};
      const double total = cost(box, area) + penalty;
      if (total < best_cost) {
        best_cost = total;
        best = box;
      }
    }
    occupy({best.x - 2, best.y - 2, best.width + 4, best.height + 4}, 6);
    svg.text({best.x + width / 2, best.bottom() - 0.15 * label_size}, request.text,
             {.size = label_size, .colour = request.colour, .anchor = Anchor::middle, .halo = true});
  }
}

}  // namespace muster::plotting
