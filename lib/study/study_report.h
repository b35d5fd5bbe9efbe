#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/plot.h"
#include "report/table.h"
#include "study/study_analysis.h"

namespace sateen {

/// A plot with its file's name, without extension.
struct NamedPlot {
  std::string name, caption;
  PlotSheet sheet;
};
/// The talk's figures, one a look, direct and with bounces; and all strategies at equal time. Scenes that are not
/// finished are left out.
std::vector<NamedPlot> study_plots(const StudyResult& result);

Table run_table(const StudyResult& result);     ///< every render, for study.csv
Table goal_table(const StudyResult& result);    ///< what the program is held to, and what was found
Table thread_table(const StudyResult& result);  ///< the talk's claims of single threads, by quadrature
Table figure_table(const StudyResult& result);  ///< its figures, of bare threads and of whole cloth
/// Where the talk's claims hold and where they do not, in plain words; empty where nothing was measured.
std::vector<std::string> talk_findings(const StudyResult& result);
Table claim_table(const StudyResult& result);      ///< the talk's claims in the program's own pictures
Table ratio_table(const StudyResult& result);      ///< MSE of ours over every strategy's at equal time, a scene a row
Table winner_table(const StudyResult& result);     ///< least MSE at equal time, a scene a row
Table reference_table(const StudyResult& result);  ///< how far the references can be trusted

/// "0.0314 (0.028 to 0.034)"; where the ends are more than a factor of 10,000 apart, that in words.
std::string interval_text(const Interval& interval, int digits = 4);

/// What was done and found, as text for a terminal.
std::string study_text(const StudyResult& result);
std::string study_json(const StudyResult& result, const std::string& version, const std::string& command_line);
std::string study_page(const StudyResult& result, const std::filesystem::path& picture_folder);

/// Writes study.csv, study.json, study.txt, plots as SVG and PNG, pictures and index.html into the folder, which is
/// made where it is missing. Returns the files' names.
std::vector<std::string> write_study(const std::filesystem::path& folder, const StudyResult& result,
                                     const std::string& version, const std::string& command_line);

}  // namespace sateen
