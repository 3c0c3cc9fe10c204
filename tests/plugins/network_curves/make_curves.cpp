// Prints curves.csv: every case by ns-3.
#include <cstdio>

#include "cases.hpp"
#include "peers/ns3.hpp"

int main() {
  using namespace muster::peers;
  std::printf("network,kind,radios,x,arrived,no_access,scatter\n");
  for (const Case& c : cases()) {
    const Curve ns3 = mean_of(c, [&](const Task& t) { return c.network == "wifi" ? ns3_wifi(t, 6) : ns3_lr_wpan(t); });
    std::printf("%s,%s,%zu,%g,%.5f,%.5f,%.5f\n", c.network.c_str(), c.kind.c_str(), c.radios, c.x, ns3.arrived,
                ns3.no_access, ns3.scatter);
    std::fflush(stdout);
  }
}
