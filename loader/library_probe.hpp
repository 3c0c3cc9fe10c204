// Runs risky operations in a child process first. A library's static initialisers, and dlopen() itself on a corrupted
// file, can crash, hang, throw past every handler or call exit(). Nothing in this process could stop them.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>

namespace muster {

// Receives the current operation, in words that end "crashes while ...": "it is opened".
using Progress = std::function<void(const char*)>;

// A child process that tries one thing after another, since a fork costs more than a load. It is forked at the first
// trial, has one thread, shows no output, and is replaced after its end.
class Probe {
 public:
  using Body = std::function<void(const std::string& what, const Progress&)>;
  Probe(Body body, std::chrono::milliseconds limit) : body_(std::move(body)), limit_(limit) {}
  ~Probe() { stop(); }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  // Runs the body on `what` in the child. Returns "" if it returned, the Refusal's words if it threw one, and otherwise
  // the fate of the child. A failure always occurs in a fresh child, so no earlier trial can be its reason.
  std::string try_out(const std::string& what);

 private:
  void start();
  int stop();
  std::string ask(const std::string& what);

  Body body_;
  std::chrono::milliseconds limit_;
  pid_t child_ = 0;
  int line_ = -1;  // to the child, a packet a message
};

}  // namespace muster
