// Open questions of a diagnosis, for text, JSON and page.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

// A possible measurement.
struct Measurement {
  std::string say;
  double predicted = 0;  // expected D with it
  bool advised = false;  // the one whose planned readings are written
};

struct Question {
  std::string cause, alternative;
  std::string pair;                  // "unmapped wall or obstacle", "the column battery or drift"
  double separability = 0;           // D with the present data
  std::string tell_apart;            // from the cause's manual
  std::vector<Measurement> plans{};  // the largest D first
};

// Undecided pairs (D < 25) of a cause, or of an unexplained effect, and an alternative.
std::vector<Question> open_questions(const Diagnosis& diagnosis);

// Name of the k-th step of the held-out error: "the world, fitted", "+ unmapped wall".
std::string name_of_step(const Diagnosis& diagnosis, std::size_t k);

}  // namespace muster::report
