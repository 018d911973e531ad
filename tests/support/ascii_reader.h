#pragma once

#include "output/contact_files.h"
#include "output/glstat.h"
#include "output/matsum.h"
#include "output/nodout.h"

#include <string>
#include <string_view>
#include <vector>

/// Small readers of LS-DYNA's ASCII files, used alike on LS-DYNA's own files and on ours. They go by the
/// names and columns of LS-DYNA's files and throw std::runtime_error on a line that does not fit.
namespace plash::testing {

struct GlstatFile {
    std::string heading;
    std::vector<GlobalStatistics> states;
    bool with_hourglass = false;
};
GlstatFile read_glstat(std::string_view text);

struct MatsumFile {
    std::string heading;
    std::string legend; ///< entry lines
    std::vector<double> times;
    std::vector<std::vector<PartStatistics>> states;
};
MatsumFile read_matsum(std::string_view text);

struct NodoutFile {
    std::string heading;
    std::string legend;
    struct Table {
        long cycle = 0;
        double time = 0;
        std::vector<NodeRow> motion;       ///< either this
        std::vector<RotationRow> rotation; ///< or this
    };
    std::vector<Table> tables;
};
NodoutFile read_nodout(std::string_view text);

/// States of rcforc or sleout.
struct ContactFile {
    std::string heading;
    std::string legend;
    struct State {
        double time = 0;
        long cycle = 0; ///< sleout only
        std::vector<ElementResults::ContactForce> contacts;
        double total[4] = {}; ///< sleout: slave, master, both, friction
    };
    std::vector<State> states;
};
ContactFile read_rcforc(std::string_view text);
ContactFile read_sleout(std::string_view text);

} // namespace plash::testing
