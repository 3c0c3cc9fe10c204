// Notes about a callback that does not return. Times are given to the watch: no test waits.
#include "kernel/callback_watch.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "kernel/crash_report.hpp"

namespace muster {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(CallbackWatch, ToldAtTenSecondsAndFromThenOn) {
  CallbackWatch watch;
  EXPECT_THAT(watch.look(100s), IsEmpty());
  const RunningCallback running("world.xml:5:3: mine (control.mine)", "step", 3, 0.15);
  EXPECT_THAT(watch.look(101s), IsEmpty());
  EXPECT_THAT(watch.look(110s), IsEmpty());
  EXPECT_THAT(watch.look(111s),
              ElementsAre("note: world.xml:5:3: mine (control.mine): has been in step() for 10 s, at "
                          "tick 3 (t = 0.15 s), and the run waits for it; expected it to return in "
                          "every tick: a wait is a condition that it looks at again in the next one"));
  EXPECT_THAT(watch.look(112s), IsEmpty());
  EXPECT_THAT(watch.look(121s), ElementsAre(testing::HasSubstr("in step() for 20 s, ")));
  EXPECT_THAT(watch.look(141s), ElementsAre(testing::HasSubstr("in step() for 40 s, ")));
  EXPECT_THAT(watch.look(181s), ElementsAre(testing::HasSubstr("in step() for 80 s, ")));
  EXPECT_THAT(watch.look(241s), ElementsAre(testing::HasSubstr("in step() for 140 s, ")));
}

TEST(CallbackWatch, EachCallbackHasItsOwnTime) {
  CallbackWatch watch;
  for (int tick = 0; tick < 30; ++tick) {
    const RunningCallback running("mine", "step", tick);
    EXPECT_THAT(watch.look(std::chrono::seconds(tick)), IsEmpty());
  }
  EXPECT_THAT(watch.look(100s), IsEmpty());
}

TEST(CallbackWatch, CreateHasNoTickAndWhatMayWaitIsLeftAlone) {
  CallbackWatch watch;
  const RunningCallback outer("mine", "create", -1);
  EXPECT_THAT(watch.look(0s), IsEmpty());
  EXPECT_THAT(watch.look(10s), ElementsAre("note: mine: has been in create() for 10 s, and the run waits for it"));
  {
    const RunningCallback running("a bridge", "step", 1, 0.1, true);
    EXPECT_THAT(watch.look(20s), IsEmpty());
    EXPECT_THAT(watch.look(40s), IsEmpty());
  }
  EXPECT_THAT(watch.look(50s), IsEmpty());  // its time begins again
  EXPECT_THAT(watch.look(60s), ElementsAre(testing::HasSubstr("mine: has been in create() for 10 s")));
}

TEST(CallbackWatch, OtherThreadsAreSeenAndGo) {
  CallbackWatch watch;
  std::thread other([&] {
    const RunningCallback running("theirs", "step", 2, 1);
    std::thread looks([&] {
      EXPECT_THAT(watch.look(0s), IsEmpty());
      EXPECT_THAT(watch.look(10s), ElementsAre(testing::StartsWith("note: theirs: has been in step() for 10 s")));
    });
    looks.join();
  });
  other.join();
  EXPECT_THAT(watch.look(30s), IsEmpty());
}

}  // namespace
}  // namespace muster
