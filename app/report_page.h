#pragma once

#include "output/history_reader.h"

#include <string>
#include <utility>
#include <vector>

namespace plash {

/// One plot of the report: curves over time that share an axis.
struct ReportPlot {
    std::string title;
    std::string note; ///< a sentence below the title
    std::vector<double> time;
    std::vector<History::Column> curves;
};

/// What the page shows; text is escaped when it is written.
struct ReportPage {
    std::string title;
    std::string verdict;                                    ///< how the run ended, in one sentence
    bool trouble = false;                                   ///< the verdict is a warning
    std::vector<std::pair<std::string, std::string>> facts; ///< name and value
    std::vector<ReportPlot> plots;
    std::string timings_title = "Where the time went";
    std::vector<std::vector<std::string>> timings; ///< first row: headings
    std::string picture_title = "The model";
    std::string picture_png; ///< bytes of a PNG; empty: none
};

/// One self-contained HTML page: plots can be zoomed and read off (uPlot inside the page, with its licence).
std::string to_html(const ReportPage& page);

} // namespace plash
