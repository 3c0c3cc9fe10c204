// muster bundle as a user calls it, on a small world that reads files of one name in several folders.
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bundle/archive.hpp"
#include "bundle/manifest.hpp"
#include "hostile.hpp"
#include "tests/cli/errors/program.hpp"

namespace muster::test {

namespace fs = std::filesystem;

struct BundleFolder : ProgramFolder {
  BundleFolder() {
    write("lab/site/a/way.csv", "x[m],y[m]\n9,0\n");
    write("lab/site/b/way.csv", "x[m],y[m]\n0,9\n");
    write("lab/shared/way.csv", "x[m],y[m]\n-9,-9\n");
    write("lab/shared/walls.csv",
          "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\nw,20,-9,20,9,3,0.1,brick\n");
    write("lab/site/world.xml",
          "<world name=\"three ways\" dt=\"0.1\" until=\"3\" seed=\"1\">\n"
          "<material name=\"brick\" loss=\"8\"/><walls file=\"../shared/walls.csv\"/><station name=\"s\" at=\"30 0 "
          "1\"/>\n"
          "<robot name=\"r\" at=\"0 0 0\"/><robot name=\"q\" at=\"0 5 0\"/><robot name=\"p\" at=\"0 10 0\"/>\n"
          "<physics.planar name=\"physics\"/><radio.multiwall tx_power=\"-10\" l0=\"40\" n=\"2.4\"/>\n"
          "<radio.fading shadowing=\"4\"/><network.ideal/><control.beacon radio=\"s\"/>\n"
          "<control.waypoint name=\"u\" robot=\"r\" path=\"a/way.csv\"/><control.waypoint name=\"v\" robot=\"q\" "
          "path=\"b/way.csv\"/>\n"
          "<control.waypoint name=\"w\" robot=\"p\" path=\"../shared/way.csv\"/></world>");
    write("counted/world.xml",
          "<world name=\"c\" dt=\"0.1\" until=\"2\" seed=\"1\"><test.revised name=\"counter\"/></world>");
  }
  Outcome bundle(std::vector<std::string> words) const {
    words.insert(words.begin(), "bundle");
    return muster(words);
  }
  nlohmann::json told(std::vector<std::string> words, int exit = 0) const {
    words.emplace_back("--json");
    const Outcome outcome = bundle(std::move(words));
    EXPECT_EQ(outcome.exit, exit) << outcome.out << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
  std::string digest_of_run(std::vector<std::string> words) const {
    words.insert(words.begin(), "run");
    words.emplace_back("--json");
    return nlohmann::json::parse(muster(words).out).at("digest");
  }
  bundle::Manifest manifest_of(const std::string& file) const {
    const Folder folder;
    bundle::unpack(path() / file, folder.path());
    return bundle::read_manifest(folder / bundle::manifest_name);
  }
  // Packs a bundle anew, each of its files by name as `change` leaves it.
  void change(const std::string& from, const std::string& to,
              const std::function<void(std::map<std::string, std::string>&)>& change) const {
    const Folder folder;
    bundle::unpack(path() / from, folder.path());
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      if (entry.is_regular_file()) files[entry.path().lexically_relative(folder.path())] = contents(entry);
    change(files);
    std::vector<HostileEntry> entries;
    for (const auto& [name, bytes] : files) entries.push_back({name, bytes});
    write_archive(path() / to, entries);
  }
  static std::string revision(int number) { return std::string(MUSTER_TOYS) + '/' + std::to_string(number); }
};

}  // namespace muster::test
