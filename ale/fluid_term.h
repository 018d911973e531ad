#pragma once

#include "ale/box_fluid.h"
#include "ale/deck_groups.h"
#include "ale/hydrostatic.h"
#include "ale/mesh_block.h"
#include "ale/mesh_boundary.h"
#include "ale/mesh_motion.h"
#include "core/term.h"

#include <functional>
#include <memory>

namespace plash {

class HexFluid;

/// The fluid in one Eulerian mesh of a deck as a Term. Its nodes have no mass in the State and stay, or move
/// with the mesh as a whole; the fluid keeps its own velocities, at t_n, and goes from n to n + 1 once the
/// structures have moved.
class EulerianFluid : public Term {
public:
    EulerianFluid(const Model& model, MeshBlock block, DeckGroups groups, const FluidSettings& settings);

    std::string_view name() const override { return "Eulerian fluid"; }
    std::size_t items() const override { return fluid_->cell_count(); }
    /// In the first cycle takes over the initial velocities of the State's nodes. In a phase before the run
    /// the fluid stands still.
    void add_forces(const Clock& clock, State& state) override;
    void after_motion(const Clock& clock, State& state) override;
    void begin_phase(bool /*relaxing*/, State& /*state*/) override { clear_outside(); }
    StepVote stable_step() const override;
    void report(EnergyLedger& ledger) const override;
    void serialise(Archive& archive) override;
    std::vector<std::string> notices(const State& state) const override;
    void collect(const State& state, ElementResults& results) const override;

    const Fluid& fluid() const { return *fluid_; }
    Fluid& fluid() { return *fluid_; }
    /// The fluid of a mesh that is a box.
    BoxFluid& box() { return dynamic_cast<BoxFluid&>(*fluid_); }
    /// The fluid of a mesh that is not.
    HexFluid& hexahedra();
    /// Called before each step of the fluid, when the structures have moved.
    std::function<void(const State&)> follow_structures;
    bool moves() const { return motion_.moves(); }
    const MeshBlock& block() const { return block_; }
    const DeckGroups& groups() const { return groups_; }
    /// The level of a fluid that starts at rest.
    const std::optional<StillLevel>& still_level() const { return still_; }
    struct Unrest {
        double acceleration = 0; ///< along an axis [acceleration]
        Vec3 place{};            ///< [length]
    };
    /// Largest acceleration of the fluid in the first cycle of a run that begins with the state as it is.
    Unrest first_unrest(const State& state);
    /// Acceleration of the frame's loads on the fluid [acceleration].
    std::array<double, 3> gravity(double time) const;

private:
    const Model& model_;
    MeshBlock block_;
    DeckGroups groups_;
    std::unique_ptr<Fluid> fluid_;
    MeshBoundary boundary_;
    MeshMotion motion_;
    std::vector<Vec3> reference_before_; ///< places of the nodes that a deforming mesh has followed [length]
    std::size_t reference_rule_ = 0;     ///< by which it did
    MeshSmoothing smoothing_;
    Index outside_pressure_curve_;          ///< none: the pressure on the outer faces stays as it is
    std::vector<std::size_t> loaded_nodes_; ///< of the mesh, on which loads of the deck act
    std::vector<const BodyLoad*> frame_loads_;
    bool started_ = false;
    std::optional<StillLevel> still_; ///< it starts at rest, and so does what is coupled with it

    void start(State& state);
    void clear_outside();
    void find_ambient_cells();
    void find_loaded_nodes();
    void find_frame_loads();
    void take_loads(const State& state);
    void move_mesh(const Clock& clock, State& state);
    void deform_mesh(const Clock& clock, State& state);
    void follow_material(double time);
    void advance(const Clock& clock);
    void refuse_walls() const;
    std::vector<Vec3> reference_nodes(const State& state, double time) const;
    Index part_of_group(const DeckGroup& group) const;
    void collect_cells(ElementResults& results) const;
    void collect_nodes(ElementResults& results) const;
    void collect_parts(ElementResults& results) const;
    double kinetic_per_mass(const FluidCell& cell) const;
    void collect_cell_sums(ElementResults& results) const;
    void collect_region(ElementResults::FluidRegion& region) const;
};

/// The fluids of all Eulerian meshes of a Model; none when it has none.
std::vector<std::unique_ptr<EulerianFluid>> make_eulerian_fluids(const Model& model);

} // namespace plash
