// Self-test of a cause by fault injection: hides it at a known strength in readings of sound worlds, and diagnoses
// these.
#pragma once

#include <functional>

#include "diagnosis/pipeline/diagnose.hpp"

namespace muster::diagnosis {

struct SelfTestOptions {
  double lambda = 60;  // whitened energy of the hidden effect: twice the expected log-likelihood ratio
  uint64_t seed = 1;
  std::filesystem::path scratch;  // folder for worlds with hidden effects
};

// Result of one world.
struct HiddenCase {
  std::filesystem::path world;
  std::string why_not{};                  // reason why the cause is not testable here; all else is then unset
  std::string where{};                    // row or place
  double lambda = 0;                      // of the hidden effect; not the requested one if the cause has no strength
  double difference = 0;                  // dB, largest between the search's column and the simulated effect
  std::string named{};                    // named causes, the strongest first; may be empty
  bool found = false, alone = false;      // named as the strongest cause; and as the only one
  bool named_on_clean = false;            // named on readings without a hidden effect
  std::map<std::string, double> alike{};  // by cause: share of the hidden effect that it explains at its best
};

struct CauseSelfTest {
  std::string id;
  std::vector<HiddenCase> cases;

  int tested() const;
  int found() const;
  int false_names() const;
  double difference() const;
  // Mean share by cause, the largest first.
  std::vector<std::pair<std::string, double>> alike() const;
};

// `id`: of a cause that shifts levels. `worlds`: folders with world.xml and measured.csv, without hidden effects.
// Throws Error.
CauseSelfTest self_test_cause(const std::string& id, const std::vector<std::filesystem::path>& worlds,
                              const Library::SearchPath& plugins, const SelfTestOptions& options,
                              const std::function<void(double share)>& progress);

}  // namespace muster::diagnosis
