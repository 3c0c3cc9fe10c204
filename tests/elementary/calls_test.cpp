// Nothing that a digest depends on asks the C library for a function whose bits depend on the processor.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "tests/sanitized.hpp"

namespace {

namespace fs = std::filesystem;

std::string printed(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string result;
  for (int c = 0; pipe && (c = std::fgetc(pipe.get())) != EOF;) result += static_cast<char>(c);
  return result;
}

std::vector<fs::path> plugins() {
  std::vector<fs::path> result;
  for (const auto& file : fs::directory_iterator(MUSTER_PLUGINS_DIR)) {
    if (file.path().extension() == ".so") result.push_back(file.path());
  }
  return result;
}

const std::regex of_processor(
    R"(\bU (a?(sin|cos|tan)h?|sincos|atan2|expm?1?|log2?|pow|erfc?|[lt]gamma|(sin|cos|sincos|exp2?|log2?|pow)f)(@|\n))");

void look_at(const std::string& symbols, const fs::path& library) {
  for (std::sregex_iterator call(symbols.begin(), symbols.end(), of_processor), none; call != none; ++call)
    ADD_FAILURE() << library.filename() << " calls " << (*call)[1] << " of the C library";
}

TEST(Elementary, NoPluginCallsThoseOfTheProcessor) {
  if (muster::test::sanitized) GTEST_SKIP() << "the sanitizer has a sincos of its own, which is linked first";
  ASSERT_GT(plugins().size(), 20u);
  for (const fs::path& plugin : plugins()) {
    const std::string symbols = printed("nm -D --undefined-only '" + plugin.string() + "'");
    ASSERT_NE(symbols.find("GLIBC"), symbols.npos) << plugin;
    look_at(symbols, plugin);
  }
}

// What the kernel computes is in the digest, too, and the program is not linked to ours. Reading a world takes a
// heading for a message alone.
TEST(Elementary, TheKernelCallsNone) {
  for (const char* library : {MUSTER_KERNEL_LIBRARIES}) {
    const std::string symbols = printed("nm --undefined-only '" + std::string(library) + "'");
    ASSERT_NE(symbols.find(" U "), symbols.npos) << library;
    look_at(symbols, library);
  }
}

TEST(Elementary, CallsAreSeen) {
  EXPECT_TRUE(std::regex_search("                 U sin@GLIBC_2.2.5\n", of_processor));
  EXPECT_TRUE(std::regex_search("                 U log\n", of_processor));
  EXPECT_FALSE(std::regex_search("                 U log10@GLIBC_2.2.5\n", of_processor));
  EXPECT_FALSE(std::regex_search("                 U Sleef_cinz_sind1_u35purec\n", of_processor));
}

}  // namespace
