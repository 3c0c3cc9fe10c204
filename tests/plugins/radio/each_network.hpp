// Every network, identified by its file alone, in a world of six radios: the base of the conformance tests.
#pragma once

#include <algorithm>

#include "world_of.hpp"

namespace muster {

inline const std::string walls_and_fading =
    "<radio.links range=\"600\"/><radio.multiwall n=\"3\"/><radio.fading shadowing=\"2\"/>"
    "<radio.receiver sensitivity=\"-90\"/>";

inline std::vector<std::string> networks(const std::string& but = "") {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(MUSTER_PLUGINS_DIR)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".so" && name.compare(0, 8, "network_") == 0 && name.substr(8) != but)
      result.push_back("network." + name.substr(8));
  }
  return result;
}

class EachNetwork : public testing::TestWithParam<std::string> {
 protected:
  std::string network(const std::string& attributes = "") const {
    return "<" + GetParam() + " name=\"network\" " + attributes + "/>\n";
  }
  bool shares_a_channel() const { return GetParam() != "network.ideal"; }

  // Four radios in a room, one out of reach, one without any link.
  Simulation world(const std::string& senders, int workers = 1, const std::string& dt = "0.1") const {
    return world_of(folder,
                    station("a", "0 0 1") + station("b", "3 0 1") + station("c", "0 4 1") + station("d", "5 5 1") +
                        station("far", "400 0 1") + station("gone", "0 900 1") + walls_and_fading + network() + senders,
                    workers, dt);
  }
  const Folder folder;
};

// Those in which radios contend for the air: all but the ideal one.
class EachSharedChannel : public EachNetwork {};

// A radio's counts by their columns' names.
inline double traffic(const Simulation& sim, const std::string& radio, const std::string& column) {
  const std::vector<std::string> names{"asked",     "delivered",  "too_weak", "no_link", "collided",
                                       "no_access", "queue_full", "no_ack",   "gone"};
  const auto at = std::find(names.begin(), names.end(), column) - names.begin();
  return sim.table("radio/" + radio + "/traffic").at(0, static_cast<std::size_t>(at));
}

inline double sum_of_outcomes(const TableView& traffic, std::size_t row) {
  double sum = 0;
  for (std::size_t c = 1; c < traffic.cols(); ++c) sum += traffic.at(row, c);
  return sum;
}

inline const std::string busy = send("s1", "a") + send("s2", "b", "to=\"c\" count=\"5\" size=\"90\"") +
                                send("s3", "c", "size=\"60\" count=\"3\"") + send("s4", "d", "to=\"a\" size=\"700\"") +
                                send("s5", "b", "to=\"far\"") + send("s6", "b", "to=\"gone\"") +
                                "<test.leaver radio=\"d\" at=\"30\"/>";

// A radio that only jams, from a distance at which it drowns some and not others.
inline const std::string jammed = busy + station("jammer", "60 0 1") +
                                  "<radio.jammer radio=\"jammer\" excess=\"55\" period=\"0.0131\" duty=\"0.4\"/>";

// Two PANs, which some networks support.
inline const std::string apart = busy + "<radio.pan id=\"1\" radios=\"a c far\"/>";

}  // namespace muster
