#include "saved_run.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "run_options.hpp"
#include "text/number.hpp"
#include "text/text_file.hpp"

namespace muster::cli {

SavedRun::SavedRun(std::string file, const std::optional<std::string>& every, double dt) : file_(std::move(file)) {
  if (file_.empty()) return;
  if (::access(std::filesystem::absolute(file_).parent_path().c_str(), W_OK | X_OK) != 0)
    throw Error(Exit::io, Place{file_}, "cannot be written: " + system_message(errno));
  if (!every) return;
  const double seconds = real_of(*every, "--save-every", "s");
  if (!(seconds >= dt))
    throw Error(Exit::invalid_input, "--save-every: " + *every + " s is less than a tick of " + print_real(dt) +
                                         " s; expected at least that");
  every_ = ticks_of(seconds, dt, {"--save-every"});
}

void SavedRun::after_tick(const Simulation& run) const {
  if (every_ > 0 && run.tick() % every_ == 0 && !run.done()) run.snapshot().save(file_);
}

bool SavedRun::at_end(const Simulation& run) const {
  if (file_.empty()) return false;
  run.snapshot().save(file_);
  return true;
}

}  // namespace muster::cli
