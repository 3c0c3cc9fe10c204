// Tables that routing plugins write.
#pragma once

namespace muster {

// radio/*/journeys: end-to-end outcomes of a radio's requests: copies asked for (one a receiver) and how they ended;
// the rest are still under way. Where a copy met several outcomes, the last of these columns counts.
struct Journeys {
  static constexpr const char* columns = "asked delivered lost gone queue_full no_route ttl_expired";
  double asked, delivered;
  double lost;         // between two radios
  double gone;         // its origin, target or holder left
  double queue_full;   // of a radio on the route
  double no_route;     // no route known
  double ttl_expired;  // more hops than allowed
};

// radio/*/relaying: packets that a radio gave to its network.
struct Relaying {
  static constexpr const char* columns = "own relayed control";
  double own;      // requests of its own
  double relayed;  // of others
  double control;  // route discovery and upkeep
};

}  // namespace muster
