// Parts of one step on the threads of the run.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::HasSubstr;

class Parts : public ToyWorld {
 protected:
  Simulation of(int workers, const std::string& fault = "none") const {
    std::string robots;
    for (int i = 0; i < 20; ++i) robots += "<robot name='r" + std::to_string(i) + "' at='0 0 0'/>\n";
    return run(robots + "<toy.parts name='p' fault='" + fault + "'/>\n", workers);
  }
  std::string fault(int workers, const std::string& name) const {
    Simulation sim = of(workers, name);
    return error_of([&] { sim.step(); });
  }
};

TEST_F(Parts, AllAreDoneOnceWhateverTheThreads) {
  for (const int workers : {1, 2, 3, 7}) {
    Simulation sim = of(workers);
    for (int tick = 1; tick <= 3; ++tick) {
      sim.step();
      for (std::size_t i = 0; i < 20; ++i) {
        double sum = 0;
        for (std::size_t n = 1; n <= 100 * (i + 1); ++n) sum += std::sqrt(static_cast<double>(n) * tick);
        EXPECT_EQ(cell(sim, "robot/*/sum", 0, i), sum) << workers << " workers, row " << i;
      }
    }
  }
}

TEST_F(Parts, OfSeveralThatFailTheFirstIsNamed) {
  for (const int workers : {1, 2, 7}) EXPECT_THAT(fault(workers, "throws"), HasSubstr("part 2 came off"));
}

TEST_F(Parts, ArithmeticOfEveryThreadStaysAsItWas) {
  for (const int workers : {1, 2, 7}) {
    EXPECT_THAT(fault(workers, "rounds"), HasSubstr("rounds upward for a thread; expected"));
  }
}

}  // namespace
}  // namespace muster
