#include "below_ground.hpp"

#include <algorithm>

#include "stored_cells.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double slab = 1;  // m; a floor that much below the ground is no slab under it
constexpr std::size_t upright_columns = 8, mesh_columns = 7;
constexpr const char* ned_question = " below the ground (z = 0); is z down here, as in PX4 (NED)? expected metres up";

struct Upright {
  const RowDeclaration* row;
  double base, top;
};

std::vector<Upright> uprights_of(const World& world) {
  std::vector<Upright> result;
  for (const auto& row : world.rows) {
    if (row.set != "wall") continue;
    const auto cells = stored_cells(row, "wall/shape", upright_columns);
    result.push_back({&row, cells[4], cells[4] + cells[5]});
  }
  return result;
}

// A surface may be a valley.
bool has_terrain(const World& world) {
  return std::any_of(world.rows.begin(), world.rows.end(), [](const RowDeclaration& row) {
    return row.set == "mesh" && stored_cells(row, "mesh/shape", mesh_columns)[6] == 1;
  });
}

}  // namespace

void look_below_ground(const XmlElement& root, World& world) {
  const auto walls = uprights_of(world);
  const auto warn = [&](const Place& place, const std::string& what) { world.warnings.push_back({place, what}); };
  if (!walls.empty() && std::all_of(walls.begin(), walls.end(), [](const Upright& wall) { return wall.top <= 0; }))
    warn(walls[0].row->place, "wall " + quote(walls[0].row->name) + " stands from " + print_real(walls[0].base) +
                                  " to " + print_real(walls[0].top) + " m, as all walls do," + ned_question +
                                  ": base=\"0\"");
  if (has_terrain(world)) return;
  double lowest = 0;  // where a cellar's walls begin
  for (const Upright& wall : walls) lowest = std::min(lowest, wall.base);
  const auto look = [&](const XmlElement& element) {
    const XmlAttribute* at = element.attribute(element.name == "floor" ? "z" : "at");
    if (!at || (element.name != "station" && element.name != "floor")) return;
    auto place = parse_reals(at->value, element.name == "floor" ? 1 : 3);
    const double slack = element.name == "floor" ? slab : 0;
    if (!place || !(place->back() < -slack) || place->back() >= lowest - slack) return;
    const XmlAttribute* name = element.attribute("name");
    const double deep = -place->back();
    place->back() = deep;
    std::string meant;
    for (const double each : *place) meant += (meant.empty() ? "" : " ") + print_real(each);
    warn(at->value_place, "attribute " + quote(at->name) + ": " + element.name +
                              (name ? ' ' + quote(name->value) : "") + " is " + print_real(deep) + " m" + ned_question +
                              ": " + at->name + "=\"" + meant + '"');
  };
  for (const auto& child : root.children) {
    look(child);
    for (const auto& inside : child.children) look(inside);  // of <at>: what joins later
  }
}

}  // namespace muster
