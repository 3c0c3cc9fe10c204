#include "exam/simulated/simulator.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <charconv>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <vector>

#include "exam/files.hpp"

namespace muster::exam::simulated {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder() {
  std::string name = (fs::temp_directory_path() / "muster_exam_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a folder in " + fs::temp_directory_path().string());
  return name;
}

// The last column of a record, in the order of its rows.
Eigen::VectorXd last_column(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<double> values;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    const std::size_t from = line.find_last_of(',') + 1;
    double value = std::numeric_limits<double>::quiet_NaN();
    if (from < line.size()) {
      const auto [end, error] = std::from_chars(line.data() + from, line.data() + line.size(), value);
      if (error != std::errc{}) throw std::runtime_error("the simulator recorded \"" + line + "\"");
    }
    values.push_back(value);
  }
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

fs::path simulator_program() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  fs::path beside = folder / "muster";
  if (fs::is_regular_file(beside)) return beside;
  return folder.parent_path().parent_path() / "bin" / "muster";
}

Simulator::Simulator(fs::path program, const std::string& places, const std::string& walls)
    : program_(std::move(program)), folder_(fresh_folder()) {
  write_file(folder_ / "places.csv", places);
  write_file(folder_ / "walls.csv", walls);
}

Simulator::~Simulator() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Eigen::VectorXd Simulator::drawn(const std::string& elements, std::uint64_t seed) const {
  return run(elements, seed, "");
}

Eigen::VectorXd Simulator::expected(const std::string& elements) const { return run(elements, 1, " --expected"); }

Eigen::VectorXd Simulator::run(const std::string& elements, std::uint64_t seed, const std::string& options) const {
  write_file(folder_ / "world.xml",
             fmt::format("<world name=\"truth\" dt=\"0.1\" until=\"0.1\" seed=\"{}\">\n"
                         "<data.links file=\"places.csv\"/>\n{}<record table=\"link/*/rssi\"/>\n</world>\n",
                         seed, elements));
  const std::string command =
      fmt::format("'{}' run '{}'{} --out '{}' >'{}' 2>&1", program_.string(), (folder_ / "world.xml").string(), options,
                  (folder_ / "out").string(), (folder_ / "words").string());
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("the simulator failed: " + read_file(folder_ / "words"));
  return last_column(read_file(folder_ / "out" / "link_rssi.csv"));
}

}  // namespace muster::exam::simulated
