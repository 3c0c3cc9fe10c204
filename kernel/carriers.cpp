#include "carriers.hpp"

#include <algorithm>
#include <string_view>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double one_carrier = 1.2;  // ratio of two channels of one band, and more

bool is_carrier(const muster_param& declared) {
  return std::string_view(declared.name) == "frequency" && !(declared.flags & MUSTER_FREE) &&
         std::string_view(declared.help).rfind("carrier", 0) == 0;
}

}  // namespace

void compare_carriers(const std::vector<std::unique_ptr<Instance>>& instances,
                      const std::function<void(const std::string&)>& tell) {
  const Instance* first = nullptr;
  double carrier = 0;
  for (const auto& instance : instances) {
    const int number = instance->find_param("frequency");
    if (instance->phase() != MUSTER_RADIO || number < 0 || !is_carrier(instance->plugin().params[number])) continue;
    const double own = instance->params()[static_cast<std::size_t>(number)];
    if (!first) {
      first = instance.get(), carrier = own;
    } else if (std::max(own, carrier) > one_carrier * std::min(own, carrier)) {
      const XmlAttribute* given = instance->declared().attribute("frequency");
      tell("warning: " + (given ? given->value_place : instance->place()).text() + ": the carrier of " +
           quote(instance->name()) + " is " + print_real(own) + " Hz, and that of " + quote(first->name()) + " (" +
           first->place().text() + ") " + print_real(carrier) + " Hz; expected one carrier in one channel");
    }
  }
}

}  // namespace muster
