#include "diagnosis/noise/vecchia.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/noise/neighbourhood.hpp"

namespace muster::noise {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// out_i = own_i x_i + sum of beside_ia x_neighbour for columns that lie row by row.
template <class Scalar>
void apply(const Field& field, const Stencil& stencil, const Scalar* x, Index columns, Scalar* out) {
  constexpr Index block = 128;  // columns whose rows stay in the cache together
  for (Index from = 0; from < columns; from += block) {
    const Index width = std::min(block, columns - from);
    for (Index i = 0; i < field.size(); ++i) {
      Scalar* const to = out + i * columns + from;
      const Scalar* const own = x + i * columns + from;
      const auto scale = static_cast<Scalar>(stencil.own[at(i)]);
      for (Index k = 0; k < width; ++k) to[k] = scale * own[k];
      for (int a = 0; a < field.slots(); ++a) {
        const Index j = field.neighbour(i, a);
        if (j < 0) continue;
        const auto weight = static_cast<Scalar>(stencil.beside[at(i * field.slots() + a)]);
        const Scalar* const other = x + j * columns + from;
        for (Index k = 0; k < width; ++k) to[k] += weight * other[k];
      }
    }
  }
}

// The same for one column, as refinement asks for it thousands of times.
Eigen::VectorXd applied_to_one(const Field& field, const Stencil& stencil, const double* x) {
  Eigen::VectorXd out(field.size());
  const auto slots = static_cast<Index>(field.slots());
  for (Index i = 0; i < field.size(); ++i) {
    const double* const weights = stencil.beside.data() + i * slots;
    double sum = stencil.own[at(i)] * x[i];
    for (Index a = 0; a < slots; ++a) {
      const Index j = field.neighbour(i, static_cast<int>(a));
      sum += weights[a] * x[std::max<Index>(j, 0)];  // the weight of none is 0
    }
    out[i] = sum;
  }
  return out;
}

Eigen::MatrixXd applied(const Field& field, const Stencil& stencil, const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  if (columns.cols() == 1) return applied_to_one(field, stencil, columns.data());
  using ByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const ByRow x = columns;
  ByRow out(x.rows(), x.cols());
  apply(field, stencil, x.data(), x.cols(), out.data());
  return out;
}

Stencil empty_stencil(const Field& field) {
  return {std::vector<double>(at(field.size())), std::vector<double>(at(field.size() * field.slots()))};
}

// Writes lane by lane what was worked out for a group of rows; `combination` has a value a slot, then the row's own.
void store(const Field& field, Index group, const std::vector<Lanes>& combination, Stencil& stencil) {
  for (Index lane = 0; lane < Field::lanes; ++lane) {
    const Index i = group * Field::lanes + lane;
    if (i >= field.size()) return;
    for (int a = 0; a < field.slots(); ++a) stencil.beside[at(i * field.slots() + a)] = combination[at(a)][lane];
    stencil.own[at(i)] = combination[at(field.slots())][lane];
  }
}

}  // namespace

Field::Field(Sites sites, const Conditioning& conditioning)
    : sites_(std::move(sites)), slots_(conditioning.slots()), neighbours_(neighbours_of(sites_, conditioning)) {
  double longest = 0;
  each_pair([&](std::size_t, Index i, Index j) {
    longest = std::max(longest, (sites_.place.col(i) - sites_.place.col(j)).norm() +
                                    (sites_.anchor.col(i) - sites_.anchor.col(j)).norm());
  });
  spacing_ = std::max(spacing_, longest / (distances - 1));
  near_.assign(at(groups() * pairs() * lanes), distances);
  joint_.assign(near_.size(), distances);
  each_pair([&](std::size_t slot, Index i, Index j) {
    const double place = (sites_.place.col(i) - sites_.place.col(j)).squaredNorm();
    near_[slot] = entry(std::sqrt(place));
    if (sites_.radio[at(i)] != sites_.radio[at(j)]) return;
    joint_[slot] = entry(std::sqrt(place + (sites_.anchor.col(i) - sites_.anchor.col(j)).squaredNorm()));
  });
}

template <class Each>
void Field::each_pair(Each each) const {
  for (Index i = 0; i < size(); ++i) {
    for (int a = 0; a < slots_; ++a) {
      if (neighbour(i, a) < 0) continue;
      for (int b = 0; b <= a; ++b) {
        const Index other = b < a ? neighbour(i, b) : i;
        if (other < 0) continue;
        const Index pair = Index{a} * (a + 1) / 2 + b;
        each(at(((i / lanes) * pairs() + pair) * lanes + i % lanes), neighbour(i, a), other);
      }
    }
  }
}

uint16_t Field::entry(double distance) const {
  return static_cast<uint16_t>(std::min(distance / spacing_ + 0.5, distances - 1.0));
}

Whitener::Whitener(const Field& field, const Covariance& covariance, Stencil stencil)
    : field_(&field), covariance_(covariance), stencil_(std::move(stencil)) {}

Whitener::Whitener(const Field& field, const Covariance& covariance)
    : Whitener(field, covariance, empty_stencil(field)) {
  Neighbourhood neighbourhood(field, covariance);
  for (Index g = 0; g < field.groups(); ++g) {
    neighbourhood.factorise(g);
    store(field, g, neighbourhood.combination(), stencil_);
  }
  sum_up();
}

void Whitener::sum_up() {
  for (const double own : stencil_.own) log_scale_ += std::log(own);
}

Eigen::MatrixXd Whitener::operator()(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  return applied(*field_, stencil_, columns);
}

Sheet Whitener::sheet(const Sheet& columns) const {
  Sheet out(columns.rows(), columns.cols());
  apply(*field_, stencil_, columns.data(), columns.cols(), out.data());
  return out;
}

WhitenerSlopes::WhitenerSlopes(const Field& field, const Covariance& covariance)
    : field_(&field), whitener_(field, covariance, empty_stencil(field)) {
  for (Stencil& stencil : stencils_) stencil = empty_stencil(field);
  Neighbourhood neighbourhood(field, covariance);
  for (Index g = 0; g < field.groups(); ++g) {
    neighbourhood.factorise(g);
    store(field, g, neighbourhood.combination(), whitener_.stencil_);
    neighbourhood.differentiate(g);
    const Index used = std::min<Index>(Field::lanes, field.size() - g * Field::lanes);
    for (std::size_t p = 0; p < 4; ++p) {
      store(field, g, neighbourhood.slope(p), stencils_[p]);
      for (Index lane = 0; lane < used; ++lane)
        of_log_scale_[static_cast<Index>(p)] += neighbourhood.log_slope(p)[lane];
    }
    for (Index p = 0; p < 4; ++p) {
      for (Index q = 0; q <= p; ++q) {
        const Lanes product = neighbourhood.information(at(p), at(q));
        for (Index lane = 0; lane < used; ++lane) information_(p, q) += product[lane];
        information_(q, p) = information_(p, q);
      }
    }
  }
  whitener_.sum_up();
}

Eigen::MatrixXd WhitenerSlopes::operator()(int parameter, const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  return applied(*field_, stencils_[static_cast<std::size_t>(parameter)], columns);
}

}  // namespace muster::noise
