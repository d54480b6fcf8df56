// SPDX-License-Identifier: Apache-2.0
//
// A study on disk: for spreadsheets, for programs, and as a page to look at.

#pragma once

#include <filesystem>
#include <string>

#include "pipeline/shot/shot.h"
#include "pipeline/study/study.h"

namespace lensplane {

/// SHOT.study.FRAME in the folder for output.
std::filesystem::path study_folder(const Shot& shot, int frame);

/// Writes study.csv, study.json and study.html. Throws Failure (BadOutput).
void write_study(const std::filesystem::path& folder, const Study& study);

/// A line with the columns' names, then one for each trace, picture and price. Fields that a row does not
/// have are empty, and so is a bound that has no limit.
std::string csv_from_study(const Study& study);

/// Everything but the error maps.
std::string json_from_study(const Study& study);

}  // namespace lensplane
