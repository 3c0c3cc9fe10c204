#include "bundle_run.hpp"

#include <bit>
#include <muster/random.hpp>

#include "run_options.hpp"

namespace muster::cli {
namespace {

std::string digest_of_table(const Snapshot::SavedTable& table) {
  uint64_t digest = combined(key_of(table.columns), table.cells.rows);
  for (const double value : table.cells.data) digest = combined(digest, std::bit_cast<uint64_t>(value));
  for (const uint64_t tick : table.cells.appended) digest = combined(digest, tick);
  for (const Blob& blob : table.cells.blobs)
    digest = combined(digest, key_of({reinterpret_cast<const char*>(blob->data()), blob->size()}));
  return hexadecimal(digest);
}

bundle::Waymark waymark_of(const Simulation& run) {
  const Snapshot now = run.snapshot();
  bundle::Waymark result{run.tick(), hexadecimal(now.digest()), {}};
  for (const auto& [name, table] : now.tables) result.tables[name] = digest_of_table(table);
  return result;
}

}  // namespace

std::vector<bundle::Waymark> waymarks_of(Simulation& run, const std::string& title) {
  Progress progress(title);
  std::vector<bundle::Waymark> result{waymark_of(run)};
  while (!run.done()) {
    if (interrupted()) throw Error(Exit::interrupted, "interrupted at " + std::to_string(run.time()) + " s");
    run.step();
    if (run.done() || std::has_single_bit(run.tick())) result.push_back(waymark_of(run));
    progress.at(static_cast<double>(run.tick()) / static_cast<double>(run.world().ticks));
  }
  return result;
}

}  // namespace muster::cli
