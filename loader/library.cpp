#include "library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#define BOOST_DLL_USE_STD_FS  // else Boost.DLL 1.74 needs Boost.Filesystem
#include <boost/core/demangle.hpp>
#include <boost/dll/shared_library.hpp>

#include "elf.hpp"
#include "library_copy.hpp"
#include "library_doubts.hpp"
#include "library_probe.hpp"
#include "process_guard.hpp"
#include "registration.hpp"
#include "text/names.hpp"
#include "text/synonyms.hpp"

namespace muster {

namespace {

bool is_mapped(const std::string& name) {
  void* found = ::dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD);
  if (found) ::dlclose(found);
  return found != nullptr;
}

}  // namespace

// A library and the copy that it runs from.
struct Library::Module {
  explicit Module(const std::filesystem::path& file) : copy(file) {}
  ~Module() {
    const ProcessGuard guard;  // restores what static destructors change
    library.unload();
    // A surviving thread may have objects of the library to destroy at its end; until then the code must stay mapped.
    if (is_mapped(copy.name())) copy.abandon();
  }
  LibraryCopy copy;
  boost::dll::shared_library library;
};

namespace {

constexpr std::chrono::seconds patience(10);  // for a library to load, register and unload in the child
constexpr std::string_view abi_prefix = "muster.abi.";

// Replaces line breaks and unprintable bytes: a file's words may hold anything, and a message is one line of text.
std::string one_line(std::string_view words) {
  std::string result;
  for (const char c : words) {
    const auto code = static_cast<unsigned char>(c);
    result += code < 0x20 ? ' ' : code < 0x7f ? c : '?';
  }
  return result;
}

// ---- Before anything of it runs ----

// The section survives strip, unlike symbols. elf_sections() finds it; boost::dll::library_info lists the table of
// names instead of the sections, and loses a name that is the end of another one.
void check_abi(const LibraryCopy& copy) {
  const std::string expected = fmt::format("{}{}", abi_prefix, MUSTER_ABI);
  std::string other;
  for (const std::string& section : elf_sections(copy.bytes())) {
    if (section == expected) return;
    if (section.starts_with(abi_prefix)) other = one_line(section.substr(abi_prefix.size()));
  }
  if (other.empty())
    throw Refusal(fmt::format(
        "is a shared library but no muster plugin: it has no section {}; expected MUSTER_PLUGIN_IS(NAME) at "
        "the end of its source, and a build by muster_plugin() of plugin_api",
        expected));
  throw Refusal(fmt::format("is built for plugin ABI {}; this muster has plugin ABI {}; rebuild it against plugin_api",
                            other, MUSTER_ABI));
}

// ---- Loading ----

// The part of a text between two others, the second of which may be its end; null if the first is absent.
std::optional<std::string> between(const std::string& text, std::string_view before, std::string_view after) {
  const std::size_t at = text.find(before);
  if (at == text.npos) return {};
  const std::size_t start = at + before.size();
  return text.substr(start, after.empty() ? text.npos : text.find(after, start) - start);
}

// Rephrases dlerror()'s text. Boost.DLL's own message has the last errno appended, which is unrelated.
std::string why_not_opened(std::string text, const std::string& copy_name) {
  for (std::size_t at; (at = text.find(copy_name)) != text.npos;) text.replace(at, copy_name.size(), "it");
  if (const auto symbol = between(text, "undefined symbol: ", ","))
    return fmt::format("needs {}, which neither it nor a library that it links defines; link what defines it",
                       boost::core::demangle(symbol->c_str()));
  if (const auto version = between(text, ": version `", "' not found"))
    return fmt::format("needs {}, which {} here has not; rebuild it on this machine", *version,
                       text.substr(0, text.find(": version `")));
  const std::size_t absent = text.find(": cannot open shared object file");
  if (absent != text.npos)
    return fmt::format("needs {}, which is not found; install it or link by an absolute run path",
                       text.substr(0, absent));
  return "cannot be loaded: " + (text.starts_with("it: ") ? text.substr(4) : text);
}

void check_unchanged(const ProcessGuard& guard, const char* when) {
  const std::string what = guard.what();
  if (what.empty()) return;
  const bool fast_math = what.find("denormals") != what.npos;
  throw Refusal(fmt::format("{} when {}{}", what, when, fast_math ? "; is it built with -ffast-math?" : ""));
}

std::vector<muster_plugin> open_and_register(boost::dll::shared_library& library, const std::string& name,
                                             const Progress& progress) {
  const ProcessGuard guard;
  progress("it is opened");
  std::error_code failed;
  library.load(name, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local, failed);
  if (!library.is_loaded()) {
    const char* text = ::dlerror();
    throw Refusal(why_not_opened(text ? text : failed.message(), name));
  }
  check_unchanged(guard, "it is opened");
  if (!library.has("muster_register"))
    throw Refusal("does not export muster_register; expected one MUSTER_PLUGIN_IS in it");
  progress("it registers");
  std::vector<muster_plugin> result = registered_plugins(library.get<decltype(muster_register)>("muster_register"));
  check_unchanged(guard, "it registers");
  return result;
}

// In the child: every operation on the library except making instances.
void rehearse(const std::string& name, const Progress& progress) {
  boost::dll::shared_library library;
  open_and_register(library, name, progress);
  const ProcessGuard guard;
  progress("it is closed");
  library.unload();
  check_unchanged(guard, "it is closed");
  if (is_mapped(name))
    throw Refusal(
        "stays mapped when it is closed, and would run old code after a reload; build it with -fno-gnu-unique, "
        "as muster_plugin() does");
}

// ---- Finding ----

std::string file_name(std::string id) {
  std::ranges::replace(id, '.', '_');
  return id + ".so";
}

// The id that a file's name encodes, if its role is one word: radio_one_slope.so is radio.one_slope.
std::string likely_id(const std::filesystem::path& file) {
  std::string result = file.stem().string();
  if (const std::size_t at = result.find('_'); at != result.npos) result[at] = '.';
  return result;
}

std::vector<std::filesystem::path> libraries_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> result;
  std::error_code absent;
  for (auto at = std::filesystem::directory_iterator(folder, absent); at != std::filesystem::directory_iterator();
       at.increment(absent))
    if (at->path().extension() == ".so") result.push_back(at->path());
  std::ranges::sort(result);
  return result;
}

// True if the file has the text of an id, such as "radio.slope/1", as one of its own.
bool holds_id(const std::filesystem::path& file, const std::string& id) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string begin = std::string(1, '\0') + id + '/';
  for (auto at = bytes.find(begin); at != bytes.npos; at = bytes.find(begin, at + 1)) {
    const auto digits = at + begin.size();
    const auto end = bytes.find_first_not_of("0123456789", digits);
    if (end != bytes.npos && end > digits && bytes[end] == '\0') return true;
  }
  return false;
}

// `; build/plugins/radio_one_slope.so has the id radio.slope`: the file is named otherwise than the plugin in it.
std::string under_another_name(const std::string& id, const Library::SearchPath& search_path) {
  for (const std::filesystem::path& folder : search_path) {
    for (const std::filesystem::path& file : libraries_in(folder)) {
      if (!holds_id(file, id)) continue;
      return fmt::format(
          "; {} has the id {}, and a plugin's file is named after it: expected {}, by muster_plugin({} ...) "
          "in its CMakeLists.txt",
          file.string(), id, file_name(id), std::filesystem::path(file_name(id)).stem().string());
    }
  }
  return "";
}

// `; build/plugins has it: expected --plugins build/plugins`, where a build has put it into a folder of its own.
std::string in_a_folder_below(const std::string& id, const Library::SearchPath& search_path) {
  for (const std::filesystem::path& folder : search_path) {
    std::error_code unknown;
    if (const auto below = folder / "plugins"; std::filesystem::exists(below / file_name(id), unknown))
      return fmt::format("; {0} has it: expected {0} in the place of {1}", below.string(), folder.string());
  }
  return "";
}

std::string not_found(const std::string& id, const Library::SearchPath& search_path) {
  std::vector<std::string> folders, ids;
  for (const std::filesystem::path& folder : search_path) {
    folders.push_back(folder.string());
    for (const std::filesystem::path& file : libraries_in(folder)) ids.push_back(likely_id(file));
  }
  // Of one kind no two are near for the word that they begin with: sensors.compass is not sensors.camera.
  const std::string kind = id.substr(0, id.find('.') == id.npos ? 0 : id.find('.') + 1);
  std::erase_if(ids, [&](const std::string& each) {
    if (kind.empty() || !each.starts_with(kind) || each.starts_with(id)) return false;
    const std::string own = id.substr(kind.size());
    return nearest(own, {each.substr(kind.size())}).empty() && synonym(own, {each}).empty();
  });
  const std::string other = under_another_name(id, search_path) + in_a_folder_below(id, search_path);
  return fmt::format(
      "{} not found; looked in {}{}", file_name(id),
      folders.empty() ? "no folder: the plugin path is empty" : fmt::format("{}", fmt::join(folders, ", ")),
      other.empty() ? did_you_mean(id, ids) : other);
}

std::filesystem::path find(const std::string& id, const Library::SearchPath& search_path) {
  if (parse_plugin_id(id + "/1").revision == 0)
    throw Refusal("is no plugin id; expected words of a-z, 0-9 and _ with dots between them");
  for (const std::filesystem::path& folder : search_path) {
    std::filesystem::path file = folder / file_name(id);
    std::error_code unknown;  // a broken link is listed, so that open() can report it
    if (std::filesystem::exists(std::filesystem::symlink_status(file, unknown))) return file;
  }
  throw Refusal(not_found(id, search_path));
}

// ---- Messages ----

// What is to be done where a file's name and the id in it differ.
std::string of_its_name(std::string_view id, const std::string& expected, const muster_plugin& plugin) {
  const std::string other = std::filesystem::path(file_name(std::string(id))).stem().string();
  return fmt::format(
      "; write id = \"{}/{}\" in its source, or muster_plugin({} ...) in its CMakeLists.txt and <{}/> in the world",
      expected, parse_plugin_id(plugin.id).revision, other, id);
}

Error fault(const Place& where, const std::string& plugin_id, const std::string& words) {
  const std::string message = fmt::format("plugin {}: {}", quote(plugin_id), words);
  return where.file.empty() ? Error(Exit::plugin_fault, message) : Error(Exit::plugin_fault, where, message);
}

}  // namespace

LibraryLoader::LibraryLoader(Library::SearchPath search_path)
    : search_path_(std::move(search_path)), probe_(std::make_unique<Probe>(rehearse, patience)) {}

LibraryLoader::~LibraryLoader() = default;

std::shared_ptr<Library> LibraryLoader::open(const std::filesystem::path& file) {
  auto module = std::make_unique<Library::Module>(file);
  check_abi(module->copy);
  const std::string name = module->copy.name();
  if (const std::string why = probe_->try_out(name); !why.empty()) throw Refusal(one_line(why));
  std::vector<muster_plugin> plugins = open_and_register(module->library, name, [](const char*) {});
  const std::string id(parse_plugin_id(plugins.front().id).id);
  std::vector<std::string> doubts = library_doubts(module->copy.bytes(), id);
  std::shared_ptr<Library> result(new Library(file, std::move(module), std::move(plugins)));
  result->doubts_ = std::move(doubts);
  return result;
}

std::shared_ptr<Library> LibraryLoader::load(const std::string& plugin_id,
                                             const std::optional<std::filesystem::path>& library, const Place& where) {
  std::filesystem::path file;
  try {
    file = library ? std::filesystem::path(where.file).parent_path() / *library : find(plugin_id, search_path_);
  } catch (const Refusal& refusal) {
    throw fault(where, plugin_id, refusal.what());
  }
  try {
    std::shared_ptr<Library> result = open(file);
    if (result->id() != plugin_id)
      throw Refusal(
          fmt::format("registers {}; expected {}{}", quote(result->id()), quote(plugin_id),
                      library ? std::string() : of_its_name(result->id(), plugin_id, result->plugins().back())));
    return result;
  } catch (const Refusal& refusal) {
    throw fault(where, plugin_id, fmt::format("{} {}", file.native(), refusal.what()));
  }
}

std::shared_ptr<Library> Library::load(const std::string& plugin_id,
                                       const std::optional<std::filesystem::path>& library,
                                       const SearchPath& search_path, const Place& where) {
  return LibraryLoader(search_path).load(plugin_id, library, where);
}

std::shared_ptr<Library> Library::of_program(decltype(&muster_register) call) {
  return std::shared_ptr<Library>(new Library({}, nullptr, registered_plugins(call)));
}

Library::Library(std::filesystem::path file, std::unique_ptr<Module> module, std::vector<muster_plugin> plugins)
    : file_(std::move(file)), module_(std::move(module)), plugins_(std::move(plugins)) {}

Library::~Library() = default;

std::string_view Library::id() const { return parse_plugin_id(plugins_.front().id).id; }

std::vector<ListedPlugin> list_plugins(const Library::SearchPath& search_path) {
  LibraryLoader loader(search_path);
  std::vector<ListedPlugin> result;
  for (const std::filesystem::path& folder : search_path)
    for (const std::filesystem::path& file : libraries_in(folder)) {
      const auto same_name = [&](const ListedPlugin& p) { return p.file.filename() == file.filename(); };
      const auto first = std::ranges::find_if(result, same_name);
      ListedPlugin listed{file, nullptr, ""};
      try {
        if (first != result.end()) throw Refusal("is hidden by " + first->file.string());
        std::shared_ptr<Library> library = loader.open(file);
        const std::string expected = file_name(std::string(library->id()));
        if (file.filename() != expected)
          throw Refusal(
              fmt::format("registers {}; such a file is called {}, by muster_plugin({} ...) in its CMakeLists.txt",
                          quote(library->id()), expected, std::filesystem::path(expected).stem().string()));
        listed.library = std::move(library);
      } catch (const Refusal& refusal) {
        listed.reason = refusal.what();
      }
      result.push_back(std::move(listed));
    }
  return result;
}

}  // namespace muster
