// Blind exams: 20 cases of the exam, and 20 draws of the simulator itself, that nobody has seen, since their seed is
// the commit's hash. Chance alone fails them once in a thousand commits a measure, as long as the tool keeps to the
// rates below.
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cstdio>

#include "tests/hidden/examined.hpp"

namespace muster::exam {
namespace {

// The first 64 bits of the commit's hash; 1 where there is no repository.
std::uint64_t seed_of_commit() {
  FILE* pipe = popen("git -C '" MUSTER_SOURCE_DIR "' rev-parse HEAD 2>/dev/null", "r");
  std::array<char, 16> digits{};
  const std::size_t n = fread(digits.data(), 1, digits.size(), pipe);
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + n, seed, 16);
  return pclose(pipe) == 0 && n == digits.size() && error == std::errc{} ? seed : 1;
}

struct Measure {
  const char* share;
  double goal;   // as in docs/exam_table.md
  double holds;  // what the tool is held to today: the goal, or the worse end of the measured rate's 95 % interval
  bool at_least;
};

// Rates at lambda 60, of clean worlds as they come: docs/exam_table.md. Pairs, both of them: what two single ones would
// make at the least.
constexpr std::array<Measure, 7> of_exam{{
    {"clean / false name / all", 0.007, 0.007, false},
    {"clean / false unexplained / all", 0.007, 0.007, false},
    {"one / top name right / lambda >= 50", 0.99, 0.762, true},
    {"one / wrong extra name / all", 0.01, 0.029, false},
    {"two / found / lambda >= 50", 0.97, 0.5, true},
    {"outside / right covariate / lambda >= 50", 0.97, 0.792, true},
    {"outside / false name / all", 0.02, 0.109, false},
}};

// Clean worlds that the simulator draws under all its laws of fading, one way and both: no false name in 40 of two
// seeds.
constexpr std::array<Measure, 2> of_own_draws{{
    {"clean / false name / all", 0.01, 0.088, false},
    {"clean / false unexplained / all", 0.01, 0.05, false},
}};

template <std::size_t number>
void expect_rates(const std::string& cases, const std::array<Measure, number>& measures, std::size_t most_absent) {
  const std::uint64_t seed = seed_of_commit();
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  const Grades grades = examined("--seed " + std::to_string(seed) + cases);
  std::printf("%s", as_text(grades).c_str());
  EXPECT_TRUE(grades.missing.empty()) << grades.missing.size() << " cases without a report";
  std::size_t absent = 0;
  for (const Measure& m : measures) {
    const auto at = grades.shares.find(m.share);
    if (at == grades.shares.end()) {  // no such case was drawn
      std::printf("absent: %s\n", m.share);
      ++absent;
      continue;
    }
    const Share& s = at->second;
    if (m.at_least)
      EXPECT_GE(s.hits, least_hits(s.of, m.holds)) << m.share << ": " << s.hits << " of " << s.of;
    else
      EXPECT_LE(s.hits, s.of - least_hits(s.of, 1 - m.holds)) << m.share << ": " << s.hits << " of " << s.of;
  }
  EXPECT_LE(absent, most_absent) << "of the shares of " << cases;
}

TEST(Blind, Exam) { expect_rates(" --cases 20 --lambda 60 --rows 2000 2500", of_exam, of_exam.size() - 1); }

TEST(Blind, OwnDraws) { expect_rates(" --cases 20 --generator run --mix clean", of_own_draws, 0); }

}  // namespace
}  // namespace muster::exam
