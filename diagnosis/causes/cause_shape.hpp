// Shape of a cause in the search: rows, place, axes and strengths, and the mapping of theta to its plugin's attributes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/data/recorded_time.hpp"
#include "diagnosis/inference/state/candidate.hpp"

namespace muster::diagnosis {

// A searched parameter of a cause, one entry of theta.
struct Axis {
  std::string parameter;  // of the plugin; "" for an entry of a place
  bool logarithmic = false;
  double lower = 0, upper = 0, step = 0;
  std::vector<double> values;                      // start values, as in theta: logarithms on a logarithmic axis
  double least = 0, most = 0;                      // bounds of a logarithmic axis: exp(log(x)) may exceed x
  bool cyclic = false;                             // an angle
  std::shared_ptr<const RecordedTime> recorded{};  // of a time in a log with pauses: theta is the shortened time

  double value_at(double entry) const;  // of the parameter, at an entry of theta
};

// Geometry of a cause's place.
enum class PlaceShape { none = 1, point, segment };
Eigen::Index place_entries(PlaceShape place);  // number of its entries in theta

// theta: index of the row; x y of a point, or x y of the middle, length and angle of a segment; axes.
struct CauseShape {
  Cause cause;
  std::vector<CauseRow> rows;               // one without names if it concerns none
  std::vector<const muster_param*> linear;  // strengths, a column each; empty: one column
  PlaceShape place = PlaceShape::none;
  std::vector<std::string> coordinates;  // parameters of the place: x y, or x0 y0 x1 y1
  std::vector<Axis> axes;
  std::map<std::string, double> held;  // fixed parameters, such as a heading along the plan
  std::string wave;                    // the cyclic parameter represented by two quadrature columns; may be empty

  std::map<std::string, double> parameters(const Eigen::VectorXd& theta) const;
  // True if the cause declares several strengths, be it that the data show only one of them.
  bool one_of_several() const { return !linear.empty() && cause.linear().size() > 1; }
  // Sets one strength to 1 and all others to 0.
  void set_one(std::size_t one, std::map<std::string, double>& parameters) const;
  const CauseRow& row(const Eigen::VectorXd& theta) const { return rows[static_cast<std::size_t>(theta[0])]; }
  // "radio/beacon1", for two "radio/beacon1 radio/beacon2"; empty if it concerns none.
  std::string row_label(const Eigen::VectorXd& theta) const;
  std::string set() const;  // of its first reference; "" without one
  // True if it has a heading, which is the plan's.
  bool has_heading_of_plan() const;
  // True for a point with a length, a width and the plan's heading.
  bool is_room() const { return place == PlaceShape::point && axes.size() > 1 && has_heading_of_plan(); }
  // True for a segment with a width, searched by its logarithm.
  bool is_strip() const { return place == PlaceShape::segment && !axes.empty() && axes[0].logarithmic; }
  Eigen::Index columns() const {
    return !wave.empty() ? 2 : linear.empty() ? 1 : static_cast<Eigen::Index>(linear.size());
  }
};

struct CauseCandidate {
  std::shared_ptr<const CauseShape> shape;
  inference::Candidate candidate;
};

struct CauseSearch {
  std::vector<CauseCandidate> found;
  std::vector<std::string> not_tested;  // "effect.two_ray: reason"
};

// Sources of causes' columns: the worlds that evaluate them, and the rows of the measured table behind the search's
// readings.
struct CauseSources {
  std::shared_ptr<CauseModel> run;
  std::vector<Eigen::Index> used;
};

}  // namespace muster::diagnosis
