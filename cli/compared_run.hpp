// One of several runs that are compared: what it is, how far it has come, and why it has stopped.
#pragma once

#include <memory>
#include <optional>

#include "divergence.hpp"
#include "kernel/record.hpp"
#include "run_pictures.hpp"
#include "text/error.hpp"

namespace muster::cli {

struct ComparedRun {
  std::string label;  // "A", "B", ...
  std::string what;   // "as given", or the words that name it
  std::unique_ptr<Simulation> run;
  std::optional<Divergence> divergence{};  // from the first run; that one has none
  std::optional<Error> fault{};            // what ended it early
  std::vector<std::filesystem::path> files{};
  std::map<std::string, std::vector<plotting::Point>> ways{};  // of robots, for pictures
  std::filesystem::path folder{};
  std::unique_ptr<Recorder> recorder{};
  std::unique_ptr<RunPictures> pictures{};

  bool goes_on() const { return !fault && !run->done(); }
  void write_to(const std::filesystem::path& folder);  // records and pictures
  void step();
  void look_at_robots();
  void finish();
};

}  // namespace muster::cli
