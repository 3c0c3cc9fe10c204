// muster exam make|run|grade: the program muster_exam beside this one. It stays a program of its own, so that an error
// of a plugin's formulas cannot hide in the exam.
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "verbs.hpp"

namespace muster::cli {

int run_exam(const Arguments& arguments) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "muster_exam").string();
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw Error(Exit::io, program + " cannot be started: " + std::strerror(errno));
}

}  // namespace muster::cli
