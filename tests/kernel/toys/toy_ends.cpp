// Does one thing in one step, or in create() or destroy(), that ends its process, holds it up, or reaches beyond its
// own.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <muster/plugin.hpp>
#include <string>
#include <thread>

namespace {

using namespace muster;

struct Count {
  static constexpr const char* columns = "count";
  double count;
};
struct Ending {
  static constexpr auto id = "toy.ends/1", summary = "ends its process";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      choice("how", "never|segfault|exit|abort|kill|loop|thread|reaches|umask|handler|folder|behind|before|keeps|limit",
             "what it does"),
      choice("where", "step|create|destroy", "in which callback"),
      integer("tick", 3, 0, 1000, "in the step of this tick"),
      text("once", "", "a file: it does so if it can delete that"),
  };

  explicit Ending(Setup& s)
      : how(static_cast<int>(s.param("how"))),
        where(static_cast<int>(s.param("where"))),
        at(s.value("tick")),
        once(s.text("once")),
        count(s.write<Count>("self/count")),
        pose(s.read<Pose>("robot/*/pose")) {
    if (where == 1) act(nullptr);
  }
  ~Ending() {
    if (where == 2) act(nullptr);
  }

  void step(const Step& k) const {
    k[count]->count = k.last(count)->count + 1;
    if (where != 0) return;
    static double* kept = nullptr;
    if (how == 13 && kept && k.tick() == static_cast<uint64_t>(k[at])) *kept = 1;
    if (how == 13) kept = &k[count][0].count;
    if (k.tick() != static_cast<uint64_t>(k[at])) return;
    if (how == 11) (&k[count][0].count)[1] = 1;
    if (how == 12) (&k[count][0].count)[-1] = 1;
    act(&k[pose][0].x);
  }

  void act(const double* read) const {
    if (!once.empty() && std::remove(once.c_str()) != 0) return;
    switch (how) {
      case 1:
        *nowhere = 1;
        break;
      case 2:
        std::exit(0);
      case 3:
        std::abort();
      case 4:
        ::raise(SIGKILL);
        break;
      case 5:
        while (*&running) continue;
        break;
      case 6:
        std::thread([] { *nowhere = 1; }).join();
        break;
      case 7:
        *const_cast<double*>(read) = 77;  // NOLINT(clang-analyzer-core.NullDereference): in step() it is one
        break;
      case 8:
        ::umask(0777);
        break;
      case 9:
        std::signal(SIGINT, SIG_IGN);
        break;
      case 10:
        if (::chdir("/") != 0) std::abort();
        break;
      case 14:
        limit_memory();
        break;
      default:
        break;
    }
  }

  static void limit_memory() {
    struct rlimit limit {};
    if (::getrlimit(RLIMIT_AS, &limit) != 0) std::abort();
    limit.rlim_cur = std::min({limit.rlim_cur - 4096, limit.rlim_max, rlim_t{1} << 44});
    if (::setrlimit(RLIMIT_AS, &limit) != 0) std::abort();
  }

  static int* volatile nowhere;
  static volatile bool running;
  int how, where;
  Value at;
  std::string once;
  Out<Count> count;
  In<Pose> pose;
};

int* volatile Ending::nowhere = nullptr;
volatile bool Ending::running = true;

}  // namespace

MUSTER_PLUGIN_IS(Ending)
