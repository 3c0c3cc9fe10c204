// Looks at a library before anything of it runs: dlopen() dies of SIGBUS or SIGSEGV on truncated and corrupted files,
// and calls a library of another machine "No such file or directory".
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace muster {

// Why a library is not loaded: words that follow its file's name, such as "is built for AArch64; expected x86-64".
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The names of the sections of a shared object, given the bytes of its file, in the file's order. Throws Refusal
// unless the bytes are a whole shared object for this machine.
std::vector<std::string> elf_sections(std::string_view bytes);

}  // namespace muster
