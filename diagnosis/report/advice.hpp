// What a diagnosis leaves open, and what was looked at and found fine: lists that text, JSON and page share.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

struct Question {
  std::string cause, rival;
  double separability = 0;                              // D of the data
  std::string tell_apart;                               // in the cause's own words
  std::vector<std::pair<std::string, double>> plans{};  // measurements that could be made, D predicted, best first
};

// Pairs of a cause and a rival that the data do not decide, D < 25.
std::vector<Question> open_questions(const Diagnosis& diagnosis);

// Whether a candidate is among what was found.
bool found(const Diagnosis& diagnosis, const std::string& id);

// "the world, fitted", "+ unmapped wall", of the k-th step of the held-out error.
std::string name_of_step(const Diagnosis& diagnosis, std::size_t k);

}  // namespace muster::report
