#include "diagnosis/causes/strength_selection.hpp"

#include <algorithm>

#include "diagnosis/causes/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

}  // namespace

VectorXd BaseSpace::rest(const VectorXd& column) const {
  VectorXd result = turned_.householderQ().transpose() * column;
  result.head(columns_).setZero();
  return turned_.householderQ() * result;
}

bool BaseSpace::leaves(const VectorXd& column) const {
  const VectorXd turned = turned_.householderQ().transpose() * column;
  return column.norm() > 0 && turned.tail(turned.size() - columns_).norm() > thresholds::least_left * column.norm();
}

void choose_strengths(CauseShape& shape, const CauseSources& sources, const BaseSpace& base) {
  shape.linear = shape.cause.linear();
  if (shape.linear.size() < 2) return;
  struct Strength {
    const muster_param* parameter;
    VectorXd column;
    Index count;
  };
  std::vector<Strength> all;
  for (std::size_t k = 0; k < shape.linear.size(); ++k) {
    std::map<std::string, double> parameters = shape.held;
    shape.set_one(k, parameters);
    VectorXd column(static_cast<Index>(sources.used.size()));
    sources.run->fill(shape.cause, shape.rows, 0, parameters, sources.used, column);
    const Index count = (column.array() != 0).count();
    if (count > 0) all.push_back({shape.linear[k], std::move(column), count});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.count < b.count; });
  Eigen::MatrixXd together(static_cast<Index>(sources.used.size()), 0);
  std::vector<const muster_param*> kept;
  for (const Strength& s : all) {
    VectorXd rest = base.rest(s.column);
    for (int twice = 0; twice < 2; ++twice) rest -= together * (together.transpose() * rest);
    if (!(rest.norm() > thresholds::least_left * s.column.norm())) continue;
    together.conservativeResize(Eigen::NoChange, together.cols() + 1);
    together.rightCols(1) = rest.normalized();
    kept.push_back(s.parameter);
  }
  std::erase_if(shape.linear, [&](const muster_param* p) { return !std::count(kept.begin(), kept.end(), p); });
}

}  // namespace muster::diagnosis
