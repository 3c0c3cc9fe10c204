#include "diagnosis/radio/links/link_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/data/clock.hpp"
#include "text/number.hpp"
#include "text/text_table.hpp"

namespace muster::diagnosis {
namespace {

constexpr const char* stand_in = "data";  // name of the instance of data.links

// True for instances that list links, which the measured links replace.
bool lists_links(const InstanceDeclaration& instance) {
  return instance.plugin == "radio.links" || instance.plugin == "data.links";
}

// False also if the file is no table: its reader then reports the error.
bool has_columns_of(const TextTable& data, const std::filesystem::path& file, TableCache& tables) try {
  const auto table = tables.read(file);
  return std::all_of(table->columns().begin(), table->columns().end(), [&](const TextColumn& column) {
    const auto found = data.find(column.name);
    return found && data.columns()[*found].unit == column.unit;
  });
} catch (const Error&) {
  return false;
}

// Replaces an instance's `file` by the data if these have all of its columns. The file's settings over time, such as
// transmit powers, belong to another measurement.
void take_settings_from(const std::filesystem::path& data, World& world, TableCache& tables) {
  for (InstanceDeclaration& instance : world.instances) {
    for (XmlAttribute& attribute : instance.attributes) {
      if (attribute.name != "file") continue;
      if (has_columns_of(*tables.read(data), world.file.parent_path() / attribute.value, tables))
        attribute.value = std::filesystem::absolute(data).string();
    }
  }
}

// Throws Error with the first place of the data beyond the scene: the scene's own error cites only the world's file.
void refuse_far_places(const std::filesystem::path& data) {
  constexpr double farthest = 100'000;  // m, as of the scene
  const TextTable table = TextTable::read(data);
  std::optional<std::pair<std::size_t, std::size_t>> first;  // row, column
  double far = 0;
  for (const char* name : {"tx_x", "tx_y", "tx_z", "rx_x", "rx_y", "rx_z", "distance"}) {
    const auto column = table.find(name);
    if (!column) continue;
    const std::vector<double> places = table.reals(*column, {.empty = true});
    const auto at = std::find_if(places.begin(), places.end(), [](double v) { return std::abs(v) > farthest; });
    const std::pair here(static_cast<std::size_t>(at - places.begin()), *column);
    if (at == places.end() || (first && *first < here)) continue;
    first = here;
    far = *at;
  }
  if (first)
    throw invalid(table.place(first->first, first->second),
                  "row " + std::to_string(first->first + 1) + ": " + print_real(far) +
                      " m lies beyond the world's scene; expected metres within " + fmt::format("{:.0f}", farthest) +
                      " m (is it another unit, such as millimetres?)");
}

World world_for(const std::filesystem::path& file, const std::filesystem::path& data, TableCache& tables,
                std::optional<uint64_t> seed) {
  World world = read_world(file, standard());
  world.seed = seed.value_or(world.seed);
  std::vector<std::string> told_by_the_data_set;
  tables.put(data, with_clock_in_seconds(tables.read(data), told_by_the_data_set));
  std::erase_if(world.instances, lists_links);
  world.stand_still();  // readings are evaluated, and no time passes
  take_settings_from(data, world, tables);
  return world;
}

Options options_for(const World& world, const Library::SearchPath& plugins, const std::shared_ptr<TableCache>& tables,
                    const std::vector<std::shared_ptr<Library>>& libraries) {
  const Place place{world.file.string()};
  Options options;
  options.search_path = plugins;
  options.tables = tables;
  options.libraries = libraries;
  const auto is_receiver = [](const InstanceDeclaration& i) { return i.plugin == "radio.receiver"; };
  if (std::none_of(world.instances.begin(), world.instances.end(), is_receiver))
    options.more.push_back({"radio.receiver", "receiver", 1, {}, {}, {}, place});
  return options;
}

}  // namespace

InstanceDeclaration measured_links(const std::filesystem::path& file, const Place& place) {
  return {"data.links", stand_in, 1, {}, {}, {{"file", std::filesystem::absolute(file).string(), place, place}}, place};
}

namespace {

Observable links_of(const std::filesystem::path& data, const Place& place) {
  return {MUSTER_RADIO, "link/*/level", "link/*/rssi", measured_links(data, place)};
}

}  // namespace

LinkModel::LinkModel(const std::filesystem::path& world, const std::filesystem::path& data,
                     const Library::SearchPath& plugins, const std::shared_ptr<TableCache>& tables,
                     std::optional<uint64_t> seed, const std::vector<std::shared_ptr<Library>>& libraries)
    : LinkModel(world_for(world, data, *tables, seed), data, plugins, tables, libraries) {}

LinkModel::LinkModel(const World& declared, const std::filesystem::path& data, const Library::SearchPath& plugins,
                     const std::shared_ptr<TableCache>& tables,
                     const std::vector<std::shared_ptr<Library>>& libraries) try
    : MeasuredWorld(declared, options_for(declared, plugins, tables, libraries),
                    links_of(data, {declared.file.string()})) {
  ends_ = ends_now();
} catch (const Error& error) {
  if (std::string_view(error.what()).find("beyond the scene") != std::string_view::npos) refuse_far_places(data);
  throw;
}

std::vector<std::array<End, 2>> LinkModel::ends_now() const {
  const TableView pose = simulation().table("endpoint/*/pose"), radio = simulation().table("endpoint/*/radio");
  const auto end = [&](std::size_t i) {
    const double qw = pose.at(i, 3), qx = pose.at(i, 4), qy = pose.at(i, 5), qz = pose.at(i, 6);
    return End{pose.at(i, 0), pose.at(i, 1), pose.at(i, 2),
               std::atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz)), static_cast<int>(radio.at(i, 0))};
  };
  const TableView link = simulation().table("link/*/ends");
  std::vector<std::array<End, 2>> result;
  for (std::size_t i = 0; i < link.rows(); ++i)
    result.push_back({end(static_cast<std::size_t>(link.at(i, 0))), end(static_cast<std::size_t>(link.at(i, 1)))});
  return result;
}

const std::vector<std::string>& LinkModel::radio_names() const { return simulation().board().find_set("radio")->names; }

std::string LinkModel::radio_name(int radio) const { return radio_names().at(static_cast<std::size_t>(radio)); }

std::vector<std::string> LinkModel::added_radios() const {
  std::vector<std::string> result = radio_names();
  for (const RowDeclaration& row : simulation().world().rows) {
    if (std::find(row.sets.begin(), row.sets.end(), "radio") != row.sets.end()) std::erase(result, row.name);
  }
  return result;
}

std::optional<LinkModel::Carrier> LinkModel::carrier() const {
  std::optional<Carrier> result;
  for (const auto& instance : simulation().instances()) {
    const muster_plugin& plugin = instance->plugin();
    const int at = plugin.phase == MUSTER_RADIO ? instance->find_param("frequency") : -1;
    if (at < 0 || std::string_view(plugin.params[at].unit) != "Hz") continue;
    const bool is_written = instance->declared().attribute("frequency") != nullptr;
    if (!result || is_written) result = {instance->params()[static_cast<std::size_t>(at)], is_written};
    if (is_written) break;
  }
  return result;
}

std::optional<End> LinkModel::first_end(const std::string& radio) const {
  const auto number = static_cast<int>(simulation().board().find_set("radio")->find(radio));
  for (const auto& ends : ends_) {
    for (const End& end : ends)
      if (end.radio == number) return end;
  }
  return {};
}

std::set<std::string> LinkModel::link_of(int one, int other) const { return {radio_name(one), radio_name(other)}; }

Eigen::VectorXd LinkModel::changes_nearby(double metres) {
  const Eigen::VectorXd here = expected();
  Eigen::VectorXd most = Eigen::VectorXd::Zero(here.size());
  for (const char* way : {"/aside", "/along"}) {
    ParameterGuard moved(*this);
    for (const double by : {-metres, metres}) {
      moved.set(stand_in + std::string(way), by);
      most = most.cwiseMax((expected() - here).cwiseAbs());
    }
  }
  return most;
}

}  // namespace muster::diagnosis
