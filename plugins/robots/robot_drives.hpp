// The differential drive of each robot of a world, by its row; nothing where its model has none.
#pragma once

#include <muster/plugin.hpp>

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "description/robot.hpp"

namespace muster {

using RobotDrives = std::vector<std::optional<description::DifferentialDrive>>;

inline std::optional<description::DifferentialDrive> read_drive(const std::string& model, const std::vector<std::string>& directories) {
  try {
    return description::read_robot(description::find_model(model, directories)).drive;
  } catch (const std::runtime_error& wrong) {
    throw BadInput(wrong.what());
  }
}

// For constructors: the kernel tells models during setup only. Throws, naming the model, where it cannot be read.
inline RobotDrives robot_drives(const Setup& setup) {
  const muster_host* host = setup.host();
  std::vector<std::string> directories;
  for (uint32_t i = 0; const char* directory = host->search_path(host, i); ++i) {
    directories.push_back(directory);
    directories.push_back(std::string(directory) + "/models");
  }
  std::map<std::string, std::optional<description::DifferentialDrive>> by_model;
  RobotDrives result;
  for (uint32_t row = 0; row < host->rows(host, "robot"); ++row) {
    const std::string model = setup.text("robot/" + std::string(host->row_name(host, "robot", row)) + "/model");
    const auto [drive, is_new] = by_model.emplace(model, std::nullopt);
    if (is_new && !model.empty()) drive->second = read_drive(model, directories);
    result.push_back(drive->second);
  }
  return result;
}

// The drive of a robot whose model's number is kept in a table: 1 + the row of the robot that the world file gave that
// model. So a robot that joins as a copy of another has the other's drive. Null where there is none.
inline const description::DifferentialDrive* drive_of(const RobotDrives& drives, double model) {
  const auto row = static_cast<std::size_t>(model);
  return row >= 1 && row <= drives.size() && drives[row - 1] ? &*drives[row - 1] : nullptr;
}

// The number to keep for a robot: the one it has, or at first its own.
inline double model_of(double kept, std::size_t row) { return kept > 0 ? kept : static_cast<double>(row + 1); }

}  // namespace muster
