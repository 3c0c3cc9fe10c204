// The services of ROS 2's package simulation_interfaces 2.1 that a run has, as its .srv and .msg files define them
// (https://github.com/ros-simulation/simulation_interfaces, Apache-2.0); and its numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace muster::live {

struct Interface {
  const char* name;  // "StepSimulation"
  std::string request, response;
};
const std::vector<Interface>& interfaces();

// Services of the package that a run has not, each with the reason.
struct Lacking {
  const char *name, *reason;
};
const std::vector<Lacking>& lacking_interfaces();

enum Result : std::uint8_t {  // simulation_interfaces/msg/Result
  feature_unsupported = 0,
  ok = 1,
  not_found = 2,
  incorrect_state = 3,
  operation_failed = 4,
  // Of SetSimulationState.
  already_in_target_state = 101,
  state_transition_error = 102,
  incorrect_transition = 103,
  // Of SetEntityState.
  invalid_pose = 101,
  // Of SpawnEntity.
  name_not_unique = 101,
  name_invalid = 102,
  unsupported_format = 103,
  no_resource = 104,
  namespace_invalid = 105,
  invalid_initial_pose = 109
};

enum Feature : std::uint16_t {  // simulation_interfaces/msg/SimulatorFeatures
  spawning = 0,
  deleting = 1,
  entity_categories = 8,
  entity_state_getting = 10,
  entity_state_setting = 11,
  entity_info_getting = 12,
  spawnables = 14,
  simulation_reset = 20,
  simulation_reset_spawned = 23,
  simulation_state_getting = 24,
  simulation_state_setting = 25,
  simulation_state_pause = 26,
  step_simulation_single = 31,
  step_simulation_multiple = 32
};

enum Scope : std::uint8_t {  // simulation_interfaces/srv/ResetSimulation
  scope_default = 0,
  scope_time = 1,
  scope_state = 2,
  scope_spawned = 4,
  scope_all = 255
};

inline constexpr std::uint8_t bounds_box = 0;      // simulation_interfaces/msg/Bounds
inline constexpr std::uint8_t category_robot = 2;  // simulation_interfaces/msg/EntityCategory

}  // namespace muster::live
