#include "diagnosis/simulated_readings.hpp"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <numeric>

#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;

std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

fs::path new_file() {
  static std::atomic<int> count{0};
  return fs::temp_directory_path() /
         ("muster_readings_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".csv");
}

void write(const noise::Readings& r, const std::vector<std::string>& radios, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << (r.t.empty() ? "" : "t[s],") << "tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]"
      << (r.rx_yaw.empty() ? "" : ",rx_yaw[rad]") << '\n';
  for (Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!r.t.empty()) out << print_real(r.t[k]) << ',';
    out << quoted(radios[static_cast<std::size_t>(r.tx[k])]) << ','
        << quoted(radios[static_cast<std::size_t>(r.rx[k])]);
    for (const auto& at : {r.tx_at.col(i), r.rx_at.col(i)})
      for (Index c = 0; c < 3; ++c) out << ',' << print_real(at[c]);
    if (!r.rx_yaw.empty()) out << ',' << print_real(r.rx_yaw[k]);
    out << '\n';
  }
  if (!out.flush()) throw Error(Exit::io, file.string() + ": cannot be written");
}

}  // namespace

SimulatedReadings::SimulatedReadings(const noise::Readings& readings, const std::vector<std::string>& radios,
                                     const fs::path& world, const Library::SearchPath& plugins, const BaseColumns& base)
    : table_(new_file()), all_(static_cast<std::size_t>(readings.size())) {
  std::iota(all_.begin(), all_.end(), 0);
  write(readings, radios, table_);
  model_ = std::make_unique<LinkModel>(world, table_, plugins);
  for (std::size_t j = 0; j < base.paths.size(); ++j) model_->set(base.paths[j], base.values[static_cast<Index>(j)]);
  run_ = std::make_shared<CauseModel>(*model_, world, table_, plugins);
}

SimulatedReadings::~SimulatedReadings() {
  std::error_code none;
  fs::remove(table_, none);
}

search::Candidate SimulatedReadings::at(const CauseCandidate& cause, const Dataset& data) const {
  return at_readings_of(cause, {run_, *model_, data, all_});
}

bool reads_a_table(const LinkModel& model) {
  for (const auto& instance : model.simulation().instances()) {
    const muster_plugin& plugin = instance->plugin();
    for (uint32_t k = 0; plugin.cause && k < plugin.param_count; ++k) {
      if (plugin.params[k].kind == MUSTER_FILE) return true;
    }
  }
  return false;
}

}  // namespace muster::diagnosis
