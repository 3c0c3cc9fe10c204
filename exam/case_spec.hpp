// Specification of each case of an exam, drawn from the exam's seed and the case's number alone.
#pragma once

#include "exam/case.hpp"

namespace muster::exam {

struct Syllabus {
  std::uint64_t seed = 1;
  // Also "three", and "each": one or outside, in turn.
  std::vector<std::string> kinds{"clean", "one", "two", "outside"};
  std::vector<std::string> effects;  // to draw from; empty: all
  std::string walls{};               // a user's own plan, as a table; empty: plans are drawn
  bool corridor = true;              // true if plans have one
  double least_rows = 2000, most_rows = 20000;
  double least_lambda = 12, most_lambda = 400;
};

std::uint64_t seed_of(const Syllabus& syllabus, int number);
// Case 1, 2, ...; throws std::invalid_argument if no effect fits its kind.
Order draw_order(const Syllabus& syllabus, int number);
std::string name_of(int number);

}  // namespace muster::exam
