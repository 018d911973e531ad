#pragma once

#include "assess/curve.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// A curve with its name: "glstat/kinetic_energy", "nodout/5/z-disp", "rcforc/2/slave_z", "rwforc/1/normal",
/// "matsum/3/internal", or the heading of a column of a CSV file.
struct Signal {
    std::string name;
    TimeCurve curve;
};

/// A file that is not there or holds no such signal; the message says which there are.
class SignalError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// All curves of one ASCII result file, Plash's or LS-DYNA's: glstat, nodout, rcforc, rwforc, matsum. A state
/// that breaks off (a run that was killed while it wrote) is left out. `kind` is the file's name.
std::vector<Signal> read_signals(std::string_view kind, std::string_view text);

/// The files whose signals read_signals() knows.
const std::vector<std::string>& signal_files();

/// One signal of a run by its name; blanks and underscores are the same. Throws SignalError.
TimeCurve run_signal(const std::string& directory, const std::string& name);

/// Columns of a CSV file: the first is time, headings in the first line if they are not numbers, '#' starts a
/// comment. Curves are named by their headings, "2", "3" ... without. Throws SignalError.
std::vector<Signal> read_csv(const std::string& path);

/// The column of that heading or number, counted from 1; the second column when `column` is empty. Throws
/// SignalError.
TimeCurve csv_signal(const std::string& path, const std::string& column);

} // namespace plash
