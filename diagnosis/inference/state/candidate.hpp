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

// One object that a class of candidates found: id of the candidate and where.
struct Piece {
  std::string id;
  Eigen::VectorXd theta;
};

// A column that grows row by row, and what it gains as it stands.
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
  int sign = 0;        // of the coefficient, where physics fixes it (width 1 only)
  bool whole = false;  // the column counts as it is: theta holds its strength, and the coefficient belongs at 1

  // One atom a theta; at least one (a candidate without parameters has one empty theta).
  std::vector<Eigen::VectorXd> grid;
  // Row means of the grid's columns, an atom after the other, where they are known already. May be empty.
  std::shared_ptr<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> atoms;
  // One row a reading, `width` columns. Must not depend on anything but theta.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& theta)> columns;
  // The same with one row a row of the search, evaluated at the reading in its middle: enough for a search over many
  // thetas. Empty: the columns' row means.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& theta)> sketch;
  // The columns again, cheaper for many thetas near this one. Empty: no cheaper there than anywhere.
  std::function<std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>(const Eigen::VectorXd& theta)> near;
  // A smooth with that many times the functions; may be empty.
  std::function<Eigen::MatrixXd(int times)> wider;
};

// Continuous refinement of theta.
struct Refinement {
  // Bounds of theta and the first simplex; step 0 holds an entry fixed. All empty: none.
  Eigen::VectorXd lower, upper, step;
  // Moves that suit its shape, as columns: one of each changes the gain about equally. Empty: the steps.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& theta)> moves;
  // Thetas worth refining, the best first, from a search of its own over what a tally gains. Empty: from the grid.
  std::function<std::vector<Eigen::VectorXd>(Tally& tally)> proposed;
  int starts = 1;         // places to refine from; more than one: its gain has many local optima
  int evaluations = 110;  // of the columns, a start
  double charge = 0;      // nats that refinement costs beyond the grid (from nulls refined alike)
  // The share of its gain that a theta may keep: below 1 where the object cannot stand. May be empty.
  std::function<double(const Eigen::VectorXd& theta)> admitted;
  // Prior log density of theta over the highest, nats. May be empty.
  std::function<double(const Eigen::VectorXd& theta)> belief;

  bool any() const { return step.size() > 0 && step.any(); }
};

// Competition with other candidates.
struct CandidateRole {
  std::set<std::string> stands_for;  // covariates of smooths that it may take the place of
  std::string pieces;  // candidates of one such class may find one object in pieces ("place"); empty: none
  // Thetas to try as the one object that these pieces are. May be empty.
  std::function<std::vector<Eigen::VectorXd>(const std::vector<Piece>&)> spanning;
  bool over_sites = false;  // a function of the site: residuals of other terms find a place somewhere
  bool slow = false;        // varies so slowly within one group that the field can absorb it
  bool time_like = false;   // a function of time: an observed column that does as well comes first
  bool observed = false;    // smooth of a column or factor of the data
  bool level_like = false;  // a function of the level: clipping imitates it
  int parameters = 1;       // of the cause: of two that the readings cannot separate, the one with fewer is meant
};

struct Candidate {
  std::string id;
  Kind kind = Kind::named;
  std::vector<std::string> covariates;                             // what it is a function of, its own one first
  std::function<std::string(const Eigen::VectorXd& theta)> label;  // empty: the id
  CandidateDesign design;
  Refinement refinement;
  CandidateRole role;

  std::string label_of(const Eigen::VectorXd& theta) const { return label ? label(theta) : id; }
  const std::string& own() const { return covariates.front(); }
};

}  // namespace muster::inference
