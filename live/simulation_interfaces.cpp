#include "live/simulation_interfaces.hpp"

#include <algorithm>

#include "mcap/records.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace muster::live {
namespace {

const std::string prefix = "simulation_interfaces/";

Value result(Result code, const std::string& words = "") {
  return {{"result", {{"result", static_cast<int>(code)}, {"error_message", words}}}};
}

std::string json_of(const Value& value) { return value.dump(-1, ' ', false, Value::error_handler_t::replace); }

}  // namespace

SimulationInterfaces::SimulationInterfaces(RunControl& control) : control_(control) {
  using Here = SimulationInterfaces;
  const std::vector<std::pair<std::string, Verb>> verbs{{"GetSimulatorFeatures", &Here::get_features},
                                                        {"GetSimulationState", &Here::get_state},
                                                        {"SetSimulationState", &Here::set_state},
                                                        {"StepSimulation", &Here::step},
                                                        {"ResetSimulation", &Here::reset},
                                                        {"GetEntities", &Here::get_entities},
                                                        {"GetEntitiesStates", &Here::get_entities_states},
                                                        {"GetEntityInfo", &Here::get_entity_info},
                                                        {"GetEntityState", &Here::get_entity_state},
                                                        {"SetEntityState", &Here::set_entity_state},
                                                        {"SpawnEntity", &Here::spawn},
                                                        {"DeleteEntity", &Here::remove},
                                                        {"GetSpawnables", &Here::get_spawnables}};
  for (const Interface& one : interfaces()) {
    const auto verb = std::find_if(verbs.begin(), verbs.end(), [&](const auto& v) { return v.first == one.name; });
    services_.push_back({'/' + prefix + one.name, prefix + "srv/" + one.name, one.request, one.response});
    verbs_.push_back(verb->second);
    requests_.emplace_back(one.request);
    responses_.emplace_back(one.response);
  }
}

void SimulationInterfaces::call(std::size_t service, const std::string& encoding, std::string_view payload,
                                std::function<void(ServiceAnswer)> answer) {
  const bool is_cdr = encoding == "cdr";
  if (!is_cdr && encoding != "json") return answer({"", "the encoding " + quote(encoding) + "; expected cdr or json"});
  try {
    const RosType& type = requests_[service];
    Value request = Value::object();
    if (is_cdr) {
      if (payload.size() > 4) request = type.read_cdr(payload);
    } else if (!payload.empty()) {
      request = parsed_json(payload);
      if (request.is_discarded()) return answer({"", services_[service].name + ": the request is no JSON"});
    }
    request = type.completed(request);
    (this->*verbs_[service])(request, [this, service, is_cdr, answer](const Value& given) {
      const Value whole = responses_[service].completed(given);
      answer({is_cdr ? responses_[service].cdr(whole) : json_of(whole)});
    });
  } catch (const Error& error) {
    answer({"", services_[service].name + ": " + error.what()});
  } catch (const mcap::Malformed& error) {
    answer({"", services_[service].name + ": " + error.what()});
  }
}

void SimulationInterfaces::call(const std::string& name, std::string_view json,
                                std::function<void(ServiceAnswer)> answer) {
  std::vector<std::string> valid;
  for (std::size_t i = 0; i < services_.size(); ++i) {
    if (name == interfaces()[i].name) return call(i, "json", json, std::move(answer));
    valid.push_back(interfaces()[i].name);
  }
  for (const Lacking& one : lacking_interfaces()) {
    if (name == one.name) return answer({json_of(result(feature_unsupported, one.reason))});
  }
  answer({"", "no service is called " + quote(name) + "; " + suggest(name, valid)});
}

// ---- The run ----

void SimulationInterfaces::get_features(const Value&, const Answer& answer) {
  answer({{"features",
           {{"features",
             {spawning, deleting, entity_categories, entity_state_getting, entity_state_setting, entity_info_getting,
              spawnables, simulation_reset, simulation_reset_spawned, simulation_state_getting,
              simulation_state_setting, simulation_state_pause, step_simulation_single, step_simulation_multiple}},
            {"spawn_formats", {"muster"}},
            {"custom_info", "muster: entities are robots; the uri muster:robot/NAME is a copy of that robot"}}}});
}

void SimulationInterfaces::get_state(const Value&, const Answer& answer) {
  Value given = result(ok);
  given["state"] = {{"state", static_cast<int>(control_.state())}};
  answer(given);
}

void SimulationInterfaces::set_state(const Value& request, const Answer& answer) {
  const auto wanted = request["state"]["state"].get<unsigned>();
  if (wanted > static_cast<unsigned>(RunState::quitting))
    return answer(result(feature_unsupported, "state " + std::to_string(wanted) +
                                                  "; expected 0 (stopped), 1 (playing), "
                                                  "2 (paused) or 3 (quitting)"));
  const auto to = static_cast<RunState>(wanted);
  if (to == control_.state()) return answer(result(already_in_target_state, "the run has this state already"));
  if (to == RunState::playing && control_.run().done())
    return answer(
        result(state_transition_error, "the run is at its end; STATE_STOPPED or ResetSimulation begins anew"));
  control_.set_state(to, [answer](const std::string& fault) {
    answer(fault.empty() ? result(ok) : result(state_transition_error, fault));
  });
}

void SimulationInterfaces::step(const Value& request, const Answer& answer) {
  if (control_.state() != RunState::paused)
    return answer(
        result(operation_failed, "the run is not paused; expected SetSimulationState with STATE_PAUSED before"));
  const auto steps = request["steps"].get<std::uint64_t>();
  const std::uint64_t left = control_.run().world().ticks - control_.run().tick();
  if (steps > left)
    return answer(result(operation_failed,
                         std::to_string(steps) + " steps; the run has " + std::to_string(left) + " ticks left"));
  control_.step(steps, [answer](const std::string& fault) {
    answer(fault.empty() ? result(ok) : result(operation_failed, fault));
  });
}

void SimulationInterfaces::reset(const Value& request, const Answer& answer) {
  const auto scope = request["scope"].get<unsigned>();
  constexpr unsigned whole = scope_time | scope_state | scope_spawned;
  if (scope == scope_spawned) {
    for (const auto& entity : spawned_) remove_spawned(entity);
    spawned_.clear();
    return answer(result(ok));
  }
  if (scope != scope_default && (scope & whole) != whole)
    return answer(result(feature_unsupported, "scope " + std::to_string(scope) +
                                                  "; a run is reset as a whole: expected SCOPE_DEFAULT, SCOPE_ALL, or "
                                                  "SCOPE_SPAWNED alone"));
  control_.reset(
      [answer](const std::string& fault) { answer(fault.empty() ? result(ok) : result(operation_failed, fault)); });
}

}  // namespace muster::live
