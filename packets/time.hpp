// Simulated time as whole nanoseconds.
#pragma once

#include <cstdint>

namespace muster::packets {

using Time = std::int64_t;  // ns
constexpr Time never = INT64_MAX;

}  // namespace muster::packets
