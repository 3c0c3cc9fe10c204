// Cost of hostile and large files. Not under sanitizers, which cost more than the code measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "error_of.hpp"
#include "large_xml.hpp"
#include "text/number.hpp"
#include "text/xml.hpp"

namespace muster {
namespace {

class XmlCost : public test::FolderTest {};

struct Cost {
  double seconds = 0;  // CPU time
  long megabytes = 0;  // peak resident memory over that of the bare process
  std::string message;
};

// In a process of its own, since a peak never decreases.
Cost cost_of_reading(const std::filesystem::path& path) {
  int pipe_ends[2];
  if (::pipe(pipe_ends) != 0) return {};
  const ::pid_t child = ::fork();
  if (child == 0) {
    struct rusage before {
    }, after{};
    ::getrusage(RUSAGE_SELF, &before);
    const std::string message = test::error_of([&] { read_xml(path); }, path.parent_path()).substr(0, 1000);
    ::getrusage(RUSAGE_SELF, &after);
    const auto micro = [](const ::timeval& t) {
      return static_cast<long>(t.tv_sec) * 1'000'000 + static_cast<long>(t.tv_usec);
    };
    const std::string report = std::to_string(micro(after.ru_utime) + micro(after.ru_stime) - micro(before.ru_utime) -
                                              micro(before.ru_stime)) +
                               "\n" + std::to_string((after.ru_maxrss - before.ru_maxrss) / 1024) + "\n" + message;
    ::_exit(::write(pipe_ends[1], report.data(), report.size()) < 0);
  }
  ::close(pipe_ends[1]);
  char report[4096];
  const ::ssize_t size = ::read(pipe_ends[0], report, sizeof report);
  ::close(pipe_ends[0]);
  ::waitpid(child, nullptr, 0);
  const std::string text(report, static_cast<std::size_t>(std::max<::ssize_t>(size, 0)));
  const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
  const long long microseconds = parse_integer(text.substr(0, first)).value_or(-1);
  return {static_cast<double>(microseconds) * 1e-6,
          static_cast<long>(parse_integer(text.substr(first + 1, second - first - 1)).value_or(-1)),
          text.substr(second + 1)};
}

TEST_F(XmlCost, HostileFilesAreRefusedCheaply) {
  const std::pair<std::string, std::string_view> cases[] = {
      {test::repeat("<a>", 1'000'000), "nested too deep"},
      {test::attributes(40'000), "too many attributes"},
      {"<w a='" + test::repeat("x", 15'000'000) + "'/>", "too long"},
      {"<w>" + test::repeat("<a/>", 2'000'000) + "</w>", "too many elements"},
      {"<w>" + test::repeat("\n", 15'000'000) + "x", "stands between elements"},
      {"<w a='" + test::repeat("&#", 7'000'000) + "'/>", "'&' in a value"},
      {"<" + test::repeat("n", 15'000'000) + "/>", "a name is too long"},
      {"</" + test::repeat("n", 15'000'000) + ">", "a name is too long"},
  };
  for (const auto& [bytes, message] : cases) {
    const Cost cost = cost_of_reading(write("hostile.xml", bytes));
    EXPECT_THAT(cost.message, ::testing::HasSubstr(message));
    EXPECT_LT(cost.message.size(), 300u);
    EXPECT_GE(cost.seconds, 0);
    EXPECT_LT(cost.seconds, 1);
    EXPECT_LT(cost.megabytes, 50);
  }
}

// The largest files within the limits; a search for '&' to the end of the file once made the first take 27 s.
TEST_F(XmlCost, LargeFilesTakeLinearTime) {
  const auto large = [](const std::string& tag, int count) { return "<w>" + test::repeat(tag, count) + "</w>"; };
  for (const auto& [tag, most] : {std::pair<std::string, int>{test::attributes(250), 3900}, {"<a/>", 999'999}}) {
    const Cost quarter = cost_of_reading(write("quarter.xml", large(tag, most / 4)));
    const Cost cost = cost_of_reading(write("large.xml", large(tag, most)));
    EXPECT_EQ(cost.message, "no error");
    EXPECT_LT(cost.seconds, 8 * quarter.seconds);  // four times, where it is linear; sixteen, where it is quadratic
    EXPECT_GT(cost.megabytes, 50);                 // so the measure above does see memory
    RecordProperty("milliseconds", static_cast<int>(cost.seconds * 1e3));
  }
}

}  // namespace
}  // namespace muster
