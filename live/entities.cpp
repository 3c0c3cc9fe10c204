// Entities of simulation_interfaces: the robots of a run.
#include <algorithm>
#include <cmath>
#include <regex>

#include "live/simulation_interfaces.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"

namespace muster::live {
namespace {

constexpr std::size_t longest_filter = 256;  // of a regular expression
constexpr double farthest = 1e6;             // [m], as in a world file
constexpr double unit_error = 1e-3;          // of a quaternion's length
const std::string copied = "muster:robot/";

Value outcome(Result code, const std::string& words = "") {
  return {{"result", {{"result", static_cast<int>(code)}, {"error_message", words}}}};
}

Value vector(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }

// The pose, or empty where it is none.
std::vector<double> pose_of(const Value& given) {
  const Value &p = given["position"], &q = given["orientation"];
  std::vector<double> pose;
  for (const char* axis : {"x", "y", "z"}) pose.push_back(p[axis].get<double>());
  double length = 0;
  for (const char* part : {"w", "x", "y", "z"}) {
    pose.push_back(q[part].get<double>());
    length = std::hypot(length, pose.back());
  }
  if (!(std::abs(length - 1) <= unit_error)) return {};
  for (std::size_t i = 3; i < pose.size(); ++i) pose[i] /= length;
  const bool is_near = std::all_of(pose.begin(), pose.begin() + 3, [](double v) { return std::abs(v) <= farthest; });
  return is_near ? pose : std::vector<double>{};
}

std::string printed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += ' ' + print_real(value);
  return text;
}

bool is_world(const Value& header) {
  const auto frame = header["frame_id"].get<std::string>();
  return frame.empty() || frame == "world";
}

// All state of a new robot begins as it does in a world file, and only its model is that of the robot of which it is a
// copy: the table that physics keeps it in, robot/*/body.
void start_anew(Simulation& run, const std::string& name) {
  const Set* robots = run.board().find_set("robot");
  for (const auto& [known, table] : run.board().tables()) {
    const std::string quantity = known.substr(known.rfind('/') + 1);
    if (&table->set() != robots || quantity == "body" || quantity.find('@') != quantity.npos) continue;
    std::vector<double> row(table->width());
    table->fill_initial(row.data());
    run.set_row("robot/" + name + '/' + quantity, row);
  }
}

const std::string bad_pose =
    "no pose: expected a quaternion of length 1, and coordinates within " + print_real(farthest) + " m";

}  // namespace

std::vector<std::string> SimulationInterfaces::entities() const {
  std::vector<std::string> names;
  const Set* robots = control_.run().board().find_set("robot");
  for (std::size_t i = 0; robots && i < robots->names.size(); ++i) {
    if (robots->alive[i]) names.push_back(robots->names[i]);
  }
  return names;
}

bool SimulationInterfaces::is_there(const std::string& entity, const Answer& answer) {
  const auto names = entities();
  if (std::find(names.begin(), names.end(), entity) != names.end()) return true;
  answer(outcome(not_found, "no robot is called " + quote(entity) + which_is(control_.run().world(), entity, "robot") +
                                "; " + suggest(entity, names)));
  return false;
}

std::vector<std::string> SimulationInterfaces::matching(const Value& filters, const Answer& answer,
                                                        bool& is_answered) const {
  const auto refuse = [&](Result code, const std::string& why) {
    is_answered = true;
    answer(outcome(code, why));
    return std::vector<std::string>{};
  };
  if (!filters["tags"]["tags"].empty()) return refuse(feature_unsupported, "robots have no tags");
  if (!filters["bounds"]["points"].empty()) return refuse(feature_unsupported, "filters of bounds");
  const auto& categories = filters["categories"];
  const bool is_robot = std::any_of(categories.begin(), categories.end(),
                                    [](const Value& one) { return one["category"] == category_robot; });
  if (!categories.empty() && !is_robot) return {};
  const auto text = filters["filter"].get<std::string>();
  auto names = entities();
  if (text.empty()) return names;
  if (text.size() > longest_filter) return refuse(operation_failed, "the filter is too long");
  try {
    const std::regex filter(text, std::regex::extended);
    names.erase(std::remove_if(names.begin(), names.end(),
                               [&](const std::string& name) { return !std::regex_search(name, filter); }),
                names.end());
  } catch (const std::regex_error&) {
    return refuse(operation_failed, quote(text) + " is no extended regular expression of POSIX");
  }
  return names;
}

Value SimulationInterfaces::state_of(const std::string& entity) const {
  const Simulation& run = control_.run();
  const TableView pose = run.table("robot/" + entity + "/pose");
  const auto ns = static_cast<std::int64_t>(std::llround(run.time() * 1e9));
  Value state{
      {"header", {{"stamp", {{"sec", ns / 1'000'000'000}, {"nanosec", ns % 1'000'000'000}}}, {"frame_id", "world"}}},
      {"pose",
       {{"position", vector(pose.at(0, 0), pose.at(0, 1), pose.at(0, 2))},
        {"orientation", {{"x", pose.at(0, 4)}, {"y", pose.at(0, 5)}, {"z", pose.at(0, 6)}, {"w", pose.at(0, 3)}}}}}};
  if (run.board().find("robot/*/twist")) {
    const TableView twist = run.table("robot/" + entity + "/twist");
    state["twist"] = {{"linear", vector(twist.at(0, 0), twist.at(0, 1), twist.at(0, 2))},
                      {"angular", vector(twist.at(0, 3), twist.at(0, 4), twist.at(0, 5))}};
  }
  return state;
}

std::string SimulationInterfaces::description_of(const std::string& entity) const {
  const Set& robots = *control_.run().board().find_set("robot");
  const std::string& like = robots.names[robots.like[static_cast<std::size_t>(robots.find(entity))]];
  const auto& texts = control_.run().world().texts;
  const auto model = texts.find("robot/" + like + "/model");
  return "robot" + (model == texts.end() ? "" : ", model " + model->second);
}

void SimulationInterfaces::get_entities(const Value& request, const Answer& answer) {
  bool is_answered = false;
  const auto names = matching(request["filters"], answer, is_answered);
  if (is_answered) return;
  Value given = outcome(ok);
  given["entities"] = names;
  answer(given);
}

void SimulationInterfaces::get_entities_states(const Value& request, const Answer& answer) {
  bool is_answered = false;
  const auto names = matching(request["filters"], answer, is_answered);
  if (is_answered) return;
  Value given = outcome(ok);
  given["entities"] = names;
  given["states"] = Value::array();
  for (const auto& name : names) given["states"].push_back(state_of(name));
  answer(given);
}

void SimulationInterfaces::get_entity_info(const Value& request, const Answer& answer) {
  const auto entity = request["entity"].get<std::string>();
  if (!is_there(entity, answer)) return;
  Value given = outcome(ok);
  given["info"] = {{"category", {{"category", category_robot}}}, {"description", description_of(entity)}};
  answer(given);
}

void SimulationInterfaces::get_entity_state(const Value& request, const Answer& answer) {
  const auto entity = request["entity"].get<std::string>();
  if (!is_there(entity, answer)) return;
  Value given = outcome(ok);
  given["state"] = state_of(entity);
  answer(given);
}

// Physics goes on from the pose and twist that stand in the tables, whatever they were before.
void SimulationInterfaces::set_entity_state(const Value& request, const Answer& answer) {
  const auto entity = request["entity"].get<std::string>();
  if (!is_there(entity, answer)) return;
  const Value& state = request["state"];
  if (!is_world(state["header"])) return answer(outcome(feature_unsupported, "frames other than \"world\""));
  const bool has_pose = request["set_pose"].get<bool>(), has_twist = request["set_twist"].get<bool>();
  if (!has_pose && !has_twist)
    return answer(outcome(operation_failed, "nothing is set: expected set_pose or set_twist"));
  const auto pose = pose_of(state["pose"]);
  if (has_pose && pose.empty()) return answer(outcome(invalid_pose, bad_pose));
  std::vector<double> twist;
  for (const char* part : {"linear", "angular"}) {
    for (const char* axis : {"x", "y", "z"}) twist.push_back(state["twist"][part][axis].get<double>());
  }
  Simulation& run = control_.run();
  if (has_twist && !run.board().find("robot/*/twist"))
    return answer(outcome(feature_unsupported, "the world has no physics, and its robots no twist"));
  try {
    if (has_twist) run.set_row("robot/" + entity + "/twist", twist);
    if (has_pose) run.set_row("robot/" + entity + "/pose", pose);
  } catch (const Error& error) {
    return answer(outcome(operation_failed, error.what()));
  }
  run.note("robot " + quote(entity) + " is set" + (has_pose ? " to the pose" + printed(pose) : "") +
           (has_pose && has_twist ? " and" : "") + (has_twist ? " to the twist" + printed(twist) : ""));
  answer(outcome(ok));
}

// What SpawnEntity can copy. A box is given where the run has the boxes of its robots (robots.geometry).
void SimulationInterfaces::get_spawnables(const Value& request, const Answer& answer) {
  const Simulation& run = control_.run();
  std::string elsewhere;
  for (const auto& source : request["sources"]) elsewhere += ' ' + quote(source.get<std::string>());
  Value given = outcome(
      ok,
      elsewhere.empty() ? "" : "only robots of this run can be spawned; these sources are not searched:" + elsewhere);
  given["spawnables"] = Value::array();
  for (const auto& name : entities()) {
    Value one{{"uri", copied + name}, {"description", description_of(name)}};
    if (run.board().find("robot/*/geometry")) {
      const TableView box = run.table("robot/" + name + "/geometry");  // its middle, its size
      const auto corner = [&](double side) {
        return vector(box.at(0, 0) + side * box.at(0, 3) / 2, box.at(0, 1) + side * box.at(0, 4) / 2,
                      box.at(0, 2) + side * box.at(0, 5) / 2);
      };
      one["spawn_bounds"] = {{"type", bounds_box}, {"points", {corner(1), corner(-1)}}};
    }
    given["spawnables"].push_back(one);
  }
  answer(given);
}

// A copy of a robot, with its radio; nobody commands it.
void SimulationInterfaces::spawn(const Value& request, const Answer& answer) {
  const auto refuse = [&](Result code, const std::string& why) { answer(outcome(code, why)); };
  const auto uri = request["entity_resource"]["uri"].get<std::string>();
  if (uri.empty())
    return request["entity_resource"]["resource_string"].get<std::string>().empty()
               ? refuse(no_resource, "expected a uri " + copied + "NAME")
               : refuse(feature_unsupported, "resource_string; expected a uri " + copied + "NAME");
  const std::string like = uri.starts_with(copied) ? uri.substr(copied.size()) : "";
  const auto names = entities();
  if (std::find(names.begin(), names.end(), like) == names.end())
    return refuse(unsupported_format, "the uri " + quote(uri) + "; expected " + copied +
                                          "NAME, a copy of a robot: " + suggest(like, names));
  if (!request["entity_namespace"].get<std::string>().empty())
    return refuse(namespace_invalid, "names of robots have no namespace");
  if (!is_world(request["initial_pose"]["header"])) return refuse(feature_unsupported, "frames other than \"world\"");
  const auto pose = pose_of(request["initial_pose"]["pose"]);
  if (pose.empty()) return refuse(invalid_initial_pose, bad_pose);
  Simulation& run = control_.run();
  Set& robots = *run.board().find_set("robot");
  const Set* radios = run.board().find_set("radio");
  std::string name = request["name"].get<std::string>();
  const bool may_rename = request["allow_renaming"].get<bool>();
  const auto is_taken = [&](const std::string& word) {
    return robots.find(word) >= 0 || (radios && radios->find(word) >= 0);
  };
  if (!name.empty() && !is_name(name))
    return refuse(name_invalid, quote(name) + " is not a name; expected letters, digits, _, - and .");
  if (name.empty() && !may_rename) return refuse(name_invalid, "no name; expected one, or allow_renaming");
  if (is_taken(name) && !may_rename)
    return refuse(name_not_unique, "a robot or radio is called " + quote(name) + " already; names are never reused");
  const std::string base = name.empty() ? like : name;
  for (int i = 1; name.empty() || is_taken(name); ++i) name = base + '_' + std::to_string(i);
  try {
    run.join("robot", name, like);
    spawned_.push_back(name);
    start_anew(run, name);
    run.set_row("robot/" + name + "/pose", pose);
    if (radios && radios->find(like) >= 0 && run.board().find("radio/*/mount")) {
      run.join("radio", name, like);
      const TableView mount = run.table("radio/" + name + "/mount");
      run.set_row("radio/" + name + "/mount", {static_cast<double>(robots.find(name)), mount.at(0, 1), mount.at(0, 2),
                                               mount.at(0, 3), mount.at(0, 4)});
    }
  } catch (const Error& error) {
    return refuse(operation_failed, error.what());
  }
  run.note("robot " + quote(name) + " is set to the pose" + printed(pose));
  Value given = outcome(ok);
  given["entity_name"] = name;
  answer(given);
}

void SimulationInterfaces::remove_spawned(const std::string& entity) {
  Simulation& run = control_.run();
  run.leave("robot", entity);
  const Set* radios = run.board().find_set("radio");
  const int radio = radios ? radios->find(entity) : -1;
  if (radio >= 0 && radios->alive[static_cast<std::size_t>(radio)]) run.leave("radio", entity);
}

// Of a robot of the world file, plugins may hold the row by its name: it stays.
void SimulationInterfaces::remove(const Value& request, const Answer& answer) {
  const auto entity = request["entity"].get<std::string>();
  if (!is_there(entity, answer)) return;
  const auto found = std::find(spawned_.begin(), spawned_.end(), entity);
  if (found == spawned_.end())
    return answer(
        outcome(operation_failed, quote(entity) + " is of the world file; only what was spawned can be deleted"));
  spawned_.erase(found);
  remove_spawned(entity);
  answer(outcome(ok));
}

}  // namespace muster::live
