#pragma once

#include "ale/coupling/coupling_options.h"
#include "ale/coupling/coupling_points.h"
#include "ale/coupling/interface_depth.h"
#include "ale/coupling/surface_coupling.h"

#include <memory>
#include <optional>

namespace plash {

/// Penalty coupling of a surface with the fluid of an Eulerian mesh: where fluid stands before a point of the
/// surface, the motion that carries it through the surface is summed up as a penetration, and a spring (and a
/// damper) presses both apart. Fluid nodes take the force by the trilinear weights of the point, so that
/// force and moment on both sides are equal and opposite. See docs/eulerian.md. Sources: Olovsson & Souli
/// (2000), 'Eulerian-Lagrangian coupling using fluid-structure interaction algorithm', for the penalty form;
/// Aquelet, Souli & Olovsson (2006), Comput. Methods Appl. Mech. Engrg. 195, 110-132, for stiffness and
/// damping.
class FluidCoupling : public SurfaceCoupling {
public:
    FluidCoupling(const Model& model, CouplingOptions options, Surface surface, EulerianFluid& fluid,
                  const std::vector<Vec3>& position);

    std::size_t items() const override { return points_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override;
    void serialise(Archive& archive) override;
    void collect(const State& state, ElementResults& results) const override;

    Vec3 force() const override;

private:
    /// What is known of a point in this cycle.
    struct Touch {
        MeshPoint place;       ///< in the mesh
        Vec3 position;         ///< [length]
        PlaceWeights at;       ///< nodes of the fluid; weights without empty nodes
        Vec3 normal;           ///< unit, into the fluid
        double area = 0;       ///< [length^2]
        double stiffness = 0;  ///< spring of the point [force/length]
        double damper = 0;     ///< [force time/length]
        Vec3 velocity;         ///< of the surface [velocity]
        Vec3 approach;         ///< velocity of the surface against the fluid [velocity]
        double pressing = 0;   ///< normal force, positive apart [force]
        double sound_rate = 0; ///< of the fluid, cells passed in a time [1/time]
        double excess = 0;     ///< how far fluid stands behind the surface [length]; only with leak control
        bool active = false;   ///< fluid stands before it
    };

    const Model& model_;
    CouplingOptions options_;
    CouplingPoints points_;
    EulerianFluid& fluid_;
    std::vector<double> bulk_modulus_; ///< of each fluid at reference density [pressure]

    std::vector<Touch> touches_;
    std::vector<double> penetration_; ///< of each point along its normal [length]
    /// Of points that started with the pressure of a fluid at rest, how much deeper those around were then
    /// than the volumes of the fluid say [length]; empty without a hydrostatic start.
    std::vector<double> rest_depth_;
    /// And how much deeper than those of its plane in its cell taken together [length].
    std::vector<double> rest_unevenness_;
    std::vector<Vec3> slip_;               ///< and across it, where that is held [length]
    std::vector<Vec3> force_;              ///< on the structure at each point at t_n [force]
    std::vector<std::array<int, 3>> cell_; ///< where each point was last
    std::vector<char> segment_near_;       ///< fluid may stand at some point of the segment
    std::vector<Index> near_;              ///< points of such segments, rising
    std::vector<Index> active_;            ///< those that fluid stands before, rising

    /// Mass that the springs and dampers on each node need to be stable, by storage place of the fluid's
    /// nodes and by node of the State [mass]; zero between uses.
    std::vector<double> load_, structure_load_;
    DryFaces dry_faces_;
    std::vector<DryFaces::Point> present_; ///< points in the mesh; none where it has no void
    std::vector<Index> asking_;            ///< of present_, those that fluid stands before
    InterfaceDepth interface_depth_;
    std::vector<Index> entry_; ///< of each node of the fluid among its outside forces, by storage place
    double work_on_structure_ = 0;
    bool hydrostatic_ = false; ///< the fluid starts at rest under gravity

    bool is_near(std::size_t segment, const State& state) const;
    void find_near(const Clock& clock, const State& state);
    MeshPoint place_before(const Touch& touch, const std::array<int, 3>& guess) const;
    void look(std::size_t point, const State& state);
    void list_active();
    double fraction_before(const Touch& touch) const;
    double share_behind(const MeshPoint& at, const Vec3& normal) const;
    void limit_stiffness(const State& state);
    void add_loads();
    void clear_loads();
    double needed_mass(const Touch& touch) const;
    double pressure_before(const Touch& touch, const Vec3& gravity) const;
    void rest_on(std::size_t point, const Vec3& gravity);
    void stretch(std::size_t point, const Clock& clock);
    std::optional<double> unknown_depth(const Touch& touch) const;
    double unevenness(std::size_t point) const;
    void remember_rest(std::size_t point);
    void sum_depths();
    void load_spring(std::size_t point, const Clock& clock);
    double share_of_way(const Touch& touch, double cells_of_sound, const Clock& clock) const;
    void correct_depth(std::size_t point, const Clock& clock);
    void separate();
    void press(std::size_t point, const Clock& clock);
    void find_dry_faces();
    void push_fluid(const Touch& touch, const Vec3& force);
    void hand_out(const Clock& clock, State& state);
    ElementResults::ContactForce as_contact(const State& state) const;
    double step_bound() const { return fluid_.fluid().stable_step(); }
};

/// The couplings of a Model with these fluids.
std::vector<std::unique_ptr<SurfaceCoupling>>
make_fluid_couplings(const Model& model, const std::vector<EulerianFluid*>& fluids, const State& state);

} // namespace plash
