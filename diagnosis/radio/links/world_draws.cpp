#include "diagnosis/radio/links/world_draws.hpp"

#include <utility>

#include "diagnosis/radio/links/drawn_term.hpp"
#include "muster/random.hpp"

namespace muster::diagnosis {

WorldDraws::WorldDraws(std::filesystem::path world, std::filesystem::path data, Library::SearchPath plugins,
                       std::shared_ptr<TableCache> tables, double step, std::map<std::string, double> floors)
    : world_(std::move(world)),
      data_(std::move(data)),
      plugins_(std::move(plugins)),
      tables_(std::move(tables)),
      step_(step),
      floors_(std::move(floors)) {}

WorldDraw WorldDraws::draw(uint64_t number, const std::map<std::string, double>& values,
                           const noise::StatedField& field) const {
  LinkModel model(world_, data_, plugins_, tables_, combined(key_of("draws of the world"), number));
  for (const auto& [path, lowest] : floors_) model.set(path, lowest);
  for (const auto& [path, value] : values) model.set(path, value);
  if (field.shadowing > 0) set_drawn_field(model, field);
  Eigen::VectorXd drawn = model.drawn();
  if (step_ > 0) drawn = step_ * (drawn / step_).array().round();
  return {drawn, model.expected()};
}

}  // namespace muster::diagnosis
