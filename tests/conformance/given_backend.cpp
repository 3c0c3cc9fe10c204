// A physics backend from outside the project, under the same tests.
#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "tests/conformance/physics_backends.hpp"
#include "text/number.hpp"

namespace muster::test {

namespace {

// Abilities that a backend may claim, by name.
const std::map<std::string, bool Backend::*> abilities = {{"height", &Backend::height},
                                                          {"slip", &Backend::slip},
                                                          {"torque", &Backend::torque},
                                                          {"round_friction", &Backend::round_friction},
                                                          {"load_transfer", &Backend::load_transfer},
                                                          {"rotors", &Backend::rotors},
                                                          {"bouncing", &Backend::bouncing},
                                                          {"bounces_on_wheels", &Backend::bounces_on_wheels},
                                                          {"limbs", &Backend::limbs},
                                                          {"pushed", &Backend::pushed},
                                                          {"has_step", &Backend::has_step}};
const std::map<std::string, int Backend::*> orders = {{"order", &Backend::order},
                                                      {"flight_order", &Backend::flight_order}};
const std::map<std::string, double Backend::*> tolerances = {{"fall", &Backend::fall},
                                                             {"rest", &Backend::rest},
                                                             {"arc", &Backend::arc},
                                                             {"course", &Backend::course},
                                                             {"ramp", &Backend::ramp},
                                                             {"climb", &Backend::climb},
                                                             {"spin", &Backend::spin},
                                                             {"collision", &Backend::collision},
                                                             {"bounce", &Backend::bounce},
                                                             {"parting", &Backend::parting},
                                                             {"apex", &Backend::apex},
                                                             {"slide", &Backend::slide},
                                                             {"force", &Backend::force},
                                                             {"swing", &Backend::swing},
                                                             {"coarsest_of_order", &Backend::coarsest_of_order}};

// Value of MUSTER_BACKEND; "" if it is not set.
std::string claims_of_another() {
  const char* given = std::getenv("MUSTER_BACKEND");
  return given ? given : "";
}

// True if a world with this robot is accepted.
bool takes(const std::string& plugin, const std::string& robot) {
  const Folder folder;
  folder.write("world.xml", "<world dt='0.01' until='1' seed='1'>" + robot + "<" + plugin + "/></world>");
  try {
    const Simulation accepted(read_world(folder.path(), standard()), standard(), search());
    return true;
  } catch (const Error&) {
    return false;
  }
}

double number_in(const std::string& word, std::size_t equals) {
  const auto number = parse_real(word.substr(equals + 1));
  if (!number) throw std::runtime_error("MUSTER_BACKEND claims " + word + ": " + why_not_real(word.substr(equals + 1)));
  return *number;
}

// An external backend, by MUSTER_BACKEND="path/to/physics_mine.so slip torque order=2 fall=1e-4 with.solver=fast
// smooth.friction=0". Its refusals show which robots it holds. Tolerances that it does not claim are the widest of the
// shipped ones. `with` gives it attributes, `smooth` those that leave bodies without friction.
Backend another(const std::string& claims) {
  std::istringstream words(claims);
  std::string word;
  words >> word;
  std::string id = std::filesystem::path(word).stem();
  const auto stroke = id.find('_');
  if (stroke == id.npos || !std::filesystem::exists(word))
    throw std::runtime_error("MUSTER_BACKEND: expected a file physics_NAME.so that there is, got " + word);
  id[stroke] = '.';
  Backend made{"given_" + id.substr(stroke + 1), id, {}};
  made.rotors = made.height = takes(id, bird("a", "0 0 1"));
  made.pushed = takes(id, "<robot name='a' model='crate' at='0 0 0'/>");
  for (const auto& [name, tolerance] : tolerances) {
    for (const Backend& backend : table()) made.*tolerance = std::max(made.*tolerance, backend.*tolerance);
  }
  while (words >> word) {
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    if (abilities.count(name) && equals == word.npos) {
      made.*abilities.at(name) = true;
    } else if (orders.count(name) && equals != word.npos) {
      made.*orders.at(name) = static_cast<int>(number_in(word, equals));
    } else if (tolerances.count(name) && equals != word.npos) {
      made.*tolerances.at(name) = number_in(word, equals);
    } else if (name == "pendulum" && equals != word.npos) {
      made.pendulum = word.substr(equals + 1);
    } else if (name.rfind("with.", 0) == 0 && equals != word.npos) {
      made.attributes[name.substr(5)] = word.substr(equals + 1);
    } else if (name.rfind("smooth.", 0) == 0 && equals != word.npos) {
      made.smooth[name.substr(7)] = word.substr(equals + 1);
    } else {
      throw std::runtime_error("MUSTER_BACKEND claims \"" + word + "\", which nothing here is held to");
    }
  }
  return made;
}

}  // namespace

Options search(int workers) {
  Options options{{MUSTER_BUILD_DIR "/tests/conformance", MUSTER_PLUGINS_DIR}, workers, {}};
  std::string file;
  if (std::istringstream(claims_of_another()) >> file)  // before the project's own, which may have its name
    options.search_path.insert(options.search_path.begin(), std::filesystem::absolute(file).parent_path());
  return options;
}

std::optional<Backend> given_backend() {
  const std::string claims = claims_of_another();
  if (claims.empty()) return std::nullopt;
  return another(claims);
}

}  // namespace muster::test
