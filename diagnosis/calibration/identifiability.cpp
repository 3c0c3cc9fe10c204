#include "diagnosis/calibration/identifiability.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>

namespace muster::diagnosis {
namespace {

constexpr double blind = 1e-7;  // rounding errors, relative to the whole box or to the strongest direction

}  // namespace

std::vector<Blindness> blindnesses(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& box_width) {
  std::vector<Blindness> result;
  std::vector<Eigen::Index> seen;
  Eigen::VectorXd norm(slopes.cols());
  const double rows = std::sqrt(static_cast<double>(slopes.rows()));
  for (Eigen::Index j = 0; j < slopes.cols(); ++j) {
    norm[j] = slopes.col(j).norm();
    if (norm[j] * box_width[j] > blind * rows) {  // dB over the whole box, as a root mean square over the rows
      seen.push_back(j);
    } else {
      result.push_back({{static_cast<int>(j)}, Eigen::VectorXd::Unit(slopes.cols(), j)});
    }
  }
  if (seen.empty()) return result;
  Eigen::MatrixXd even(slopes.rows(), static_cast<Eigen::Index>(seen.size()));
  for (std::size_t k = 0; k < seen.size(); ++k)
    even.col(static_cast<Eigen::Index>(k)) = slopes.col(seen[k]) / norm[seen[k]];
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::ColPivHouseholderQRPreconditioner> svd(even, Eigen::ComputeThinV);
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k) {
    if (svd.singularValues()[k] > blind * svd.singularValues()[0]) continue;
    Blindness found{{}, Eigen::VectorXd::Zero(slopes.cols())};
    for (std::size_t j = 0; j < seen.size(); ++j) {
      const double part = svd.matrixV()(static_cast<Eigen::Index>(j), k);
      if (std::abs(part) < 1e-3) continue;
      found.parameters.push_back(static_cast<int>(seen[j]));
      found.direction[seen[j]] = part / norm[seen[j]];
    }
    Eigen::Index largest = 0;
    found.direction.cwiseAbs().maxCoeff(&largest);
    found.direction /= found.direction[largest];
    result.push_back(found);
  }
  return result;
}

std::string in_words(const Blindness& blindness, const std::vector<std::string>& names,
                     const std::vector<std::string>& units) {
  if (blindness.parameters.size() == 1)
    return fmt::format("no reading depends on {}", names[static_cast<std::size_t>(blindness.parameters[0])]);
  std::string result;
  for (const int j : blindness.parameters) {
    const auto at = static_cast<std::size_t>(j);
    result += fmt::format("{}{} by {:.4g}{}{}", result.empty() ? "changing " : " together with ", names[at],
                          blindness.direction[j], units[at].empty() ? "" : " ", units[at]);
  }
  return result + " changes no reading";
}

}  // namespace muster::diagnosis
