#pragma once

#include "ale/coupling/coupling_options.h"
#include "ale/coupling/cut_cells.h"
#include "ale/coupling/surface_coupling.h"
#include "ale/fluid_term.h"
#include "contact/surface.h"

namespace plash {

/// A surface that a coupling of the deck names.
struct CoupledSurface {
    CouplingOptions options;
    Surface surface;
};

/// Couplings of closed surfaces, rigid or not, with the fluid of a box by the cells that they cut (CutCells),
/// in place of the springs of FluidCoupling: one set of cuts for all couplings of a mesh. Forces go to the
/// nodes of triangles by their shape functions. Nodes of the fluid behind the surface are nobody's: they go
/// along with the surface across it, for its fluid would fall freely there.
class CutCoupling : public SurfaceCoupling {
public:
    CutCoupling(std::vector<CoupledSurface> surfaces, EulerianFluid& fluid,
                const std::vector<Vec3>& position);
    CutCoupling(const CutCoupling&) = delete;

    std::size_t items() const override { return triangles_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    StepVote stable_step() const override;
    void report(EnergyLedger& ledger) const override { ledger.sliding -= work_on_structure_; }
    void serialise(Archive& archive) override
    {
        archive(force_, work_on_structure_);
        cells_.serialise(archive);
    }
    void collect(const State& state, ElementResults& results) const override;
    std::vector<std::string> notices(const State& state) const override;

    Vec3 force() const override;

private:
    /// Nodes of the State that carry a triangle. Two triangles make a rigid quadrilateral. One that deforms
    /// is made of four around its middle, which goes with the mean of all nodes, so that each bears the same
    /// share of a pressure; its triangle has the first two nodes and the middle as corners.
    struct Carriers {
        std::array<Index, 4> node; ///< without a middle, the last one repeats the third and bears nothing
        bool middle;
    };
    using Weights = std::array<double, 4>; ///< of the nodes that carry a triangle

    EulerianFluid& fluid_;
    std::vector<CoupledSurface> surfaces_;
    std::vector<std::size_t> first_triangle_; ///< of each surface
    bool deformable_ = false;                 ///< some surface is
    CutCells cells_;
    std::array<BoxCuts, 2> cuts_;    ///< at the beginning and at the end of a step, in turn
    int now_ = 0;                    ///< of them, that of the present places of the triangles
    std::vector<Carriers> carriers_; ///< of the triangles
    std::vector<SurfaceTriangle> triangles_;
    std::vector<Vec3> force_;          ///< by carrier of the triangles, on the structure at t_n [force]
    std::vector<Index> outside_entry_; ///< of each node of the fluid among its outside forces
    double work_on_structure_ = 0;
    double refilled_ = 0; ///< largest share of a cell by which fluid at rest was fitted to the cuts

    const BoxCuts::Cell* gap() const;
    const CouplingOptions& options_of(Index triangle) const;
    void check_exposed(const Clock& clock, const State& state) const;
    SurfaceTriangle triangle_at(std::size_t number, const std::vector<Vec3>& position) const;
    void find_cuts(const std::vector<Vec3>& position);
    bool has_moved(const State& state) const;
    Weights weights(const BoxCuts::Piece& piece) const;
    Weights of_carriers(std::size_t triangle, double at_a, double at_b, double at_c) const;
    Weights lean(const BoxCuts::Piece& piece, const Vec3& slope) const;
    Vec3 velocity_of(const BoxCuts::Piece& piece, const State& state) const;
    void press(std::size_t triangle, const Weights& weight, const Vec3& force);
    void push_fluid(std::ptrdiff_t node, const Vec3& force);
    template <class Use>
    void for_wet_pieces(Use&& use) const;
    void find_swept(const State& state);
    void find_compliance(const State& state);
    void press_structure(const Vec3& gravity);
    void hold_covered_nodes(const Clock& clock, const State& state);
    struct Covered {
        std::ptrdiff_t node;
        const BoxCuts::Piece* piece; ///< nearest one
    };
    std::vector<Covered> covered_nodes() const;
    std::vector<double> shares_of_motion(const std::vector<Covered>& covered, const State& state) const;
    double power(const State& state) const;
};

/// Whether a coupling can be one by cut cells: refuses what cannot.
void check_cut_coupling(const CoupledSurface& surface, const EulerianFluid& fluid);

} // namespace plash
