// Ends the process in its third step: by a null pointer, on the run's thread, on all of its workers or on a thread of
// its own, by an overflow of a worker's stack, or by exit() and its like. Or tells more than anybody reads.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <muster/parallel.hpp>
#include <muster/plugin.hpp>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

using namespace muster;

struct Crash {
  static constexpr auto id = "test.crash/1", summary = "crashes";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      flag("parallel", false, "on the run's threads"),
      choice("how", "segfault|exit|quick_exit|thread|tells|_exit|_Exit|child|overflow", "what it does")};

  explicit Crash(Setup& s) : parallel(s.value("parallel")), how(s.value("how")), cell(s.write<Cell>("self/cell")) {}

  void step(const Step& k) const {
    k[cell]->value = 0;
    if (k.tick() < 3) return;
    if (k[how] == 1) std::exit(0);
    if (k[how] == 2) std::quick_exit(0);
    if (k[how] == 3) std::thread([] { *nowhere = 1; }).join();
    if (k[how] == 4) {
      for (int i = 0; i < 5000; ++i) k.event("line\x1b[31m");
      throw std::runtime_error(std::string(1'000'000, 'e'));
    }
    if (k[how] == 5) ::_exit(0);
    if (k[how] == 6) std::_Exit(0);
    if (k[how] == 7) return wait_for_child();
    if (k[how] == 8) return overflow_worker(k);
    if (k[parallel] == 0) *nowhere = 1;
    each(k, 8, [](std::size_t) { *nowhere = 1; });
  }

  // A process of the plugin's own ends as it likes.
  static void wait_for_child() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(5);
    int status = 0;
    if (::waitpid(child, &status, 0) != child || WEXITSTATUS(status) != 5) throw std::runtime_error("the child's code");
  }

  // The stack of a worker's thread, for which the run's own waits a while.
  static void overflow_worker(const Step& k) {
    const auto run = std::this_thread::get_id();
    each(k, 8, [run](std::size_t) {
      if (std::this_thread::get_id() != run) go_deeper(0);
      for (int i = 0; i < 1'000'000; ++i) std::this_thread::yield();
    });
  }
  static int go_deeper(int depth) {
    volatile char frame[1024];
    frame[0] = static_cast<char>(depth);
    const int below = nowhere ? 0 : go_deeper(depth + 1);
    return below + frame[0];  // looked at afterwards, so that each call keeps its frame
  }

  struct Cell {
    static constexpr const char* columns = "value";
    double value;
  };
  static int* volatile nowhere;
  Value parallel, how;
  Out<Cell> cell;
};

int* volatile Crash::nowhere = nullptr;

}  // namespace

MUSTER_PLUGIN_IS(Crash)
