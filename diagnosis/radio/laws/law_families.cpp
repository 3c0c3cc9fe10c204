#include "diagnosis/radio/laws/law_families.hpp"

#include <algorithm>

namespace muster::diagnosis {
namespace {

// Multiples of the variance of the stated law and its noise.
constexpr double times[] = {0.2, 0.35, 0.5, 0.65, 0.78, 0.88, 1.13, 1.28, 1.5, 1.8, 2.3, 3.2, 5.0};
constexpr double least_variance = 0.05;  // dB^2, of which multiples are tried
// dB^2, where no law is stated: up to Rayleigh's.
constexpr double any_variance[] = {0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4, 12, 20, 31};

std::vector<double> strengths_of(const ReadingLaw& law, const ReadingDistribution& stated) {
  const muster_law& declared = law.declared();
  std::vector<double> result(declared.grid, declared.grid + declared.grid_count);
  if (!law.replaces()) return result;
  if (declared.grid) {
    for (double& value : result) value = law.variance(law.at_strength(law.defaults(), value), 1);
    std::sort(result.begin(), result.end());
  } else if (!stated.base.law) {
    result.assign(std::begin(any_variance), std::end(any_variance));
  } else {
    const double variance = std::max(base_variance(stated) + stated.noise * stated.noise, least_variance);
    for (const double f : times) result.push_back(variance * f);
  }
  return result;
}

// With the interval up to the middle of its neighbours; a whole number is exact.
LawValue form_value(const muster_param& form, double value) {
  if (form.kind == MUSTER_INTEGER) return {form.name, value, value, value};
  return {form.name, value, value / 1.4, value * 1.3};
}

}  // namespace

std::optional<ReadingDistribution> LawFamily::with(ReadingDistribution base, double strength) const {
  const ReadingLaw& law = *part.law;
  if (law.replaces()) {
    const auto value = law.strength_of(strength, part.params, base.draws);
    if (!value) return {};
    base.base = {part.law, law.at_strength(part.params, *value)};
    return base;
  }
  if (strength < law.strength().min || strength > law.strength().max) return {};
  std::erase_if(base.added, [&](const LawPart& p) { return p.law->id() == law.id(); });
  base.added.push_back({part.law, law.at_strength(part.params, strength)});
  return base;
}

double LawFamily::reported(double strength) const {
  return part.law->replaces() ? part.law->nearest_strength(strength, part.params) : strength;
}

std::vector<LawFamily> families_of(const std::vector<std::shared_ptr<const ReadingLaw>>& laws,
                                   const ReadingDistribution& stated) {
  std::vector<LawFamily> result;
  for (const auto& law : laws) {
    const bool is_base = stated.base.law && stated.base.law->id() == law->id();
    const LawFamily family{{law, is_base ? stated.base.params : law->defaults()}, strengths_of(*law, stated)};
    const muster_law& declared = law->declared();
    if (!declared.form) result.push_back(family);
    for (uint32_t k = 0; k < declared.form_count; ++k) {
      LawFamily of_form = family;
      of_form.part.params = law->at_form(family.part.params, declared.forms[k]);
      of_form.beside.push_back(form_value(law->form(), declared.forms[k]));
      result.push_back(std::move(of_form));
    }
  }
  return result;
}

std::optional<ReadingDistribution> averaged_over(ReadingDistribution law, uint32_t draws) {
  if (draws == law.draws) return law;
  if (!law.base.law) return {};
  const auto strength = law.base.law->strength_of(base_variance(law), law.base.params, draws);
  if (!strength) return {};
  law.base.params = law.base.law->at_strength(law.base.params, *strength);
  law.draws = draws;
  return law;
}

}  // namespace muster::diagnosis
