// muster exam make|run|grade: the program muster_exam beside this one. It stays a program of its own, so that an error
// of a plugin's formulas cannot hide in the exam.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "installation.hpp"
#include "verbs.hpp"

namespace muster::cli {

namespace {

std::string exam_program() { return (installation().parts / "muster_exam").string(); }

// As one word of a shell.
std::string quoted_word(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + '\'';
}

}  // namespace

std::string exam_help() {
  const std::string program = exam_program();
  struct Close {
    void operator()(std::FILE* pipe) const { ::pclose(pipe); }
  };
  const std::unique_ptr<std::FILE, Close> pipe(::popen((quoted_word(program) + " --help").c_str(), "r"));
  std::string result;
  char bytes[4096];
  for (std::size_t got; pipe && (got = std::fread(bytes, 1, sizeof bytes, pipe.get())) > 0;) result.append(bytes, got);
  if (result.empty()) throw Error(Exit::io, program + " cannot be started");
  return result;
}

int run_exam(const Arguments& arguments) {
  const std::string program = exam_program();
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw Error(Exit::io, program + " cannot be started: " + std::strerror(errno));
}

}  // namespace muster::cli
