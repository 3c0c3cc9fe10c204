// Writes a case as files: the examinee's inputs, and the answer.
#pragma once

#include <filesystem>

#include "exam/case.hpp"

namespace muster::exam {

std::string world_xml(const Case& made);
std::string walls_csv(const Plan& plan);
// `decimals`: of the levels.
std::string readings_csv(const GroundTruth& site, const Data& data, int decimals = 0);
std::string answer_json(const Case& made);

// folder/NAME/{world.xml, walls.csv, measured.csv, second.csv} and folder/answers/NAME.json
void write_case(const Case& made, const std::filesystem::path& folder);

}  // namespace muster::exam
