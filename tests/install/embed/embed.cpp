// A program of somebody's own that runs a world: embed WORLD PLUGINS.
#include <cstdio>

#include "kernel/simulation.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    muster::Options options;
    options.search_path = {argv[2]};
    muster::Simulation run(muster::read_world(argv[1], muster::standard()), muster::standard(), options);
    for (int tick = 0; tick < 100; ++tick) run.step();
    const muster::TableView pose = run.table("robot/*/pose");
    std::printf("after %g s the first robot is at %g %g\n", run.time(), pose.at(0, 0), pose.at(0, 1));
    return run.tick() == 100 ? 0 : 1;
  } catch (const muster::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
