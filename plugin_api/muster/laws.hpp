// Builds the declaration of a law of single readings (muster_law), part by part.
#pragma once

#include <muster/plugin.h>

#include <cstddef>

namespace muster {

using LogDensity = void(const double* params, uint32_t draws, const double* db, uint32_t count, double* out);
using LawAtoms = uint32_t(const double* params, double* db, double* probability, uint32_t most);
using OfParams = double(const double* params);

// Law of single readings; see muster_law for each part.
struct Law : muster_law {
  constexpr Law replaces() const {
    Law result = *this;
    result.flags |= MUSTER_REPLACES;
    return result;
  }
  template <std::size_t n>
  constexpr Law from(const double (&values)[n]) const {  // its grid
    Law result = *this;
    result.grid = values;
    result.grid_count = n;
    return result;
  }
  template <std::size_t n>
  constexpr Law with_form(const char* parameter, const double (&values)[n]) const {
    Law result = *this;
    result.form = parameter;
    result.forms = values;
    result.form_count = n;
    return result;
  }
  constexpr Law averaged_up_to(uint32_t draws) const {
    Law result = *this;
    result.most_draws = draws;
    return result;
  }
  constexpr Law with_atoms(LawAtoms* function) const {
    Law result = *this;
    result.atoms = function;
    return result;
  }
  constexpr Law with_mean(OfParams* function) const {
    Law result = *this;
    result.mean = function;
    return result;
  }
  constexpr Law drawn_anew_after(OfParams* metres) const {
    Law result = *this;
    result.apart = metres;
    return result;
  }
};

constexpr Law law_of_readings(const char* strength, LogDensity* log_density) {
  return {
      {sizeof(muster_law), 0, strength, nullptr, nullptr, nullptr, 0, 0, 1, log_density, nullptr, nullptr, nullptr}};
}

}  // namespace muster
