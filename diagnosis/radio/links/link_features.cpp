#include "diagnosis/radio/links/link_features.hpp"

#include <cmath>

#include "diagnosis/radio/links/floor_plan.hpp"
#include "diagnosis/radio/links/run_tables.hpp"

namespace muster::diagnosis {
namespace {

std::size_t at(double row) { return static_cast<std::size_t>(row); }

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
    const scene::Scene scene = scene_of(model.simulation());
    std::vector<scene::Crossing> crossings;
    for (std::size_t row = 0; row < model.rows(); ++row) {
      const auto& [tx, rx] = model.ends()[row];
      add_directions(f, tx, rx);
      scene.crossings({tx.x, tx.y, tx.z}, {rx.x, rx.y, rx.z}, crossings);
      double incidence = 0;
      for (const auto& c : crossings) {
        if (c.wall >= 0) f.crossed.push_back(c.wall);
        ++f.by_material[at(c.material)][row];
        incidence += std::acos(std::min(1.0, c.cos_incidence));
      }
      f.incidence.push_back(crossings.empty() ? std::nan("") : incidence / static_cast<double>(crossings.size()));
      f.first.push_back(f.crossed.size());
    }
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& e) {  // with the row at fault
    throw Error(Exit::invalid_input, model.simulation().world().file.string() + ": " + e.what());
  }
  return f;
}

}  // namespace muster::diagnosis
