// muster bundle check FILE: whether a bundle is whole, what differs here from where it was made, and whether its run
// comes to the same digest here.
#pragma once

#include <string>
#include <vector>

#include "text/error.hpp"

namespace muster::cli {

struct BundleCheckWords {
  std::string file, out;
  std::vector<std::string> plugins;
  int workers = 1;
  bool own_plugins = true, json = false;
};

// Throws Error.
Exit check_bundle(const BundleCheckWords& words);

}  // namespace muster::cli
