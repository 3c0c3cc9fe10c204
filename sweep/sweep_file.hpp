// The file of a sweep: which worlds, parameters and plugins are varied, under which seeds, and what is measured of each
// run. docs/reference/sweep_file.md is its reference.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "text/error.hpp"

namespace muster::sweep {

struct Word {
  std::string text;
  Place place;
};

// What one <vary> varies.
struct Variation {
  enum class Kind { world, parameter, plugin };
  Kind kind = Kind::parameter;
  std::string path;  // the parameter's, or the instance's name
  std::vector<Word> values;
  Place place;  // of the path, or of the element

  std::string title() const { return kind == Kind::world ? "world" : path; }
};

enum class Over { end, mean, least, most };  // of the values after each tick

struct MetricDeclaration {
  Word of;  // "robot/leader/pose/x", "moved"
  Over over = Over::end;
};

struct SweepFile {
  std::filesystem::path file;
  Word world;  // of combinations where no <vary> has one
  std::optional<Word> until;
  std::vector<std::int64_t> seeds;
  Place seeds_place;
  std::vector<Variation> varied;
  std::vector<MetricDeclaration> metrics;  // none: the usual ones

  std::string name() const { return file.stem().string(); }
  // Every value of a variation meets every value of the others; of two combinations beside each other, the last
  // variations differ.
  std::size_t combinations() const;
  // The value of each variation.
  std::vector<Word> combination(std::size_t number) const;
  // A path of the file, which counts from the file's folder.
  std::filesystem::path beside(const std::string& path) const { return file.parent_path() / path; }
};

// Throws Error.
SweepFile read_sweep(const std::filesystem::path& path);

}  // namespace muster::sweep
