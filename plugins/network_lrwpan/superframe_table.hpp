// What radios of a PAN with beacons know of them, on the blackboard, and what a run tells of it.
#pragma once

#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "medium.hpp"

namespace muster::lrwpan {

class SuperframeTable {
 public:
  explicit SuperframeTable(Setup& s) : table_(s.write<Row>("radio/*/superframe")) {}

  void step(const Step& k, const std::vector<Member>& members, std::size_t coordinator) const {
    for (std::size_t i = 0; i < k[table_].size(); ++i) {
      const Member member = i < members.size() ? members[i] : Member();
      const Row& last = k.last(table_)[i];
      Row& row = k[table_][i];
      row = {member.is_in_step ? 1.0 : 0.0, last.heard + static_cast<double>(member.heard),
             last.lost + static_cast<double>(member.lost), last.silent + static_cast<double>(member.silent),
             last.between_devices + static_cast<double>(member.between_devices)};
      if (member.is_one && i != coordinator) tell(k, i, last, row, std::string(k.name("radio", coordinator)));
    }
  }

 private:
  // in_step: 1 if the radio knows when superframes begin. Counts since the begin of the run: beacons heard, and lost;
  // copies that ended as no_access since no beacon was heard, and as no_link since a device sent them to a device.
  struct Row {
    static constexpr const char* columns = "in_step heard lost silent between_devices";
    double in_step, heard, lost, silent, between_devices;
  };

  void tell(const Step& k, std::size_t radio, const Row& last, const Row& row, const std::string& coordinator) const {
    const std::string name = "radio '" + std::string(k.name("radio", radio)) + '\'';
    const std::string beacons = " of '" + coordinator + '\'';
    const std::string most = std::to_string(most_lost_beacons);
    const bool was_told_silent = last.heard > 0 || last.lost >= most_lost_beacons;
    if (row.in_step > last.in_step && was_told_silent)
      k.event(name + " hears the beacons" + beacons + " and is in step again");
    if (row.in_step < last.in_step)
      k.event(name + " has lost " + most + " beacons" + beacons + " in a row and is silent until it hears one");
    if (row.heard == 0 && last.lost < most_lost_beacons && row.lost >= most_lost_beacons)
      k.warn("self", name + " has heard none of the first " + most + " beacons" + beacons +
                         " and is silent; expected a coordinator within its reach");
    if (row.between_devices > 0 && last.between_devices == 0)
      k.warn("self", name + " sends to another device, to which a star has no link (no_link); expected messages to '" +
                         coordinator + "', a routing that relays, such as routing.aodv, or no beacon_order");
  }

  Out<Row> table_;
};

}  // namespace muster::lrwpan
