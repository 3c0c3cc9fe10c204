// Imputes censored readings: those clipped at the top or bottom code, or lost below the floor. Each becomes its
// expectation beyond the bound; mean and spread are refitted in turn (Tobit: Tobin 1958; EM: Dempster, Laird and
// Rubin 1977). Where readings below a level are missing from the table (truncation), those above it become the normal
// levels of the same rank.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace muster::noise {

// Meaning of a reading: the level itself, an upper bound of it (below) or a lower bound (above).
enum class Known : uint8_t { value = 1, below, above };

struct Bounds {
  std::vector<Known> known;  // one a reading; empty: all are values
  double half_code = 0.5;    // units of a reading: a bound's code covers levels up to half a step beyond it
  Eigen::VectorXd end{};     // of each reading, the level below which it would be missing; empty: none would

  bool any() const;      // is one of them a bound?
  bool changes() const;  // are readings imputed?
  // The range in which the level of a reading lies.
  double lowest(std::size_t i, double reading) const;
  double highest(std::size_t i, double reading) const;
  // Distance of a level from that range: 0 where a bound allows it.
  double error(std::size_t i, double reading, double level) const;
  bool is_bound(std::size_t i) const { return !known.empty() && known[i] != Known::value; }
};

// Readings with the censored ones imputed. The mean is linear in the columns of `design` (one row a reading).
Eigen::VectorXd imputed(const Eigen::VectorXd& readings, const Bounds& bounds, const Eigen::MatrixXd& design,
                        int rounds);

}  // namespace muster::noise
