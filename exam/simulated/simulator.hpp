// Runs the simulator, as a program of its own, over measured places.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>

namespace muster::exam::simulated {

class Simulator {
 public:
  // `program` is muster; `places` the table of readings without levels, `walls` the plan. Throws std::runtime_error,
  // as the rest does.
  Simulator(std::filesystem::path program, const std::string& places, const std::string& walls);
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  // RSSI of each row of the table in dBm as a run of this world draws it; NaN: not received. `elements` is the inside
  // of the world, which may refer to places.csv and walls.csv.
  Eigen::VectorXd drawn(const std::string& elements, std::uint64_t seed) const;
  // As it is expected on average; no receiver cuts it.
  Eigen::VectorXd expected(const std::string& elements) const;

 private:
  Eigen::VectorXd run(const std::string& elements, std::uint64_t seed, const std::string& options) const;

  std::filesystem::path program_, folder_;
};

// The program muster: beside this one in a build folder; where it is installed, bin/muster of lib/muster/ here.
std::filesystem::path simulator_program();

}  // namespace muster::exam::simulated
