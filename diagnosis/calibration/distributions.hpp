// Tails and quantiles of F, Student, chi-square and Poisson distributions, for tests and intervals. Boost's templates
// take seconds to compile: here they do so once.
#pragma once

namespace muster::diagnosis {

// Probability that an F-distributed value with these degrees of freedom exceeds x.
double fisher_tail(double numerator_freedom, double denominator_freedom, double x);
// Probability that a Student-distributed value exceeds x.
double student_tail(double freedom, double x);
// Probability that a chi-square of so much freedom exceeds x >= 0; and the value that it stays below with a
// probability.
double chi_square_tail(double freedom, double x);
double chi_square_quantile(double freedom, double probability);
// Probability that a count of this mean (> 0), distributed after Poisson, is `count` (>= 1) or more.
double poisson_tail(double mean, int count);

}  // namespace muster::diagnosis
