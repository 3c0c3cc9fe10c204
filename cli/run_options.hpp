// What verbs that run worlds are told alike: the seed, the end, parameters, plugins, and what is to be written where.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verbs.hpp"

namespace muster::cli {

struct RunOptions {
  std::vector<std::string> plugins, record, set;
  std::string out;
  int workers = 1;
  std::optional<std::string> until, seed;
  bool json = false;
  bool may_log = false;  // there is --mcap
  bool has_log = false;  // records go to a log, with or without `out`
};

void declare(CommandLine& line, RunOptions& words);

// The number, or Error that names the option.
double real_of(const std::string& text, const char* option, const char* unit = "");

// The tick of that time of the world's run, or Error that names the option: where it is after the run's end.
uint64_t tick_in_run(const World& world, double seconds, const char* option);

// The world as its file has it, with what the words say instead. Throws Error.
World world_of(const std::string& path, const RunOptions& words);

// The attribute's name is the path; its place is an option, or where a file has it. Throws Error.
void set_parameter(Simulation& run, const XmlAttribute& given);
// Each "PATH=VALUE". Throws Error.
void set_parameters(Simulation& run, const std::vector<std::string>& given);

// An instance of a plugin, its attributes as words "NAME=VALUE"; `who` gave them, for messages. Throws Error.
InstanceDeclaration instance_of(const std::string& name, const std::string& plugin,
                                const std::vector<std::string>& attributes, const std::string& who);

std::string hexadecimal(uint64_t digest);

}  // namespace muster::cli
