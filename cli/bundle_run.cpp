#include "bundle_run.hpp"

#include <bit>
#include <filesystem>
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

void add_named_file(const std::string& named, bundle::WorldFiles& files) {
  const std::filesystem::path file = files.folder() / named;
  std::error_code none;
  if (!named.empty() && std::filesystem::is_regular_file(file, none) && !files.has(file)) files.add_data(file);
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

void add_robots(const World& world, bundle::WorldFiles& files) {
  for (const RowDeclaration& row : world.rows) {
    const auto text = [&](const char* name) {
      const auto found = world.texts.find(row.set + '/' + row.name + '/' + name);
      return found == world.texts.end() ? std::string() : found->second;
    };
    if (row.set == "robot") files.add_robot(text("model"), text("packages"), text("fittings"));
  }
}

void add_default_files(const muster_plugin& plugin, const InstanceDeclaration& declared, bundle::WorldFiles& files) {
  for (uint32_t i = 0; i < plugin.param_count; ++i) {
    const muster_param& param = plugin.params[i];
    if (param.kind == MUSTER_FILE && param.text && !declared.attribute(param.name)) add_named_file(param.text, files);
  }
}

void add_files_of_instances(const Simulation& run, bundle::WorldFiles& files) {
  for (const auto& instance : run.instances()) {
    for (const XmlAttribute& given : instance->declared().attributes) add_named_file(given.value, files);
    add_default_files(instance->plugin(), instance->declared(), files);
  }
}

}  // namespace muster::cli
