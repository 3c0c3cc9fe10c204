#include "diagnosis/pipeline/closed_loop.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/pipeline/extended_world.hpp"

namespace muster::diagnosis {
namespace {

// Root mean square error of a model's mean over the received readings.
double rmse_of(LinkModel& model, const Dataset& data) {
  const Eigen::VectorXd& mean = model.expected();
  double sum = 0;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (std::isnan(data.rssi[row])) continue;
    const double error = data.rssi[row] - mean[static_cast<Eigen::Index>(row)];
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(data.heard()));
}

}  // namespace

std::optional<SecondLook> second_look(const std::filesystem::path& world, const std::filesystem::path& extended,
                                      const std::filesystem::path& file, const Library::SearchPath& plugins,
                                      const inference::Watch& watch) {
  const auto tables = std::make_shared<TableCache>();
  const Dataset data = read_dataset(tables->read(file));
  LinkModel given(world, file, plugins, tables), model(extended, file, plugins, tables);
  const Diagnosis again = diagnose(extended, file, plugins, tables, watch);
  if (again.interrupted) return {};
  return SecondLook{file, data.heard(), fit(given, data, {}).residual_sd, rmse_of(model, data), named_causes(again)};
}

std::optional<Loop> closed_loop(const Diagnosis& found, const std::filesystem::path& world,
                                const std::filesystem::path& data, const std::filesystem::path& out,
                                const Library::SearchPath& plugins, const inference::Watch& watch) {
  const auto tables = std::make_shared<TableCache>();
  Loop loop{.world = out};
  const std::filesystem::path file = write_extended_world(found, world, out);
  LinkModel model(file, data, plugins, tables);
  loop.rmse_extended = rmse_of(model, read_dataset(tables->read(data)));
  const Eigen::VectorXd& simulated = model.expected();
  for (Eigen::Index i = 0; i < simulated.size(); ++i) {
    if (!std::isnan(found.mean[i]))
      loop.mean_difference = std::max(loop.mean_difference, std::abs(simulated[i] - found.mean[i]));
  }
  const Diagnosis again = diagnose(file, data, plugins, tables, watch);
  if (again.interrupted) return {};
  loop.rediagnosis = named_causes(again);
  if (again.held_out) loop.unseen_error = again.held_out->rmse_before;
  loop.fitted_again = again.world_values;
  return loop;
}

}  // namespace muster::diagnosis
