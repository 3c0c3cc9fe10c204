// Kernels of three kinds for the errors of two links. All decorrelation distances are computed at once: each is half
// the one before, so one exponential yields all by squaring.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "diagnosis/calibration/residual_covariance.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::size_t count = 5;
constexpr std::array<double, count> distances = {5.6, 2.8, 1.4, 0.7, 0.35};  // m: room to furniture
constexpr int pieces = 12;                                                   // of a path

using ByDistance = std::array<double, count>;

// Adds weight * exp(-r / d) for every d.
void add_decay(ByDistance& sums, double r, double weight) {
  double decay = std::exp(-r / distances[0]);
  for (double& sum : sums) {
    sum += weight * decay;
    decay *= decay;
  }
}

// By place: links with nearby ends share shadowing, in either direction. The sum over both directions keeps the
// matrix positive.
void by_place(const LinkPlace& p, const LinkPlace& q, ByDistance& sums) {
  add_decay(sums, (p.a - q.a).norm() + (p.b - q.b).norm(), 1);
  add_decay(sums, (p.a - q.b).norm() + (p.b - q.a).norm(), 1);
}

// By path: links side by side share shadowing. The double line integral of a field with correlation exp(-r/d), over
// the roots of both lengths (Agrawal and Patwari, IEEE Trans. Wireless Comm. 8(8), 2009).
void by_way(const LinkPlace& p, const LinkPlace& q, ByDistance& sums) {
  const Eigen::Vector3d u = (p.b - p.a) / pieces, v = (q.b - q.a) / pieces;
  const double du = u.norm(), dv = v.norm();
  if (du == 0 || dv == 0) return;
  const double soft = std::pow((du + dv) / 6, 2);  // squared size of a piece
  using Pieces = Eigen::Array<double, pieces, 1>;
  const Pieces along = Pieces::LinSpaced(pieces, 0.5, pieces - 0.5);
  Eigen::Array<double, pieces, pieces> decay;  // first the squared distances
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector3d from = p.a + u * (i + 0.5) - q.a;
    decay.col(i) = (from.x() - v.x() * along).square() + (from.y() - v.y() * along).square() +
                   (from.z() - v.z() * along).square() + soft;
  }
  decay = (decay.sqrt() / -distances[0]).exp();
  for (std::size_t d = 0; d < count; ++d) {
    sums[d] += decay.sum() * std::sqrt(du * dv) / (2 * distances[d] * pieces);
    decay *= decay;
  }
}

// By radio: offsets shared by readings with the same radio.
void by_radio(const LinkPlace& p, const LinkPlace& q, ByDistance& sums) {
  for (double& sum : sums) sum += (p.radio_a == q.radio_a) + (p.radio_b == q.radio_b);
}

using Correlation = void (*)(const LinkPlace&, const LinkPlace&, ByDistance&);

// Mean over pairs of readings from two clusters. Within one cluster over distinct readings only: an error of a single
// reading counts as white.
ByDistance between(const std::vector<LinkPlace>& p, const std::vector<LinkPlace>& q, Correlation correlation) {
  const bool same = &p == &q;
  const std::size_t most = same ? 4 : 3;
  ByDistance sums{};
  int pairs = 0;
  for (std::size_t i = 0; i < std::min(most, p.size()); ++i) {
    for (std::size_t j = 0; j < std::min(most, q.size()); ++j) {
      if (same && i == j && p.size() > 1) continue;
      correlation(p[i], q[j], sums);
      ++pairs;
    }
  }
  for (double& sum : sums) sum /= pairs;
  return sums;
}

// Adds the least white part that makes the matrix positive: means over a few examples need not be a covariance.
void make_positive(Eigen::MatrixXd& shape) {
  const double unit = shape.diagonal().mean();
  for (double white = 1e-6; Eigen::LLT<Eigen::MatrixXd>(shape).info() != Eigen::Success && white < 1; white *= 2)
    shape.diagonal().array() += white * unit;
}

void add_shapes(std::vector<Kernels>& kernels, const Clusters& clusters, Correlation correlation) {
  const auto n = static_cast<Eigen::Index>(clusters.count());
  for (Kernels& k : kernels) k.shapes.emplace_back(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const ByDistance values = between(clusters.examples[static_cast<std::size_t>(i)],
                                        clusters.examples[static_cast<std::size_t>(j)], correlation);
      for (std::size_t d = 0; d < count; ++d) {
        Eigen::MatrixXd& shape = kernels[d].shapes.back();
        shape(i, j) = shape(j, i) = values[d];
      }
    }
  }
  for (Kernels& k : kernels) make_positive(k.shapes.back());
}

bool many_pairs(const Clusters& clusters) {
  std::set<std::pair<int, int>> pairs;
  for (const auto& examples : clusters.examples) pairs.emplace(examples[0].radio_a, examples[0].radio_b);
  return pairs.size() >= 4;
}

}  // namespace

std::vector<Kernels> kernels_of(const Clusters& clusters) {
  std::vector<Kernels> result;
  for (const double d : distances) result.push_back({d, {}});
  add_shapes(result, clusters, by_place);
  add_shapes(result, clusters, by_way);
  if (many_pairs(clusters)) add_shapes(result, clusters, by_radio);
  return result;
}

}  // namespace muster::diagnosis
