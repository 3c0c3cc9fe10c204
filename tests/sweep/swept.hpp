// muster sweep as a user calls it, on a small world with noise, messages and a robot.
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "sweep/job_table.hpp"
#include "tests/cli/errors/program.hpp"
#include "text/text_table.hpp"

namespace muster::test {

struct SweepFolder : ProgramFolder {
  SweepFolder() {
    write("way.csv", "x[m],y[m]\n100,0\n");
    write("world.xml",
          "<world name=\"call\" dt=\"0.1\" until=\"2\" seed=\"1\"><station name=\"a\" at=\"0 0 1\"/>"
          "<robot name=\"r\" at=\"30 3 0\"/><physics.planar name=\"physics\"/>"
          "<control.waypoint name=\"steer\" robot=\"r\" path=\"way.csv\" speed=\"0.3\"/>"
          "<radio.multiwall tx_power=\"-10\" l0=\"40\" n=\"2.4\"/><radio.fading shadowing=\"4\"/><network.ideal/>"
          "<control.beacon radio=\"a\"/></world>");
  }
  // A sweep of 3 powers and 4 seeds, and what else is varied.
  void write_sweep(const std::string& more = "") const {
    write("plan.xml",
          "<sweep world=\"world.xml\" seeds=\"1..4\"><vary set=\"radio.multiwall/tx_power\" "
          "values=\"-12 -10 -8\"/>\n" +
              more + "</sweep>");
  }
  Outcome sweep(std::vector<std::string> words, const Surroundings& around = {}) const {
    words.insert(words.begin(), "sweep");
    return muster(words, around);
  }
  std::int64_t ask(const std::string& out, const std::string& sql) const {
    return muster::sweep::Database(path() / out / "sweep.sqlite").number(sql);
  }
  // What is the same however the runs were shared.
  std::string tables(const std::string& out) const {
    return read(out + "/runs.csv") + read(out + "/summary.csv") + read(out + "/summary.svg");
  }
};

}  // namespace muster::test
