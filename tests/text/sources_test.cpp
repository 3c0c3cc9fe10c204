// No line of the project reads or prints a number depending on the locale.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using Folders = std::vector<const char*>;

const Folders sources{"bridge",  "bundle",  "cli",    "description", "diagnosis", "exam",       "kernel", "live",
                      "loader",  "mcap",    "medium", "plotting",    "plugins",   "plugin_api", "ports",  "python",
                      "roadmap", "run_log", "scene",  "sweep",       "text",      "world_file"};
// Whose objects are looked through, too.
const Folders objects{"kernel", "cli", "plugins", "diagnosis", "scene", "description"};

// Functions called by these names, in code; comments may mention them.
const std::regex forbidden(
    R"(\b(strto(d|f|ld|l|ul|ll|ull)|sto(d|f|ld|i|l|ul|ll|ull)|ato(f|i|l|ll)|v?f?sscanf|lexical_cast|)"
    R"(Query\w*(Value|Attribute|Text)|(Int|Int64|Unsigned|Unsigned64|Bool|Float|Double)(Value|Attribute|Text)|)"
    R"(IntText|FloatText|DoubleText)\s*[(<])");

// Without its comment, and without ns-3's own types, which hold numbers and read none.
std::string code_of(const std::string& line) {
  static const std::regex of_ns3(R"(\bns3::\w+)");
  return std::regex_replace(line.substr(0, line.find("//")), of_ns3, "");
}

bool is_source(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".cpp" || extension == ".hpp" || extension == ".h" || extension == ".c";
}

template <class Visit>
int visit_files(const fs::path& root, const Folders& folders, Visit visit) {
  int count = 0;
  for (const char* folder : folders) {
    if (!fs::is_directory(root / folder)) {
      ADD_FAILURE() << "there is no " << (root / folder).string();
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      count += entry.is_regular_file() && visit(entry.path());
  }
  return count;
}

TEST(Sources, ThePatternFindsWhatItNames) {
  for (const char* line :
       {"x = strtod(s, &end);", "x = std::stod(text);", "return atof (s);", "e->QueryDoubleAttribute(\"n\", &n);",
        "a->DoubleValue()", "e->IntAttribute(\"n\")", "boost::lexical_cast<double>(s)", "sscanf(s, \"%lf\", &x);"}) {
    EXPECT_TRUE(std::regex_search(line, forbidden)) << line;
  }
  for (const char* line : {"history(x)", "a->Value()", "custom_stop(", "print_real(x)"})
    EXPECT_FALSE(std::regex_search(line, forbidden)) << line;
}

TEST(Sources, ReadNoNumberButThroughFromChars) {
  const int seen = visit_files(MUSTER_SOURCE_DIR, sources, [](const fs::path& path) {
    if (!is_source(path)) return false;
    std::ifstream file(path);
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
      EXPECT_FALSE(std::regex_search(code_of(line), forbidden)) << path.string() << ":" << number << ": " << line;
    }
    return true;
  });
  EXPECT_GE(seen, 300);
}

// std::to_string of a real follows the locale, of an integer it does not, and only the compiler distinguishes them. The
// first calls __gnu_cxx::__to_xstring, which is then among the object's symbols.
TEST(Sources, PrintNoRealThroughToString) {
  const int seen = visit_files(MUSTER_BUILD_DIR, objects, [](const fs::path& path) {
    if (path.extension() != ".o") return false;
    if (path.string().find("/cli/") != std::string::npos) return false;  // CLI11's header calls it for its own messages
    std::ifstream file(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(bytes.find("__to_xstring"), bytes.npos)
        << path.string() << " calls std::to_string with a real; use print_real";
    return true;
  });
  EXPECT_GE(seen, 7);
}

}  // namespace
