// Checks what a cause without a level shift declares, by its functions and by the simulator's draws: a law of readings,
// a clip, a burst.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/causes/cause_model.hpp"

namespace muster::diagnosis {

struct DeclarationCheck {
  std::string what, found;  // "density", "integrates to 1 within 2e-6 at 7 settings; expected within 1e-3"
  bool fine = true;
};

// The cause with this id. Throws Error if it is not on the path, with the reason if its library cannot be loaded.
Cause cause_on(const Library::SearchPath& plugins, const std::string& id);

// `world`: a folder with world.xml and measured.csv, whose radios and times are used. Throws Error if the cause
// declares nothing of this.
std::vector<DeclarationCheck> check_declared_law(const Cause& cause, const std::filesystem::path& world,
                                                 const Library::SearchPath& plugins);

}  // namespace muster::diagnosis
