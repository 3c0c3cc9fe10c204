// The verbs of ROS 2's simulation_interfaces for a run that is watched: each service by name, its fields as the package
// defines them, in JSON and in CDR. What a run cannot do is answered with the reason.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "live/interface_definitions.hpp"
#include "live/ros_value.hpp"
#include "live/run_control.hpp"
#include "live/services.hpp"

namespace muster::live {

class SimulationInterfaces : public Services {
 public:
  explicit SimulationInterfaces(RunControl& control);

  const std::vector<Service>& services() const override { return services_; }
  void call(std::size_t service, const std::string& encoding, std::string_view payload,
            std::function<void(ServiceAnswer)> answer) override;
  // By the service's name, in JSON; also of services that a run has not.
  void call(const std::string& name, std::string_view json, std::function<void(ServiceAnswer)> answer);
  // The robots that were spawned are part of no new run.
  void forget_spawned() { spawned_.clear(); }

 private:
  using Answer = std::function<void(Value)>;
  using Verb = void (SimulationInterfaces::*)(const Value& request, const Answer& answer);

  void get_features(const Value& request, const Answer& answer);
  void get_state(const Value& request, const Answer& answer);
  void set_state(const Value& request, const Answer& answer);
  void step(const Value& request, const Answer& answer);
  void reset(const Value& request, const Answer& answer);
  void get_entities(const Value& request, const Answer& answer);
  void get_entities_states(const Value& request, const Answer& answer);
  void get_entity_info(const Value& request, const Answer& answer);
  void get_entity_state(const Value& request, const Answer& answer);
  void set_entity_state(const Value& request, const Answer& answer);
  void spawn(const Value& request, const Answer& answer);
  void remove(const Value& request, const Answer& answer);
  void get_spawnables(const Value& request, const Answer& answer);

  bool is_there(const std::string& entity, const Answer& answer);
  std::vector<std::string> entities() const;
  std::vector<std::string> matching(const Value& filters, const Answer& answer, bool& is_answered) const;
  Value state_of(const std::string& entity) const;
  std::string description_of(const std::string& entity) const;
  void remove_spawned(const std::string& entity);

  RunControl& control_;
  std::vector<Service> services_;
  std::vector<Verb> verbs_;
  std::vector<RosType> requests_, responses_;
  std::vector<std::string> spawned_;
};

}  // namespace muster::live
