// Whitening of rows under C = s2 [rho + (1 - rho) same anchor] k(h) + t2 / count by Vecchia's approximation: each row
// given its neighbours (Vecchia 1988; Katzfuss and Guinness, Statistical Science 36, 2021). h is the distance between
// readings for a rough field, between middles for a smooth one (row_distance.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/noise/family.hpp"
#include "diagnosis/inference/noise/neighbours.hpp"
#include "diagnosis/inference/noise/recurring_sites.hpp"
#include "diagnosis/inference/noise/row_kernel.hpp"
#include "diagnosis/inference/noise/stated_tables.hpp"

namespace muster::noise {

// A row's combination with its neighbours: whitened_i = own_i x_i + sum over slots of beside_ia x_neighbour.
struct Stencil {
  std::vector<double> own, beside;
};

// Parts independent of theta: neighbours, and the distances within each neighbourhood as entries of a table of
// correlations.
class Field {
 public:
  explicit Field(Sites sites, const Conditioning& conditioning = {});

  Index size() const { return sites_.size(); }
  const Sites& sites() const { return sites_; }
  // Those between which errors are correlated: where that is over time, moments in the place of places.
  const Sites& correlated() const { return moments_ ? *moments_ : sites_; }
  int slots() const { return slots_; }
  // What may be fitted: the stated one first, if there is one, else the exponential one.
  std::vector<Family> families() const;
  // Families with a fixed share; none unless many rows share their site with others.
  std::vector<Family> fixed_families() const;
  // At the k-th of the decorrelation distances; made on first use.
  const StatedTables& stated(int k) const;
  // Entries of all pairs of rows at that distance: of row i those with the rows before it.
  const std::vector<uint16_t>& stated_triangle(int k) const;
  Index groups() const { return (size() + lanes - 1) / lanes; }
  double spacing() const { return spacing_; }  // m between entries
  Index neighbour(Index row, int slot) const { return neighbours_[static_cast<std::size_t>(row * slots_ + slot)]; }
  const RecurringSites& recurring() const { return recurring_; }
  // Entries of the pairs of group g, with same_site added once or twice (row_kernel.hpp): pair a (a + 1) / 2 + b is
  // slots a and b < a; with b = a, slot a and the row itself.
  struct Entries {
    // By place; by place and anchor, same anchor. Of the stated correlation: at one distance, and at the next.
    const uint16_t *near, *joint;
    const Joint* kinds;
  };
  // `slopes`: derivatives by the decorrelation distance are wanted too.
  Entries entries(Index group, const Covariance& covariance, bool slopes = true) const;
  Index pairs() const { return Index{slots_} * (slots_ + 1) / 2; }
  // Combinations with these weights for each row's neighbours, then its own.
  Combinations combinations(const Stencil& stencil) const;

 private:
  struct Table {
    std::vector<uint16_t> near, joint;
    std::vector<Joint> kinds;
  };
  NeighbourPairs neighbour_pairs() const;
  // use(slot, row, row, m by place, m by place and anchor)
  template <class Use>
  void each_pair(bool by_readings, const Use& use) const;
  uint16_t entry(double distance) const;
  int within_site(Index a, Index b) const { return same_site * static_cast<int>(recurring_.of(a, b)); }
  Table table(bool by_readings) const;
  void compare_ends(Table& table) const;

  Sites sites_;
  std::optional<Sites> moments_;  // of errors that are correlated over time
  RecurringSites recurring_;
  int slots_;
  std::vector<Index> neighbours_;
  double spacing_ = 0.01;
  Table smooth_, rough_;          // the second one is empty where every row is a point: both are equal there
  std::vector<Joint> different_;  // of the pairs of any group: both distances' entries are looked up
  mutable std::shared_ptr<const NeighbourPairs> neighbour_pairs_;  // of the stated correlation; made on first use
  mutable std::map<int, StatedTables> stated_tables_;
  mutable std::map<int, std::vector<uint16_t>> stated_triangles_;
};

class Whitener {
 public:
  Whitener(const Field& field, const Covariance& covariance);

  const Covariance& covariance() const { return covariance_; }
  const Stencil& stencil() const { return stencil_; }
  double log_scale() const { return log_scale_; }  // sum of log own: minus half the log determinant
  Eigen::MatrixXd operator()(const Eigen::Ref<const Eigen::MatrixXd>& columns) const;
  Sheet sheet(const Sheet& columns) const;

 private:
  friend class WhitenerSlopes;
  Whitener(const Field& field, const Covariance& covariance, Stencil stencil);  // not yet factorised
  void sum_up();

  const Field* field_;
  Covariance covariance_;
  Stencil stencil_;
  double log_scale_ = 0;
};

// A whitener with its derivatives by theta.
class WhitenerSlopes {
 public:
  WhitenerSlopes(const Field& field, const Covariance& covariance);

  const Whitener& whitener() const { return whitener_; }
  bool is_of(const Field& field) const { return field_ == &field; }
  const Theta& of_log_scale() const { return of_log_scale_; }
  // Fisher's information of theta in the rows (Guinness, Statistics and Computing 31, 2021).
  const Eigen::Matrix4d& information() const { return information_; }
  // For each entry of theta the sum over rows of products of `x`, combined by the whitener's derivative, with `with`.
  Theta contracted(const Eigen::MatrixXd& x, const Eigen::MatrixXd& with) const;

 private:
  const Field* field_;
  Whitener whitener_;
  std::array<Stencil, 4> stencils_;
  Theta of_log_scale_ = Theta::Zero();
  Eigen::Matrix4d information_ = Eigen::Matrix4d::Zero();
};

}  // namespace muster::noise
