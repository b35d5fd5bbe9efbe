#pragma once
#include <string>
#include <vector>

#include "render/assemble.h"
#include "render/bill.h"
#include "render/verify.h"
#include "study/bill_report.h"

namespace sateen::app {

/// The plan as a table for a terminal.
std::string plan_text(const Plan& plan);

/// What the level of subdivision and those beside it give and take: silhouettes, triangles, memory and the time to
/// set up, of which the chosen level's is measured.
std::string levels_text(const Plan& plan, const SceneReport& report);

/// Says how the plan did where it was put to the test; false where an effect was ruled out that should not have been.
bool report_verdicts(const Plan& plan, const std::vector<Verdict>& verdicts);

/// The bill as a page of its own.
void write_bill_page(const std::filesystem::path& path, const Bill& bill, const std::string& lead);

}  // namespace sateen::app
