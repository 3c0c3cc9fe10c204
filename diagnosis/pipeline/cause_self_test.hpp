// Whether a cause can be diagnosed: it is hidden at a known strength in measurements of worlds that are otherwise as
// the world file says, and looked for.
#pragma once

#include <functional>

#include "diagnosis/pipeline/diagnose.hpp"

namespace muster::diagnosis {

struct CauseCheckOptions {
  double lambda = 60;  // whitened energy of what is hidden: twice the expected log-likelihood ratio
  uint64_t seed = 1;
  std::filesystem::path scratch;  // a folder for worlds with something hidden
};

// One world.
struct HiddenCase {
  std::filesystem::path world;
  std::string why_not{};                  // the data cannot speak of the cause: then nothing else is known
  std::string where{};                    // the row or place
  double lambda = 0;                      // as hidden; another one than asked for where the cause has no strength
  double difference = 0;                  // dB, largest, between what the search adds and what the simulator executes
  std::string named{};                    // what was named, the strongest first; "" for nothing
  bool found = false, alone = false;      // as the strongest; and nothing besides
  bool named_on_clean = false;            // where nothing was hidden
  std::map<std::string, double> alike{};  // share of what was hidden that another cause explains at its best
};

struct CauseCheck {
  std::string id;
  std::vector<HiddenCase> cases;

  int tested() const;
  int found() const;
  int false_names() const;
  double difference() const;
  // Mean share by cause, the largest first.
  std::vector<std::pair<std::string, double>> alike() const;
};

// `worlds`: folders with world.xml and measured.csv, in which nothing is hidden. Throws Error.
CauseCheck check_cause(const std::string& id, const std::vector<std::filesystem::path>& worlds,
                       const Library::SearchPath& plugins, const CauseCheckOptions& options,
                       const std::function<void(double share)>& progress);

}  // namespace muster::diagnosis
