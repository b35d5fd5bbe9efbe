#pragma once
#include <string>
#include <vector>

#include "render/bill.h"
#include "render/verify.h"
#include "report/table.h"

namespace sateen::app {

/// The plan as a table for a terminal.
std::string plan_text(const Plan& plan);

/// Says how the plan did where it was put to the test; false where an effect was ruled out that should not have been.
bool report_verdicts(const Plan& plan, const std::vector<Verdict>& verdicts);

/// The bill as a table, and as a page of its own with the small pictures.
Table bill_table(const Bill& bill);
void write_bill_page(const std::filesystem::path& path, const Bill& bill, const std::string& lead);

}  // namespace sateen::app
