// --isolate: which instances of a run step in processes of their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/isolation.hpp"

namespace muster::cli {

// Each "INSTANCE" or "INSTANCE=stop|restart|without"; "all" for those that are not named. `limit`: seconds of a step.
// Throws Error.
Isolations isolations_of(const std::vector<std::string>& given, const std::optional<std::string>& limit);

}  // namespace muster::cli
