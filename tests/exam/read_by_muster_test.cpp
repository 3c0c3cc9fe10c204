// Worlds and tables of the field generator, as the program reads them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "command.hpp"
#include "exam/field_survey/survey_case.hpp"
#include "tests/folder.hpp"

namespace muster::exam::survey {
namespace {

// The scene of a world reaches 1 km; tables beyond it are refused.
bool within_the_scene(const Made& made) {
  return std::all_of(made.campaign.rows.begin(), made.campaign.rows.end(), [&](const Row& row) {
    const Path path = path_of(made.map, row);
    return std::max({std::abs(path.tx.x), std::abs(path.tx.y), std::abs(path.rx.x), std::abs(path.rx.y)}) < 1000;
  });
}

TEST(FieldSurvey, TheProgramReadsWorldsAndTables) {
  const test::Folder folder;
  Request request;
  request.seed = 23;
  int fitted = 0;
  for (int number = 1; number <= 24; ++number) {
    const Made made = make(request, number);
    write(made, folder.path());
    const std::string world = (folder / made.name).string();
    const Outcome checked = run_command(std::string(MUSTER_PROGRAM) + " check " + world);
    EXPECT_EQ(checked.code, 0) << made.campaign.style << ": " << checked.text;
    if (!within_the_scene(made) || made.rssi.size() > 1500) continue;
    const Outcome fit =
        run_command(std::string(MUSTER_PROGRAM) + " fit " + world + " --data " + world + "/measured.csv");
    // 1: read and fitted, but a parameter cannot be told from these readings, such as the loss of a wall none crosses.
    EXPECT_TRUE(fit.code == 0 || (fit.code == 1 && fit.text.find("readings heard of") != std::string::npos))
        << made.name << ' ' << made.campaign.style << ": " << fit.text;
    ++fitted;
  }
  EXPECT_GE(fitted, 5);
}

}  // namespace
}  // namespace muster::exam::survey
