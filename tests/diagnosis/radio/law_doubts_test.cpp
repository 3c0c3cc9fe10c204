// What another field of the readings may be instead.
#include "diagnosis/radio/laws/law_doubts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muster::diagnosis {
namespace {

CauseEstimate field_of(double evidence) {
  CauseEstimate field;
  field.id = "effect.shadowing_correlation";
  field.evidence = evidence;
  return field;
}

Diagnosis with_check(const std::string& id, double p) {
  Diagnosis found;
  found.checks = {{"~time", "time", inference::Kind::smooth, 2, std::log(0.3)},
                  {id, "radio/st1", inference::Kind::named, 30, std::log(p)}};
  return found;
}

// A station of -4.3 dB and a wall of 5 dB were in a field of 4 dB, where 2.5 dB were stated.
TEST(LawDoubts, AnotherFieldIsInDoubtBesideWhatItMayHaveAbsorbed) {
  EXPECT_EQ(doubt_of_field(with_check("effect.tx_offset", 3e-5), field_of(60)),
            "what is not found makes a field wide, too, and tx_offset comes near (p = 3e-05)");
  EXPECT_EQ(doubt_of_field(with_check("effect.tx_offset", 0.01), field_of(60)), "");
  Diagnosis told = with_check("effect.tx_offset", 3e-5);
  told.causes.resize(1);
  told.causes[0].id = "effect.tx_offset";
  EXPECT_EQ(doubt_of_field(told, field_of(60)), "");
  // What is named and comes near for another radio hides nothing else.
  told.checks.push_back({"effect.obstacle", "", inference::Kind::named, 25, std::log(2e-4)});
  EXPECT_NE(doubt_of_field(told, field_of(60)).find("obstacle comes near"), std::string::npos);
  Diagnosis beside = with_check("~time", 3e-5);
  EXPECT_NE(doubt_of_field(beside, field_of(60)), "");
  beside.unexplained = {{"time", 30, 60, {}}};
  EXPECT_EQ(doubt_of_field(beside, field_of(60)), "");
}

// Five antennas of a robot that turned scattered as by outliers.
TEST(LawDoubts, ALawOfScatterIsInDoubtBesideWhatIsPlainlyLeft) {
  EXPECT_EQ(doubt_of_scatter(with_check("~time", 1e-9)),
            "what is not found scatters readings, too, and time comes near "
            "(p = 1e-09)");
  EXPECT_EQ(doubt_of_scatter(with_check("~time", 1e-5)), "");
}

TEST(LawDoubts, AFieldOfLittleEvidenceMayHaveAnotherLawOfDistance) {
  EXPECT_NE(doubt_of_field(with_check("effect.tx_offset", 0.5), field_of(11)), "");
  EXPECT_EQ(doubt_of_field(Diagnosis(), field_of(60)), "");
}

// A plan of stations in feet: readings of some 76 m by 54 m were in a field that is alike over 36 m.
TEST(LawDoubts, AFieldAsLongAsTheGroundIsNone) {
  LinkReadings r;
  r.tx_at = Eigen::Matrix3Xd::Zero(3, 40);
  r.rx_at = Eigen::Matrix3Xd::Zero(3, 40);
  for (int i = 0; i < 40; ++i) {
    r.tx.push_back(i % 2);
    r.rx.push_back(5);
    r.tx_at.col(i) << 240 * (i % 2), 0, 3;  // stations cover nothing
    r.rx_at.col(i) << 76.0 * i / 39, 54.0 * (i % 4) / 3, 1;
  }
  const noise::StatedField stated{2.5, 5};
  EXPECT_NE(doubt_of_extent(r, {7.8, 36}, stated).find("over 36 m of the 74 m that a link covers"), std::string::npos)
      << doubt_of_extent(r, {7.8, 36}, stated);
  EXPECT_EQ(doubt_of_extent(r, {7.8, 20}, stated), "");
  EXPECT_EQ(doubt_of_extent(r, {7.8, 36}, {2.5, 20}), "");  // the world says nearly as much
}

// A station that was carried elsewhere half way left outliers of lambda 44 beside "depends on time" of lambda 506.
TEST(LawDoubts, WhatIsNotExplainedScattersReadings) {
  LawTest law;
  law.cause = "effect.outliers";
  law.gain = 44;
  Diagnosis found;
  EXPECT_EQ(doubt_beside_unexplained(found, law), "");
  found.unexplained = {{"time", 50, 126, {}}, {"time_per_tx", 232, 506, {}}};
  EXPECT_NE(doubt_beside_unexplained(found, law).find("effect.outliers (lambda 44)"), std::string::npos);
  law.gain = 243;
  EXPECT_EQ(doubt_beside_unexplained(found, law), "");
}

}  // namespace
}  // namespace muster::diagnosis
