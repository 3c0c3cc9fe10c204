// Checks the receiver by its readings, without a model: quantisation step, clipping, and soundness of the record.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/data/dataset.hpp"

namespace muster::diagnosis {

// Readings piled up at the highest or lowest code, to which levels beyond it are clipped.
struct Clip {
  double level = 0;                   // dBm
  std::size_t count = 0, beside = 0;  // moments with it, and with the next code inside
  double log_p = 0;                   // of such a pile from an unclipped receiver
  std::size_t row = 0;                // of the table, from 0: the first one there
};

struct ReceiverCheck {
  std::string what, found;  // "readings at the highest code", "12 at -40 dBm"
  bool fine = true;
  std::optional<std::size_t> row{};  // of the table, from 1
};

struct ReceiverChecks {
  double step = 0;  // dB between codes; 0 if there is none
  std::optional<Clip> top{}, bottom{};
  std::vector<ReceiverCheck> checks{};
};

// `data`: accepted by check_readings(), whose checks are listed as passed.
ReceiverChecks receiver_checks(const Dataset& data);

// Greatest extent, m, of the places that one radio has in readings at this level: infinite without places.
double extent_at_level(const Dataset& data, double level);
// Pairs of radios with readings at this level.
std::size_t links_at_level(const Dataset& data, double level);

}  // namespace muster::diagnosis
