// Worlds and tables of the field generator, as the program reads them.
#include <gtest/gtest.h>

#include "command.hpp"
#include "exam/field_survey/survey_case.hpp"
#include "tests/folder.hpp"

namespace muster::exam::survey {
namespace {

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
    if (made.rssi.size() > 1500) continue;  // of the larger ones some seconds each
    const Outcome fit =
        run_command(std::string(MUSTER_PROGRAM) + " fit " + world + " --data " + world + "/measured.csv");
    // 1: read and fitted, but a parameter cannot be told from these readings, such as the loss of a wall none crosses.
    EXPECT_TRUE(fit.code == 0 || (fit.code == 1 && fit.text.find("readings heard of") != std::string::npos))
        << made.name << ' ' << made.campaign.style << ": " << fit.text;
    ++fitted;
  }
  EXPECT_GE(fitted, 8);
}

}  // namespace
}  // namespace muster::exam::survey
