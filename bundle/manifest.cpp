#include "manifest.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "archive.hpp"
#include "sha256.hpp"
#include "text/error.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/text_file.hpp"

namespace muster::bundle {
namespace {

namespace fs = std::filesystem;

constexpr const char format_name[] = "muster.bundle.1";
constexpr std::uint64_t most_of_manifest = 64 << 20;

class ManifestReader {
 public:
  explicit ManifestReader(const fs::path& file) : place_{file.string()} {
    const TextFile text = read_text_file(file, most_of_manifest);
    json_ = nlohmann::json::parse(text.text, nullptr, false);
    if (json_.is_discarded()) refuse("is no JSON");
    if (!json_.is_object()) refuse("is no list of a bundle");
    if (const std::string format = text_at(json_, "format"); format != format_name)
      refuse("is of the format " + quote(format) + ", and this version of muster reads " + quote(format_name));
  }

  Manifest read() const {
    Manifest result;
    result.date = text_at(json_, "date");
    result.muster = text_at(json_, "muster");
    const auto& machine = at(json_, "machine");
    result.machine = {text_at(machine, "system"), text_at(machine, "architecture"),
                      text_at(machine, "libc"),   text_at(machine, "compiler"),
                      text_at(machine, "cpu"),    texts_at(machine, "cpu_features")};
    const auto& run = at(json_, "run");
    result.world = text_at(run, "world");
    result.seed = number_at(run, "seed"), result.ticks = number_at(run, "ticks");
    const auto& dt = at(run, "dt");
    if (!dt.is_number() || !(dt.get<double>() > 0)) refuse("\"dt\" is no time");
    result.dt = dt.get<double>();
    result.set = texts_at(run, "set");
    for (const auto& one : array_at(json_, "files"))
      result.files.push_back({text_at(one, "name"), number_at(one, "bytes"), text_at(one, "sha256"),
                              one.contains("named") ? text_at(one, "named") : ""});
    for (const auto& one : array_at(json_, "plugins"))
      result.plugins.push_back({text_at(one, "id"), text_at(one, "file")});
    for (const auto& one : array_at(json_, "waymarks")) {
      Waymark mark{number_at(one, "tick"), text_at(one, "digest"), {}};
      const auto& tables = at(one, "tables");
      if (!tables.is_object()) refuse("\"tables\" is no object");
      for (const auto& [name, digest] : tables.items()) {
        if (!digest.is_string()) refuse("a digest of \"tables\" is no text");
        mark.tables[name] = digest.get<std::string>();
      }
      result.waymarks.push_back(std::move(mark));
    }
    check(result);
    return result;
  }

 private:
  void check(const Manifest& manifest) const {
    std::set<std::string> names;
    for (const ListedFile& file : manifest.files) {
      if (const std::string fault = fault_of_name(file.name); !fault.empty())
        refuse("lists " + quote(file.name) + ", " + fault);
      if (file.name == manifest_name || !names.insert(file.name).second)
        refuse("lists " + quote(file.name) + " more than once");
    }
    if (!names.count(manifest.world)) refuse("does not list the world " + quote(manifest.world));
    for (const ListedPlugin& plugin : manifest.plugins)
      if (!names.count(plugin.file)) refuse("does not list the plugin " + quote(plugin.file));
    std::uint64_t next = 0;
    for (const Waymark& mark : manifest.waymarks) {
      if (mark.tick < next) refuse("has digests that are not in order of ticks");
      next = mark.tick + 1;
    }
    if (manifest.waymarks.empty() || manifest.waymarks.back().tick != manifest.ticks)
      refuse("has no digest of the end of its run");
  }

  const nlohmann::json& at(const nlohmann::json& from, const char* name) const {
    if (!from.is_object() || !from.contains(name)) refuse("has no " + quote(name));
    return from.at(name);
  }
  std::string text_at(const nlohmann::json& from, const char* name) const {
    const auto& value = at(from, name);
    if (!value.is_string()) refuse(quote(name) + " is no text");
    return value.get<std::string>();
  }
  std::uint64_t number_at(const nlohmann::json& from, const char* name) const {
    const auto& value = at(from, name);
    if (!value.is_number_unsigned()) refuse(quote(name) + " is no whole number");
    return value.get<std::uint64_t>();
  }
  const nlohmann::json& array_at(const nlohmann::json& from, const char* name) const {
    const auto& value = at(from, name);
    if (!value.is_array()) refuse(quote(name) + " is no list");
    return value;
  }
  std::vector<std::string> texts_at(const nlohmann::json& from, const char* name) const {
    std::vector<std::string> result;
    for (const auto& one : array_at(from, name)) {
      if (!one.is_string()) refuse(quote(name) + " is no list of texts");
      result.push_back(one.get<std::string>());
    }
    return result;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw invalid(place_, what + "; expected the " + manifest_name + " that `muster bundle` wrote");
  }

  Place place_;
  nlohmann::json json_;
};

}  // namespace

std::string text_of(const Manifest& manifest) {
  const Machine& machine = manifest.machine;
  Json json{{"format", format_name},
            {"date", manifest.date},
            {"muster", manifest.muster},
            {"machine",
             {{"system", machine.system},
              {"architecture", machine.architecture},
              {"libc", machine.libc},
              {"compiler", machine.compiler},
              {"cpu", machine.cpu},
              {"cpu_features", machine.cpu_features}}},
            {"run",
             {{"world", manifest.world},
              {"seed", manifest.seed},
              {"dt", manifest.dt},
              {"ticks", manifest.ticks},
              {"set", manifest.set}}},
            {"digest", manifest.waymarks.back().digest},
            {"plugins", Json::array()},
            {"files", Json::array()},
            {"waymarks", Json::array()}};
  for (const ListedPlugin& plugin : manifest.plugins)
    json["plugins"].push_back({{"id", plugin.id}, {"file", plugin.file}});
  for (const ListedFile& file : manifest.files) {
    Json one{{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}};
    if (!file.named.empty()) one["named"] = file.named;
    json["files"].push_back(std::move(one));
  }
  for (const Waymark& mark : manifest.waymarks) {
    Json one{{"tick", mark.tick}, {"digest", mark.digest}, {"tables", Json::object()}};
    for (const auto& [name, digest] : mark.tables) one["tables"][name] = digest;
    json["waymarks"].push_back(std::move(one));
  }
  return json.dump(1) + '\n';
}

Manifest read_manifest(const fs::path& file) { return ManifestReader(file).read(); }

Faults faults_of(const fs::path& folder, const Manifest& manifest) {
  Faults result;
  std::set<std::string> listed{manifest_name};
  for (const ListedFile& file : manifest.files) {
    listed.insert(file.name);
    const fs::path path = folder / file.name;
    if (!fs::is_regular_file(fs::symlink_status(path)))
      result.missing.push_back(file.name);
    else if (fs::file_size(path) != file.bytes || sha256_of(path) != file.sha256)
      result.changed.push_back(file.name);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_directory() && !listed.count(name)) result.extra.push_back(name);
  }
  std::sort(result.extra.begin(), result.extra.end());
  return result;
}

}  // namespace muster::bundle
