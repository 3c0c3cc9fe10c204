// A candidate: a named cause or a generic smooth, as columns on the readings over a grid of places, times or shapes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace muster::inference {

using Eigen::Index;

enum class Kind { named = 1, smooth };

// One object found by a candidate of a class: its id and its theta.
struct Piece {
  std::string id;
  Eigen::VectorXd theta;
};

// A column that grows row by row, and its current gain.
class Tally {
 public:
  virtual ~Tally() = default;
  virtual Index rows() const = 0;
  virtual void clear() = 0;
  virtual void add(Index row, double value) = 0;
  virtual double gain() const = 0;  // fall of the deviance; 0 where the coefficient would be negative
};

// Columns on the readings, one atom of `width` columns for each theta of a grid.
struct CandidateDesign {
  int width = 1;       // columns of one atom
  int sign = 0;        // sign of the coefficient, where physics fixes it (width 1 only)
  bool whole = false;  // theta holds the effect's strength: the coefficient is held at 1

  // One atom a theta; at least one (a candidate without parameters has one empty theta).
  std::vector<Eigen::VectorXd> grid;
  // Row means of the grid's columns, atom after atom, if already known. May be empty.
  std::shared_ptr<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> atoms;
  // One row a reading, `width` columns; more for a theta of `wider`. A function of theta alone.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& theta)> columns;
  // The same at each row's middle reading, one row a row of the search: enough for a search over many thetas. Empty:
  // the columns' row means.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& theta)> sketch;
  // The same columns, cheaper for many thetas among these. Empty: no cheaper version.
  std::function<std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>(const std::vector<Eigen::VectorXd>& thetas)>
      near;
  // Thetas of the same smooth with more functions, fewest first; may be empty.
  std::vector<Eigen::VectorXd> wider;
};

// Continuous refinement of theta.
struct Refinement {
  // Bounds of theta and the first simplex; step 0 holds an entry fixed. All empty: no refinement.
  Eigen::VectorXd lower, upper, step;
  // Preconditioned moves, as columns: each changes the gain about equally. Empty: the steps.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& theta)> moves;
  // Thetas worth refining, the best first, from a search over a tally's gain. Empty: from the grid.
  std::function<std::vector<Eigen::VectorXd>(Tally& tally)> proposed;
  int starts = 1;         // start thetas; more than one where the gain has many local optima
  int evaluations = 110;  // evaluations of the columns for each start
  double charge = 0;      // nats: cost of refinement beyond the grid (from nulls refined alike)
  // Share of its gain that a theta keeps: below 1 where the object is physically impossible. May be empty.
  std::function<double(const Eigen::VectorXd& theta)> admitted;
  // Prior log density of theta relative to its maximum, nats. May be empty.
  std::function<double(const Eigen::VectorXd& theta)> belief;
  // The columns have edges, on which their gain beside a field rests: a theta near the best shows little of it.
  bool edged = false;

  bool any() const { return step.size() > 0 && step.any(); }
};

// Competition with other candidates.
struct CandidateRole {
  std::set<std::string> replaces;  // covariates of smooths that it may replace
  std::string pieces;  // class of candidates that may find one object in several pieces ("place"); empty: none
  // Start thetas for one object that covers these pieces. May be empty.
  std::function<std::vector<Eigen::VectorXd>(const std::vector<Piece>&)> spanning;
  bool over_sites = false;  // a function of the site: residuals of other terms fit some place by chance
  bool slow = false;        // varies so slowly within one group that the field can absorb it
  bool time_like = false;   // a function of time: an observed column that explains as much is preferred
  bool observed = false;    // smooth of a column or factor of the data
  bool level_like = false;  // a function of the level: clipping imitates it
  // Of the cause, and one more of an instrument's: of two that the readings cannot separate, the one with fewer is
  // preferred.
  int parameters = 1;
};

struct Candidate {
  std::string id;
  Kind kind = Kind::named;
  std::vector<std::string> covariates;                             // its arguments, its own one first
  std::function<std::string(const Eigen::VectorXd& theta)> label;  // empty: the id
  CandidateDesign design;
  Refinement refinement;
  CandidateRole role;

  std::string label_of(const Eigen::VectorXd& theta) const { return label ? label(theta) : id; }
  const std::string& own() const { return covariates.front(); }
};

}  // namespace muster::inference
