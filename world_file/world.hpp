// A world as its file declares it: rows of the standard sets, instances of plugins, swaps, changes and records. Plain
// data: no plugin is loaded, and no reference to a plugin's declarations is resolved yet.
#pragma once

#include <filesystem>
#include <map>
#include <muster/sets.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"
#include "text/xml.hpp"

namespace muster {

// Values for one table's row, in the order in which they are to be stored.
struct StoredValues {
  std::string table;                                           // "wall/shape"
  void (*store)(const double* values, double* row) = nullptr;  // null: values are the whole row
  std::vector<double> values;
  const Attribute* attribute = nullptr;  // null where the values come from a file
};

// One row of a standard set, and of each further set that its element adds to.
struct RowDeclaration {
  std::string set, name;
  std::vector<std::string> sets;  // all sets that get a row of this name
  std::string own_row;            // "set/quantity" whose first column refers to this row
  Place place;
  std::vector<StoredValues> values;
  bool joins_later = false;  // its element stands in an <at>
};

// An element that is a plugin: <radio.multiwall name="radio" every="2" l0="40"/>.
struct InstanceDeclaration {
  std::string plugin;
  std::string name;
  uint64_t every = 1;
  std::optional<std::filesystem::path> library;
  std::optional<uint64_t> revision;
  std::vector<XmlAttribute> attributes;  // without the reserved ones
  Place place;
  bool shares_element = false;  // its attributes are those of the <swap> element
  // Of an instance that no element names: the element that needs it, and that element's name.
  Place needed_at{};
  std::string needed_by{};

  // Null where it is not written.
  const XmlAttribute* attribute(std::string_view wanted) const;
};

// The name of the first instance that is this plugin; "" if there is none.
std::string whose_plugin(const std::vector<InstanceDeclaration>& instances, const std::string& plugin);
// `; control.waypoint is the plugin of "driver"`, where somebody has it.
std::string plugin_hint(const std::string& plugin, const std::string& instance);

// A plugin that is exchanged, inserted or removed while the run goes on.
struct PluginChange {
  enum class Kind { swap, insert, remove };
  Kind kind = Kind::swap;
  std::string instance;
  InstanceDeclaration plugin;  // the new one
  Place place{};
  Place instance_place{};  // of the attribute that names the instance
};

// A number that is set by its path, or rows that join or leave.
struct RowChange {
  enum class Kind { set, join, leave };
  Kind kind = Kind::set;
  std::string path;               // "door/d1/state", "control.goal2d/x"
  XmlAttribute value;             // of that path
  std::string row;                // that joins or leaves
  std::vector<std::string> sets;  // whose row it is
  Place place;
};

// A number of a table held against another: `when="link/base/rover/rssi/rssi below -60"`.
struct Condition {
  enum class Relation { below, above, is };
  std::string text;
  std::string path;  // "robot/leader/pose/x", "robot/*/pose/x" for any of them
  Relation relation = Relation::below;
  double value = 0;
  Place place;
};

// What happens at a tick, or each time that a condition begins to hold. Plugins change first.
struct Occasion {
  uint64_t tick = 0;
  std::optional<Condition> when{};  // instead of the tick
  std::vector<PluginChange> plugins{};
  std::vector<RowChange> rows{};
  Place place{};
  std::string title = "<at>";  // for messages
};

struct RecordDeclaration {
  std::string table;
  uint64_t every = 1;
  Place place;
};

struct Warning {
  Place place;
  std::string message;
};

struct World {
  std::filesystem::path file;
  std::string name;
  double dt = 0.01;
  uint64_t ticks = 0;  // number of a run's ticks
  uint64_t seed = 1;
  std::vector<RowDeclaration> rows;
  std::map<std::string, std::string> texts;  // "robot/leader/model"
  std::vector<InstanceDeclaration> instances;
  std::vector<Occasion> occasions;  // in the order of the file
  std::vector<RecordDeclaration> records;
  std::vector<Warning> warnings;

  double until() const { return static_cast<double>(ticks) * dt; }
  // The same world in which no time passes: all its rows are there, and nothing happens.
  void stand_still();
};

// `path` is the file, or a folder with a world.xml. Throws Error.
World read_world(const std::filesystem::path& path, const Standard& standard);

// The plugin's element as an instance: reserved attributes taken out, the others left for the plugin. Throws Error.
InstanceDeclaration read_instance(const XmlElement& element, const std::string& plugin);

// The whole number of ticks nearest to a time, or an error where that is before the start, less than a tick, or 1e12
// ticks or more.
uint64_t ticks_of(double time, double dt, const Place& place);

// The reserved names in a world: attributes of every plugin's element.
inline const std::vector<std::string> reserved_attributes = {"name", "every", "library", "revision"};
// Attributes that <swap> keeps for itself where the new plugin's attributes are in the same element.
inline const std::vector<std::string> swap_attributes = {"at", "instance", "plugin"};

}  // namespace muster
