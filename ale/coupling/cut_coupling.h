#pragma once

#include "ale/coupling/coupling_options.h"
#include "ale/coupling/cut_cells.h"
#include "ale/coupling/surface_coupling.h"
#include "ale/fluid_term.h"
#include "contact/surface.h"

#include <memory>

namespace plash {

/// Coupling of a closed rigid surface with the fluid of a box by the cells that it cuts (CutCells), in place
/// of the springs of FluidCoupling. Nodes of the fluid behind the surface are nobody's: they go along with
/// the surface across it, for its fluid would fall freely there.
class CutCoupling : public SurfaceCoupling {
public:
    CutCoupling(const CouplingOptions& options, const Surface& surface, EulerianFluid& fluid,
                const std::vector<Vec3>& position);
    CutCoupling(const CutCoupling&) = delete;

    std::size_t items() const override { return triangles_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    StepVote stable_step() const override;
    void report(EnergyLedger& ledger) const override { ledger.sliding -= work_on_structure_; }
    void serialise(Archive& archive) override { archive(force_, work_on_structure_); }
    void collect(const State& state, ElementResults& results) const override;
    std::vector<std::string> notices(const State& state) const override;

    Vec3 force() const override;

private:
    using Corners = std::array<Index, 3>; ///< nodes of the State

    EulerianFluid& fluid_;
    CutCells cells_;
    std::array<BoxCuts, 2> cuts_; ///< at the beginning and at the end of a step, in turn
    int now_ = 0;                 ///< of them, that of the present places of the triangles
    std::vector<Corners> corners_;
    std::vector<SurfaceTriangle> triangles_;
    std::vector<Vec3> force_;          ///< by corner of the triangles, on the structure at t_n [force]
    std::vector<Index> outside_entry_; ///< of each node of the fluid among its outside forces
    double work_on_structure_ = 0;

    const BoxCuts::Cell* gap() const;
    void find_cuts(const std::vector<Vec3>& position);
    bool has_moved(const State& state) const;
    std::array<double, 3> weights(const BoxCuts::Piece& piece) const;
    Vec3 velocity_of(const BoxCuts::Piece& piece, const State& state) const;
    void press(std::size_t triangle, const std::array<double, 3>& weight, const Vec3& force);
    void push_fluid(std::ptrdiff_t node, const Vec3& force);
    template <class Use>
    void for_wet_pieces(Use&& use) const;
    void find_swept(const State& state);
    void press_structure(const Vec3& gravity);
    void hold_covered_nodes(const Clock& clock, const State& state);
    double power(const State& state) const;
};

/// Refuses what it cannot do.
std::unique_ptr<CutCoupling> make_cut_coupling(const CouplingOptions& options, const Surface& surface,
                                               EulerianFluid& fluid, const std::vector<Vec3>& position);

} // namespace plash
