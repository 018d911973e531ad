#pragma once

#include "conditions/loaded_elements.h"
#include "conditions/segment_forces.h"
#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Pressures on segments and shells that follow curves (*LOAD_SEGMENT, _SET, *LOAD_SHELL_ELEMENT, _SET).
/// Positive pressure acts against the segment's normal, and turns and grows with the surface (a follower
/// load). A curve begins at the arrival time: its value is that at t - AT. A segment whose element has been
/// deleted is no longer loaded.
class PressureLoads : public Term {
public:
    explicit PressureLoads(const Model& model);

    std::string_view name() const override { return "pressure loads"; }
    std::size_t items() const override { return segments_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_; }
    void serialise(Archive& archive) override { archive(sum_, work_); }

private:
    const Model& model_;
    std::vector<SegmentNodes> segments_;
    std::vector<Index> load_; ///< of the Model, by segment
    LoadedElements elements_;
    CornerSum sum_;
    double work_ = 0; ///< [energy]

    double pressure_of(const PressureLoad& load, const Clock& clock) const;
};

} // namespace plash
