#include "thread_pool.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#ifdef MUSTER_THREAD_SANITIZER
// The sanitizer sees no memory accesses inside oneTBB's library but its calls of memcmp, free and the like: those are
// ignored.
extern "C" const char* __tsan_default_suppressions() { return "called_from_lib:libtbb.so\n"; }
#endif

namespace muster {

struct ThreadPool::Threads {
  explicit Threads(int count)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)), arena(count) {}

  tbb::global_control limit;  // the requested number of threads, even on fewer processors
  tbb::task_arena arena;
};

ThreadPool::ThreadPool(int threads) : threads_(std::make_unique<Threads>(threads)) {}
ThreadPool::~ThreadPool() = default;

void ThreadPool::run(std::size_t count, Call call, void* work) {
  threads_->arena.execute([&] {
    tbb::this_task_arena::isolate([&] {  // a thread that waits for its own parts takes no other work meanwhile
      tbb::parallel_for(
          std::size_t{0}, count, [&](std::size_t i) { call(work, i); }, tbb::simple_partitioner{});
    });
  });
}

}  // namespace muster
