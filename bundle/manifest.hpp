// The list of a bundle, bundle.json: its files with their hashes, what was run where, and what came of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "machine.hpp"

namespace muster::bundle {

inline constexpr const char manifest_name[] = "bundle.json";

struct ListedFile {
  std::string name;  // its path in the bundle
  std::uint64_t bytes = 0;
  std::string sha256;
  std::string named;  // as the world's author wrote it, where the bundle's copy says something else; or ""
};

struct ListedPlugin {
  std::string id;    // "radio.multiwall/1"
  std::string file;  // its name in the bundle
};

// The state after so many ticks: the run's digest, and one of each table, as hexadecimal digits.
struct Waymark {
  std::uint64_t tick = 0;
  std::string digest;
  std::map<std::string, std::string> tables;
};

struct Manifest {
  std::string date;    // "2026-11-27T04:17:22Z"
  std::string muster;  // its version
  Machine machine;
  std::string world;  // its file in the bundle
  std::uint64_t seed = 0, ticks = 0;
  double dt = 0;
  std::vector<std::string> set;  // "PATH=VALUE", as --set takes it
  std::vector<ListedPlugin> plugins;
  std::vector<Waymark> waymarks;  // at least the end
  std::vector<ListedFile> files;  // all but the list itself
};

std::string text_of(const Manifest& manifest);
// Throws Error where the file is no list, or says what no list says.
Manifest read_manifest(const std::filesystem::path& file);

// What of a folder is not as the list has it, by name.
struct Faults {
  std::vector<std::string> changed, missing, extra;
  bool any() const { return !changed.empty() || !missing.empty() || !extra.empty(); }
};
Faults faults_of(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace muster::bundle
