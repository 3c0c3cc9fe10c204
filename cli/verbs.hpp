// The verbs of the program, one file each. A verb gets the words after its name and returns the exit code; it throws
// Error for everything that ends it early.
#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "kernel/simulation.hpp"
#include "text/error.hpp"

namespace muster::cli {

int run_bundle(const Arguments& arguments);
int run_check(const Arguments& arguments);
int run_compare(const Arguments& arguments);
int run_describe(const Arguments& arguments);
int run_diagnose(const Arguments& arguments);
int run_exam(const Arguments& arguments);
int run_features(const Arguments& arguments);
int run_fit(const Arguments& arguments);
int run_graph(const Arguments& arguments);
int run_import(const Arguments& arguments);
int run_log(const Arguments& arguments);
int run_map(const Arguments& arguments);
int run_new(const Arguments& arguments);
int run_plugin_check(const Arguments& arguments);
int run_plugins(const Arguments& arguments);
int run_probe(const Arguments& arguments);
int run_report(const Arguments& arguments);
int run_roadmap(const Arguments& arguments);
int run_run(const Arguments& arguments);
int run_schema(const Arguments& arguments);
int run_sweep(const Arguments& arguments);
int run_swap(const Arguments& arguments);

// The help of muster_exam, which declares its options by itself. Throws Error where it cannot be started.
std::string exam_help();

struct Verb {
  const char* name;
  int (*run)(const Arguments&);
  const char* summary;
  std::string (*help)() = nullptr;  // of a verb that declares its options elsewhere
};

// Those of this program (verbs.cpp).
std::span<const Verb> verbs();

// ---- What verbs share (common.cpp) ----

// The folders in which plugins are looked for: --plugins, MUSTER_PLUGIN_PATH, and the program's own.
Library::SearchPath plugin_path(const std::vector<std::string>& given = {});

// A line of progress on standard error, on a terminal only; gone when it is destroyed.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  void at(double share);
  // What is being done, where its share of the whole is not known. Where the output is no terminal, a line every 30 s.
  void at(const std::string& now);
  // Notes once, some seconds after the first call, that at this pace the rest takes hours or more.
  void tell_if_endless(double share);

 private:
  std::string what_;
  bool shown_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now(), spoken_ = begun_;
  int last_ = -1;
  unsigned asked_ = 0;
  double first_share_ = -1;
  bool told_ = false;
};

// Throws Error where the world has no radio channel: no link between radios.
void expect_channel(const Simulation& run);

// Set by SIGINT; a run ends whole at the next tick.
bool interrupted();
void watch_interrupt();

// From now on what cannot be written to standard error is lost, and nothing else is.
void keep_standard_error();

}  // namespace muster::cli
