// A client as a program of its own, beside the run.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace muster::test {

class ClientProcess {
 public:
  explicit ClientProcess(const std::vector<std::string>& words) : number_(::fork()) {
    if (number_ != 0) return;
    std::vector<char*> argv;
    for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ClientProcess(const ClientProcess&) = delete;
  ClientProcess& operator=(const ClientProcess&) = delete;
  ~ClientProcess() { exit(); }
  // As a shell gives it.
  int exit() {
    if (number_ > 0) {
      int status = 0;
      ::waitpid(number_, &status, 0);
      code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      number_ = -1;
    }
    return code_;
  }

 private:
  pid_t number_;
  int code_ = -1;
};

}  // namespace muster::test
