// Work in parts, each of which is done even where another fails.
#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <optional>
#include <string_view>

#include "text/error.hpp"

namespace muster::cli {

// Runs all parts of a work, and then throws the first Error among theirs; the others are told.
class AllParts {
 public:
  template <class Part>
  void run(Part&& part) try {
    part();
  } catch (const Error& e) {
    if (!first_)
      first_ = e;
    else if (std::string_view(e.what()) != first_->what())
      fmt::print(stderr, "muster: error: {}\n", e.what());
  }
  void throw_first() const {
    if (first_) throw Error(*first_);
  }

 private:
  std::optional<Error> first_;
};

}  // namespace muster::cli
