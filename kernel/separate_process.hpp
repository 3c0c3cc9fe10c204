// A copy of this process that serves calls over shared memory: what happens to it does not happen here.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace muster {

class SeparateProcess {
 public:
  using Serve = std::function<void(std::byte* memory)>;

  // Forks; the copy calls serve() once for each call() and never returns. It has only the thread that forked, and ends
  // with this process. Both see the `bytes` of memory() alike. Throws std::system_error.
  SeparateProcess(std::size_t bytes, const Serve& serve);
  ~SeparateProcess();
  SeparateProcess(const SeparateProcess&) = delete;
  SeparateProcess& operator=(const SeparateProcess&) = delete;

  std::byte* memory() const;
  std::size_t bytes() const { return bytes_; }

  // One call of serve() in the copy; memory() carries its input and its result. Returns "", or how the copy ended:
  // "ended with a segmentation fault (SIGSEGV)"; one that takes longer than the limit is ended. After an end no further
  // call is possible.
  std::string call(std::chrono::milliseconds limit);

 private:
  struct Gate;
  Gate& gate() const;
  [[noreturn]] void serve_for_ever(const Serve& serve, pid_t parent);
  std::string how_it_ended(int status);

  std::size_t bytes_;
  void* mapped_;
  pid_t child_ = 0;
};

}  // namespace muster
