"""The controller of toys/control_pair.cpp as a client. usage: pair.py CLIENT_FOLDER SOCKET_OR_PORT [LAST_TICK]"""

import os
import sys

sys.path.insert(0, sys.argv[1])
import muster_client

ROBOTS = ("east", "west")
at = sys.argv[2]
last = int(sys.argv[3]) if len(sys.argv) > 3 else None
run = muster_client.connect(port=int(at)) if at.isdigit() else muster_client.connect(path=at)
for tick in run:
    if tick.index == last:
        os.kill(os.getpid(), 9)
    for i, name in enumerate(ROBOTS):
        here = tick[f"robot/{name}/odometry"]
        v, w = 0.3 - 0.05 * here.x, 0.4 - 0.2 * here.yaw
        for message in tick[f"inbox/{name}/message"]:
            v += 0.001 * message.rssi
            w += 0.01 * len(message.payload)
            if message[1] == "base":  # from; a keyword of Python is no name of a column
                w += 1
        tick.set(f"robot/{name}/command", v=v, w=w)
        if tick.index % 5 == i:
            to = None if tick.index % 2 else ROBOTS[1 - i]
            tick.send(f"outbox/{name}/message", to=to, payload=b"tick %d" % tick.index)
print(run.end)
