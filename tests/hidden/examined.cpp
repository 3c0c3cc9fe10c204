#include "tests/hidden/examined.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

#include "text/temporary_folder.hpp"

namespace muster::exam {
namespace {

void muster(const std::string& arguments) {
  const std::string command = std::string(MUSTER_PROGRAM) + " exam " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  std::array<char, 4096> part{};
  for (std::size_t n; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) said.append(part.data(), n);
  if (pclose(pipe) != 0) throw std::runtime_error(command + "\n" + said);
}

}  // namespace

Grades examined(const std::string& wanted, const std::string& command) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "exam").string();
  muster("make " + wanted + " --out " + out);
  const std::string program = std::string("muster() { ") + MUSTER_PROGRAM + " \"$@\"; }; ";
  muster("run " + out + (command.empty() ? "" : " --command '" + program + command + "'"));
  return grade(out, folder.path() / "exam/reports");
}

}  // namespace muster::exam
