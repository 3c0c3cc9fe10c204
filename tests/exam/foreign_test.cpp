// Cases of anybody's generator: what is taken, and in which words the rest is refused.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "exam/foreign_generator.hpp"

namespace muster::exam {
namespace {

std::string refused(const std::string& answer) {
  try {
    full_answer(answer, "case_0001", "answer.json");
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(ForeignGenerator, TheShortAnswerBecomesAFullOne) {
  const auto full = nlohmann::json::parse(
      full_answer(R"({"effects": [{"id": "step", "lambda": 70, "rows": ["radio/a"]}, {"id": "drift", "lambda": 9}]})",
                  "case_0007", "answer.json"));
  EXPECT_EQ(full["format"], "muster_exam/1");
  EXPECT_EQ(full["case"], "case_0007");
  EXPECT_EQ(full["kind"], "two");
  EXPECT_EQ(full["effects"][0]["rows"], nlohmann::json({"radio/a"}));
  EXPECT_EQ(full["effects"][1]["covariates"], nlohmann::json::array());
  EXPECT_EQ(nlohmann::json::parse(full_answer(R"({"effects": []})", "c", "f"))["kind"], "clean");
  EXPECT_EQ(nlohmann::json::parse(full_answer(
                R"({"effects": [{"id": "rain", "lambda": 9, "in_vocabulary": false, "covariates": ["time"]}]})", "c",
                "f"))["kind"],
            "outside");
}

TEST(ForeignGenerator, WrongAnswersAreRefusedByKey) {
  EXPECT_EQ(
      refused(R"({"effects": [{"id": "unmaped_wall", "lambda": 3}]})"),
      "answer.json: effects[0].id: no cause is called \"unmaped_wall\"; did you mean \"unmapped_wall\"? An effect "
      "without a name in muster has \"in_vocabulary\": false");
  EXPECT_EQ(refused(R"({"effects": [{"id": "step"}]})"),
            "answer.json: effects[0].lambda: expected a number from 0, twice the expected log-likelihood ratio");
  EXPECT_EQ(refused(R"({"effects": [{"id": "step", "lambda": 1, "row": []}]})"),
            "answer.json: effects[0].row: unknown; expected one of id, lambda, in_vocabulary, rows, parameters, also, "
            "class, covariates, acts, wanted_lambda");
  EXPECT_EQ(refused(R"({"effects": [{"id": "step", "lambda": 1, "also": ["drfit"]}]})"),
            "answer.json: effects[0].also: no cause is called \"drfit\"; did you mean \"drift\"?");
  EXPECT_EQ(refused("{}"), "answer.json: effects: expected a list, empty for a clean case");
  EXPECT_EQ(refused(R"({"format": "mine", "effects": []})"), "answer.json: format: expected \"muster_exam/1\"");
  EXPECT_EQ(refused("[").substr(0, 23), "answer.json: not JSON: ");
}

}  // namespace
}  // namespace muster::exam
