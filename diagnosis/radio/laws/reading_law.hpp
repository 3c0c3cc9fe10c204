// A law of single readings as a plugin declares it (muster_law): its density on a grid, its variance, its strength.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/causes/cause_model.hpp"

namespace muster::diagnosis {

// A bin's centre is lowest + width * (index + 0.5), in dB.
struct BinGrid {
  double lowest, width;
  std::size_t count;

  double centre(std::size_t bin) const { return lowest + width * (static_cast<double>(bin) + 0.5); }
};

// Value with a probability of its own.
struct Atom {
  double db, probability;
};

class ReadingLaw {
 public:
  // `plugin`: one of the library, with a law, whose declaration the loader has checked.
  ReadingLaw(std::string id, std::shared_ptr<Library> library, const muster_plugin& plugin);

  const std::string& id() const { return id_; }  // "effect.outliers"
  const muster_law& declared() const { return *plugin_.law; }
  bool replaces() const { return (declared().flags & MUSTER_REPLACES) != 0; }
  const muster_param& strength() const { return plugin_.params[strength_]; }
  const muster_param& form() const { return plugin_.params[form_]; }  // if it has one
  // Declared values of all parameters.
  std::vector<double> defaults() const;
  // The same parameters at another strength, or another value of the form.
  std::vector<double> at_strength(std::vector<double> params, double value) const;
  std::vector<double> at_form(std::vector<double> params, double value) const;

  // Density per dB at the grid's centres, without atoms.
  std::vector<double> densities(const std::vector<double>& params, uint32_t draws, const BinGrid& grid) const;
  std::vector<Atom> atoms(const std::vector<double>& params) const;
  // Probability that a single draw is farther off than that, in dB.
  double beyond(const std::vector<double>& params, double db) const;
  // True if single draws have a larger kurtosis than a normal law's.
  bool is_heavy_tailed(const std::vector<double>& params) const;
  double apart(const std::vector<double>& params) const {
    return declared().apart ? declared().apart(params.data()) : 0;
  }

  // In dB^2. That of a law that replaces is interpolated over its strength; at least that of a steady reading.
  double variance(const std::vector<double>& params, uint32_t draws) const;
  // The strength with this variance, if there is one: the other parameters as given.
  std::optional<double> strength_of(double variance, const std::vector<double>& params, uint32_t draws) const;
  // The strength with the variance nearest to this one.
  double nearest_strength(double variance, const std::vector<double>& params) const;

 private:
  // Variances at `steps` + 1 strengths between its bounds.
  struct Variances {
    std::vector<double> values;
    std::size_t first = 0, last = 0;  // between which they exceed that of a steady reading

    double at(double place) const;  // of a place on the scale of strengths, in steps
  };
  double strength_at(double place) const;
  double place_of(double strength) const;
  const Variances& variances(std::vector<double> params, uint32_t draws) const;
  // Probabilities of the coarse grid's bins, and the atoms.
  std::vector<Atom> masses(const std::vector<double>& params, uint32_t draws) const;
  double computed_variance(const std::vector<double>& params, uint32_t draws) const;

  std::string id_;
  std::shared_ptr<Library> library_;
  const muster_plugin& plugin_;
  std::size_t strength_, form_ = 0;
  mutable std::mutex lock_;
  mutable std::map<std::pair<std::vector<double>, uint32_t>, Variances> known_;
};

}  // namespace muster::diagnosis
