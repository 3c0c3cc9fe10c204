// Temporary files for tests, and errors as text.
#pragma once

#include <functional>
#include <string>

#include "tests/folder.hpp"

namespace muster::diagnosis {

using Scratch = test::Folder;
using test::contents;

// The error message, without the folder of the file; "" without an error.
inline std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& e) {
    std::string text = e.what();
    const std::size_t slash = text.substr(0, text.find(": ")).rfind('/');
    return text[0] != '/' || slash == text.npos ? text : text.substr(slash + 1);
  }
  return "";
}

}  // namespace muster::diagnosis
