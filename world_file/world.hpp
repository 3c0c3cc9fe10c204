// A world as its file declares it: rows of the standard sets, instances of plugins, swaps, changes and records. Plain
// data: no plugin is loaded, and no reference to a plugin's declarations is resolved yet.
#pragma once

#include <filesystem>
#include <map>
#include <muster/sets.hpp>
#include <optional>
#include <string>
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
};

struct SwapDeclaration {
  uint64_t tick = 0;
  std::string instance;
  InstanceDeclaration replacement;
};

// What <at> does at a tick: sets a number by its path, or takes a robot out.
struct ChangeDeclaration {
  uint64_t tick = 0;
  std::string path;    // "door/d1/state", "control.goal2d/x"
  XmlAttribute value;  // of that path
  std::string robot;   // that leaves; empty: a number is set
  Place place;
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
  std::vector<SwapDeclaration> swaps;
  std::vector<ChangeDeclaration> changes;  // in the order of the file; those of one tick come after its swaps
  std::vector<RecordDeclaration> records;
  std::vector<Warning> warnings;

  double until() const { return static_cast<double>(ticks) * dt; }
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
