#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <string>
#include <vector>

namespace plash {

/// The discrete beams that disbout shows: those of *DATABASE_HISTORY_BEAM, or all where it names none.
std::vector<Index> shown_discrete_beams(const Model&);

/// LS-DYNA's number of the material type of a beam's part; 0 where there is none of its own.
int discrete_material_type(const Model&, Index beam);

/// States of these beams now; those that have failed are left out.
std::vector<ElementResults::DiscreteBeam> discrete_beam_states(const Snapshot&,
                                                               const std::vector<Index>& beams);

/// *DATABASE_DISBOUT: relative displacements and rotations, resultants and local axes of discrete beams.
class DisboutRecorder final : public ScheduledRecorder {
public:
    DisboutRecorder(const Model&, Schedule, const ResultPath& path);

private:
    std::vector<Index> beams_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash
