// Built for a later plugin_api: none of its code may run, not even its initialisers.
#include <cstdio>
#include <cstdlib>

__attribute__((section("muster.abi.2"), used)) static const unsigned abi = 2;

namespace {
const bool ran = [] {
  if (const char* trace = std::getenv("MUSTER_ZOO_TRACE")) {
    if (FILE* file = std::fopen(trace, "w")) std::fclose(file);
  }
  return true;
}();
}  // namespace
