// The verbs of muster_runs, which is built long before muster and shows a first run.
#include "verbs.hpp"

namespace muster::cli {
namespace {

constexpr Verb all[] = {
    {"run", run_run, "run a world"},
    {"check", run_check, "read a world, load and link its plugins, and say what is wrong"},
    {"swap", run_swap, "run a world and exchange an instance's plugin on the way"},
};

}  // namespace

std::span<const Verb> verbs() { return all; }

}  // namespace muster::cli
