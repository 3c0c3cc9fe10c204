#include "live/interface_definitions.hpp"

namespace muster::live {
namespace {

#define MUSTER_MSG(name) \
  "================================================================================\nMSG: " name "\n"

const std::string result_type = MUSTER_MSG("simulation_interfaces/Result") "uint8 result\nstring error_message\n";
const std::string state_type = MUSTER_MSG("simulation_interfaces/SimulationState") "uint8 state\n";
const std::string category = MUSTER_MSG("simulation_interfaces/EntityCategory") "uint8 category\n";
const std::string time_and_header = MUSTER_MSG("builtin_interfaces/Time") "int32 sec\nuint32 nanosec\n" MUSTER_MSG(
    "std_msgs/Header") "builtin_interfaces/Time stamp\nstring frame_id\n";
const std::string pose =
    MUSTER_MSG("geometry_msgs/Point") "float64 x\nfloat64 y\nfloat64 z\n" MUSTER_MSG("geometry_msgs/Quaternion")
        "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n" MUSTER_MSG(
            "geometry_msgs/Pose") "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n";
const std::string entity_state =
    MUSTER_MSG("simulation_interfaces/EntityState")
        "std_msgs/Header header\ngeometry_msgs/Pose pose\ngeometry_msgs/Twist twist\n"
        "geometry_msgs/Accel acceleration\n" +
    time_and_header + pose +
    MUSTER_MSG("geometry_msgs/Vector3") "float64 x\nfloat64 y\nfloat64 z\n" MUSTER_MSG(
        "geometry_msgs/Twist") "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n" MUSTER_MSG(
        "geometry_msgs/Accel") "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n";
const std::string bounds =
    MUSTER_MSG("simulation_interfaces/Bounds") "uint8 type\ngeometry_msgs/Vector3[] points\n" MUSTER_MSG(
        "geometry_msgs/Vector3") "float64 x\nfloat64 y\nfloat64 z\n";
const std::string filters =
    MUSTER_MSG("simulation_interfaces/EntityFilters")
        "string filter\nsimulation_interfaces/EntityCategory[] categories\nsimulation_interfaces/TagsFilter tags\n"
        "simulation_interfaces/Bounds bounds\n" +
    category + MUSTER_MSG("simulation_interfaces/TagsFilter") "string[] tags\nuint8 filter_mode\n" + bounds;
const std::string only_result = "simulation_interfaces/Result result\n" + result_type;

}  // namespace

const std::vector<Interface>& interfaces() {
  static const std::vector<Interface> known{
      {"GetSimulatorFeatures", "",
       "simulation_interfaces/SimulatorFeatures features\n" MUSTER_MSG(
           "simulation_interfaces/SimulatorFeatures") "uint16[] features\nstring[] spawn_formats\nstring "
                                                      "custom_info\n"},
      {"GetSimulationState", "",
       "simulation_interfaces/SimulationState state\nsimulation_interfaces/Result result\n" + state_type + result_type},
      {"SetSimulationState", "simulation_interfaces/SimulationState state\n" + state_type, only_result},
      {"StepSimulation", "uint64 steps 1\n", only_result},
      {"ResetSimulation", "uint8 scope\n", only_result},
      {"GetEntities", "simulation_interfaces/EntityFilters filters\n" + filters,
       "simulation_interfaces/Result result\nstring[] entities\n" + result_type},
      {"GetEntitiesStates", "simulation_interfaces/EntityFilters filters\n" + filters,
       "simulation_interfaces/Result result\nstring[] entities\nsimulation_interfaces/EntityState[] states\n" +
           result_type + entity_state},
      {"GetEntityInfo", "string entity\n",
       "simulation_interfaces/Result result\nsimulation_interfaces/EntityInfo info\n" + result_type +
           MUSTER_MSG("simulation_interfaces/EntityInfo") "simulation_interfaces/EntityCategory category\nstring "
                                                          "description\nstring[] tags\n" +
           category},
      {"GetEntityState", "string entity\n",
       "simulation_interfaces/Result result\nsimulation_interfaces/EntityState state\n" + result_type + entity_state},
      {"SetEntityState",
       "string entity\nsimulation_interfaces/EntityState state\nbool set_pose\nbool set_twist\nbool "
       "set_acceleration\n" +
           entity_state,
       only_result},
      {"SpawnEntity",
       "string name\nbool allow_renaming\nsimulation_interfaces/Resource entity_resource\nstring entity_namespace\n"
       "geometry_msgs/PoseStamped initial_pose\n" MUSTER_MSG(
           "simulation_interfaces/Resource") "string uri\nstring resource_string\n" MUSTER_MSG("geometry_msgs/"
                                                                                               "PoseStamped") "std_"
                                                                                                              "msgs/"
                                                                                                              "Header "
                                                                                                              "header\n"
                                                                                                              "geometry"
                                                                                                              "_msgs/"
                                                                                                              "Pose "
                                                                                                              "pose\n" +
           time_and_header + pose,
       "simulation_interfaces/Result result\nstring entity_name\n" + result_type},
      {"DeleteEntity", "string entity\n", only_result},
      {"GetSpawnables", "string[] sources\n",
       "simulation_interfaces/Result result\nsimulation_interfaces/Spawnable[] spawnables\n" + result_type +
           MUSTER_MSG("simulation_interfaces/Spawnable") "string uri\nstring description\n"
                                                         "simulation_interfaces/Bounds spawn_bounds\n" +
           bounds},
  };
  return known;
}

const std::vector<Lacking>& lacking_interfaces() {
  static const std::vector<Lacking> known{{"GetAvailableWorlds", "a run has the one world that it was started with"},
                                          {"GetCurrentWorld", "the world's name is in serverInfo of the websocket"},
                                          {"GetEntityBounds", "bounds of robots are in the table robot/*/geometry"},
                                          {"GetNamedPoseBounds", "worlds have no named poses"},
                                          {"GetNamedPoses", "worlds have no named poses"},
                                          {"LoadWorld", "a run has the one world that it was started with"},
                                          {"SetEntityInfo", "what a robot is, is in the world file"},
                                          {"SpawnEntities", "SpawnEntity spawns one robot"},
                                          {"UnloadWorld", "a run has the one world that it was started with"}};
  return known;
}

}  // namespace muster::live
