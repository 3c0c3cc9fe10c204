// The table of runs among processes: no claim is held twice, what the dead held is taken again, what the living hold is
// not.
#include "sweep/job_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster::sweep {
namespace {

using test::Folder;
using testing::ElementsAre;

const Sources sources{{"sweep", "1"}};

void fill(const Folder& folder, std::size_t combinations, const std::vector<std::int64_t>& seeds) {
  JobTable(folder.path()).fill(sources, {{"m", "s"}}, combinations, seeds);
}

pid_t in_child(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  try {
    work();
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

int exit_of(pid_t child) {
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

// A child that has claimed a job and goes on living with it.
struct Holder {
  explicit Holder(const Folder& folder) {
    EXPECT_EQ(::pipe(told), 0);
    child = in_child([&] {
      JobTable table(folder.path());
      const char claimed = table.claim({}) ? 'y' : 'n';
      if (::write(told[1], &claimed, 1) == 1) ::pause();
    });
    char claimed = 0;
    EXPECT_EQ(::read(told[0], &claimed, 1), 1);
    EXPECT_EQ(claimed, 'y');
  }
  void kill() const {
    ::kill(child, SIGKILL);
    EXPECT_EQ(WTERMSIG(exit_of(child)), SIGKILL);
  }
  pid_t child = 0;
  int told[2] = {};
};

TEST(JobTable, ManyProcessesDoEachJobOnce) {
  const Folder folder;
  fill(folder, 20, {1, 2, 3, 4, 5});
  std::vector<pid_t> children;
  for (int i = 0; i < 6; ++i) {
    children.push_back(in_child([&] {
      JobTable table(folder.path());
      while (const auto job = table.claim({}))
        table.record(*job,
                     {1, "d", "", {static_cast<double>(job->combination) * 100 + static_cast<double>(job->seed)}});
    }));
  }
  for (const pid_t child : children) EXPECT_EQ(exit_of(child), 0);
  JobTable table(folder.path());
  const auto runs = table.done();
  ASSERT_EQ(runs.size(), 100u);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i].number, static_cast<std::int64_t>(i));
    const std::size_t combination = i / 5, seed = i % 5 + 1;
    EXPECT_THAT(runs[i].values, ElementsAre(static_cast<double>(100 * combination + seed)));
  }
  EXPECT_EQ(Database(folder.path() / JobTable::file_name).number("SELECT max(begun) FROM job"), 1);
}

// Two that began at once: one of them ended with "database is locked".
TEST(JobTable, ManyProcessesMakeOne) {
  for (int round = 0; round < 40; ++round) {
    const Folder folder;
    int start[2] = {};
    ASSERT_EQ(::pipe(start), 0);
    std::vector<pid_t> children;
    for (int i = 0; i < 6; ++i) {
      children.push_back(in_child([&] {
        ::close(start[1]);
        char none = 0;
        if (::read(start[0], &none, 1) != 0) ::_exit(2);  // it ends when the last writer has closed it
        fill(folder, 1, {1});
      }));
    }
    ::close(start[0]);
    ::close(start[1]);
    for (const pid_t child : children) ASSERT_EQ(exit_of(child), 0) << "round " << round;
    EXPECT_EQ(JobTable(folder.path()).counts().all, 1);
  }
}

TEST(JobTable, AClaimEndsWithItsWorker) {
  const Folder folder;
  fill(folder, 1, {1, 2});
  const Holder holder(folder);
  {
    JobTable table(folder.path());
    EXPECT_TRUE(table.left().empty());
    const auto other = table.claim({});
    ASSERT_TRUE(other);
    EXPECT_EQ(other->seed, 2);      // the first is the living one's
    EXPECT_FALSE(table.claim({}));  // and this one ours
    EXPECT_EQ(table.counts().done, 0);
    holder.kill();
    ASSERT_EQ(table.left().size(), 1u);
    EXPECT_EQ(table.left()[0].seed, 1);
    const auto again = table.claim({});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->seed, 1);
  }
  EXPECT_EQ(Database(folder.path() / JobTable::file_name).number("SELECT begun FROM job WHERE number = 0"), 2);
}

TEST(JobTable, RecordsNoJobTwiceAndNoneOfAnother) {
  const Folder folder;
  fill(folder, 1, {1, 2});
  const Holder holder(folder);
  JobTable table(folder.path());
  const auto job = table.claim({});
  ASSERT_TRUE(job);
  EXPECT_THROW(table.record({0, 0, 1, ""}, {1, "d", "", {1}}), Error);  // the living one's
  table.record(*job, {1, "d", "", {1}});
  EXPECT_THROW(table.record(*job, {1, "d", "", {1}}), Error);
  EXPECT_THROW(table.release(*job), Error);
  EXPECT_EQ(table.counts().done, 1);
  holder.kill();
}

TEST(JobTable, AReleasedJobIsOpen) {
  const Folder folder;
  fill(folder, 1, {1});
  JobTable table(folder.path());
  const auto job = table.claim({});
  EXPECT_FALSE(table.claim({}));
  table.release(*job);
  EXPECT_TRUE(table.claim({}));
}

TEST(JobTable, SharesPartTheJobs) {
  const Folder folder;
  fill(folder, 2, {1, 2, 3, 4, 5});
  JobTable table(folder.path());
  std::vector<std::int64_t> numbers;
  for (int index = 1; index <= 3; ++index) {
    while (const auto job = table.claim({index, 3})) {
      EXPECT_EQ(job->number % 3, index - 1);
      numbers.push_back(job->number);
    }
  }
  EXPECT_THAT(numbers, testing::UnorderedElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_EQ(table.counts({1, 3}).all, 4);
  EXPECT_EQ(table.counts({3, 3}).all, 3);
}

TEST(JobTable, IsFilledOnce) {
  const Folder folder;
  JobTable table(folder.path());
  EXPECT_FALSE(table.is_filled());
  table.fill(sources, {{"m", "s"}}, 1, {1});
  table.fill({{"sweep", "2"}}, {{"other", ""}}, 9, {1, 2});
  EXPECT_EQ(table.sources(), sources);
  EXPECT_EQ(table.counts().all, 1);
  EXPECT_EQ(table.metrics().size(), 1u);
}

TEST(JobTable, KeepsNumbersToTheBit) {
  const Folder folder;
  fill(folder, 1, {1, 2, 3});
  JobTable table(folder.path());
  const double odd = 0.1 + 0.2, infinite = std::numeric_limits<double>::infinity();
  for (const double value : {odd, -infinite, std::numeric_limits<double>::quiet_NaN()})
    table.record(*table.claim({}), {odd, "d", "", {value}});
  const auto runs = table.done();
  EXPECT_EQ(runs[0].values[0], odd);
  EXPECT_EQ(runs[0].time, odd);
  EXPECT_EQ(runs[1].values[0], -infinite);
  EXPECT_TRUE(std::isnan(runs[2].values[0]));
}

TEST(JobTable, ARunThatFailedHasNoValues) {
  const Folder folder;
  fill(folder, 1, {1, 2});
  JobTable table(folder.path());
  table.record(*table.claim({}), {1, "", "broken", {}});
  table.record(*table.claim({}), {1, "d", "", {5}});
  EXPECT_EQ(table.counts().failed, 1);
  EXPECT_TRUE(std::isnan(table.done()[0].values[0]));
  EXPECT_EQ(table.done()[1].values[0], 5);
}

TEST(JobTable, AddsAJobForEachNewSource) {
  const Folder folder;
  JobTable table(folder.path());
  table.fill(sources, {{"m", "s"}}, 0, {});
  table.add({{"a", "1"}, {"b", "2"}});
  EXPECT_EQ(table.claim({})->label, "a");
  table.add({{"0", "3"}, {"a", "4"}});
  EXPECT_EQ(table.counts().all, 3);
  EXPECT_EQ(table.claim({})->label, "b");
  const auto last = table.claim({});
  EXPECT_EQ(last->label, "0");
  EXPECT_EQ(last->number, 2);
  EXPECT_EQ(table.sources(), (Sources{{"0", "3"}, {"a", "1"}, {"b", "2"}, {"sweep", "1"}}));
  table.renew({{"a", "5"}, {"c", "6"}});
  EXPECT_EQ(table.sources(), (Sources{{"0", "3"}, {"a", "5"}, {"b", "2"}, {"sweep", "1"}}));
}

TEST(JobTable, AReopenedJobIsDoneAgain) {
  const Folder folder;
  fill(folder, 1, {1, 2});
  JobTable table(folder.path());
  for (const double value : {5.0, 6.0}) table.record(*table.claim({}), {1, "", "broken", {value}});
  EXPECT_EQ(table.done()[1].values[0], 6) << "of a failed run, too";
  const auto is_first = [](const Job& job) { return job.seed == 1; };
  table.reopen_if(is_first);
  EXPECT_EQ(table.counts().done, 1);
  EXPECT_EQ(table.counts().failed, 1);
  const auto again = table.claim({});
  ASSERT_EQ(again->number, 0);
  table.reopen_if(is_first);  // it is not done, but begun, and stays with who began it
  table.record(*again, {1, "d", "", {7}});
  EXPECT_EQ(table.done()[0].values[0], 7);
}

TEST(JobTable, RefusesFilesOfOthers) {
  const Folder folder;
  folder.write(JobTable::file_name,
               "no database, but a text that is longer than the header of one would have to be ...........");
  try {
    JobTable table(folder.path());
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(folder.inside(e.what()), "sweep.sqlite: file is not a database");
  }
  const Folder other;
  Database(other.path() / JobTable::file_name).run("CREATE TABLE mine (x)");
  try {
    JobTable table(other.path());
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(e.exit(), Exit::invalid_input);
    EXPECT_EQ(other.inside(e.what()), "sweep.sqlite: is no table of this version's sweeps; expected another folder");
  }
}

}  // namespace
}  // namespace muster::sweep
