#pragma once

#include "conditions/air_blast.h"
#include "conditions/loaded_elements.h"
#include "conditions/segment_forces.h"
#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Pressures of explosions in air on segments (*LOAD_BLAST_ENHANCED with *LOAD_BLAST_SEGMENT, _SET). They act
/// against the segment's normal, which looks towards the charge, and turn with the segment. The shock that
/// hits a segment is that of its distance when it arrives; how much of it is reflected follows the angle as
/// it is. A segment whose element has been deleted is no longer loaded.
class BlastLoads : public Term {
public:
    BlastLoads(const Model& model, const State& state);

    std::string_view name() const override { return "blast loads"; }
    std::size_t items() const override { return segments_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_; }
    std::vector<std::string> notices(const State& state) const override;
    void serialise(Archive& archive) override { archive(shock_, sum_, work_); }

private:
    /// What is known of the shock at a segment.
    struct Shock {
        AirBlast blast;       ///< by the last look
        double arrival = 0;   ///< since the explosion [time]
        bool arrived = false; ///< the blast stays as it is
    };
    const Model& model_;
    std::vector<SegmentNodes> segments_;
    std::vector<Index> load_;   ///< of the Model, by segment
    std::vector<double> scale_; ///< SCALEP [-]
    LoadedElements elements_;
    CornerSum sum_;
    std::vector<Shock> shock_;
    std::vector<double>
        scaled_time_; ///< of each load: one unit of time over the charge's mass [ms / lb^(1/3)]
    double work_ = 0; ///< [energy]

    Vec3 to_charge(std::size_t segment, const State& state) const;
    double scaled_distance(std::size_t segment, const State& state) const;
    void look(std::size_t segment, const State& state);
    bool has_arrived(std::size_t segment, double since_explosion, const State& state);
    double pressure_at(std::size_t segment, double since_explosion, const Vec3& normal,
                       const State& state) const;
};

} // namespace plash
