// The verbs of muster, and of muster_runs, which has those that run worlds alone.
#include "verbs.hpp"

namespace muster::cli {
namespace {

constexpr Verb all[] = {
    {"run", run_run, "run a world"},
    {"check", run_check, "read a world, load and link its plugins, and say what is wrong"},
    {"swap", run_swap, "run a world and exchange an instance's plugin on the way"},
#ifndef MUSTER_RUNS
    {"compare", run_compare, "run a world with instances exchanged, or several worlds, and say what differs"},
    {"sweep", run_sweep, "run a plan of parameters, plugins, worlds and seeds, and say what came of it"},
    {"bundle", run_bundle, "pack a run with all that it needs, and see whether another machine gets the same digest"},
    {"graph", run_graph, "who reads and writes what, and the order of steps"},
    {"plugins", run_plugins, "the plugins that can be loaded"},
    {"plugin-check", run_plugin_check, "hide a cause in worlds of known truth, and see whether a diagnosis finds it"},
    {"describe", run_describe, "the manual of a plugin or of an element, from its declarations"},
    {"schema", run_schema, "an XML schema of world files for editors, from the declarations"},
    {"fit", run_fit, "fit a world's free parameters to measured data, and say where it misfits"},
    {"diagnose", run_diagnose, "find what a world gets wrong about measured data, name the cause and extend the world"},
    {"exam", run_exam, "make sealed cases for a diagnosis, run it on them and grade what it says", exam_help},
    {"report", run_report, "a recorded run as one page: scene, time and plots, without a network"},
    {"log", cli::run_log, "what an MCAP file of a run holds; recover, cut, or make a table of it"},
    {"map", run_map, "the RSSI of a world's radios over its floor"},
    {"roadmap", run_roadmap, "where a robot can drive on a world's plan, and the shortest way"},
    {"probe", run_probe, "a link's budget, line by line, and why nothing is received"},
    {"features", run_features, "distance, walls and angles of each measured reading"},
    {"import", run_import, "bring a foreign file into the format of measured data"},
    {"new", run_new, "begin a plugin or a world of your own, in a folder outside the tree"},
#endif
};

}  // namespace

std::span<const Verb> verbs() { return all; }

}  // namespace muster::cli
