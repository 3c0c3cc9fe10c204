// muster exam run DIR: a diagnosis of each case. A case is a job of a sweep's table: several commands share them, one
// that was killed is taken up again, and none is done twice.
#include "exam_run.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "installation.hpp"
#include "shell_word.hpp"
#include "sweep/job_table.hpp"
#include "sweep_sources.hpp"
#include "sweep_workers.hpp"
#include "text/names.hpp"
#include "text/whole_file.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

const std::string command_source = "command";  // no case is called so

struct ExamRunWords {
  std::string exam, reports, command;
  int jobs = 1;
};

// In one pass, so that a slot's name in a value is no slot: a folder may be called anything.
std::string filled(const std::string& command, const std::map<std::string, fs::path>& values) {
  std::string result;
  for (std::size_t at = 0; at < command.size();) {
    const auto slot = std::find_if(values.begin(), values.end(), [&](const auto& each) {
      return command.compare(at, each.first.size(), each.first) == 0;
    });
    result += slot == values.end() ? command.substr(at, 1) : shell_word(slot->second.string());
    at += slot == values.end() ? 1 : slot->first.size();
  }
  return result;
}

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// The names of the cases, each with a digest of its files.
sweep::Sources cases_in(const fs::path& exam) {
  if (!fs::is_directory(exam))
    throw Error(Exit::invalid_input,
                exam.string() + ": there is no such folder; expected one that muster exam make wrote");
  sweep::Sources result;
  for (const auto& entry : fs::directory_iterator(exam)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || !name.starts_with("case_")) continue;
    sweep::Sources files;
    for (const auto& file : fs::directory_iterator(entry.path()))
      if (file.is_regular_file()) files[file.path().filename().string()] = digest_of(file.path());
    std::string& digest = result[name];
    for (const auto& [file, of_file] : files) digest += of_file;
  }
  if (result.empty())
    throw Error(Exit::invalid_input,
                exam.string() + ": has no folder case_...; expected one that muster exam make wrote");
  return result;
}

// A program that runs in a group of its own.
class Child {
 public:
  // It does not outlive the process that made it, which has no other threads.
  explicit Child(const std::vector<std::string>& words, const fs::path& out = {}, const fs::path& err = {}) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::fflush(nullptr);
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ < 0) throw Error(Exit::io, words[0] + " cannot be started: " + std::strerror(errno));
    if (process_ > 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid(0, 0);
    const bool is_ready = ::getppid() == parent && leads_to(STDOUT_FILENO, out) && leads_to(STDERR_FILENO, err);
    if (is_ready) ::execv(arguments[0], arguments.data());
    std::perror(arguments[0]);
    ::_exit(127);
  }

  // Its exit code, or 128 and the signal that ended it. An interrupt ends it, too.
  int wait(rusage& used) const {
    for (bool told = false;;) {
      int status = 0;
      const pid_t ended = ::wait4(process_, &status, WNOHANG, &used);
      if (ended == process_) return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      if (ended < 0 && errno != EINTR)
        throw Error(Exit::io, std::string("cannot wait for a command: ") + std::strerror(errno));
      if (interrupted() && !told) {
        ::kill(-process_, SIGTERM);
        told = true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

 private:
  static bool leads_to(int stream, const fs::path& file) {
    if (file.empty()) return true;
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    return opened >= 0 && ::dup2(opened, stream) == stream;
  }

  pid_t process_ = 0;
};

// The files of the reports.
class Reports {
 public:
  explicit Reports(fs::path folder) : folder_(std::move(folder)) {}
  const fs::path& folder() const { return folder_; }
  fs::path report(const std::string& name) const { return folder_ / (name + ".txt"); }
  fs::path errors(const std::string& name) const { return folder_ / (name + ".err"); }
  // Of this process alone: what a killed one left may still be written to.
  fs::path part(const std::string& name) const { return folder_ / fmt::format("{}.part{}", name, ::getpid()); }
  bool has(const std::string& name) const { return fs::exists(report(name)); }

 private:
  fs::path folder_;
};

class ExamRun {
 public:
  explicit ExamRun(const ExamRunWords& words) : words_(words), exam_(words.exam), reports_(words.reports) {}

  Exit run() {
    watch_interrupt();
    const sweep::Sources cases = cases_in(exam_);
    const std::set<std::string> kept = prepare(cases);
    const Exit worked =
        work_on_table(reports_.folder(), {}, words_.jobs, "muster exam run", "cases", [&] { return work(); });
    sweep::JobTable table(reports_.folder());
    std::vector<sweep::DoneJob> done;
    table.exclusively([&] {  // two commands may end at once
      done = table.done();
      write_costs(done);
    });
    std::erase_if(done, [&](const sweep::DoneJob& job) { return !cases.count(job.label); });  // a case that is gone
    const auto ran = std::count_if(done.begin(), done.end(), [&](const auto& job) { return !kept.count(job.label); });
    const auto failed = std::count_if(done.begin(), done.end(), [](const auto& job) { return !job.fault.empty(); });
    fmt::print("{} run, {} had a report, {} failed\n", counted(static_cast<std::size_t>(ran)), kept.size(), failed);
    for (const sweep::DoneJob& job : done)
      if (!job.fault.empty()) fmt::print("{}: {}\n", job.label, job.fault);
    tell_rest(table, cases.size(), done.size());
    if (interrupted()) return Exit::interrupted;
    if (worked != Exit::done) return worked;
    return failed > 0 || done.size() < cases.size() ? Exit::check_failed : Exit::done;
  }

 private:
  static std::string counted(std::size_t cases) { return fmt::format("{} case{}", cases, cases == 1 ? "" : "s"); }

  static void tell_rest(sweep::JobTable& table, std::size_t all, std::size_t done) {
    if (done == all) return;
    if (interrupted() || !table.left().empty())
      fmt::print(stderr, "muster: note: {} of {} are done; the same command goes on with the others\n", done,
                 counted(all));
    else
      fmt::print(stderr, "muster: note: what is left is run by another command: {}\n", counted(all - done));
  }

  // Makes a job of each case; those that failed or whose report is gone are to be done again. Which have a report.
  std::set<std::string> prepare(const sweep::Sources& cases) const {
    sweep::JobTable table(reports_.folder());
    if (!table.is_filled())
      table.fill({{command_source, words_.command}}, {{"cpu", "s"}, {"memory", "MB"}, {"code", ""}}, 0, {});
    const sweep::Sources before = table.sources();
    const auto command = before.find(command_source);
    if (command == before.end())
      throw Error(Exit::invalid_input, reports_.folder().string() +
                                           ": has the table of a sweep; expected another folder for the reports "
                                           "(--reports)");
    std::set<std::string> kept;
    sweep::Sources anew;  // of what no report has been made of
    for (const auto& [name, digest] : cases) {
      if (!reports_.has(name)) {
        anew[name] = digest;
        continue;
      }
      kept.insert(name);
      const auto known = before.find(name);
      if (known != before.end() && known->second != digest)
        throw Error(Exit::invalid_input,
                    fmt::format("{}: is not what it was when {} was made of it; expected another folder for the "
                                "reports (--reports)",
                                (exam_ / name).string(), reports_.report(name).string()));
    }
    if (kept.empty())
      anew[command_source] = words_.command;
    else if (command->second != words_.command)
      fmt::print(stderr, "muster: note: {}: reports of another command are there: {}\n", reports_.folder().string(),
                 command->second);
    table.renew(anew);
    table.add(cases);
    table.reopen_if([&](const sweep::Job& job) { return cases.count(job.label) && !reports_.has(job.label); });
    return kept;
  }

  Exit work() const {
    sweep::JobTable table(reports_.folder());
    while (!interrupted()) {
      const auto job = table.claim({});
      if (!job) return Exit::done;
      const auto result = reports_.has(job->label) ? sweep::RunResult{} : outcome_of(job->label);
      result ? table.record(*job, *result) : table.release(*job);
    }
    return Exit::interrupted;
  }

  // None where it was interrupted.
  std::optional<sweep::RunResult> outcome_of(const std::string& name) const {
    const fs::path part = reports_.part(name), errors = reports_.errors(name);
    const std::string command = filled(words_.command, {{"{world}", exam_ / name},
                                                        {"{data}", exam_ / name / "measured.csv"},
                                                        {"{second}", exam_ / name / "second.csv"},
                                                        {"{answer}", exam_ / "answers" / (name + ".json")},
                                                        {"{out}", reports_.folder() / name}});
    rusage used{};
    const int code = Child({"/bin/sh", "-c", command}, part, errors).wait(used);
    if (interrupted()) {
      fs::remove(part);
      return {};
    }
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    sweep::RunResult result;
    result.values = {seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024,
                     static_cast<double>(code)};
    if (code == 0) {
      fs::rename(part, reports_.report(name));  // before the job is done: a job that is done has its report
      if (fs::is_empty(errors)) fs::remove(errors);
    } else {
      fs::remove(part);
      result.fault = fmt::format("exit code {}: {}", code, first_line(errors));
    }
    return result;
  }

  void write_costs(const std::vector<sweep::DoneJob>& done) const {
    std::string text = "case,cpu[s],memory[MB],code\n";
    for (const sweep::DoneJob& job : done) {
      if (std::isnan(job.values[0])) continue;  // its report was there before the table
      text += fmt::format("{},{:.2f},{:.0f},{:.0f}\n", job.label, job.values[0], job.values[1], job.values[2]);
    }
    write_whole(reports_.folder() / "costs.csv", text);
  }

  const ExamRunWords& words_;
  fs::path exam_;
  Reports reports_;
};

}  // namespace

int run_exam_cases(const Arguments& arguments) {
  ExamRunWords words;
  std::vector<std::string> rows;
  std::map<std::string, std::string> of_generator;
  CommandLine line("exam run",
                   "Runs a diagnosis over the cases of an exam. What it prints becomes DIR/reports/case_0001.txt ..., "
                   "what it\n"
                   "cost DIR/reports/costs.csv. Cases that have a report are left alone; several commands may share an "
                   "exam.\n"
                   "Example: muster exam run exam --jobs 2");
  line.option("exam", words.exam, "folder of the cases, as muster exam make wrote it").required();
  line.option("--reports", words.reports, "folder of the reports; without it reports/ in that of the cases");
  line.option("--command", words.command,
              "what is run, by a shell, for each case; without it muster diagnose {world} --data {data} --json. Other "
              "slots: {second}, {answer}, {out}");
  line.option("--jobs", words.jobs, "cases at a time").within(1, 256);
  line.option("--generator", of_generator["--generator"], "make the cases first, but for those that are there");
  for (const char* name :
       {"--seed", "--cases", "--first", "--mix", "--lambda", "--size", "--effects", "--walls", "--style"}) {
    line.option(name, of_generator[name], "as muster exam make takes it");
    line.only_with(name, "--generator");
  }
  line.option("--rows", rows, "as muster exam make takes it").takes(2);
  line.only_with("--rows", "--generator");
  line.parse(arguments);
  if (words.reports.empty()) words.reports = (fs::path(words.exam) / "reports").string();
  if (words.command.empty())
    words.command = shell_word(fs::read_symlink("/proc/self/exe").string()) + " diagnose {world} --data {data} --json";
  if (!of_generator["--generator"].empty()) {
    std::vector<std::string> make{exam_program(), "make", "--keep", "--out", words.exam};
    for (const auto& [option, value] : of_generator)
      if (!value.empty()) make.insert(make.end(), {option, value});
    if (!rows.empty()) make.insert(make.end(), {"--rows", rows[0], rows[1]});
    rusage used{};
    if (const int code = Child(make).wait(used); code != 0) return code;
  }
  return static_cast<int>(ExamRun(words).run());
}

}  // namespace muster::cli
