#include "diagnosis/prediction/measured_world.hpp"

#include <algorithm>

namespace muster::diagnosis {
namespace {

Options completed(Options options, const Observable& observable, const std::shared_ptr<TableCache>& tables) {
  options.tables = tables;
  options.more.insert(options.more.begin(), observable.stand_in);
  return options;
}

}  // namespace

FirstColumn first_column(const TableView& table) {
  const auto rows = static_cast<Eigen::Index>(table.rows()), columns = static_cast<Eigen::Index>(table.cols());
  return {table.table->now().data.data(), rows, Eigen::InnerStride<>(columns)};
}

MeasuredWorld::MeasuredWorld(World world, Options options, Observable observable)
    : observable_(std::move(observable)),
      tables_(options.tables ? options.tables : std::make_shared<TableCache>()),
      run_(std::make_unique<Simulation>(std::move(world), *observable_.sets,
                                        completed(std::move(options), observable_, tables_))) {
  evaluate(true);
}

std::vector<std::shared_ptr<Library>> MeasuredWorld::libraries() const {
  std::vector<std::shared_ptr<Library>> result;
  for (const auto& instance : run_->instances()) {
    // One that the world names by its file is not what others mean by its id.
    if (!instance->declared().library) result.push_back(instance->library());
  }
  return result;
}

void MeasuredWorld::evaluate(bool expected) {
  run_->evaluate(observable_.phase, expected);
  ++evaluations_;
  values_ = first_column(run_->table(observable_.measured));
}

const Eigen::VectorXd& MeasuredWorld::expected() {
  evaluate(true);
  return values_;
}

Eigen::VectorXd MeasuredWorld::drawn() {
  evaluate(false);
  return values_;
}

ParameterGuard::~ParameterGuard() {
  for (const auto& [path, value] : before_) world_.set(path, value);
}

void ParameterGuard::set(const std::string& path, double value) {
  const auto known = std::find_if(before_.begin(), before_.end(), [&](const auto& b) { return b.first == path; });
  if (known == before_.end()) before_.emplace_back(path, world_.parameter(path).value);
  world_.set(path, value);
}

}  // namespace muster::diagnosis
