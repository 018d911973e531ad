#pragma once

#include "core/recorder.h"

#include <memory>
#include <string>
#include <vector>

namespace plash {

/// What is written besides what the deck asks for.
struct RecorderOptions {
    bool vtk =
        false; ///< a VtkSeries at the interval of d3plot, or twenty states if the deck asks for no d3plot
    bool resume = false; ///< files that are there go on, from where a restart file says (Recorder::serialise)
};

/// Every result file that the Model's *DATABASE requests ask for, to be written into `directory`, which must
/// be there. Requests without an interval, or without anything to show (nodout without history nodes), make
/// no file. RunError when a file cannot be created.
std::vector<std::unique_ptr<Recorder>> make_recorders(const Model&, const std::string& directory,
                                                      const RecorderOptions& = {});

/// Names of the ASCII files that make_recorders knows.
std::vector<std::string> ascii_file_names();

} // namespace plash
