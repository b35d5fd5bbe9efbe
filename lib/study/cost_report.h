#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/table.h"
#include "study/cost.h"
#include "study/study_report.h"

namespace sateen {

/// "2 % -> 1 %: +31 s" for halvings of the noise within what was measured, and a last one beyond it; seconds by the
/// clock with the threads of the settings, on a machine that does nothing else.
std::vector<std::string> halving_sentences(const CostResult& result);

Table start_table(const CostResult& result);
Table point_table(const CostResult& result);
Table price_table(const PriceList& list);
Table quality_table(const CostResult& result);
std::vector<NamedPlot> cost_plots(const CostResult& result);

std::string cost_text(const CostResult& result);
std::string cost_json(const CostResult& result, const std::string& version, const std::string& command_line);
std::string cost_page(const CostResult& result, const std::filesystem::path& picture_folder);

/// Writes cost.csv, cost.json, cost.txt, plots as SVG and PNG, pictures and index.html into the folder, which is made
/// where it is missing. Returns the files' names.
std::vector<std::string> write_cost(const std::filesystem::path& folder, const CostResult& result,
                                    const std::string& version, const std::string& command_line);

}  // namespace sateen
