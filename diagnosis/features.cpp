#include "diagnosis/features.hpp"

#include <cmath>
#include <muster/tables.hpp>

#include "scene/walls.hpp"

namespace muster::diagnosis {
namespace {

std::size_t at(double row) { return static_cast<std::size_t>(row); }

template <class Row>
std::vector<Row> rows_of(const Simulation& run, const std::string& name) {
  const Table* table = run.board().find(name);
  if (!table) return {};
  const auto* first = reinterpret_cast<const Row*>(table->now().data.data());
  return {first, first + table->now().rows};
}

std::vector<std::string> names_of(const Simulation& run, const std::string& set) {
  const Set* found = run.board().find_set(set);
  return found ? found->names : std::vector<std::string>{};
}

scene::Scene scene_of(const Simulation& run, int materials) {
  std::vector<scene::Wall> walls;
  const auto given = rows_of<Wall>(run, "wall/*/shape");
  for (const Wall& w : given)
    walls.push_back({w.x0, w.y0, w.x1, w.y1, w.base, w.height, w.thickness, static_cast<int>(w.material)});
  std::vector<scene::Door> doors;
  const auto states = rows_of<DoorState>(run, "door/*/state");
  for (const Door& d : rows_of<Door>(run, "door/*/shape")) {
    const double material = std::isnan(d.material) ? given.at(at(d.wall)).material : d.material;
    const bool open = states.at(doors.size()).open != 0;
    doors.push_back({static_cast<int>(d.wall), d.at, d.width, d.height, static_cast<int>(material), open});
  }
  return {walls, doors, materials};
}

void add_directions(Features& f, const End& tx, const End& rx) {
  const double x = rx.x - tx.x, y = rx.y - tx.y, z = rx.z - tx.z, azimuth = std::atan2(y, x);
  f.distance.push_back(std::sqrt(x * x + y * y + z * z));
  f.azimuth.push_back(azimuth);
  f.elevation.push_back(std::atan2(z, std::hypot(x, y)));
  f.tx_bearing.push_back(wrapped(azimuth - tx.yaw));
  f.rx_bearing.push_back(wrapped(azimuth + 3.141592653589793 - rx.yaw));
}

}  // namespace

double wrapped(double angle) {
  const double result = std::remainder(angle, 6.283185307179586);
  return result <= -3.141592653589793 ? result + 6.283185307179586 : result;
}

Features features_of(const LinkModel& model) {
  Features f;
  f.materials = names_of(model.simulation(), "material");
  f.walls = names_of(model.simulation(), "wall");
  f.by_material.assign(f.materials.size(), std::vector<int>(model.rows(), 0));
  f.first.push_back(0);
  try {
    const scene::Scene scene = scene_of(model.simulation(), static_cast<int>(f.materials.size()));
    std::vector<scene::Crossing> crossings;
    for (std::size_t row = 0; row < model.rows(); ++row) {
      const auto& [tx, rx] = model.ends()[row];
      add_directions(f, tx, rx);
      scene.crossings({tx.x, tx.y, tx.z}, {rx.x, rx.y, rx.z}, crossings);
      double incidence = 0;
      for (const auto& c : crossings) {
        f.crossed.push_back(c.wall);
        ++f.by_material[at(c.material)][row];
        incidence += std::acos(std::min(1.0, c.cos_incidence));
      }
      f.incidence.push_back(crossings.empty() ? std::nan("") : incidence / static_cast<double>(crossings.size()));
      f.first.push_back(f.crossed.size());
    }
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& e) {  // the scene's words name the row at fault
    throw Error(Exit::invalid_input, model.simulation().world().file.string() + ": " + e.what());
  }
  return f;
}

}  // namespace muster::diagnosis
