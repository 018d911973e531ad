#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// Columns over time as an ASCII result file holds them.
struct History {
    struct Column {
        std::string name;           ///< as in the file, e.g. "kinetic energy"
        std::vector<double> values; ///< one for each entry of `time`
    };
    std::vector<double> time; ///< [time]
    std::vector<Column> columns;

    /// The column of that name; nullptr when there is none.
    const Column* find(std::string_view name) const;
};

/// All bytes of a file; none when it cannot be read.
std::string bytes_of(const std::filesystem::path& path);

/// Reads a file in the layout of glstat: one "name.... value" a line, a new state at each "time". Works on
/// LS-DYNA's files as well. A state that breaks off (a run that was killed while it wrote) is left out.
History read_glstat_history(std::string_view text);

/// Normal force on each rigid wall, from rwforc: columns "wall 3".
History read_rwforc_history(std::string_view text);

/// Size of the resultant force on the slave side of each contact, from rcforc: columns "contact 7".
History read_rcforc_history(std::string_view text);

} // namespace plash
