// Faults of maps and logs, in ten random cases each: how many are named by their cause, alone, and with the right rows
// and choices.
#include <gtest/gtest.h>

#include <cstdio>

#include "diagnosis/pipeline/diagnose.hpp"
#include "tests/diagnosis/pipeline/damaged_log.hpp"

namespace muster::diagnosis {
namespace {

const Library::SearchPath plugins = {MUSTER_PLUGINS_DIR};
constexpr unsigned first_case = 21, cases = 10;

struct Share {
  Fault fault;
  int least;  // of ten cases
};

void PrintTo(const Share& share, std::ostream* out) { *out << word_of(share.fault); }

class OwnWorldShare : public testing::TestWithParam<Share> {};

TEST_P(OwnWorldShare, OfTenRandomCases) {
  int right = 0;
  for (unsigned seed = first_case; seed < first_case + cases; ++seed) {
    const Scratch scratch;
    const DamagedLog log = damaged_log(scratch, GetParam().fault, seed);
    const std::string told = names_in_words(named_causes(diagnose(log.world, log.table, plugins)));
    right += told == log.truth;
    if (told != log.truth)
      std::printf("%s %u: %s instead of %s\n", word_of(GetParam().fault), seed, told.c_str(), log.truth.c_str());
  }
  RecordProperty("right", right);
  std::printf("%s: %d of %d right\n", word_of(GetParam().fault), right, static_cast<int>(cases));
  EXPECT_GE(right, GetParam().least);
}

INSTANTIATE_TEST_SUITE_P(Faults, OwnWorldShare,
                         testing::Values(Share{Fault::none, 10}, Share{Fault::swapped, 9}, Share{Fault::shifted, 9},
                                         Share{Fault::mirrored, 9}, Share{Fault::turned, 9},
                                         Share{Fault::names_late, 9}, Share{Fault::places_late, 9},
                                         Share{Fault::moved, 9}, Share{Fault::misplaced, 2}));

}  // namespace
}  // namespace muster::diagnosis
