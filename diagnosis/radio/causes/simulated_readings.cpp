#include "diagnosis/radio/causes/simulated_readings.hpp"

#include <numeric>

#include "text/text_table_writer.hpp"

namespace muster::diagnosis {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;

void write(const LinkReadings& r, const std::vector<std::string>& radios, const fs::path& file) {
  std::vector<TextColumn> columns{{"tx", ""},    {"rx", ""},    {"tx_x", "m"}, {"tx_y", "m"},
                                  {"tx_z", "m"}, {"rx_x", "m"}, {"rx_y", "m"}, {"rx_z", "m"}};
  if (!r.t.empty()) columns.push_back({"t", "s"});
  if (!r.rx_yaw.empty()) columns.push_back({"rx_yaw", "rad"});
  if (!r.tx_yaw.empty()) columns.push_back({"tx_yaw", "rad"});
  TextTableWriter table(file, columns);
  for (Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    table.text(radios[static_cast<std::size_t>(r.tx[k])]);
    table.text(radios[static_cast<std::size_t>(r.rx[k])]);
    for (const auto& at : {r.tx_at.col(i), r.rx_at.col(i)})
      for (Index c = 0; c < 3; ++c) table.real(at[c]);
    if (!r.t.empty()) table.real(r.t[k]);
    if (!r.rx_yaw.empty()) table.real(r.rx_yaw[k]);
    if (!r.tx_yaw.empty()) table.real(r.tx_yaw[k]);
    table.end_row();
  }
  table.close();
}

// These readings, then one of each radio that has none: a cause may concern a radio that only measured readings name.
LinkReadings with_all_radios(LinkReadings r, const std::vector<std::string>& radios) {
  const Index before = r.size();
  if (before == 0) return r;
  std::vector<char> heard(radios.size());
  for (const auto* ends : {&r.tx, &r.rx}) {
    for (const int radio : *ends) heard[static_cast<std::size_t>(radio)] = 1;
  }
  for (std::size_t radio = 0; radio < radios.size(); ++radio) {
    if (heard[radio]) continue;
    r.tx.push_back(static_cast<int>(radio));
    r.rx.push_back(r.tx.front());
    for (std::vector<double>* column : {&r.t, &r.rx_yaw, &r.tx_yaw}) {
      if (!column->empty()) column->push_back(column->back());
    }
  }
  for (Eigen::Matrix3Xd* at : {&r.tx_at, &r.rx_at}) {
    at->conservativeResize(Eigen::NoChange, r.size());
    at->rightCols(r.size() - before).colwise() = at->col(0).eval();
  }
  return r;
}

}  // namespace

SimulatedReadings::SimulatedReadings(const LinkReadings& readings, const std::vector<std::string>& radios,
                                     const fs::path& world, const Library::SearchPath& plugins,
                                     const Sensitivities& base, const std::vector<std::shared_ptr<Library>>& libraries)
    : all_(static_cast<std::size_t>(readings.size())) {
  std::iota(all_.begin(), all_.end(), 0);
  const fs::path table = folder_.path() / "readings.csv";
  write(with_all_radios(readings, radios), radios, table);
  model_ = std::make_unique<LinkModel>(world, table, plugins, std::make_shared<TableCache>(), std::nullopt, libraries);
  for (std::size_t j = 0; j < base.paths.size(); ++j) model_->set(base.paths[j], base.values[static_cast<Index>(j)]);
  run_ = std::make_shared<CauseModel>(*model_, world, table, plugins);
}

Eigen::MatrixXd SimulatedReadings::slopes(const Sensitivities& base) {
  return slopes_at(*model_, base).topRows(static_cast<Index>(all_.size()));
}

inference::Candidate SimulatedReadings::at(const CauseCandidate& cause) const {
  return at_readings_of(cause, {run_, all_});
}

bool holds_a_table_reader(const LinkModel& model) {
  for (const auto& instance : model.simulation().instances()) {
    const muster_plugin& plugin = instance->plugin();
    for (uint32_t k = 0; plugin.cause && k < plugin.param_count; ++k) {
      if (plugin.params[k].kind == MUSTER_FILE) return true;
    }
  }
  return false;
}

}  // namespace muster::diagnosis
