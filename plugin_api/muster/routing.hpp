// The tables of routers.
#pragma once

namespace muster {

// radio/*/journeys: what became of a radio's requests from end to end: copies asked for (one a receiver) and their
// outcomes; those that are still under way are the rest. Where a copy met several, the last of these columns counts.
struct Journeys {
  static constexpr const char* columns = "asked delivered lost gone queue_full no_route ttl_expired";
  double asked, delivered;
  double lost;         // between two radios
  double gone;         // its origin, its target or who held it left
  double queue_full;   // of a radio on its way
  double no_route;     // nobody knew a way on
  double ttl_expired;  // more hops than allowed
};

// radio/*/relaying: packets that a radio gave to its network.
struct Relaying {
  static constexpr const char* columns = "own relayed control";
  double own;      // requests of its own
  double relayed;  // of others
  double control;  // by which routers find ways
};

}  // namespace muster
