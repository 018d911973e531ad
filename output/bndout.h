#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// What bndout shows of one loaded or driven node or rigid part.
struct BoundaryRow {
    Id id = 0;
    bool rigid_part = false; ///< `id` is a part, and the moment is shown
    Vec3 force{}, moment{};
    double energy = 0;
};

/// Sums what acts on one node or part; nodes come before parts, each by rising number.
std::vector<BoundaryRow> boundary_rows(const std::vector<ElementResults::BoundaryForce>&, const Model&);

/// The tables of one state as LS-DYNA prints them; an empty table is left out.
std::string format_bndout(double time, std::span<const BoundaryRow> loads,
                          std::span<const BoundaryRow> motions);

/// *DATABASE_BNDOUT: forces of nodal loads and of prescribed motions at n, and the energy they have put in. A
/// node that is loaded or driven in several directions has one row.
class BndoutRecorder final : public ScheduledRecorder {
public:
    BndoutRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash
