// Cost of 20,000 readings and a thousand atoms, by step, in CPU seconds of one core.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>

#include "diagnosis/inference/assess/search.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

class Clock {
 public:
  // CPU seconds of this process since the last call.
  double lap() {
    const std::clock_t now = std::clock();
    const double seconds = static_cast<double>(now - last_) / CLOCKS_PER_SEC;
    last_ = now;
    return seconds;
  }

 private:
  std::clock_t last_ = std::clock();
};

TEST(Cost, TwentyThousandReadingsAndAThousandAtomsAreSearchedInTwoSeconds) {
  const auto world = synthetic::world_of(synthetic::varied(51, 20000));
  auto causes = synthetic::causes_of(world);
  Candidate& wall = causes[9];  // robots that drive this long leave few places free: here they may drive through walls
  wall.refinement.admitted = {};
  wall.design.grid.clear();
  for (uint64_t k = 0; k < 1000; ++k) {
    const Stream s(combined(key_of("wall"), k));
    wall.design.grid.push_back(
        Eigen::Vector4d(24 * s.uniform(0), 16 * s.uniform(1), 2 + 3 * s.uniform(2), 3 * s.uniform(3)));
  }
  const Eigen::VectorXd effect = synthetic::scaled_to(world, causes[0].design.columns(causes[0].design.grid[0]), 150) -
                                 synthetic::scaled_to(world, causes[9].design.columns(causes[9].design.grid[90]), 200);
  const Problem problem = synthetic::problem_of(world, effect, causes);
  Clock clock;
  const noise::Rows rows = problem.layout->rows();
  const noise::Field field(problem.layout->sites(rows));
  std::printf("rows and neighbours   %7.3f s  %ld rows\n", clock.lap(), static_cast<long>(rows.size()));
  const Eigen::VectorXd y = rows.mean(problem.measured);
  const Eigen::MatrixXd base = rows.mean(problem.base);
  const noise::Covariance start = noise::default_start(y, base, noise::Family::exponential);
  clock.lap();
  const noise::Whitener whitener(field, start);
  std::printf("one factorisation     %7.3f s\n", clock.lap());
  noise::objective(field, start, y, base, {});
  std::printf("one scoring step      %7.3f s\n", clock.lap());
  noise::fit_families(field, y, base, {});
  std::printf("five families         %7.3f s\n", clock.lap());
  Search search(problem);
  std::printf("model state           %7.3f s\n", clock.lap());
  Index atoms = 0;
  for (const Entry& entry : search.state().entries()) atoms += entry.atoms->cols();
  noise::Sheet sheet(rows.size(), 1000);
  for (Index j = 0; j < 1000; ++j) sheet.col(j).setConstant(static_cast<float>(j));
  clock.lap();
  whitener.sheet(sheet);
  const double whitening = clock.lap();
  std::printf("1,000 columns whitened%7.3f s\n", whitening);
  const Result result = search.run();
  const double seconds = clock.lap();
  std::printf("search                %7.3f s  %ld columns in the grids\n", seconds, static_cast<long>(atoms));
  for (const Finding& f : result.findings) std::printf("  %s gain %.1f\n", f.id.c_str(), f.gain);
  EXPECT_LT(whitening, 1);
  EXPECT_GE(result.findings.size(), 2u);
}

}  // namespace
}  // namespace muster::inference
