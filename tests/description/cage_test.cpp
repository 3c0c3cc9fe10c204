// A process in the cage can compute and end, and nothing else.
#include "description/cage.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <vector>

namespace muster::description {
namespace {

// The exit code of a child in the cage, or minus the signal that ended it.
int in_the_cage(const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    enter_cage({});
    ::_exit(body());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(Cage, LetsMemoryBeUsed) {
  EXPECT_EQ(in_the_cage([] {
              std::vector<double> many(1 << 20, 1.0);
              for (int k = 0; k < 8; ++k) many.insert(many.end(), 1 << 18, 2.0);
              return many.back() == 2.0 ? 7 : 1;
            }),
            7);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // under which the cage stays open

TEST(Cage, OpensNoFileAndNoSocket) {
  EXPECT_NE(in_the_cage([] { return ::open("/dev/null", O_RDONLY) < 0 ? errno : 0; }), 0);
  EXPECT_NE(in_the_cage([] { return ::socket(AF_INET, SOCK_STREAM, 0) < 0 ? errno : 0; }), 0);
}

TEST(Cage, StartsAndReadsAndWritesNothing) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  EXPECT_EQ(in_the_cage([] { return ::fork() < 0 ? errno : 0; }), EPERM);
  EXPECT_EQ(in_the_cage([] { return ::unlink("/nowhere") < 0 ? errno : 0; }), EPERM);
  EXPECT_EQ(in_the_cage([&] { return ::write(ends[1], "x", 1) < 0 ? errno : 0; }), EPERM);
  ::close(ends[0]), ::close(ends[1]);
}

TEST(Cage, EndsWhatTakesTooMuchMemory) {
  EXPECT_EQ(in_the_cage([] {
              errno = 0;
              ::sbrk(std::intptr_t{1} << 30);
              return errno;
            }),
            ENOMEM);
}

#endif

}  // namespace
}  // namespace muster::description
