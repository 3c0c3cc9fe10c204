// What is written and nobody reads.
#include <algorithm>
#include <iterator>
#include <set>

#include "claim.hpp"
#include "link.hpp"
#include "text/names.hpp"

namespace muster {

// True where a plugin reads a table of the set, or one that refers to its rows.
bool Linker::is_minded(const std::string& set) const {
  return std::any_of(claimed_.begin(), claimed_.end(), [&](const auto& each) {
    const auto& readers = each.second.readers;
    return std::any_of(readers.begin(), readers.end(), [&](const Claimed::By& by) {
      const auto& columns = by.get().columns;
      return by.get().name.set == set ||
             std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.reference == set; });
    });
  });
}

// True for a quantity that has no effect without a reader: a command, a message, or a property of radios or robots that
// a radio plugin writes and that is all it does. One that also writes or adds to a standard table acts by that.
bool Linker::is_for_others(const Claimed::By& writer) const {
  const Claim& claim = writer.get();
  const bool is_standard = standard_quantity(standard_, claim.name);
  if (writer.instance->phase() <= MUSTER_ACTUATE) return is_standard;
  const Set* set = board_.find_set(claim.name.set);
  if (writer.instance->phase() != MUSTER_RADIO || is_standard || !set || set->kind != SetKind::live) return false;
  const auto& claims = writer.instance->claims();
  return std::none_of(claims.begin(), claims.end(), [this](const Claim& each) {
    return each.kind != MUSTER_READ && standard_quantity(standard_, each.name);
  });
}

namespace {

// ` robot="rover"` of a controller that is to read that row.
std::string of_row(const TableName& name, const std::string& reader) {
  if (!reader.starts_with("control.") || name.row.empty() || name.row == "*") return "";
  return ' ' + name.set + "=\"" + name.row + '"';
}

// Quantities of radios that plugins of networks read, and which do.
struct OfNetworks {
  const char *quantity, *readers;
};
constexpr OfNetworks of_networks[] = {{"emission", "network.wifi, network.lrwpan or network.bluetooth"},
                                      {"pan", "network.lrwpan"}};

// Of what only some networks read: `the network of this world, network.ideal (world.xml:8:3), does not read, so that it
// has no effect; expected network.wifi`; "" for any other quantity, and where there is no network.
std::string of_network(const std::string& quantity, const Instance* network) {
  const auto known = std::find_if(std::begin(of_networks), std::end(of_networks),
                                  [&](const OfNetworks& each) { return quantity == each.quantity; });
  if (known == std::end(of_networks) || !network) return "";
  return "the network of this world, " + network->declared().plugin + " (" + network->place().text() +
         "), does not read, so that it has no effect; expected " + known->readers;
}

// An instance that writes what muster knows as this plugin's: a world has one of the two. Null where there is none.
const Instance* in_place_of(const std::string& plugin, const std::map<std::string, Claimed>& claimed,
                            const Standard& standard) {
  for (const auto& [logical, c] : claimed) {
    const TableName name{logical.substr(0, logical.find('/')), "*", logical.substr(logical.rfind('/') + 1), ""};
    const Quantity* known = standard_quantity(standard, name);
    if (known && plugin == known->provider && !c.writers.empty()) return c.writers[0].instance;
  }
  return nullptr;
}

}  // namespace

// Lists tables written but never read, and fixed rows of the world that no plugin reads.
std::vector<std::string> Linker::unread() const {
  std::vector<std::string> result;
  std::set<std::string> told;
  const auto inbox = claimed_.find("inbox/*/message");
  const Instance* network =
      inbox == claimed_.end() || inbox->second.writers.empty() ? nullptr : inbox->second.writers[0].instance;
  for (const auto& row : world_.rows) {
    const Set* set = board_.find_set(row.set);
    if (set && set->kind == SetKind::fixed && told.insert(row.set).second && !is_minded(row.set))
      result.push_back(row.place.text() + ": nobody reads the world's " + row.set + " rows, which do nothing");
  }
  for (const auto& entry : claimed_) {
    const auto& logical = entry.first;
    const auto& c = entry.second;
    const auto is_record = [&](const auto& record) { return record.table == logical; };
    if (!c.readers.empty() || std::any_of(world_.records.begin(), world_.records.end(), is_record)) continue;
    std::set<const Instance*> silent;  // of several rows that one instance writes, the first is named
    for (const auto& by : c.writers) {
      if (!is_for_others(by) || !silent.insert(by.instance).second) continue;
      const Quantity* standard = standard_quantity(standard_, by.get().name);
      const std::string unheard = standard ? "" : of_network(by.get().name.quantity, network);
      if (const Instance* other = standard ? in_place_of(standard->user, claimed_, standard_) : nullptr;
          other && other->declared().plugin != standard->user) {
        result.push_back(by.instance->title() + ": writes " + quote(by.get().name.text()) + ", which " +
                         other->title() + " does not read, so that it has no effect; expected <" + standard->user +
                         "/> in the place of " + other->declared().plugin + ", or no " +
                         by.instance->declared().plugin);
        continue;
      }
      result.push_back(by.instance->title() + ": writes " + quote(by.get().name.text()) + ", which " +
                       (unheard.empty() ? "nobody reads" : unheard) +
                       (standard && *standard->user ? "; expected <" + std::string(standard->user) +
                                                          of_row(by.get().name, standard->user) + "/> in the world"
                        : unheard.empty()
                            ? "; muster describe " + by.instance->declared().plugin + " says what it is for"
                            : ""));
    }
  }
  tell_unheard(result);
  tell_late(result);
  return result;
}

}  // namespace muster
