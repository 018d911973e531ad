#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

/// What elout and swforc show of beams, in the columns of LS-DYNA R13.
namespace plash {

/// Resultants and point stresses of some beams at one state, as elout prints them; eroded beams are left out.
std::string format_elout_beams(const Snapshot&, std::span<const Index> beams);

/// The beams of *MAT_SPOTWELD, which swforc shows.
std::vector<Index> spot_weld_beams(const Model&);

/// *DATABASE_SWFORC: axial and shear force, length, resultant moment and torsion of every spot-weld beam.
class SwforcRecorder final : public ScheduledRecorder {
public:
    SwforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    std::vector<Index> beams_;
    std::vector<Index> rows_; ///< row of each beam of the Model among `beams_`
    std::vector<double>
        failed_since_; ///< time at which a beam was first seen to have failed; below 0: it holds
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash
