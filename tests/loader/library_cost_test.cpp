// Cost of loading, the same at the thousandth time.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>

#include "loader/float_guard.hpp"
#include "zoo.hpp"

namespace muster {
namespace {

struct Held {
  long pages = 0;  // of private memory that is resident
  std::ptrdiff_t files = 0, maps = 0;
};

Held held() {
  Held result;
  long ignored, resident, shared;
  FILE* statm = std::fopen("/proc/self/statm", "r");
  EXPECT_EQ(std::fscanf(statm, "%ld %ld %ld", &ignored, &resident, &shared), 3);
  std::fclose(statm);
  result.pages = resident - shared;
  result.files = std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
  const std::string maps = test::contents("/proc/self/maps");
  result.maps = std::ranges::count(maps, '\n');
  return result;
}

TEST(LibraryCost, AThousandLoadsKeepNothing) {
  const auto load = [](int times) {
    for (int i = 0; i < times; ++i) {
      Library::load("zoo.good", std::nullopt, {zoo}, {});
      EXPECT_THROW(Library::load("zoo.no_section", std::nullopt, {zoo}, {}), Error);
    }
  };
  load(100);  // the allocator's and the loader's own tables grow once
  const Held before = held();
  load(1000);
  const Held after = held();
  EXPECT_EQ(after.files, before.files);
  EXPECT_LE(after.maps, before.maps + 1);
  EXPECT_LE(after.pages, before.pages + 16);
}

// The bound is ten times what they take: it finds what grows with their number, and no slow machine.
TEST(LibraryCost, FiftyPluginsLoadAtOnce) {
  double best = 1e9;  // [ms] of five tries: other work on the machine is not ours
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    LibraryLoader loader({zoo});
    std::vector<std::shared_ptr<Library>> libraries;
    for (int k = 0; k < 50; ++k) libraries.push_back(loader.load("zoo.good", std::nullopt, {}));
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  RecordProperty("milliseconds", std::to_string(best));
  std::printf("50 plugins in %.1f ms\n", best);
  EXPECT_LE(best, 400);
}

double thread_seconds() {
  timespec time;
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TEST(FloatGuard, CostsNanoseconds) {
  constexpr int times = 1'000'000;
  const FloatGuard guard;
  double best = 1;  // [s]
  int changes = 0;
  for (int i = 0; i < 5; ++i) {
    const double start = thread_seconds();
    for (int k = 0; k < times; ++k) changes += guard.changed();
    best = std::min(best, thread_seconds() - start);
  }
  std::printf("a check: %.1f ns\n", 1e9 * best / times);
  EXPECT_EQ(changes, 0);
  EXPECT_LE(1e9 * best / times, 20);
}

}  // namespace
}  // namespace muster
