// A diagnosis command over all cases of an exam: what it prints becomes the case's report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muster::exam {

// {world} the case's folder, {data} its readings, {second} its other readings, {answer} its answer, for what follows a
// diagnosis' advice and no diagnosis itself, {out} a folder of the command's own;
// each is put in as one word of the shell.
struct RunOrder {
  std::filesystem::path exam, reports;
  std::string command;
  int jobs = 1;
};

struct RunOutcome {
  int ran = 0, kept = 0;            // cases of this run, and those that had a report before
  std::vector<std::string> failed;  // "case_0001: exit code 65: its first line of error"
};

// muster diagnose, of the program beside this one.
std::string default_command();

// Cases that have a report are left alone, so that a run goes on where it was stopped. A command that fails leaves no
// report. Appends the cost of each case to costs.csv beside the reports. Throws std::runtime_error.
RunOutcome run_cases(const RunOrder& order);

}  // namespace muster::exam
