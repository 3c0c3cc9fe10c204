#include "compared_run.hpp"

#include <muster/tables.hpp>

namespace muster::cli {

void ComparedRun::write_to(const std::filesystem::path& here) {
  folder = here;
  recorder = std::make_unique<Recorder>(*run, run->world().records, folder);
  pictures = std::make_unique<RunPictures>(*run);
  recorder->write(*run);
  pictures->look(*run);
}

// What a plugin does wrong ends this run, not the others.
void ComparedRun::step() {
  try {
    run->step();
  } catch (const Error& e) {
    if (e.exit() == Exit::io || e.exit() == Exit::internal) throw;
    fault = e;
    return;
  }
  if (recorder) recorder->write(*run), pictures->look(*run);
}

void ComparedRun::look_at_robots() {
  const Table* poses = run->board().find("robot/*/pose");
  if (!poses || poses->columns().text() != Pose::columns) return;
  for (std::size_t row = 0; row < poses->now().rows; ++row) {
    if (!poses->set().alive[row]) continue;
    const auto& pose = reinterpret_cast<const Pose*>(poses->now().data.data())[row];
    ways[poses->set().names[row]].push_back({pose.x, pose.y});
  }
}

void ComparedRun::finish() {
  if (!recorder) return;
  files = recorder->close();
  for (auto& file : pictures->write(folder)) files.push_back(std::move(file));
}

}  // namespace muster::cli
