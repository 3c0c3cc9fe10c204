// All of these tests run where a decimal point is a comma: in C's locale if a German one is installed, in C++'s always.
#include <gtest/gtest.h>

#include <clocale>
#include <locale>

namespace {

class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class CommaLocale : public ::testing::Environment {
  void SetUp() override {
    std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
    bool found = false;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"}) {
      found = found || std::setlocale(LC_ALL, name) != nullptr;
    }
    ::testing::Test::RecordProperty("comma_locale_of_c", found ? "yes" : "not installed");
  }
};

const auto* const registered = ::testing::AddGlobalTestEnvironment(new CommaLocale);

}  // namespace
