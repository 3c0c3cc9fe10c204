// The descriptions of a world's robots, for plugins. This header and starts.hpp alone include the plugin contract here.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "description/abilities.hpp"

namespace muster::description {

// The model of a robot, as a table keeps it: 1 + the row of the robot that the world file gave that model. So a robot
// that joins as a copy of another has the other's body. 0: not set yet.
struct Model {
  static constexpr const char* columns = "model";
  double model;
};

class WorldRobots {
 public:
  // For constructors: the kernel gives models during setup only. Each model is read once. Throws BadInput naming it.
  WorldRobots(const Setup& setup, Meshes meshes) {
    const muster_host* host = setup.host();
    std::vector<std::string>& directories = directories_;
    for (uint32_t i = 0; const char* directory = host->search_path(host, i); ++i) {
      directories.push_back(directory);
      directories.push_back(std::string(directory) + "/models");
    }
    std::map<std::array<std::string, 3>, std::shared_ptr<const Robot>> read;
    for (uint32_t row = 0; row < host->rows(host, "robot"); ++row) {
      const std::string of_row = std::string("robot/").append(host->row_name(host, "robot", row));
      const std::string model = setup.text(of_row + "/model");
      const UrdfSetting declared{setup.text(of_row + "/packages"), setup.text(of_row + "/fittings")};
      auto& robot = read[{model, declared.packages, declared.fittings}];
      if (!robot && !model.empty()) robot = read_one(host, row, model, declared, directories, meshes);
      robots_.push_back(robot);
    }
  }

  // The number to keep for a robot: the present one, or at first its own.
  static double model_of(double kept, std::size_t row) { return kept > 0 ? kept : static_cast<double>(row + 1); }

  // Null where there is none.
  const Robot* of(double model) const {
    const auto row = static_cast<std::size_t>(model);
    return row >= 1 && row <= robots_.size() ? robots_[row - 1].get() : nullptr;
  }
  const DifferentialDrive* drive_of(double model) const {
    const Robot* robot = of(model);
    return robot && robot->drive ? &*robot->drive : nullptr;
  }

  bool any_steers() const {
    return std::any_of(robots_.begin(), robots_.end(),
                       [](const auto& robot) { return robot && robot->drive && robot->drive->steering; });
  }
  bool any_mecanum() const {
    return std::any_of(robots_.begin(), robots_.end(),
                       [](const auto& robot) { return robot && robot->drive && robot->drive->mecanum; });
  }

  const LegDrive* legs_of(double model) const {
    const Robot* robot = of(model);
    return robot && robot->legs ? &*robot->legs : nullptr;
  }
  bool any_walks() const {
    return std::any_of(robots_.begin(), robots_.end(), [](const auto& robot) { return robot && robot->legs; });
  }
  bool any_has_limbs() const {
    return std::any_of(robots_.begin(), robots_.end(),
                       [](const auto& robot) { return robot && !limbs_of(*robot).empty(); });
  }
  const Quadrotor* quadrotor_of(double model) const {
    const Robot* robot = of(model);
    return robot && robot->quadrotor ? &*robot->quadrotor : nullptr;
  }
  bool any_quadrotor() const {
    return std::any_of(robots_.begin(), robots_.end(), [](const auto& robot) { return robot && robot->quadrotor; });
  }

  // For backends: throws BadInput with all abilities that robots need and `have` lacks, with a robot of each model
  // named.
  void require(Ability have, const Setup& setup) const {
    std::string list;
    bool is_in_simbody = true;
    std::vector<const Robot*> seen;
    for (std::size_t row = 0; row < robots_.size(); ++row) {
      const Robot* robot = robots_[row].get();
      if (!robot || std::find(seen.begin(), seen.end(), robot) != seen.end()) continue;
      seen.push_back(robot);
      const std::string lack = lacking(*robot, have);
      if (lack.empty()) continue;
      is_in_simbody = is_in_simbody && lacking(*robot, abilities_of_simbody).empty();
      list.append(list.empty() ? "robot '" : "; robot '");
      list.append(setup.host()->row_name(setup.host(), "robot", static_cast<uint32_t>(row)));
      list.append("' (model '").append(robot->name).append("') needs ").append(lack);
    }
    if (!list.empty())
      throw BadInput("it lacks what the world's robots need: " + list +
                     (is_in_simbody ? "; expected physics.simbody, which has that" : ""));
  }

  std::size_t size() const { return robots_.size(); }

  // For constructors of plugins that need a robot's laser: throws BadInput that says what would give it one.
  void require_laser(const Setup& setup, double row) const {
    const auto number = static_cast<std::size_t>(row);
    const Robot* robot = of(row + 1);
    if (robot && !robot->sensors.empty() && robot->sensors[0].laser.max_range > 0) return;
    const muster_host* host = setup.host();
    const std::string name = host->row_name(host, "robot", static_cast<uint32_t>(number));
    const std::string place = setup.text("robot/" + name + "/place"), model = setup.text("robot/" + name + "/model");
    std::string have;
    for (const std::string& each : models_with("<ray>", directories_)) have += (have.empty() ? "" : ", ") + each;
    throw BadInput("the model \"" + model + "\" of robot \"" + name + "\" (" + place + ") has no laser" +
                   (robot && !robot->sensors.empty() ? " with a range" : "") +
                   "; expected fittings=\"FILE\" at the robot, with a <sensor> with a <ray> and, in <muster>, <laser "
                   "sensor=\"...\" min_range=\"...\" max_range=\"...\"/>" +
                   (have.empty() ? "" : ", or a model that has one: " + have));
  }

 private:
  static std::shared_ptr<const Robot> read_one(const muster_host* host, uint32_t row, const std::string& model,
                                               const UrdfSetting& declared, const std::vector<std::string>& directories,
                                               Meshes meshes) {
    std::string file, doubt;
    UrdfSetting setting;
    const std::string name = host->row_name(host, "robot", row);
    // Told at the attribute, or at the robot where it has none.
    const auto refuse = [&](const std::string& attribute, const std::string& what) {
      const char* place = host->text(host, ("robot/" + name + "/place/" + attribute).c_str());
      if (!place) place = host->text(host, ("robot/" + name + "/place").c_str());
      throw BadInput((place ? std::string(place) : "robot '" + name + "'") + ": attribute \"" + attribute +
                     "\": " + what);
    };
    try {
      file = find_model(model, directories);
      doubt = doubt_of_model(model, directories);
    } catch (const std::runtime_error& wrong) {
      refuse("model", wrong.what());
    }
    try {
      setting.packages = find_setting({declared.packages, ""}, directories).packages;
    } catch (const std::runtime_error& wrong) {
      refuse("packages", wrong.what());
    }
    try {
      setting.fittings = find_setting({"", declared.fittings}, directories).fittings;
    } catch (const std::runtime_error& wrong) {
      refuse("fittings", wrong.what());
    }
    try {
      auto robot = std::make_shared<const Robot>(read_robot(file, meshes, setting));
      if (!doubt.empty()) detail::warn(host, "robot/" + std::string(host->row_name(host, "robot", row)), doubt);
      for (const std::string& warning : robot->warnings) host->event(host, ("warning: " + warning).c_str());
      return robot;
    } catch (const std::runtime_error& wrong) {
      throw BadInput(wrong.what());
    }
  }

  std::vector<std::shared_ptr<const Robot>> robots_;
  std::vector<std::string> directories_;  // in which models are looked for
};

}  // namespace muster::description
