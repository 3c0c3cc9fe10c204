// Runs a diagnosis command over all cases of an exam; its output becomes the case's report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muster::exam {

// Placeholders of the command, each substituted as one shell word: {world} the case's folder, {data} its readings,
// {second} its other readings, {out} an output folder. {answer} its answer, for commands that follow a diagnosis'
// advice, not for a diagnosis itself.
struct RunOrder {
  std::filesystem::path exam, reports;
  std::string command;
  int jobs = 1;
};

struct RunOutcome {
  int ran = 0, kept = 0;            // cases run now, and those that already had a report
  std::vector<std::string> failed;  // "case_0001: exit code 65: its first line of error"
};

// `muster diagnose` of the program beside this one.
std::string default_command();

// Cases with a report are skipped, so a stopped run continues. A failing command leaves no report. Appends the cost
// of each case to costs.csv beside the reports. Throws std::runtime_error.
RunOutcome run_cases(const RunOrder& order);

}  // namespace muster::exam
