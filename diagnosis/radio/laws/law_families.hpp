// Alternatives to the world's law of readings: each declared law at strengths from which a search starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/radio/laws/reading_distribution.hpp"

namespace muster::diagnosis {

struct LawValue {
  std::string name;
  double value, lower95, upper95;
};

// A law with one strength, and one value of its form. The strength of a law that replaces is its variance in dB^2.
struct LawFamily {
  LawPart part;
  std::vector<double> strengths;
  std::vector<LawValue> beside{};  // the form

  const std::string& cause() const { return part.law->id(); }
  const char* name() const { return part.law->strength().name; }
  // The distribution with this law at a strength, instead of the one of this cause that it has; none if the law has
  // no such strength.
  std::optional<ReadingDistribution> with(ReadingDistribution base, double strength) const;
  // A strength as the value of its parameter.
  double reported(double strength) const;
};

// By law, then by form.
std::vector<LawFamily> families_of(const std::vector<std::shared_ptr<const ReadingLaw>>& laws,
                                   const ReadingDistribution& stated);

// The distribution of which each reading averages `draws` draws, with the same variance; none if there is none.
std::optional<ReadingDistribution> averaged_over(ReadingDistribution law, uint32_t draws);

}  // namespace muster::diagnosis
