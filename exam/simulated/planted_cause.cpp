#include "exam/simulated/planted_cause.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace muster::exam::simulated {

std::string PlantedCause::element() const {
  std::string out = "<effect." + id;
  for (const auto& [name, text] : texts) out += fmt::format(" {}=\"{}\"", name, text);
  for (const Attribute& a : numbers) out += fmt::format(" {}=\"{}\"", a.name, a.value);
  return out + "/>\n";
}

double PlantedCause::number(const std::string& name) const {
  for (const Attribute& a : numbers)
    if (a.name == name) return a.value;
  throw std::logic_error("the cause " + id + " has no " + name);
}

void PlantedCause::scale(double factor) {
  for (Attribute& a : numbers)
    if (a.name == size) a.value *= factor;
}

const std::vector<CauseKind>& cause_kinds() {
  static const std::vector<CauseKind> all = [] {
    std::vector<CauseKind> result;
    for (const auto& some : {radio_causes(), building_causes(), time_causes(), law_causes()})
      result.insert(result.end(), some.begin(), some.end());
    return result;
  }();
  return all;
}

}  // namespace muster::exam::simulated
