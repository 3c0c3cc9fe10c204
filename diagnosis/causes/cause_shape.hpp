// Shape of a cause that is sought: rows, place, axes and strengths, and how theta reads as attributes of its plugin.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/causes/cause_model.hpp"
#include "diagnosis/inference/state/candidate.hpp"

namespace muster::diagnosis {

// A parameter of a cause that is sought, one entry of theta.
struct Axis {
  std::string parameter;  // of the plugin; "" for an entry of a place
  bool logarithmic = false;
  double lower = 0, upper = 0, step = 0;
  std::vector<double> values;  // to start from, as in theta: logarithms where it is logarithmic
  double least = 0, most = 0;  // where it is logarithmic: exp(log(x)) may lie above x
  bool cyclic = false;         // an angle
};

// How the coordinates of a cause make a place.
enum class PlaceShape { none = 1, point, segment };
Eigen::Index place_entries(PlaceShape place);  // of theta

// theta is: number of the row; then x y of a point, or x y of the middle, length and angle of a segment; then axes.
struct CauseShape {
  Cause cause;
  std::vector<CauseRow> rows;               // one without names where it is about none
  std::vector<const muster_param*> linear;  // whose strength is sought, a column each; none: it counts as it is
  PlaceShape place = PlaceShape::none;
  std::vector<std::string> coordinates;  // parameters of the place: x y, or x0 y0 x1 y1
  std::vector<Axis> axes;
  std::map<std::string, double> held;  // parameters that are set once, such as a heading along the plan
  std::string wave;                    // the cyclic parameter that two columns stand for; empty: one column

  std::map<std::string, double> parameters(const Eigen::VectorXd& theta) const;
  // One strength at 1 and all others at 0.
  void set_one(std::size_t one, std::map<std::string, double>& parameters) const;
  const CauseRow& row(const Eigen::VectorXd& theta) const { return rows[static_cast<std::size_t>(theta[0])]; }
  // "radio/beacon1", of two "radio/beacon1 radio/beacon2"; empty where it is about none.
  std::string row_label(const Eigen::VectorXd& theta) const;
  std::string set() const;  // of its first reference; "" without one
  // A point with a length, a width and a heading that the plan gives.
  bool is_room() const { return place == PlaceShape::point && axes.size() > 1 && !held.empty(); }
  // A segment with a width, which is sought by its logarithm.
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
  std::vector<std::string> not_tested;  // "effect.two_ray: why"
};

// Columns of causes: the worlds that evaluate them, and the rows of the measured table behind the search's readings.
struct CauseSources {
  std::shared_ptr<CauseModel> run;
  std::vector<Eigen::Index> used;
};

}  // namespace muster::diagnosis
