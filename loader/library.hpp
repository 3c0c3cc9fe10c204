// A plugin's shared object: found, checked before any of its code runs, tried in a child process, loaded, and unloaded
// when its last owner releases it. Every refusal is an Error with Exit::plugin_fault and one line.
// docs/explanation/plugin_loading.md gives the reasons.
#pragma once

#include <muster/plugin.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"

namespace muster {

class Probe;

class Library {
 public:
  using SearchPath = std::vector<std::filesystem::path>;

  // Loads one library by a LibraryLoader of its own.
  static std::shared_ptr<Library> load(const std::string& plugin_id,
                                       const std::optional<std::filesystem::path>& library,
                                       const SearchPath& search_path, const Place& where);

  // Plugins that are part of the program itself, as one that embeds the kernel may have them: file() is empty. Throws
  // Refusal.
  static std::shared_ptr<Library> of_program(decltype(&muster_register) call);

  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library();  // code and strings of the library are gone after it

  const std::filesystem::path& file() const { return file_; }
  std::string_view id() const;  // "radio.multiwall"
  // The checked descriptors, by ascending revision, at least one. Fields that an older library lacks are 0.
  const std::vector<muster_plugin>& plugins() const { return plugins_; }
  // Warnings of what it calls: library_doubts().
  const std::vector<std::string>& doubts() const { return doubts_; }
  // Steps that instances of it took which are gone.
  std::uint64_t steps() const { return steps_; }
  void add_steps(std::uint64_t more) { steps_ += more; }

 private:
  friend class LibraryLoader;
  struct Module;
  Library(std::filesystem::path file, std::unique_ptr<Module> module, std::vector<muster_plugin> plugins);

  std::filesystem::path file_;
  std::unique_ptr<Module> module_;
  std::vector<muster_plugin> plugins_;
  std::vector<std::string> doubts_;
  std::atomic<std::uint64_t> steps_ = 0;
};

// Loads the libraries of a world, which share the child process that tries them out. It forks at the first load: no
// other thread may then hold a lock that a library's initialisers need. Keep it no longer than the loading takes.
class LibraryLoader {
 public:
  explicit LibraryLoader(Library::SearchPath search_path);
  LibraryLoader(const LibraryLoader&) = delete;
  LibraryLoader& operator=(const LibraryLoader&) = delete;
  ~LibraryLoader();

  // Loads the library of `plugin_id` ("radio.multiwall", without a revision): radio_multiwall.so in the first folder of
  // the search path that has one, or the file `library`, relative to the folder of `where`'s file. Each call loads the
  // present contents of the file; share the result between instances.
  std::shared_ptr<Library> load(const std::string& plugin_id, const std::optional<std::filesystem::path>& library,
                                const Place& where);

  // As above for a file whose plugin id is unknown. Throws Refusal, whose words follow the file's name.
  std::shared_ptr<Library> open(const std::filesystem::path& file);

 private:
  Library::SearchPath search_path_;
  std::unique_ptr<Probe> probe_;
};

// A file on the plugin path: its library, or the reason for having none ("is built for AArch64; expected x86-64").
struct ListedPlugin {
  std::filesystem::path file;
  std::shared_ptr<Library> library;
  std::string reason;
};

// Every *.so of the folders, in their order and by name inside each. Missing folders have none.
std::vector<ListedPlugin> list_plugins(const Library::SearchPath& search_path);

}  // namespace muster
