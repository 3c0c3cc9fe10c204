// The threads of a run.
#pragma once

#include <cstddef>
#include <memory>

// oneTBB is not compiled with the thread sanitizer, so the hand-over between its threads is annotated here.
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#define MUSTER_HANDS_OVER(at) __tsan_release(at)
#define MUSTER_TAKES_OVER(at) __tsan_acquire(at)
#else
#define MUSTER_HANDS_OVER(at) static_cast<void>(at)
#define MUSTER_TAKES_OVER(at) static_cast<void>(at)
#endif

namespace muster {

class ThreadPool {
 public:
  explicit ThreadPool(int threads);
  ~ThreadPool();

  // Calls body(i) for every i < count, in any order; returns after all calls. Earlier writes are visible to every body,
  // and those of the bodies to the caller.
  template <class Body>
  void each(std::size_t count, const Body& body) {
    Work<Body> work{body};
    MUSTER_HANDS_OVER(&work.begun);
    run(count, Work<Body>::one, &work);
    MUSTER_TAKES_OVER(&work.done);
  }

 private:
  using Call = void (*)(void* work, std::size_t i);

  template <class Body>
  struct Work {
    const Body& body;
    char begun = 0, done = 0;  // marks for the sanitizer

    static void one(void* of, std::size_t i) {
      auto& work = *static_cast<Work*>(of);
      MUSTER_TAKES_OVER(&work.begun);
      work.body(i);
      MUSTER_HANDS_OVER(&work.done);
    }
  };

  void run(std::size_t count, Call call, void* work);

  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace muster
