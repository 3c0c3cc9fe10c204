// Simulated time as whole nanoseconds.
#pragma once

#include <cstdint>

namespace muster::medium {

using Time = std::int64_t;  // ns
constexpr Time never = INT64_MAX;

}  // namespace muster::medium
