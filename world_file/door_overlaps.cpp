#include "door_overlaps.hpp"

#include <algorithm>
#include <cmath>

#include "stored_cells.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double snapping = 1e-3;  // m; a scene rounds both ends to 2^-12 m
constexpr std::size_t door_columns = 5, wall_columns = 8;

struct Span {
  const RowDeclaration* row;
  std::size_t wall;
  double from, to;
  std::string text() const { return print_real(from) + " to " + print_real(to) + " m"; }
  bool overlaps(const Span& other) const {
    return wall == other.wall && from < other.to - snapping && other.from < to - snapping;
  }
};

double to_micrometres(double metres) { return std::round(metres * 1e6) / 1e6; }

std::vector<Span> spans_of(const World& world) {
  std::vector<Span> result;
  for (const auto& row : world.rows) {
    if (row.set != "door") continue;
    const auto cells = stored_cells(row, "door/shape", door_columns);  // wall at width height material
    result.push_back(
        {&row, static_cast<std::size_t>(cells[0]), to_micrometres(cells[1]), to_micrometres(cells[1] + cells[2])});
  }
  return result;
}

double length_of(const World& world, std::size_t wall) {
  for (const auto& row : world.rows) {
    if (row.set != "wall" || wall-- > 0) continue;
    const auto c = stored_cells(row, "wall/shape", wall_columns);
    return std::hypot(c[2] - c[0], c[3] - c[1]);
  }
  return 0;
}

// `at="6.5" or more`, behind the other door, or before it; what else is to be done where neither is free.
std::string free_place(const Span& door, const Span& other, const std::vector<Span>& all, double length) {
  const double width = to_micrometres(door.to - door.from);
  const auto is_free = [&](double at) {
    const Span there{door.row, door.wall, at, at + width};
    return at >= 0 && at + width <= length + snapping && std::none_of(all.begin(), all.end(), [&](const Span& each) {
             return each.row != door.row && each.overlaps(there);
           });
  };
  if (is_free(other.to)) return "at=\"" + print_real(other.to) + "\" or more";
  const double before = to_micrometres(other.from - width);
  if (is_free(before)) return "at=\"" + print_real(before) + "\" or less";
  return "a narrower door, or one of the two";
}

}  // namespace

void refuse_overlapping_doors(const XmlElement& root, const World& world) {
  const auto all = spans_of(world);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!all[i].overlaps(all[j])) continue;
      const Place& place = all[i].row->place;
      const auto element = std::find_if(root.children.begin(), root.children.end(), [&](const XmlElement& each) {
        return each.place.line == place.line && each.place.column == place.column;
      });
      const XmlAttribute* at = element == root.children.end() ? nullptr : element->attribute("at");
      throw invalid(at ? at->value_place : place, "door " + quote(all[i].row->name) + " (" + all[i].text() +
                                                      ") overlaps door " + quote(all[j].row->name) + " (" +
                                                      all[j].text() + ", " + all[j].row->place.text() +
                                                      ") in the same wall; expected " +
                                                      free_place(all[i], all[j], all, length_of(world, all[i].wall)));
    }
  }
}

}  // namespace muster
