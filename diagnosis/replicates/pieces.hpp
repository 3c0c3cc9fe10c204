// Samples of courses as pieces whose errors do not depend on one another: of poses the increments in the frame of the
// body, of anything else the values. Dead reckoning adds its errors up; its increments do not.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "text/text_table.hpp"

namespace muster::diagnosis {

// Kinds of pieces, in turn: piece i is of kind i % kinds.size(), and the pieces of a course follow one another in time.
struct PieceKind {
  std::string name;  // "along"
  std::string unit;
};

class PieceMaker {
 public:
  // Columns x, y and yaw, or x, y and qw, qx, qy, qz, are poses in the plane; the other columns are left out then.
  explicit PieceMaker(const std::vector<TextColumn>& columns);

  const std::vector<PieceKind>& kinds() const { return kinds_; }
  // Of one course: samples x columns in, (samples - 1) increments or samples out, each of all kinds.
  Eigen::VectorXd operator()(const Eigen::MatrixXd& samples) const;
  // Differences of pieces; an angle's is the shorter way round.
  Eigen::VectorXd difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  // A sample between two, at a share of the time from a to b.
  Eigen::RowVectorXd between(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, double share) const;

 private:
  double yaw_of(const Eigen::RowVectorXd& sample) const;

  std::vector<PieceKind> kinds_;
  std::vector<char> is_angle_;  // of each column
  int x_ = -1, y_ = -1, yaw_ = -1;
  int q_[4] = {-1, -1, -1, -1};  // w, x, y, z
  bool is_pose_ = false;
};

}  // namespace muster::diagnosis
