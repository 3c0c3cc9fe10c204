// A name that the data leave open is settled by the measurement that the diagnosis advises: the exam makes it, at the
// places and times of advised.csv.
#include <gtest/gtest.h>

#include "tests/hidden/examined.hpp"

namespace muster::exam {
namespace {

TEST(Advised, AStepThatMayBeADriftIsSettledByWhatIsMeasuredNext) {
  const Grades g = examined("--seed 72 --first 43 --cases 1 --mix one --lambda 60 --rows 2000 5000 --effects step",
                            "muster diagnose {world} --data {data} --out {out} --json && "
                            "muster exam follow {answer} --plan {out}/advised.csv --out {out}.advised.csv && "
                            "muster diagnose {world} --data {out}.advised.csv --json >{out}.advised.json");
  ASSERT_TRUE(g.missing.empty());
  EXPECT_EQ(g.shares.at("advice / settles the name / all").hits, 1);
}

}  // namespace
}  // namespace muster::exam
