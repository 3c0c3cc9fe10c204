// Kernels of all instruction sets: the same bits on every machine, equal to plain loops.
#include "diagnosis/inference/noise/row_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/noise/neighbourhood.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/apart.hpp"

namespace muster::noise {
namespace {

// Half of the anchors move, so that joint distances are equal to those of places, uncorrelated, or other.
Sites places(Index n) {
  const Stream s(31);
  Sites sites{Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              {},
              Eigen::VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<uint64_t>(i);
    sites.place.col(i) << 6 * s.uniform(k, 0), 5 * s.uniform(k, 1), s.uniform(k, 2);
    sites.group.push_back(static_cast<int>(k % 4));
    sites.anchor.col(i) << 3.0 * static_cast<double>(k % 4), k % 4 < 2 ? s.uniform(k, 4) : 1, 0;
    sites.count[i] = 1 + std::floor(3 * s.uniform(k, 3));
  }
  return sites;
}

const Covariance covariance{Family::matern32, {std::log(9.0), std::log(1.7), std::log(4.0), -1.2}};

template <class Matrix>
Matrix normals(Index rows, Index columns, uint64_t seed) {
  Matrix result(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j)
      result(i, j) =
          static_cast<typename Matrix::Scalar>(Stream(seed).normal(static_cast<uint64_t>(i), static_cast<uint64_t>(j)));
  }
  return result;
}

using ByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool same_bits(const Lanes* a, const Lanes* b, Index count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(Lanes)) == 0;
}

TEST(RowKernels, AreThoseThatTheMachineRuns) {
  EXPECT_EQ(row_kernels().number, 1 + !!__builtin_cpu_supports("x86-64-v3") + !!__builtin_cpu_supports("x86-64-v4"));
  EXPECT_EQ(&row_kernels().best(), row_kernels().all[row_kernels().number - 1]);
}

TEST(RowKernels, FactoriseToTheSameBits) {
  const Field field(places(203));
  Neighbourhood plain(field, covariance, true, *row_kernels().all[0]);
  std::array<bool, 4> seen{};
  for (int k = 1; k < row_kernels().number; ++k) {
    Neighbourhood other(field, covariance, true, *row_kernels().all[k]);
    for (Index g = 0; g < field.groups(); ++g) {
      for (Neighbourhood* one : {&plain, &other}) {
        one->factorise(g);
        one->differentiate();
      }
      EXPECT_TRUE(same_bits(plain.combination(), other.combination(), field.slots() + 1)) << g;
      for (int p = 0; p < parameters; ++p) {
        EXPECT_TRUE(same_bits(plain.slope(p), other.slope(p), field.slots() + 1)) << g << ' ' << p;
        for (int q = 0; q <= p; ++q)
          EXPECT_TRUE(same_bits(&plain.information(p, q), &other.information(p, q), 1)) << g << ' ' << p << ' ' << q;
      }
      for (Index pair = 0; pair < field.pairs(); ++pair)
        seen[static_cast<std::size_t>(field.entries(g, covariance).kinds[pair])] = true;
    }
  }
  EXPECT_TRUE(row_kernels().number == 1 || (seen[1] && seen[2] && seen[3]));
}

// Neighbourhoods of points on a line in every lane, or in all but one: there correlations contradict each other.
struct OnALine {
  static constexpr long slots = 7;
  static constexpr int odd = 3;  // lane
  static constexpr double field = 4, reading = 0.02;
  std::vector<double> correlation = std::vector<double>(1001);
  std::vector<uint16_t> near;
  std::vector<Joint> kinds = std::vector<Joint>(slots * (slots + 1) / 2, Joint::same);
  std::vector<Lanes> nugget{slots + 1}, present{slots + 1}, variance{slots + 1}, root{slots * slots}, cross{slots},
      combination{slots + 1};

  explicit OnALine(bool contradicts) {
    for (std::size_t k = 0; k < correlation.size(); ++k) correlation[k] = std::exp(-0.01 * static_cast<double>(k));
    for (int a = 0; a < slots; ++a) {
      for (int b = 0; b <= a; ++b) {
        for (int lane = 0; lane < lanes; ++lane) {
          const bool chance = contradicts && lane == odd;
          near.push_back(
              chance ? static_cast<uint16_t>(60 * Stream(7).uniform(static_cast<uint64_t>(a), static_cast<uint64_t>(b)))
                     : static_cast<uint16_t>(apart(lane, a, b < a ? b : slots)));
        }
      }
    }
    for (auto* all : {&nugget, &present, &variance}) {
      const double value = all == &nugget ? reading : all == &present ? 1 : field;
      for (Lanes& each : *all) std::fill_n(each.of, lanes, value);
    }
  }

  static int place(int lane, long slot) {
    return static_cast<int>(400 * Stream(8).uniform(static_cast<uint64_t>(lane), static_cast<uint64_t>(slot)));
  }
  static int apart(int lane, long a, long b) { return std::abs(place(lane, a) - place(lane, b)); }

  void factorise(const RowKernel& kernel) {
    Neighbourhoods n{};
    n.slots = slots;
    n.correlation = correlation.data();
    n.near_variance = field;
    n.floor_variance = floor_variance;
    n.near = n.joint = near.data();
    n.kinds = kinds.data();
    n.nugget = nugget[0].of, n.present = present[0].of, n.field = variance[0].of;
    n.root = root[0].of, n.cross = cross[0].of, n.combination = combination[0].of;
    kernel.factorise(n);
  }
};

TEST(RowKernels, ALaneThatNeedsABoundLeavesTheOthersAlone) {
  for (int k = 0; k < row_kernels().number; ++k) {
    OnALine sound(false), one(true);
    for (OnALine* each : {&sound, &one}) each->factorise(*row_kernels().all[k]);
    const double most = 1 / std::sqrt(OnALine::reading + floor_variance);
    EXPECT_NEAR(one.combination[OnALine::slots].of[OnALine::odd], most, 1e-9);  // nothing more is left of it
    for (int lane = 0; lane < lanes; ++lane) {
      Eigen::MatrixXd c(OnALine::slots + 1, OnALine::slots + 1);
      for (long a = 0; a <= OnALine::slots; ++a) {
        for (long b = 0; b <= OnALine::slots; ++b)
          c(a, b) = OnALine::field * std::exp(-0.01 * OnALine::apart(lane, a, b)) +
                    (a == b ? OnALine::reading + floor_variance : 0);
      }
      const Eigen::VectorXd last = c.inverse().col(OnALine::slots), plain = last / std::sqrt(last[OnALine::slots]);
      for (long a = 0; a <= OnALine::slots; ++a) {
        const double by_kernel = sound.combination[static_cast<std::size_t>(a)].of[lane];
        EXPECT_NEAR(by_kernel, plain[a], 1e-8 * plain[OnALine::slots]) << lane << ' ' << a;
        EXPECT_EQ(one.combination[static_cast<std::size_t>(a)].of[lane] == by_kernel, lane != OnALine::odd) << lane;
      }
    }
  }
}

// A plain loop, in the order of the slots.
template <class Matrix>
Matrix combined_plainly(const Combinations& c, const Matrix& x) {
  using Scalar = typename Matrix::Scalar;
  Matrix out(x.rows(), x.cols());
  for (Index i = 0; i < x.rows(); ++i) {
    for (Index j = 0; j < x.cols(); ++j) {
      Scalar sum = static_cast<Scalar>(c.own[i]) * x(i, j);
      for (Index a = i * c.slots; a < (i + 1) * c.slots; ++a) {
        if (c.neighbours[a] >= 0) sum += static_cast<Scalar>(c.beside[a]) * x(c.neighbours[a], j);
      }
      out(i, j) = sum;
    }
  }
  return out;
}

TEST(RowKernels, CombineColumnsAsAPlainLoopDoes) {
  const Field field(places(101));
  const Whitener whitener(field, covariance);
  const Combinations c = field.combinations(whitener.stencil());
  for (const Index columns : {1, 2, 3, 5, 8, 11, 16, 21, 37, 64, 150, 301}) {
    const ByRow x = normals<ByRow>(101, columns, 5);
    const Sheet floats = x.cast<float>();
    for (int k = 0; k < row_kernels().number; ++k) {
      ByRow out(x.rows(), x.cols());
      row_kernels().all[k]->combine(c, x.data(), columns, out.data());
      EXPECT_EQ(out, combined_plainly(c, x)) << columns << ' ' << row_kernels().all[k]->name;
      Sheet sheet(x.rows(), x.cols());
      row_kernels().all[k]->combine_floats(c, floats.data(), columns, sheet.data());
      EXPECT_EQ(sheet, combined_plainly(c, floats)) << columns << ' ' << row_kernels().all[k]->name;
    }
  }
}

TEST(RowKernels, ContractFourCombinationsAtOnce) {
  const Field field(places(101));
  std::array<Whitener, 4> whiteners{
      Whitener(field, covariance), Whitener(field, {Family::exponential, covariance.theta}),
      Whitener(field, {Family::gaussian, covariance.theta}), Whitener(field, {Family::two_scale, covariance.theta})};
  std::array<Combinations, 4> four;
  for (std::size_t p = 0; p < 4; ++p) four[p] = field.combinations(whiteners[p].stencil());
  for (const Index columns : {8, 24}) {
    const ByRow x = normals<ByRow>(101, columns, 6), with = normals<ByRow>(101, columns, 7);
    std::array<double, 4> first{};
    for (int k = 0; k < row_kernels().number; ++k) {
      std::array<double, 4> sums{};
      row_kernels().all[k]->contract(four.data(), x.data(), with.data(), columns, sums.data());
      for (std::size_t p = 0; p < 4; ++p)
        EXPECT_NEAR(sums[p], combined_plainly(four[p], x).cwiseProduct(with).sum(), 1e-10) << columns;
      if (k == 0) first = sums;
      EXPECT_EQ(sums, first) << row_kernels().all[k]->name;
    }
  }
}

TEST(RowKernels, TellDistancesAsPairByPair) {
  Sites sites = places(3 * many + 5);
  sites.place_stretch = 0.3 * normals<Eigen::MatrixXd>(3, sites.size(), 11);
  for (const bool anchors_move : {false, true}) {
    sites.anchor_stretch = 0.2 * anchors_move * normals<Eigen::MatrixXd>(3, sites.size(), 12);
    sites.anchor =
        anchors_move ? normals<Eigen::MatrixXd>(3, sites.size(), 13) : Eigen::Matrix3Xd::Ones(3, sites.size());
    const SiteFloats floats = floats_of(sites);
    PlacedSites placed(sites.size());
    for (Index i = 0; i < sites.size(); ++i) placed.set(i, floats.row(i));
    for (const bool by_readings : {false, true}) {
      const Places all = placed.places(by_readings, anchors_move, 1e9f);
      const Index row = sites.size() - 1;
      Eigen::VectorXf first;
      for (int k = 0; k < row_kernels().number; ++k) {
        Eigen::VectorXf place(placed.filled()), both(placed.filled()), told(2 * row);
        row_kernels().all[k]->apart(all, row, place.data(), both.data());
        told << place.head(row), both.head(row);
        if (k == 0) first = told;
        EXPECT_EQ(told, first) << row_kernels().all[k]->name;
      }
      for (Index i = 0; i < row; ++i) {
        const Apart apart = by_readings ? readings_apart(sites, row, i) : middles_apart(sites, row, i);
        EXPECT_NEAR(first[i], apart.place, 1e-4) << i;
        EXPECT_NEAR(first[row + i], apart.both, 1e-4) << i;
      }
    }
  }
}

// Rows on a line, in blocks of near and of far ones; readings count for every second pair of blocks.
TEST(RowKernels, TellCovariancesOfPairsToTheSameBits) {
  const Index rows = 4 * many;
  Eigen::MatrixXf at = normals<Eigen::MatrixXf>(rows, 12, 10);
  at.rightCols(6) *= 0.2f;
  at.col(0) += Eigen::VectorXf::LinSpaced(rows, 0, 40);
  const Eigen::VectorXf within_place = own_share * at.middleCols(6, 3).rowwise().norm();
  const Eigen::VectorXf within_both = own_share * at.rightCols(6).rowwise().norm();
  const auto ends = [&](Index from) {
    const auto axis = [&](Index k) { return at.col(from + k).data(); };
    return Ends{{axis(0), axis(1), axis(2)}, {axis(6), axis(7), axis(8)}};
  };
  std::vector<int> radio;
  for (Index i = 0; i < rows; ++i) radio.push_back(static_cast<int>(i % 3));
  const Eigen::VectorXf falling = Eigen::VectorXf::LinSpaced(1201, 1, 0);
  const Index row = rows - 3;
  const auto readings_apart = [&](Index i, Index columns) {
    double sum = 0;
    for (const float a : {-1.0f, 0.0f, 1.0f}) {
      for (const float b : {-1.0f, 0.0f, 1.0f})
        sum += (at.row(row) + a * at.row(row).rightCols(6).replicate(1, 2) - at.row(i) -
                b * at.row(i).rightCols(6).replicate(1, 2))
                   .head(columns)
                   .norm();
    }
    return sum / 9;
  };
  for (const bool stretched : {false, true}) {
    for (const bool anchors_move : {false, true}) {
      const Pairs pairs{{ends(0), ends(3), stretched ? within_place.data() : nullptr,
                         stretched ? within_both.data() : nullptr, 15, anchors_move},
                        radio.data(),
                        falling.data(),
                        20,
                        2,
                        5};
      Eigen::VectorXd first(rows);
      for (int k = 0; k < row_kernels().number; ++k) {
        Eigen::VectorXd told(rows);
        row_kernels().all[k]->covariances(pairs, row, told.data());
        if (k == 0) first = told;
        EXPECT_EQ(told.head(row), first.head(row)) << row_kernels().all[k]->name;
      }
      for (Index i = 0; i < row; ++i) {
        const auto apart = [&](Index columns, const Eigen::VectorXf& within) {
          if (!stretched) return static_cast<double>((at.row(row) - at.row(i)).head(columns).norm());
          return std::max(0.0, readings_apart(i, columns) - within[row] - within[i]);
        };
        const double near = apart(3, within_place), both = anchors_move ? apart(6, within_both) : near;
        const double expected = 2 * (1 - near / 60) + (i % 3 == row % 3 ? 5 * (1 - both / 60) : 0);
        EXPECT_NEAR(first[i], expected, 0.01) << i;  // half an entry is 0.003
      }
    }
  }
}

TEST(RowKernels, TakeOutWhatABasisExplains) {
  const Eigen::MatrixXd design = normals<Eigen::MatrixXd>(157, 6, 8);
  const Basis basis = basis_of(design);
  const Sheet q = basis.q.cast<float>();
  for (const Index columns : {1, 4, 7, 16, 35, 100}) {
    const Eigen::MatrixXd x = normals<Eigen::MatrixXd>(157, columns, 9) + design * Eigen::MatrixXd::Ones(6, columns);
    Sheet first;
    for (int k = 0; k < row_kernels().number; ++k) {
      Sheet left = x.cast<float>();
      std::vector<float> scratch(6 * 32);
      row_kernels().all[k]->take_out(q.data(), 157, 6, left.data(), columns, scratch.data());
      EXPECT_LT((left.cast<double>() - basis.rest(x)).cwiseAbs().maxCoeff(), 1e-5) << columns;
      if (k == 0) first = left;
      EXPECT_EQ(left, first) << columns << ' ' << row_kernels().all[k]->name;
    }
  }
}

}  // namespace
}  // namespace muster::noise
