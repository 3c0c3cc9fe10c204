// What a diagnosis leaves open, and what was looked at and found fine: lists that text, JSON and page share.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

// A measurement that could be made.
struct Measurement {
  std::string say;
  double predicted = 0;  // D with it
  bool advised = false;  // the one of which the readings are written down
};

struct Question {
  std::string cause, alternative;
  std::string pair;                  // "unmapped wall or obstacle", "the column battery or drift"
  double separability = 0;           // D of the data
  std::string tell_apart;            // in the cause's own words
  std::vector<Measurement> plans{};  // the most telling one first
};

// Pairs of a cause, or of what is unexplained, and a rival that the data do not decide, D < 25.
std::vector<Question> open_questions(const Diagnosis& diagnosis);

// "the world, fitted", "+ unmapped wall", of the k-th step of the held-out error.
std::string name_of_step(const Diagnosis& diagnosis, std::size_t k);

}  // namespace muster::report
