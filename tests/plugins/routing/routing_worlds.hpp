// Common parts of routing tests: radios in a chain, messages along it, and their outcomes.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/plugins/radio/world_of.hpp"

namespace muster {

// Links reach up to 13 m.
inline const std::string channel =
    "<radio.links range=\"600\"/><radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-73.5\"/>";

// Radios r0, r1, ... 10 m apart, of which each has links to its neighbours only.
inline std::string chain(int radios) {
  std::string result;
  for (int i = 0; i < radios; ++i) result += station("r" + std::to_string(i), std::to_string(10 * i) + " 0 1");
  return result;
}

// Routes along that chain, in both directions.
inline std::string chain_routes(int radios) {
  std::string result = "at,to,next\n";
  const auto name = [](int i) { return 'r' + std::to_string(i); };
  for (int at = 0; at < radios; ++at) {
    for (int target = 0; target < at; ++target) result += name(at) + ',' + name(target) + ',' + name(at - 1) + '\n';
    if (at + 1 < radios) result += name(at) + ",," + name(at + 1) + '\n';
  }
  return result;
}

// r5 is far away, and r4 leaves.
inline const std::string six = chain(5) + station("r5", "0 200 1") + "<test.leaver radio=\"r4\" at=\"30\"/>";

// Messages that came in this tick.
inline std::size_t arrived(const Simulation& sim) {
  const Cells& cells = sim.table("inbox/*/message").table->now();
  return static_cast<std::size_t>(std::count(cells.appended.begin(), cells.appended.end(), sim.tick()));
}

inline const std::vector<std::string> outcomes{"delivered", "lost", "gone", "queue_full", "no_route", "ttl_expired"};

inline double journeys(const Simulation& sim, const std::string& radio, const std::string& column) {
  const auto found = std::find(outcomes.begin(), outcomes.end(), column) - outcomes.begin();
  const auto at = column == "asked" ? 0 : static_cast<std::size_t>(found) + 1;
  return sim.table("radio/" + radio + "/journeys").at(0, at);
}

inline double sum_of(const Simulation& sim, const std::string& table, std::size_t column) {
  const TableView view = sim.table(table);
  double sum = 0;
  for (std::size_t r = 0; r < view.rows(); ++r) sum += view.at(r, column);
  return sum;
}

// Of radio/*/relaying.
enum { own = 0, relayed = 1, control = 2 };

class Routings : public testing::Test {
 protected:
  Simulation world(const std::string& network, const std::string& routing, const std::string& elements, int workers = 1,
                   const std::string& dt = "0.1") const {
    const auto space = routing.find(' ');
    return world_of(folder,
                    elements + channel + "<" + network + " name=\"network\"/>\n<" + routing.substr(0, space) +
                        " name=\"routing\"" + (space == std::string::npos ? "" : routing.substr(space)) + "/>\n",
                    workers, dt);
  }
  const Folder folder;
};

}  // namespace muster
