#include "run_log/run_log.hpp"

#include "text/number.hpp"

namespace muster::run_log {

RunLog::RunLog(const Simulation& run, const std::vector<RecordDeclaration>& tables, const std::filesystem::path& file,
               const std::string& version)
    : writer_(file, {"ros2", "muster " + version}), messages_(run, tables, writer_) {
  const World& world = run.world();
  writer_.metadata({"muster.run",
                    {{"world", world.name},
                     {"file", world.file.string()},
                     {"seed", std::to_string(world.seed)},
                     {"dt", print_real(world.dt)},
                     {"until", print_real(world.until())},
                     {"version", version}}});
}

void RunLog::close(const Simulation& run) {
  constexpr char digits[] = "0123456789abcdef";
  std::string digest;
  const std::uint64_t bits = run.digest();
  for (int shift = 60; shift >= 0; shift -= 4) digest += digits[bits >> shift & 15];
  writer_.metadata({"muster.outcome",
                    {{"ticks", std::to_string(run.tick())}, {"time", print_real(run.time())}, {"digest", digest}}});
  writer_.close();
}

}  // namespace muster::run_log
