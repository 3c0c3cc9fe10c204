// muster exam make|grade|...: the program muster_exam beside this one. It stays a program of its own, so that an error
// of a plugin's formulas cannot hide in the exam. muster exam run is this program's.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "exam_run.hpp"
#include "installation.hpp"
#include "shell_word.hpp"
#include "verbs.hpp"

namespace muster::cli {

std::string exam_program() { return (installation().parts / "muster_exam").string(); }

std::string exam_help() {
  const std::string program = exam_program();
  struct Close {
    void operator()(std::FILE* pipe) const { ::pclose(pipe); }
  };
  const std::unique_ptr<std::FILE, Close> pipe(::popen((shell_word(program) + " --help").c_str(), "r"));
  std::string result;
  char bytes[4096];
  for (std::size_t got; pipe && (got = std::fread(bytes, 1, sizeof bytes, pipe.get())) > 0;) result.append(bytes, got);
  if (result.empty()) throw Error(Exit::io, program + " cannot be started");
  return result;
}

int run_exam(const Arguments& arguments) {
  if (!arguments.empty() && arguments[0] == "run") return run_exam_cases({arguments.begin() + 1, arguments.end()});
  const std::string program = exam_program();
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw Error(Exit::io, program + " cannot be started: " + std::strerror(errno));
}

}  // namespace muster::cli
