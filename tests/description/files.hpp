// Files made for one test and removed after it.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/folder.hpp"

namespace muster::description {

using Files = test::Folder;

// The text that the call throws; fails the test if it throws nothing.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace muster::description
