#include "restored_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <vector>

#include "text/number.hpp"

namespace muster::cli {
namespace {

// Rows that do not move, by "wall/w1/shape", and numbers of plugins, by "steer/speed".
std::map<std::string, std::vector<double>> stated(const Simulation& run) {
  std::map<std::string, std::vector<double>> result;
  for (const auto& [name, table] : run.board().tables()) {
    const Set& set = table->set();
    if (set.kind != SetKind::fixed || !set.is_named() || set.name.starts_with("instance/")) continue;
    const std::string quantity = name.substr(name.rfind('/'));
    for (std::size_t row = 0; row < set.names.size() && row < table->now().rows; ++row) {
      const double* cells = table->now().data.data() + row * table->width();
      result[set.name + '/' + set.names[row] + quantity].assign(cells, cells + table->width());
    }
  }
  std::set<std::string> instances;
  for (const auto& instance : run.instances()) instances.insert(instance->name());
  for (const ParameterInfo& parameter : run.parameters()) {
    if (instances.count(parameter.path.substr(0, parameter.path.rfind('/'))))
      result[parameter.path] = {parameter.value};
  }
  return result;
}

// The world file itself plans to change it.
bool is_planned(const Simulation& run, const std::string& path) {
  const auto& occasions = run.world().occasions;
  return std::any_of(occasions.begin(), occasions.end(), [&](const Occasion& occasion) {
    return std::any_of(occasion.rows.begin(), occasion.rows.end(),
                       [&](const RowChange& change) { return change.path == path; });
  });
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

void restore(Simulation& run, const std::string& file, bool has_seed) {
  const Snapshot snapshot = Snapshot::load(file);
  const auto now = stated(run);
  try {
    run.restore(snapshot);
  } catch (const Error& refused) {
    throw Error(refused.exit(), "--restore: " + file + ": " + refused.what());
  }
  if (has_seed)
    fmt::print(stderr,
               "muster: note: --seed {} counts from {} s on: what {} holds was drawn from the seed of its own run, and "
               "the fields of the channel are others from then on\n",
               run.world().seed, print_real(run.time()), file);
  std::string changed;
  for (const auto& [path, values] : stated(run)) {
    const auto before = now.find(path);
    if (before != now.end() && !same_bits(before->second, values) && !is_planned(run, path))
      changed += (changed.empty() ? "" : ", ") + path;
  }
  if (!changed.empty())
    fmt::print(stderr,
               "muster: warning: --restore: the run goes on with what {} holds; changed in the world file since, and "
               "not taken: {}\n",
               file, changed);
}

void check_end(const Simulation& run, const std::string& file, bool is_expected) {
  if (run.tick() > run.world().ticks)
    throw Error(Exit::invalid_input, "--restore: " + file + " stands at " + print_real(run.time()) +
                                         " s, after the end of the run at " + print_real(run.world().until()) +
                                         " s; expected --until above " + print_real(run.time()) +
                                         ": it is a time of the world, not a duration");
  if (run.tick() == run.world().ticks && !is_expected)
    fmt::print(
        stderr,
        "muster: note: --restore: {} stands at {} s, the end of the run, so that no tick is run; expected a later "
        "end (--until)\n",
        file, print_real(run.time()));
}

void check_swap(const Simulation& run, const std::string& file, const Occasion& swap) {
  if (swap.tick >= run.tick()) return;
  const PluginChange& change = swap.plugins[0];
  const auto stands = std::find_if(run.instances().begin(), run.instances().end(),
                                   [&](const auto& each) { return each->name() == change.instance; });
  const auto declared = std::find_if(run.world().instances.begin(), run.world().instances.end(),
                                     [&](const auto& each) { return each.name == change.instance; });
  const bool was_swapped = stands != run.instances().end() && declared != run.world().instances.end() &&
                           (*stands)->declared().plugin == change.plugin.plugin &&
                           declared->plugin != change.plugin.plugin;
  if (!was_swapped)
    throw Error(Exit::invalid_input, "--at: " + print_real(static_cast<double>(swap.tick) * run.world().dt) +
                                         " s is before " + print_real(run.time()) + " s, where --restore: " + file +
                                         " stands, so that nothing would be exchanged; expected a time from " +
                                         print_real(run.time()) + " s on");
}

}  // namespace muster::cli
