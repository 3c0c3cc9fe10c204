#include "machine.hpp"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace muster::bundle {
namespace {

// The value of the first line "NAME<between>VALUE"; empty if there is none.
std::string value_in(const char* file, const std::string& name, char between) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(between);
    if (at == line.npos) continue;
    std::string key = line.substr(0, at);
    key.erase(key.find_last_not_of(" \t") + 1);
    if (key != name) continue;
    std::string value = line.substr(at + 1);
    value.erase(0, std::min(value.find_first_not_of(" \t\""), value.size()));
    value.erase(value.find_last_not_of(" \t\"") + 1);
    return value;
  }
  return "";
}

std::vector<std::string> features() {
  std::istringstream x86(value_in("/proc/cpuinfo", "flags", ':')), arm(value_in("/proc/cpuinfo", "Features", ':'));
  static const std::vector<std::string> of_x86 = {"sse4_1", "sse4_2",  "avx",      "f16c",     "fma",      "avx2",
                                                  "bmi2",   "avx512f", "avx512dq", "avx512cd", "avx512bw", "avx512vl"};
  std::vector<std::string> result;
  for (std::string one; x86 >> one;)
    if (std::find(of_x86.begin(), of_x86.end(), one) != of_x86.end()) result.push_back(one);
  for (std::string one; arm >> one;) result.push_back(one);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

Machine this_machine() {
  Machine result;
  result.system = value_in("/etc/os-release", "PRETTY_NAME", '=');
  utsname kernel{};
  if (::uname(&kernel) == 0) result.architecture = kernel.machine;
  result.libc = std::string("glibc ") + ::gnu_get_libc_version();
#ifdef __clang__
  result.compiler = __VERSION__;
#else
  result.compiler = "GCC " __VERSION__;
#endif
  result.cpu = value_in("/proc/cpuinfo", "model name", ':');
  result.cpu_features = features();
  return result;
}

}  // namespace muster::bundle
