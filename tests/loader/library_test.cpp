// The zoo of faulty libraries: each has its line, and the host survives unchanged.
#include "loader/library.hpp"

#include <elf.h>
#include <gmock/gmock.h>

#include <cfenv>
#include <clocale>
#include <cstring>
#include <random>

#include "loader/process_guard.hpp"
#include "zoo.hpp"

namespace muster {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class LibraryTest : public ZooTest {
 protected:
  // The message for zoo_NAME.so, after its file's name.
  static std::string words_for(const std::string& name, const std::string& id = "") {
    const std::string plugin = id.empty() ? "zoo." + name : id;
    const std::string message = error_of([&] { Library::load(plugin, std::nullopt, {zoo}, {"world.xml", 5, 3}); });
    const std::string before = "world.xml:5:3: plugin \"" + plugin + "\": " + (zoo / ("zoo_" + name + ".so ")).string();
    EXPECT_THAT(message, StartsWith(before));
    EXPECT_EQ(message.find('\n'), message.npos);
    return message.substr(std::min(before.size(), message.size()));
  }
};

// ---- Valid libraries ----

TEST_F(LibraryTest, LoadsAPluginByItsId) {
  const auto library = Library::load("zoo.good", std::nullopt, {folder, zoo}, {"world.xml", 5, 3});
  EXPECT_EQ(library->file(), zoo / "zoo_good.so");
  EXPECT_EQ(library->id(), "zoo.good");
  ASSERT_EQ(library->plugins().size(), 1u);
  const muster_plugin& plugin = library->plugins()[0];
  EXPECT_STREQ(plugin.id, "zoo.good/1");
  EXPECT_STREQ(plugin.summary, "does nothing");
  EXPECT_EQ(plugin.phase, MUSTER_OBSERVE + 0u);
  ASSERT_EQ(plugin.param_count, 1u);
  EXPECT_STREQ(plugin.params[0].name, "size");
}

// A constant is none of it, though it stands in a section that is written: its addresses are.
TEST_F(LibraryTest, WarnsOfCallsThatNoRunRepeats) {
  const auto of = [&](const std::string& id) { return Library::load(id, std::nullopt, {zoo}, {})->doubts(); };
  EXPECT_THAT(
      of("zoo.restless"),
      testing::ElementsAre(
          StartsWith("it calls rand(), whose numbers do not follow the world's seed, so that no run repeats "
                     "another; expected a stream"),
          StartsWith("it calls std::chrono::system_clock::now(), the clock of the computer, so that no run "
                     "repeats another; expected the time of the run, k.time()"),
          StartsWith("it calls nanosleep(), as std::this_thread::sleep_for() does, which holds up the whole run"),
          StartsWith("its step() keeps \"count\" in a static variable, which all instances share, and which is "
                     "lost where a run is restored or a plugin swapped; expected state in a table")));
  EXPECT_THAT(of("zoo.good"), testing::IsEmpty());
}

TEST_F(LibraryTest, TakesAPluginInPlainCWithTwoRevisionsInOrder) {
  const auto library = Library::load("zoo.plain", std::nullopt, {zoo}, {});
  ASSERT_EQ(library->plugins().size(), 2u);
  EXPECT_STREQ(library->plugins()[0].id, "zoo.plain/1");
  EXPECT_STREQ(library->plugins()[1].id, "zoo.plain/2");
}

TEST_F(LibraryTest, TheFirstFolderWinsAndALibraryAttributeBeatsBoth) {
  write_bytes(folder / "zoo_good.so", test::contents(zoo / "zoo_good.so"));
  EXPECT_EQ(Library::load("zoo.good", std::nullopt, {folder, zoo}, {})->file(), folder / "zoo_good.so");
  write_bytes(folder / "mine", test::contents(zoo / "zoo_good.so"));
  const Place where{(folder / "world.xml").string(), 1, 1};
  EXPECT_EQ(Library::load("zoo.good", "mine", {zoo}, where)->file(), folder / "mine");
}

TEST_F(LibraryTest, SurvivesStrip) {
  const std::filesystem::path file = folder / "zoo_good.so";
  write_bytes(file, test::contents(zoo / "zoo_good.so"));
  ASSERT_EQ(std::system(("strip --strip-all " + file.string()).c_str()), 0);
  EXPECT_EQ(Library::load("zoo.good", std::nullopt, {folder}, {})->id(), "zoo.good");
}

// ---- Missing libraries ----

TEST_F(LibraryTest, SaysWhereItLookedAndWhatIsNear) {
  const auto message = [](const std::string& id, const Library::SearchPath& path) {
    return error_of([&] { Library::load(id, std::nullopt, path, {"world.xml", 5, 3}); });
  };
  EXPECT_EQ(message("zoo.god", {folder, zoo}), "world.xml:5:3: plugin \"zoo.god\": zoo_god.so not found; looked in " +
                                                   folder.string() + ", " + zoo.string() +
                                                   "; did you mean \"zoo.good\"?");
  EXPECT_EQ(message("radio.multiwall", {folder, "/nowhere"}),
            "world.xml:5:3: plugin \"radio.multiwall\": radio_multiwall.so not found; looked in " + folder.string() +
                ", /nowhere");
  EXPECT_EQ(message("zoo.other", {folder, zoo}),
            "world.xml:5:3: plugin \"zoo.other\": zoo_other.so not found; looked in " + folder.string() + ", " +
                zoo.string() + "; " + (zoo / "zoo_impostor.so").string() +
                " has the id zoo.other, and a plugin's file is named after it: expected zoo_other.so, by "
                "muster_plugin(zoo_other ...) in its CMakeLists.txt");
  EXPECT_EQ(message("zoo.good", {}),
            "world.xml:5:3: plugin \"zoo.good\": zoo_good.so not found; looked in no folder: the plugin path is empty");
  EXPECT_EQ(
      message("../zoo", {zoo}),
      "world.xml:5:3: plugin \"../zoo\": is no plugin id; expected words of a-z, 0-9 and _ with dots between them");
}

// ---- Other files ----

TEST_F(LibraryTest, RefusesWhatIsNotAMusterPlugin) {
  EXPECT_EQ(
      words_for("no_section"),
      "is a shared library but no muster plugin: it has no section muster.abi.1; expected MUSTER_PLUGIN_IS(NAME) at "
      "the end of its source, and a build by muster_plugin() of plugin_api");
  EXPECT_EQ(words_for("no_register"), "does not export muster_register; expected one MUSTER_PLUGIN_IS in it");
  EXPECT_EQ(words_for("impostor"),
            "registers \"zoo.other\"; expected \"zoo.impostor\"; write id = \"zoo.impostor/1\" in its source, or "
            "muster_plugin(zoo_other ...) in its CMakeLists.txt and <zoo.other/> in the world");
}

TEST_F(LibraryTest, RefusesAnotherAbiBeforeAnythingOfItRuns) {
  const std::filesystem::path trace = folder / "ran";
  ::setenv("MUSTER_ZOO_TRACE", trace.c_str(), 1);
  EXPECT_EQ(words_for("other_abi"),
            "is built for plugin ABI 2; this muster has plugin ABI 1; rebuild it against plugin_api");
  EXPECT_FALSE(std::filesystem::exists(trace));
  ::unsetenv("MUSTER_ZOO_TRACE");
}

TEST_F(LibraryTest, NamesWhatALibraryLacks) {
  EXPECT_EQ(words_for("undefined"),
            "needs missing::law(double, char const*), which neither it nor a library that it links "
            "defines; link what defines it");
  EXPECT_EQ(words_for("orphan"),
            "needs libmuster_zoo_gone.so, which is not found; install it or link by an absolute run path");
  EXPECT_EQ(words_for("sticky"),
            "stays mapped when it is closed, and would run old code after a reload; build it with "
            "-fno-gnu-unique, as muster_plugin() does");
}

TEST_F(LibraryTest, NamesTheVersionThatALibraryNeeds) {
  const std::filesystem::path file = folder / "zoo_good.so";
  std::string bytes = test::contents(zoo / "zoo_good.so");
  const std::string name = "GLIBCXX_3.4";
  for (std::size_t at = 0; (at = bytes.find(name, at)) != bytes.npos; ++at) bytes[at + 8] = '9';
  write_bytes(file, bytes);
  EXPECT_THAT(load_error("zoo.good", file),
              testing::MatchesRegex(
                  ".* needs GLIBCXX_9\\.4[.0-9]*, which .*/libstdc\\+\\+\\.so\\.6 here has not; rebuild it on "
                  "this machine"));
}

// ---- Faults in its own code ----

TEST_F(LibraryTest, OutlivesInitialisersThatFail) {
  EXPECT_EQ(words_for("throws"), "throws while it is opened: std::runtime_error: no licence found");
  EXPECT_EQ(words_for("throws_int"), "throws while it is opened: int");
  EXPECT_EQ(words_for("exits"), "calls exit() while it is opened");
  EXPECT_EQ(words_for("crashes"), "crashes while it is opened (SIGILL); it is corrupted or faulty");
  EXPECT_EQ(words_for("aborts"), "crashes while it is opened (SIGABRT); it is corrupted or faulty");
  EXPECT_EQ(words_for("destructor"), "throws while it is closed: std::runtime_error: not yet");
}

TEST_F(LibraryTest, RefusesWhatChangesTheProcess) {
  const ProcessGuard guard;
  EXPECT_EQ(words_for("fast_math"), "flushes denormals to zero when it is opened; is it built with -ffast-math?");
  EXPECT_EQ(words_for("rounding"), "rounds upward when it is opened");
  EXPECT_EQ(words_for("trapping"),
            "changes which floating-point exceptions trap, changes the x87 control word when it is opened");
  EXPECT_EQ(words_for("locale"), "changes the locale to C.UTF-8 when it is opened");
  EXPECT_EQ(words_for("facet"), "changes the global std::locale when it is opened");
  EXPECT_EQ(words_for("folder"), "changes the working directory to / when it is opened");
  EXPECT_EQ(words_for("signals"), "changes the signal mask when it is opened");
  EXPECT_EQ(guard.what(), "");
}

TEST_F(LibraryTest, RestoresWhatOnlyTheHostSees) {
  ::setenv("MUSTER_ZOO_HOST", std::to_string(::getpid()).c_str(), 1);
  EXPECT_EQ(words_for("two_faced"), "rounds downward when it is opened");
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  ::unsetenv("MUSTER_ZOO_HOST");
  EXPECT_EQ(Library::load("zoo.two_faced", std::nullopt, {zoo}, {})->id(), "zoo.two_faced");
}

// ---- Broken files ----

TEST_F(LibraryTest, OutlivesTruncationAtEveryLength) {
  const std::string good = test::contents(zoo / "zoo_good.so");
  const std::filesystem::path file = folder / "zoo_good.so";
  for (std::size_t size = 4; size < good.size(); size += 1 + size / 4) {
    write_bytes(file, good.substr(0, size));
    EXPECT_THAT(load_error("zoo.good", file), HasSubstr(" is truncated: it has " + std::to_string(size) + " bytes"));
  }
}

// A section of a library, by its name.
Elf64_Shdr section_of(const std::string& bytes, const std::string& name) {
  Elf64_Ehdr header;
  std::memcpy(&header, bytes.data(), sizeof header);
  std::vector<Elf64_Shdr> table(header.e_shnum);
  std::memcpy(table.data(), bytes.data() + header.e_shoff, table.size() * sizeof(Elf64_Shdr));
  for (const Elf64_Shdr& section : table)
    if (bytes.c_str() + table[header.e_shstrndx].sh_offset + section.sh_name == name) return section;
  throw std::logic_error("the good library has no " + name);
}

// Random bytes where dlopen() follows them: it crashes on many, in the child.
TEST_F(LibraryTest, OutlivesCorruption) {
  const std::string good = test::contents(zoo / "zoo_good.so");
  const std::filesystem::path file = folder / "zoo_good.so";
  std::mt19937_64 random(1);
  int crashed = 0, refused = 0;
  for (const char* name : {".dynamic", ".dynsym", ".dynstr", ".rela.dyn", ".gnu.hash", ".init_array", ".text"}) {
    const Elf64_Shdr section = section_of(good, name);
    for (int i = 0; i < 20; ++i) {
      std::string bytes = good;
      for (int k = 0; k < 8; ++k) bytes[section.sh_offset + random() % section.sh_size] = static_cast<char>(random());
      write_bytes(file, bytes);
      const std::string message = load_error("zoo.good", file);
      refused += !message.empty();
      crashed += message.find("crashes while") != message.npos;
      EXPECT_EQ(message.find('\n'), message.npos);
    }
  }
  EXPECT_GT(crashed, 20);  // else the child has nothing to do
  EXPECT_GT(refused, crashed);
}

// ---- Reloading ----

TEST_F(LibraryTest, ReloadRunsTheNewCode) {
  const std::filesystem::path file = folder / "zoo_version.so";
  const auto load = [&] { return Library::load("zoo.version", std::nullopt, {folder}, {}); };
  write_bytes(file, test::contents(zoo / "zoo_version_1.so"));
  auto first = load();
  EXPECT_STREQ(first->plugins()[0].summary, "the first");
  write_bytes(file, test::contents(zoo / "zoo_version_2.so"));  // in place, under the running library
  const auto second = load();
  EXPECT_STREQ(second->plugins()[0].summary, "the second");
  EXPECT_STREQ(second->plugins()[0].id, "zoo.version/2");
  EXPECT_STREQ(first->plugins()[0].summary, "the first");
  first.reset();
  EXPECT_STREQ(second->plugins()[0].summary, "the second");
}

// One step of a new instance of a plugin that claims nothing.
int step_once(const muster_plugin& plugin) {
  muster_host host{};
  host.size = sizeof host;
  void* instance = plugin.create(&host);
  const muster_tick tick{};
  const int result = plugin.step(instance, &tick, nullptr, nullptr);
  plugin.destroy(instance);
  return result;
}

TEST_F(LibraryTest, SurvivesItsFileBeingEmptied) {
  const std::filesystem::path file = folder / "zoo_good.so";
  write_bytes(file, test::contents(zoo / "zoo_good.so"));
  const auto library = Library::load("zoo.good", file, {}, {});
  write_bytes(file, "");  // a mapping of the file itself would now be SIGBUS
  EXPECT_EQ(step_once(library->plugins()[0]), MUSTER_OK);
}

// This thread's object keeps the first library mapped; the second must not be taken for it.
TEST_F(LibraryTest, ReloadRunsTheNewCodeThoughAThreadHoldsTheOld) {
  const std::filesystem::path file = folder / "zoo_version.so";
  const auto load = [&] { return Library::load("zoo.version", file, {}, {}); };
  write_bytes(file, test::contents(zoo / "zoo_version_1.so"));
  EXPECT_EQ(step_once(load()->plugins()[0]), MUSTER_OK);
  EXPECT_NE(test::contents("/proc/self/maps").find("zoo_version.so"), std::string::npos);
  write_bytes(file, test::contents(zoo / "zoo_version_2.so"));
  EXPECT_STREQ(load()->plugins()[0].summary, "the second");
}

TEST_F(LibraryTest, UnloadsWithItsLastOwner) {
  const auto mapped = [] { return test::contents("/proc/self/maps").find("zoo_good.so") != std::string::npos; };
  auto one = Library::load("zoo.good", std::nullopt, {zoo}, {});
  auto two = one;
  one.reset();
  EXPECT_TRUE(mapped());
  two.reset();
  EXPECT_FALSE(mapped());
}

// ---- Listing ----

TEST_F(LibraryTest, ListsEveryFileWithItsReason) {
  const std::string good = test::contents(zoo / "zoo_good.so");
  write_bytes(folder / "zoo_good.so", good);
  write_bytes(folder / "zoo_misnamed.so", good);
  write_bytes(folder / "text.so", "hello\n");
  write_bytes(folder / "readme.txt", "not a library\n");
  const std::filesystem::path second = folder / "second";
  std::filesystem::create_directory(second);
  write_bytes(second / "zoo_good.so", good);
  const std::vector<ListedPlugin> listed = list_plugins({folder, second, "/nowhere"});
  ASSERT_EQ(listed.size(), 4u);
  EXPECT_EQ(listed[0].file, folder / "text.so");
  EXPECT_EQ(listed[0].reason, "is not a shared library: it starts with \"hello\"; expected \"\\x7fELF\"");
  EXPECT_EQ(listed[1].file, folder / "zoo_good.so");
  EXPECT_EQ(listed[1].reason, "");
  EXPECT_EQ(listed[1].library->id(), "zoo.good");
  EXPECT_EQ(listed[2].reason,
            "registers \"zoo.good\"; such a file is called zoo_good.so, by "
            "muster_plugin(zoo_good ...) in its CMakeLists.txt");
  EXPECT_EQ(listed[3].reason, "is hidden by " + (folder / "zoo_good.so").string());
}

}  // namespace
}  // namespace muster
