#include "diagnosis/causes/cause_shape.hpp"

#include <algorithm>
#include <cmath>

namespace muster::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

double Axis::value_at(double entry) const {
  if (recorded) return recorded->at(std::clamp(entry / recorded->length(), 0.0, 1.0));
  if (logarithmic) return std::clamp(std::exp(entry), least, most);
  return cyclic ? std::remainder(entry, 2 * M_PI) : entry;
}

std::map<std::string, double> CauseShape::parameters(const VectorXd& theta) const {
  std::map<std::string, double> result = held;
  if (place == PlaceShape::point) {
    result[coordinates[0]] = theta[1];
    result[coordinates[1]] = theta[2];
  } else if (place == PlaceShape::segment) {
    const double x = theta[3] / 2 * std::cos(theta[4]), y = theta[3] / 2 * std::sin(theta[4]);
    result[coordinates[0]] = theta[1] - x;
    result[coordinates[1]] = theta[2] - y;
    result[coordinates[2]] = theta[1] + x;
    result[coordinates[3]] = theta[2] + y;
  }
  for (std::size_t k = 0; k < axes.size(); ++k) {
    result[axes[k].parameter] = axes[k].value_at(theta[1 + place_entries(place) + static_cast<Index>(k)]);
  }
  return result;
}

void CauseShape::set_one(std::size_t one, std::map<std::string, double>& parameters) const {
  for (const muster_param* p : cause.linear()) parameters[p->name] = p == linear[one] ? 1 : 0;
}

Index place_entries(PlaceShape place) { return place == PlaceShape::none ? 0 : place == PlaceShape::point ? 2 : 4; }

bool CauseShape::has_heading_of_plan() const {
  return std::any_of(held.begin(), held.end(),
                     [&](const auto& value) { return (cause.parameter(value.first).flags & MUSTER_CYCLIC) != 0; });
}

std::string CauseShape::row_label(const VectorXd& theta) const {
  std::string result;
  const auto references = cause.rows();
  for (std::size_t k = 0; k < references.size(); ++k) {
    if (!row(theta)[k].empty())
      result += (result.empty() ? "" : " ") + std::string(references[k]->text) + '/' + row(theta)[k];
  }
  return result;
}

std::string CauseShape::set() const {
  const auto references = cause.rows();
  return references.empty() ? "" : references[0]->text;
}

}  // namespace muster::diagnosis
