#include "diagnosis/cause_model.hpp"

#include <algorithm>
#include <cstring>

#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

InstanceDeclaration instance_of(const Cause& cause, const std::string& name, const std::string& row,
                                const Place& place) {
  InstanceDeclaration result{cause.id, name, 1, {}, {}, {}, place};
  const auto give = [&](const std::string& attribute, const std::string& value) {
    result.attributes.push_back({attribute, value, place, place});
  };
  for (uint32_t k = 0; k < cause.plugin->param_count; ++k) {
    const muster_param& p = cause.plugin->params[k];
    if (&p == cause.linear())
      give(p.name, "1");
    else if (&p == cause.row() && !row.empty())
      give(p.name, row);
    else if (p.kind == MUSTER_REAL && (p.flags & MUSTER_REQUIRED))
      give(p.name, print_real(p.value));
  }
  return result;
}

}  // namespace

const muster_param* Cause::linear() const {
  const muster_param* result = nullptr;
  for (uint32_t k = 0; k < plugin->param_count; ++k) {
    if (!(plugin->params[k].flags & MUSTER_LINEAR)) continue;
    if (result) return nullptr;
    result = &plugin->params[k];
  }
  return result;
}

const muster_param* Cause::row() const {
  for (uint32_t k = 0; k < plugin->param_count; ++k) {
    if (plugin->params[k].kind == MUSTER_REFERENCE && !std::strcmp(plugin->params[k].name, meaning().ranges_over))
      return &plugin->params[k];
  }
  return nullptr;
}

std::vector<Cause> causes_on(const Library::SearchPath& plugins) {
  std::vector<Cause> result;
  for (const ListedPlugin& listed : list_plugins(plugins)) {
    if (!listed.library) continue;
    const muster_plugin& newest = listed.library->plugins().back();
    const std::string id(listed.library->id());
    const bool known = std::any_of(result.begin(), result.end(), [&](const Cause& c) { return c.id == id; });
    if (newest.cause && !known) result.push_back({id, listed.library, &newest});
  }
  std::sort(result.begin(), result.end(), [](const Cause& a, const Cause& b) { return a.id < b.id; });
  return result;
}

CauseModel::CauseModel(const Cause& cause, const std::filesystem::path& world, const std::filesystem::path& data,
                       const Library::SearchPath& plugins, const std::vector<std::string>& rows,
                       const std::map<std::string, double>& world_parameters)
    : count_(rows.size()) {
  World bare = read_world(world, standard());
  bare.instances.clear();
  bare.swaps.clear();
  bare.records.clear();
  const Place place{bare.file.string()};
  Options options;
  options.search_path = plugins;
  const std::string file = std::filesystem::absolute(data).string();
  options.more.push_back({"data.links", "data", 1, {}, {}, {{"file", file, place, place}}, place});
  for (std::size_t k = 0; k < rows.size(); ++k) options.more.push_back(instance_of(cause, name_of(k), rows[k], place));
  run_ = std::make_unique<Simulation>(std::move(bare), standard(), std::move(options));
  // Tables that the cause does not read are not there.
  for (const ParameterInfo& p : run_->parameters()) {
    if (const auto found = world_parameters.find(p.path); found != world_parameters.end())
      run_->set_parameter(p.path, found->second);
  }
}

Eigen::VectorXd CauseModel::column(std::size_t row, const std::map<std::string, double>& parameters) {
  if (!evaluated_ || parameters != now_) {
    for (std::size_t k = 0; k < count_; ++k) {
      for (const auto& [name, value] : parameters) run_->set_parameter(name_of(k) + '/' + name, value);
    }
    run_->evaluate(MUSTER_RADIO, true);
    now_ = parameters;
    evaluated_ = true;
  }
  const TableView part = run_->table("link/*/level@" + name_of(row));
  Eigen::VectorXd result(static_cast<Eigen::Index>(part.rows()));
  for (std::size_t i = 0; i < part.rows(); ++i) result[static_cast<Eigen::Index>(i)] = part.at(i, 0);
  return result;
}

}  // namespace muster::diagnosis
