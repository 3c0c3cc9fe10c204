#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = [] {
    std::vector<Kind> result;
    for (const auto& some : {map_kinds(), radio_kinds(), wave_kinds(), time_kinds(), receiver_kinds()})
      result.insert(result.end(), some.begin(), some.end());
    return result;
  }();
  return all;
}

}  // namespace muster::exam::survey
