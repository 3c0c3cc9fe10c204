#include "callback_watch.hpp"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>
#include <utility>

#include "text/number.hpp"

namespace muster {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds patience{10'000};  // of the first note
constexpr milliseconds slowest{60'000};   // between later ones
constexpr milliseconds between{1'000};    // of two looks

// What a thread is in. `entered` is odd while the rest changes, and another number for each callback.
struct Slot {
  std::atomic<uint64_t> entered{0};
  std::atomic<const char*> title{nullptr}, callback{""};
  std::atomic<int64_t> tick{-1};
  std::atomic<double> time{0};
};

// Never destroyed: the thread that looks outlives main().
struct Slots {
  std::mutex changing;
  std::vector<Slot*> all;
  bool is_wanted = false, is_watched = false;
};

Slots& slots() {
  static Slots& all = *new Slots;
  return all;
}

void write_line(const std::string& line) {
  for (std::size_t from = 0; from < line.size();) {
    const auto written = ::write(STDERR_FILENO, line.data() + from, line.size() - from);
    if (written <= 0) return;
    from += static_cast<std::size_t>(written);
  }
}

void look_for_ever() {
  CallbackWatch watch;
  while (true) {
    std::this_thread::sleep_for(between);
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    for (const std::string& note : watch.look(std::chrono::duration_cast<milliseconds>(now))) write_line(note + '\n');
  }
}

// Signals stay with the threads that wait for them.
void start_looking() {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(look_for_ever).detach();
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

// A thread's slot, for the thread's life.
struct Registered {
  Registered() {
    Slots& known = slots();
    const std::lock_guard lock(known.changing);
    known.all.push_back(&slot);
    if (known.is_wanted && !std::exchange(known.is_watched, true)) start_looking();
  }
  ~Registered() {
    Slots& known = slots();
    const std::lock_guard lock(known.changing);
    std::erase(known.all, &slot);
  }
  Slot slot;
};

std::string words(const Slot& slot, milliseconds lasted) {
  const std::string callback = slot.callback.load();
  const int64_t tick = slot.tick;
  std::string text = std::string("note: ") + slot.title.load() + ": has been in " + callback + "() for " +
                     std::to_string(lasted.count() / 1000) + " s";
  if (tick < 0) return text + ", and the run waits for it";
  return text + ", at tick " + std::to_string(tick) + " (t = " + print_real(slot.time) +
         " s), and the run waits for it; expected it to return in every tick: a wait is a condition that it looks at "
         "again in the next one";
}

}  // namespace

void note_callback(const CallbackAt& at) noexcept {
  static thread_local Registered own;
  Slot& slot = own.slot;
  const uint64_t entered = slot.entered.load(std::memory_order_relaxed);
  slot.entered.store(entered + 1, std::memory_order_release);
  slot.title.store(at.title, std::memory_order_release);
  slot.callback.store(at.callback, std::memory_order_release);
  slot.tick.store(at.tick, std::memory_order_release);
  slot.time.store(at.time, std::memory_order_release);
  slot.entered.store(entered + 2, std::memory_order_release);
}

void settle_callback_watch() { const std::lock_guard lock(slots().changing); }

std::vector<std::string> CallbackWatch::look(milliseconds now) {
  std::vector<std::string> notes;
  std::vector<Met> still;
  const std::lock_guard lock(slots().changing);
  for (const Slot* slot : slots().all) {
    const uint64_t entered = slot->entered;
    if (entered % 2 != 0 || !slot->title) continue;
    const auto known = std::find_if(met_.begin(), met_.end(),
                                    [&](const Met& met) { return met.thread == slot && met.entered == entered; });
    Met met = known == met_.end() ? Met{slot, entered, now, now + patience} : *known;
    if (now >= met.due) {
      const milliseconds lasted = now - met.since;
      const std::string note = words(*slot, lasted);
      if (slot->entered != entered) continue;  // it has just returned
      notes.push_back(note);
      met.due += std::min(lasted, slowest);
    }
    still.push_back(met);
  }
  met_ = std::move(still);
  return notes;
}

void watch_callbacks() {
  Slots& known = slots();
  {
    const std::lock_guard lock(known.changing);
    if (std::exchange(known.is_wanted, true)) return;
  }
  // A child must not find the lock taken by a thread that it does not have.
  ::pthread_atfork([] { slots().changing.lock(); }, [] { slots().changing.unlock(); },
                   [] { slots().changing.unlock(); });
}

}  // namespace muster
