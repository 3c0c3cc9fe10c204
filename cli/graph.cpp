// muster graph WORLD: claims, phases and batches, as text or for Graphviz.
#include <fmt/core.h>

#include "text/json.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

const char* kind_name(uint32_t kind) {
  static const char* names[] = {"?", "reads", "writes", "adds to", "modifies"};
  return names[kind <= MUSTER_MODIFY ? kind : 0];
}

std::string claimed_name(const Claim& claim) {
  return claim.name.set + (claim.name.set.find('/') == std::string::npos ? '/' + claim.name.row : "") + '/' +
         claim.name.quantity + (claim.name.part.empty() ? "" : '@' + claim.name.part);
}

void print_text(const Simulation& run) {
  uint32_t phase = 0;
  for (const auto& batch : run.batches()) {
    if (batch.phase != phase) fmt::print("{}\n", phase_name(phase = batch.phase));
    fmt::print("  at once:\n");
    for (const Instance* instance : batch.instances) {
      fmt::print("    {} ({}){}\n", instance->name(), instance->plugin().id,
                 instance->every() > 1 ? fmt::format(" every {} ticks", instance->every()) : "");
      for (const auto& claim : instance->claims()) {
        if (claim.file) continue;
        fmt::print("      {:8} {}  \"{}\"{}\n", kind_name(claim.kind), claimed_name(claim), claim.columns.text(),
                   claim.in || claim.out ? "" : "  (nobody writes it)");
      }
    }
  }
}

// Instances are boxes, tables are ellipses.
void print_dot(const Simulation& run) {
  fmt::print("digraph muster {{\n  rankdir=LR;\n  node [fontname=\"Helvetica\"];\n");
  for (const auto& instance : run.instances()) {
    fmt::print("  \"i:{0}\" [shape=box, label=\"{0}\\n{1}\\n{2}\"];\n", instance->name(), instance->plugin().id,
               phase_name(instance->phase()));
    for (const auto& claim : instance->claims()) {
      if (claim.file) continue;
      const std::string table = claim.name.logical();
      fmt::print("  \"t:{0}\" [shape=ellipse, label=\"{0}\"];\n", table);
      if (claim.kind == MUSTER_READ)
        fmt::print("  \"t:{}\" -> \"i:{}\";\n", table, instance->name());
      else
        fmt::print("  \"i:{}\" -> \"t:{}\" [label=\"{}\"];\n", instance->name(), table, kind_name(claim.kind));
    }
  }
  fmt::print("}}\n");
}

void print_json(const Simulation& run) {
  auto out = Json::array();
  for (std::size_t b = 0; b < run.batches().size(); ++b) {
    for (const Instance* instance : run.batches()[b].instances) {
      Json one = {{"instance", instance->name()},
                  {"plugin", instance->plugin().id},
                  {"phase", phase_name(instance->phase())},
                  {"batch", b},
                  {"every", instance->every()},
                  {"claims", Json::array()}};
      for (const auto& claim : instance->claims()) {
        if (!claim.file)
          one["claims"].push_back(
              {{"kind", kind_name(claim.kind)}, {"table", claimed_name(claim)}, {"columns", claim.columns.text()}});
      }
      out.push_back(std::move(one));
    }
  }
  fmt::print("{}\n", out.dump(2));
}

}  // namespace

int run_graph(const Arguments& arguments) {
  CommandLine line(
      "graph",
      "Prints who reads and writes what, and the order of steps.\nExample: muster graph worlds/connectivity --dot | "
      "dot -Tsvg > graph.svg");
  std::string path;
  std::vector<std::string> plugins;
  bool dot = false, json = false;
  line.option("world", path, "the world's folder or file").required();
  line.option("--plugins", plugins, "a folder of plugins, looked in first");
  line.flag("--dot", dot, "as a graph for Graphviz");
  line.flag("--json", json, "as JSON").excludes("--dot");
  line.parse(arguments);
  const Simulation run(read_world(path, standard()), standard(), {plugin_path(plugins), 1, {}});
  if (dot)
    print_dot(run);
  else if (json)
    print_json(run);
  else
    print_text(run);
  return 0;
}

}  // namespace muster::cli
