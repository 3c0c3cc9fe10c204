#include "diagnosis/replicates/pieces.hpp"

#include <cmath>
#include <numbers>

namespace muster::diagnosis {
namespace {

double turned(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

PieceMaker::PieceMaker(const std::vector<TextColumn>& columns) {
  const auto find = [&](const std::string& name) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].name == name) return static_cast<int>(c);
    return -1;
  };
  x_ = find("x"), y_ = find("y"), yaw_ = find("yaw");
  const char* parts[] = {"qw", "qx", "qy", "qz"};
  for (int i = 0; i < 4; ++i) q_[i] = find(parts[i]);
  const bool is_turned = q_[0] >= 0 && q_[1] >= 0 && q_[2] >= 0 && q_[3] >= 0;
  is_pose_ = x_ >= 0 && y_ >= 0 && (yaw_ >= 0 || is_turned);
  for (const TextColumn& column : columns) is_angle_.push_back(column.unit == "rad");
  if (is_pose_) {
    kinds_ = {{"along", "m"}, {"across", "m"}, {"turn", "rad"}};
    return;
  }
  for (const TextColumn& column : columns) kinds_.push_back({column.name, column.unit});
}

double PieceMaker::yaw_of(const Eigen::RowVectorXd& sample) const {
  if (yaw_ >= 0) return sample[yaw_];
  const double w = sample[q_[0]], x = sample[q_[1]], y = sample[q_[2]], z = sample[q_[3]];
  return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

Eigen::VectorXd PieceMaker::operator()(const Eigen::MatrixXd& samples) const {
  if (!is_pose_) return samples.transpose().reshaped();
  Eigen::VectorXd result(3 * (samples.rows() - 1));
  for (Eigen::Index i = 0; i + 1 < samples.rows(); ++i) {
    const double yaw = yaw_of(samples.row(i)), turn = turned(yaw_of(samples.row(i + 1)) - yaw);
    const double dx = samples(i + 1, x_) - samples(i, x_), dy = samples(i + 1, y_) - samples(i, y_);
    // In the direction half way through the turn, in which an arc's chord lies.
    const double c = std::cos(yaw + turn / 2), s = std::sin(yaw + turn / 2);
    result.segment<3>(3 * i) << c * dx + s * dy, c * dy - s * dx, turn;
  }
  return result;
}

Eigen::VectorXd PieceMaker::difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  Eigen::VectorXd result = a - b;
  const auto kinds = static_cast<Eigen::Index>(kinds_.size());
  for (Eigen::Index i = 0; i < result.size(); ++i)
    if (kinds_[static_cast<std::size_t>(i % kinds)].unit == "rad") result[i] = turned(result[i]);
  return result;
}

Eigen::RowVectorXd PieceMaker::between(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, double share) const {
  Eigen::RowVectorXd result = (1 - share) * a + share * b;
  for (Eigen::Index c = 0; c < result.size(); ++c)
    if (is_angle_[static_cast<std::size_t>(c)]) result[c] = a[c] + share * turned(b[c] - a[c]);
  return result;
}

}  // namespace muster::diagnosis
