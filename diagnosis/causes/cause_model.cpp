#include "diagnosis/causes/cause_model.hpp"

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

std::string name_of(std::size_t row) { return "cause" + std::to_string(row); }

template <class Is>
std::vector<const muster_param*> those(const muster_plugin& plugin, const Is& is) {
  std::vector<const muster_param*> result;
  for (uint32_t k = 0; k < plugin.param_count; ++k) {
    if (is(plugin.params[k])) result.push_back(&plugin.params[k]);
  }
  return result;
}

// True for edits of the world, such as places of radios, on which all terms depend.
bool edits_world(const Instance& instance) {
  const muster_cause* const cause = instance.plugin().cause;
  return cause && (cause->kind == MUSTER_WORLD_EDIT || cause->kind == MUSTER_INSTRUMENT);
}

World bare_world(const std::filesystem::path& file, const Standard& sets, const Simulation& whole) {
  World bare = read_world(file, sets);
  std::erase_if(bare.instances, [&](const InstanceDeclaration& declared) {
    return std::none_of(whole.instances().begin(), whole.instances().end(), [&](const auto& instance) {
      return instance->name() == declared.name && edits_world(*instance);
    });
  });
  bare.stand_still();
  bare.records.clear();
  return bare;
}

}  // namespace

const muster_param& Cause::parameter(const std::string& name) const {
  return *those(*plugin, [&](const muster_param& p) { return p.name == name; }).at(0);
}

std::vector<const muster_param*> Cause::linear() const {
  return those(*plugin, [](const muster_param& p) { return (p.flags & MUSTER_LINEAR) != 0; });
}

std::vector<const muster_param*> Cause::rows() const {
  std::istringstream words(meaning().ranges_over);
  std::vector<const muster_param*> result;
  for (std::string word; words >> word;) {
    for (const muster_param* p : those(*plugin, [&](const muster_param& q) { return q.name == word; }))
      if (p->kind == MUSTER_REFERENCE) result.push_back(p);
  }
  return result;
}

const muster_param* Cause::file() const {
  const auto files = those(*plugin, [](const muster_param& p) { return p.kind == MUSTER_FILE; });
  return files.empty() ? nullptr : files[0];
}

bool Cause::needs_world() const {
  // A text parameter names another instance, on which the effect depends.
  return meaning().kind != MUSTER_TERM ||
         !those(*plugin, [](const muster_param& p) { return p.kind == MUSTER_TEXT; }).empty();
}

namespace {

bool has_flag(const muster_cause& cause, std::uint32_t flag) {
  const bool has_flags = cause.size >= offsetof(muster_cause, flags) + sizeof cause.flags;
  return has_flags && (cause.flags & flag) != 0;
}

}  // namespace

bool Cause::needs_own_world() const { return has_flag(meaning(), MUSTER_OWN_WORLD); }
bool Cause::needs_both_ends() const { return has_flag(meaning(), MUSTER_BOTH_ENDS); }

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

InstanceDeclaration instance_of(const Cause& cause, const std::string& name, const CauseRow& row,
                                const std::filesystem::path& table, double linear, const Place& place) {
  InstanceDeclaration result{cause.id, name, 1, {}, {}, {}, place};
  const auto give = [&](const std::string& attribute, const std::string& value) {
    result.attributes.push_back({attribute, value, place, place});
  };
  const auto references = cause.rows();
  for (uint32_t k = 0; k < cause.plugin->param_count; ++k) {
    const muster_param& p = cause.plugin->params[k];
    const auto reference = std::find(references.begin(), references.end(), &p);
    if (p.flags & MUSTER_LINEAR) {
      give(p.name, print_real(linear));
    } else if (reference != references.end()) {
      const std::string& named = row[static_cast<std::size_t>(reference - references.begin())];
      if (!named.empty()) give(p.name, named);
    } else if (p.kind == MUSTER_FILE && !table.empty()) {
      give(p.name, std::filesystem::absolute(table).string());
    } else if (p.kind == MUSTER_REAL && (p.flags & MUSTER_REQUIRED)) {
      give(p.name, print_real(p.value));
    }
  }
  return result;
}

std::map<std::string, std::string> names_of_instances(const Cause& cause, const Simulation& world) {
  std::map<std::string, std::string> result;
  for (uint32_t k = 0; k < cause.plugin->param_count; ++k) {
    const muster_param& p = cause.plugin->params[k];
    if (p.kind != MUSTER_TEXT || !p.text || !*p.text) continue;
    for (const auto& instance : world.instances()) {
      if (instance->name() == p.text) result.erase(p.name);
      if (instance->name() == p.text) break;
      if (instance->declared().plugin == p.text) result.try_emplace(p.name, instance->name());
    }
  }
  return result;
}

CauseModel::CauseModel(MeasuredWorld& whole, const std::filesystem::path& world, const std::filesystem::path& data,
                       const Library::SearchPath& plugins)
    : observable_(whole.observable()), whole_(whole.simulation()), data_(data) {
  World bare = bare_world(world, *observable_.sets, whole_);
  Options options;
  options.search_path = plugins;
  options.tables = whole.tables();
  options.libraries = whole.libraries();
  options.more.push_back(whole.observable().stand_in);
  bare_ = std::make_unique<Simulation>(std::move(bare), *observable_.sets, std::move(options));
  before_ = whole.expected();
}

void CauseModel::remove(Simulation& run, Present& present) {
  std::vector<std::string> names;
  for (std::size_t k = present.first; k < present.first + present.count; ++k) names.push_back(name_of(k));
  if (!names.empty()) run.remove_all(names);
  present = {};
}

void CauseModel::clear() {
  remove(whole_, in_whole_);
  remove(*bare_, in_bare_);
}

void CauseModel::put(Simulation& run, Present& present, const Cause& cause, const std::vector<CauseRow>& rows,
                     std::size_t first, std::size_t count) {
  if (present.cause == cause.id && present.first == first && present.count == count) return;
  remove(run, present);
  const Place place{run.world().file.string()};
  std::vector<InstanceDeclaration> declarations;
  for (std::size_t k = first; k < first + count; ++k) {
    declarations.push_back(instance_of(cause, name_of(k), rows[k], cause.file() ? data_ : "", 1, place));
    for (const auto& [text, name] : names_of_instances(cause, whole_))
      declarations.back().attributes.push_back({text, name, place, place});
  }
  run.share(cause.library);
  run.insert_all(std::move(declarations));
  present = {cause.id, first, count, {}, {}};
  // Parameters of tables read for the first time are at declared values: set them to the fitted ones.
  if (&run == &whole_) return;
  std::map<std::string, double> fitted;
  for (const ParameterInfo& p : whole_.parameters()) fitted[p.path] = p.value;
  for (const ParameterInfo& p : run.parameters()) {
    if (p.path.rfind("material/", 0) == 0 && fitted.count(p.path)) run.set_parameter(p.path, fitted[p.path]);
  }
}

void CauseModel::evaluate(Simulation& run, Present& present, const std::map<std::string, double>& parameters) {
  if (parameters == present.at) return;
  for (std::size_t k = present.first; k < present.first + present.count; ++k) {
    for (const auto& [name, value] : parameters) run.set_parameter(name_of(k) + '/' + name, value);
  }
  run.evaluate(observable_.phase, true);
  present.at = parameters;
}

const std::vector<Eigen::VectorXd>& CauseModel::added_at(const std::map<std::string, double>& parameters) {
  constexpr std::size_t most = 2;  // both columns of a wave are needed for each row in turn
  auto& recent = in_bare_.recent;
  for (Evaluated& e : recent) {
    if (e.parameters == parameters) return e.added;
  }
  evaluate(*bare_, in_bare_, parameters);
  Evaluated now{parameters, {}};
  for (std::size_t row = 0; row < in_bare_.count; ++row) {
    const FirstColumn level = first_column(bare_->table(observable_.terms + '@' + name_of(row)));
    now.added.emplace_back(before_.size());
    for (Eigen::Index i = 0; i < before_.size(); ++i) now.added.back()[i] = level[i];
  }
  if (recent.size() == most) recent.pop_back();
  return recent.insert(recent.begin(), std::move(now))->added;
}

void CauseModel::fill(const Cause& cause, const std::vector<CauseRow>& rows, std::size_t row,
                      const std::map<std::string, double>& parameters, const std::vector<Eigen::Index>& readings,
                      Eigen::Ref<Eigen::VectorXd> column) {
  const auto fill_by = [&](const auto& value) {
    for (Eigen::Index i = 0; i < column.size(); ++i) column[i] = value(readings[static_cast<std::size_t>(i)]);
  };
  if (cause.needs_world()) {
    put(whole_, in_whole_, cause, rows, row, 1);
    evaluate(whole_, in_whole_, parameters);
    const FirstColumn with = first_column(whole_.table(observable_.measured));
    fill_by([&](Eigen::Index reading) { return with[reading] - before_[reading]; });
  } else {
    put(*bare_, in_bare_, cause, rows, 0, rows.size());
    if (rows.size() > 1) {
      const Eigen::VectorXd& added = added_at(parameters)[row];
      fill_by([&](Eigen::Index reading) { return added[reading]; });
    } else {
      evaluate(*bare_, in_bare_, parameters);
      const FirstColumn added = first_column(bare_->table(observable_.terms + '@' + name_of(row)));
      fill_by([&](Eigen::Index reading) { return added[reading]; });
    }
  }
}

}  // namespace muster::diagnosis
