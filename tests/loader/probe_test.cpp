// Each fatal behaviour of a child is reported in one line and leaves the parent alone.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "loader/elf.hpp"
#include "loader/library_probe.hpp"

namespace muster {
namespace {

using namespace std::chrono_literals;

[[noreturn]] void throw_far() { throw std::logic_error("far"); }

std::string outcome(const std::function<void()>& body, std::chrono::milliseconds limit = 20s) {
  const auto dance = [&](const std::string&, const Progress& progress) {
    progress("it dances");
    body();
  };
  return Probe(dance, limit).try_out("it");
}

TEST(Probe, TellsHowABodyEnds) {
  EXPECT_EQ(outcome([] {}), "");
  EXPECT_EQ(outcome([] { throw Refusal("is tired"); }), "is tired");
  EXPECT_EQ(outcome([] { throw std::runtime_error("no"); }), "throws while it dances: std::runtime_error: no");
  EXPECT_EQ(outcome([] { throw 42; }), "throws while it dances: int");
  EXPECT_EQ(outcome([]() noexcept { throw_far(); }), "throws while it dances: std::logic_error: far");
  EXPECT_EQ(outcome([] { std::terminate(); }), "calls std::terminate() while it dances");
  EXPECT_EQ(outcome([] { std::exit(0); }), "calls exit() while it dances");
  EXPECT_EQ(outcome([] { ::_exit(0); }), "ends the process while it dances; it is corrupted or faulty");
  EXPECT_EQ(outcome([] { __builtin_trap(); }), "crashes while it dances (SIGILL); it is corrupted or faulty");
  EXPECT_EQ(outcome([] { std::abort(); }), "crashes while it dances (SIGABRT); it is corrupted or faulty");
}

TEST(Probe, EndsABodyThatHangs) {
  EXPECT_EQ(outcome(
                [] {
                  for (;;) ::pause();
                },
                200ms),
            "hangs while it dances: it took over 0.2 s");
}

// Ctrl-C goes to every process of the terminal; the parent handles it.
TEST(Probe, LeavesInterruptionToTheParent) {
  EXPECT_EQ(outcome([] { std::raise(SIGINT); }), "");
  EXPECT_EQ(outcome([] { std::raise(SIGTERM); }), "");
}

// A handler of the parent would swallow the crash: raise() would return and the body end well.
TEST(Probe, KeepsTheParentsSignalHandlersOut) {
  const auto before = std::signal(SIGSEGV, [](int) {});
  EXPECT_EQ(outcome([] { std::raise(SIGSEGV); }), "crashes while it dances (SIGSEGV); it is corrupted or faulty");
  std::signal(SIGSEGV, before);
}

TEST(Probe, KeepsTheParentsExitHandlersOut) {
  static const pid_t parent = ::getpid();
  static int ends[2];
  ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
  std::atexit([] {
    if (::getpid() != parent) ::write(ends[1], "!", 1) == 1 ? void() : std::abort();
  });
  outcome([] { std::exit(0); });
  char byte;
  EXPECT_EQ(::read(ends[0], &byte, 1), -1);
}

TEST(Probe, SaysNothingItself) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  outcome([] {
    ::write(STDOUT_FILENO, "out", 3) > 0 ? void() : std::abort();
    ::write(STDERR_FILENO, "err", 3) > 0 ? void() : std::abort();
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(Probe, TakesLongWords) {
  const std::string words(200'000, 'x');
  EXPECT_EQ(outcome([&] { throw Refusal(words); }), words.substr(0, 4095));
}

// One child suffices as long as all succeeds; a failure is tried again in a fresh child.
TEST(Probe, BlamesNothingForWhatWentBefore) {
  int left_behind = 0;  // the child's own copy counts on
  Probe probe(
      [&](const std::string& what, const Progress&) {
        ++left_behind;
        if (what == "bad" || (what == "sensitive" && left_behind > 1))
          throw Refusal(what + " failed as number " + std::to_string(left_behind));
      },
      20s);
  EXPECT_EQ(probe.try_out("good"), "");
  EXPECT_EQ(probe.try_out("good"), "");
  EXPECT_EQ(probe.try_out("sensitive"), "");
  EXPECT_EQ(probe.try_out("good"), "");
  EXPECT_EQ(probe.try_out("bad"), "bad failed as number 1");
  EXPECT_EQ(probe.try_out("sensitive"), "");
  EXPECT_EQ(left_behind, 0);
}

}  // namespace
}  // namespace muster
