// Arithmetic on blocks equals Eigen's, in the same bits for every instruction set.
#include "block_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cstring>
#include <random>
#include <vector>

namespace muster::simbody {
namespace {

template <int N>
const BlockArithmetic<N>& of(const BlockKernel& kernel) {
  if constexpr (N == 6) return kernel.six;
  if constexpr (N == 8) return kernel.eight;
  if constexpr (N == 12) return kernel.twelve;
}

template <int N>
class Check {
 public:
  void products() {
    for (int trial = 0; trial < 20; ++trial) {
      const Block a = draw<Block>(), b = draw<Block>();
      const Rows p = draw<Rows>();
      const Column x = draw<Column>(), y = draw<Column>();
      const Eigen::Vector3d k = draw<Eigen::Vector3d>();
      expect(b, a, [&](const auto& by, double* to) { by.copy(to, b.data()); });
      const Eigen::Vector3d speeds = k + p.transpose() * x;
      expect(speeds, k, [&](const auto& by, double* to) { by.add_speeds(to, p.data(), x.data()); });
      const Column left = x - p * k, less = x - a * y, less_transposed = x - a.transpose() * y;
      expect(left, x, [&](const auto& by, double* to) { by.subtract_rows(to, p.data(), k.data()); });
      expect(less, x, [&](const auto& by, double* to) { by.subtract_product(to, a.data(), y.data()); });
      expect(less_transposed, x, [&](const auto& by, double* to) { by.subtract_transposed(to, a.data(), y.data()); });
      const Column product = a * x, transposed = a.transpose() * x;
      expect(product, x, [&](const auto& by, double* to) { by.apply(to, a.data()); });
      expect(transposed, x, [&](const auto& by, double* to) { by.apply_transposed(to, a.data()); });
      const Block upper = b.template triangularView<Eigen::Upper>(), times = a * upper, rest = a - b * b.transpose();
      expect(times, a, [&](const auto& by, double* to) { by.multiply(to, upper.data()); });
      expect(rest, a, [&](const auto& by, double* to) { by.subtract(to, b.data(), b.data()); });
    }
  }

  void contacts() {
    for (int count = 1; count <= BlockArithmetic<N>::most_contacts; ++count) {
      const Block start = draw<Block>();
      std::array<Rows, BlockArithmetic<N>::most_contacts> p, q;
      std::array<const double*, BlockArithmetic<N>::most_contacts> a, b;
      std::vector<double> k;
      Block sum = start;
      for (int i = 0; i < count; ++i) {
        p[i] = draw<Rows>(), q[i] = draw<Rows>();
        a[i] = p[i].data(), b[i] = q[i].data();
        const Eigen::Vector4d of_contact = draw<Eigen::Vector4d>();
        k.insert(k.end(), of_contact.data(), of_contact.data() + 4);
        Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
        stiffness(0, 0) = of_contact[0];
        stiffness.bottomRightCorner<2, 2>() << of_contact[1], of_contact[2], of_contact[2], of_contact[3];
        sum += p[i] * stiffness * q[i].transpose();
      }
      expect(sum, start, [&](const auto& by, double* to) { by.add_contacts(to, count, a.data(), b.data(), k.data()); });
    }
  }

  // Ten contacts among three bodies, the first of them with a static surface.
  void tables() {
    constexpr int count = 10, bodies = 3;
    struct Contact {
      Rows own, others;
    };
    std::vector<Contact> contacts(count);
    std::vector<int> of;
    std::array<ContactLanes, 2> lanes{};
    using Table = Eigen::Matrix<double, N, bodies>;
    const Table velocities = draw<Table>(), momenta = draw<Table>();
    Table left = momenta;
    Eigen::Matrix<double, 3, count> speeds;
    for (int i = 0; i < count; ++i) {
      contacts[i] = {draw<Rows>(), draw<Rows>()};
      const int body = i % bodies, other = i == 0 ? -1 : (i + 1) % bodies;
      of.insert(of.end(), {body, other});
      Eigen::Vector3d impulse = draw<Eigen::Vector3d>().cwiseAbs();
      if (i == 7) impulse.setZero();  // it neither pushes nor has any friction
      ContactLanes& c = lanes[i / 8];
      c.push[i % 8] = impulse[0], c.grip[0][i % 8] = impulse[1], c.grip[1][i % 8] = impulse[2];
      speeds.col(i) = contacts[i].own.transpose() * velocities.col(body);
      left.col(body) -= contacts[i].own * impulse;
      if (other < 0) continue;
      speeds.col(i) += contacts[i].others.transpose() * velocities.col(other);
      left.col(other) -= contacts[i].others * impulse;
    }
    const double *rows = contacts[0].own.data(), *others = contacts[0].others.data();
    const ContactTable table{count, rows, sizeof(Contact) / sizeof(double), others - rows, of.data()};
    expect(left, momenta, [&](const auto& by, double* to) { by.take_impulses(table, lanes.data(), to); });
    expect(speeds, speeds, [&](const auto& by, double* to) {
      by.look_ahead(table, velocities.data(), lanes.data());
      for (int i = 0; i < count; ++i) {
        const ContactLanes& c = lanes[i / 8];
        to[3 * i] = c.speed_ahead[i % 8];
        to[3 * i + 1] = c.slip_ahead[0][i % 8], to[3 * i + 2] = c.slip_ahead[1][i % 8];
      }
    });
  }

  void factors() {
    for (int trial = 0; trial < 20; ++trial) {
      const Block a = draw<Block>(), square = a * a.transpose() + Block::Identity();
      const Block lower = square.llt().matrixL(), expected = lower.inverse().transpose();
      expect(expected, Block(Block::Zero()), [&](const auto& by, double* to) { by.invert_factor(square.data(), to); });
    }
  }

 private:
  using Block = Eigen::Matrix<double, N, N>;
  using Column = Eigen::Matrix<double, N, 1>;
  using Rows = Eigen::Matrix<double, N, 3>;  // one after the other

  template <class Matrix>
  Matrix draw() {
    return Matrix::NullaryExpr([&](Eigen::Index) { return static_cast<double>(random_()) / 2147483648.0 - 1; });
  }

  // Runs the operation on `start` by every kernel; all must agree in all bits, and with Eigen.
  template <class Matrix, class Operation>
  void expect(const Matrix& expected, const Matrix& start, Operation operation) {
    const BlockKernels kernels = block_kernels();
    Matrix first;
    for (int k = 0; k < kernels.number; ++k) {
      Matrix result = start;
      operation(of<N>(*kernels.all[k]), result.data());
      EXPECT_LT((result - expected).norm(), 1e-12 * (1 + expected.norm())) << kernels.all[k]->name << ' ' << N;
      if (k == 0) first = result;
      EXPECT_EQ(std::memcmp(result.data(), first.data(), sizeof first), 0) << kernels.all[k]->name << ' ' << N;
    }
  }

  std::mt19937 random_{3};
};

TEST(BlockKernel, ProductsAreEigensInTheSameBits) {
  Check<6>().products();
  Check<8>().products();
  Check<12>().products();
}

TEST(BlockKernel, ContactsOfAPairAddUp) {
  Check<6>().contacts();
  Check<8>().contacts();
  Check<12>().contacts();
}

TEST(BlockKernel, TablesOfContactsAreReadWhereTheyLie) {
  Check<6>().tables();
  Check<8>().tables();
  Check<12>().tables();
}

TEST(BlockKernel, FactorsAreInvertedInTheSameBits) {
  Check<6>().factors();
  Check<8>().factors();
  Check<12>().factors();
}

}  // namespace
}  // namespace muster::simbody
