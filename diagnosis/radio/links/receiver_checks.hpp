// What readings show of the receiver that took them, before any model is asked: its step, where it clips, and that
// its record is sound.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/data/dataset.hpp"

namespace muster::diagnosis {

// Readings that pile up at the highest or lowest code: what lay beyond it is there too.
struct Clip {
  double level = 0;                   // dBm
  std::size_t count = 0, beside = 0;  // readings there, and at the next code inside
  double log_p = 0;                   // that a law as high at the next code does it
  std::size_t row = 0;                // of the table, from 0: the first one there
};

struct ReceiverCheck {
  std::string what, found;  // "readings at the highest code", "12 at -40 dBm"
  bool fine = true;
  std::optional<std::size_t> row{};  // of the table, from 1
};

struct ReceiverChecks {
  double step = 0;  // dB between codes; 0 where readings have none
  std::optional<Clip> top{}, bottom{};
  std::vector<ReceiverCheck> checks{};
};

// Of data that check_readings() has let pass: what it refuses is listed as looked for and not found.
ReceiverChecks receiver_checks(const Dataset& data);

}  // namespace muster::diagnosis
