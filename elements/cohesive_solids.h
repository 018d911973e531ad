#pragma once

#include "core/term.h"
#include "elements/patches.h"
#include "materials/cohesive_mixed_mode.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// Whether a part's section asks for cohesive elements (*SECTION_SOLID ELFORM 19, 20).
bool is_cohesive(const Model&, Index part);

/// Cohesive elements of one part (ELFORM 19, 20): a surface between the nodes 1 to 4 and 5 to 8 of a solid,
/// which may lie upon one another. Four points; tractions of the law act on the area at the start along the
/// axes of the middle surface: n normal to its diagonals, x along side 1-2.
///
/// The separation is the gap between the sides less that at the start, both in axes that follow the middle
/// surface, so that rigid motion opens nothing. Energies are the work of the nodal forces.
/// ELFORM 20 glues shells: the layer lies between the nodes, which are those of the shells' middle surfaces,
/// and is held by arms from the nodes that turn with them, so that its tractions have moments about the
/// nodes. Source of the formulation: Tvergaard & Hutchinson (1992), as bilinear element with four points in
/// LS-DYNA keyword manual, volume I, *SECTION_SOLID, ELFORM 19.
class CohesiveSolids final : public Term {
public:
    CohesiveSolids(const Model& model, Index part, std::vector<Index> elements, State& state);

    std::string_view name() const override { return name_; }
    std::size_t items() const override { return static_cast<std::size_t>(patches_.element_count); }
    void add_forces(const Clock&, State&) override;
    StepVote stable_step() const override { return vote_; }
    void report(EnergyLedger&) const override;
    void serialise(Archive& archive) override { archive(history_, arms_, vote_known_, eroded_); }
    void collect(const State&, ElementResults&) const override;

private:
    static constexpr int points = 4;
    enum History { damage, traction_x, traction_y, traction_z, point_size };
    enum ElementHistory { energy = points * point_size, alive, history_size };
    enum Constant { area, gap_x, gap_y, gap_z, constant_size };

    const Model& model_;
    Index part_;
    CohesiveMixedMode law_;
    std::string name_;
    Patches patches_;
    std::vector<Lanes, CacheAligned<Lanes>> history_;   ///< batch x variable
    std::vector<Lanes, CacheAligned<Lanes>> constants_; ///< batch x point x constant
    bool with_arms_ = false;                            ///< ELFORM 20
    std::vector<Vector3<Lanes>, CacheAligned<Vector3<Lanes>>>
        arms_;                                   ///< batch x corner: from node to layer, now
    std::vector<std::vector<std::size_t>> lost_; ///< by patch: places of this cycle
    double eroded_ = 0;                          ///< energy of deleted elements
    bool vote_known_ = false;
    StepVote vote_;

    Lanes* history_of(Index batch) { return &history_[static_cast<std::size_t>(batch) * history_size]; }
    void start(State& state);
    void start_arms(State& state);
    Vec3 arm(std::size_t place, int corner) const;
    void vote(const State& state);
    Index corner(const Patches::Patch&, std::size_t place, int corner) const;
    void add_batch_forces(Index batch, double time_step, NodeCopies&, std::vector<std::size_t>& lost);
};

/// A term for each part of cohesive elements; DeckError for materials and formulations that are not there.
std::vector<std::unique_ptr<Term>> make_cohesive_solids(const Model&, State&);

} // namespace plash
