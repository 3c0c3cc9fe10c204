// ns-3 3.37 on a task.
#pragma once

#include "peers/task.hpp"

namespace muster::peers {

// Channel 11 of 802.15.4 at 0 dBm, short addresses, as its module stands.
Counts ns3_lr_wpan(const Task& task);
// The same in superframes of this order, without inactive part: the first radio is the coordinator, and from second 1
// on all others always have a frame for it, which it does not acknowledge. The task's requests do not matter.
Counts ns3_star(const Task& task, int order);
// 802.11g ad hoc at 16.0206 dBm, all at one rate in Mbit/s; the queue drops nothing.
Counts ns3_wifi(const Task& task, unsigned mbit);

}  // namespace muster::peers
