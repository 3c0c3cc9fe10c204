// A world with every kind of work that a tick does.
#pragma once

#include "toy_world.hpp"

namespace muster {

inline const std::string busy_world =
    two_robots +
    "<robot name='c' at='3 1 0'/>\n<material name='m' loss='2'/>\n"
    "<toy.copy_control name='ask' to='robot/*/command' columns='v[m/s] w[rad/s]' own='true' add='0.1' times='0.9'/>\n"
    "<toy.copy_actuate name='clip' as='modify' to='robot/*/command' columns='v[m/s] w[rad/s]' times='0.7'/>\n"
    "<toy.copy_physics name='move' to='robot/*/pose' columns='x[m] y[m] z[m] qw qx qy qz' own='true' times='1.01' "
    "add='0.3' flags='2' every='3'/>\n"
    "<toy.copy_physics name='rush' to='robot/b/pose' columns='x[m] y[m] z[m] qw qx qy qz' own='true' times='0.99' "
    "add='0.1'/>\n"
    "<toy.plain name='cells'/>\n"
    "<toy.join name='j' at='6' leave='17' like='1'/>\n"
    "<toy.list name='l'/>\n"
    "<toy.copy_radio name='walls' as='add' to='link/*/level' columns='level[dBm]' add='-0.1'/>\n"
    "<toy.copy_radio name='far' as='add' to='link/*/level' columns='level[dBm]' add='-0.2'/>\n"
    "<toy.copy_radio name='near' as='add' to='link/*/level' columns='level[dBm]' add='0.3'/>\n"
    "<toy.copy_radio name='sum' as='add' to='robot/*/sum' own='true' times='1.1' add='0.1'/>\n"
    "<toy.copy_radio name='sum2' as='add' from='robot/*/battery' from_columns='charge' to='robot/*/sum' every='2'/>\n"
    "<toy.send_control name='send' robot='a' to='outbox/{robot}/message' count='2' size='9'/>\n"
    "<toy.send_network name='send2' robot='b' to='outbox/{robot}/message' every='5' size='33'/>\n"
    "<toy.listen_network name='hear' every='2'/>\n"
    "<toy.listen_control name='late' every='3'/>\n"
    "<toy.draw name='draw'/>\n"
    "<toy.copy_sense name='noise' as='modify' to='robot/*/reading' columns='reading[m]' from='robot/*/sum' "
    "from_columns='value'/>\n"
    "<toy.kinds name='kinds' every='2'/>\n"
    "<toy.copy_observe name='own' from='robot/*/reading' from_columns='reading[m]' to='self/state' own='true'/>\n";

}  // namespace muster
