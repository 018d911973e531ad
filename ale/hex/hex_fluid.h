#pragma once

#include "ale/cell_state.h"
#include "ale/fluid.h"
#include "ale/hex/hex_activity.h"
#include "ale/hex/hex_layout.h"
#include "ale/hex/hex_locator.h"
#include "ale/hex/hex_mesh.h"
#include "ale/hex/hex_motion.h"
#include "ale/hex/hex_smoothing.h"
#include "ale/hex/hex_sweep.h"
#include "ale/hex/hex_weight.h"

#include <optional>

namespace plash {

/// A fluid on a mesh of general hexahedra, by the same method as on a box (BoxFluid), to which it comes down
/// where cells are boxes: pressure acts on nodes by the derivatives of a cell's volume, and sweeps go along
/// the chords of the mesh, one direction after the other. Places of cells and nodes are their numbers.
class HexFluid : public Fluid {
public:
    HexMesh mesh;

    HexFluid(HexMesh mesh, std::vector<FluidGroup> groups, LagrangeSettings settings);

    double total_mass(int group) const override;
    std::array<double, 3> momentum() const override;

    std::size_t cell_count() const override { return mesh.cells(); }
    std::size_t node_count() const override { return mesh.nodes(); }
    FluidCell cell(std::size_t number) const override;
    double volume_of(std::ptrdiff_t place) const override { return mesh.volume[place]; }
    std::ptrdiff_t node_place(std::size_t number) const override { return number; }
    std::vector<OuterNode> outer_nodes() const override;
    void close_curved_walls() override;
    void shift(const std::array<double, 3>& distance) override;
    void move_nodes(std::vector<Vec3> next, double step) override;
    /// For meshes that follow their material, before the first step; nodes inside of `kept` are not smoothed.
    void prepare_to_follow(const std::vector<Index>& kept) { smoothing_.emplace(mesh, kept); }
    /// In the coming step the nodes go with the material and are then smoothed. Where they are not, nothing
    /// passes the faces between them.
    void follow_material(const NodeSmoothing& smoothing);

    MeshPoint locate(const Vec3& point, const std::array<int, 3>& guess) const override;
    std::ptrdiff_t place_of(const MeshPoint& point) const override { return point.cell[0]; }
    std::ptrdiff_t cell_beyond(const MeshPoint& point, int axis, int side) const override;
    PlaceWeights node_weights(const MeshPoint& point) const override;
    PlaceWeights cell_weights(const MeshPoint& point) const override;
    std::array<Vec3, 3> edges(const MeshPoint& point) const override { return mesh.edge[point.cell[0]]; }
    double point_spacing(const Vec3& a, const Vec3& b) const override;

    void serialise(Archive& archive) override;

protected:
    double accelerate(double step) override;
    double further_gravity_work(double step) const override;
    void deform(double step) override;
    double work_on_sides(double step) const override;
    double sweep() override;
    double return_lost_motion() override;
    void find_node_masses() override;
    CrossingRate evaluate(double last_step) override;
    std::ptrdiff_t number_of(std::ptrdiff_t place) const override { return place; }
    void update_contents() override;
    double kinetic_energy() const override;
    double internal_energy(int group) const override;

private:
    using Mask = BoxContents::Mask;

    bool mixed_;                   ///< a cell may be partly empty or hold several groups
    std::vector<HexSweep> sweeps_; ///< by direction
    HexLayout layout_;
    HexActivity activity_;
    HexLocator locator_;
    HexWeight weight_;
    HexMotion motion_;
    AlignedDoubles wind_; ///< by which a mesh that deforms passes its faces [volume/time]; else empty
    std::optional<NodeSmoothing> follows_;  ///< the material, in this step
    std::optional<HexSmoothing> smoothing_; ///< of a mesh that may follow it
    AlignedDoubles material_swept_;         ///< volumes that faces sweep with the material [length^3]
    Vec3 offset_{};                         ///< that the mesh has moved [length]
    double common_size_ = 0;                ///< median of the smallest widths of cells [length]

    AlignedDoubles mid_pressure_;            ///< of cells in the middle of the step [pressure]
    AlignedDoubles face_rate_;               ///< volume that passes a face by time [volume/time]
    AlignedDoubles face_seen_;               ///< the same, seen from the moving mesh; empty until it moves
    AlignedDoubles volume_flux_, mass_flux_; ///< through each face in the step
    /// Of the present sweep: by group and cell, then by group and face.
    struct GroupScratch {
        AlignedDoubles density, energy; ///< [density], [energy/mass]
        AlignedDoubles volume_flux, mass_flux, energy_flux;
        AlignedDoubles node_fraction; ///< of this group and those before it, mean of the cells around a node
    };
    std::vector<GroupScratch> scratch_;
    AlignedDoubles member_flux_;
    std::array<AlignedDoubles, 3> edge_velocity_;
    AlignedDoubles end_change_, end_inflow_; ///< masses that pass ends of chords, by swept node; else zero
    /// By direction: mass along its edges, and batches of edges and of faces whose fluxes are zero already.
    struct SweepScratch {
        AlignedDoubles edge_flux;
        std::vector<std::uint8_t> still_edges, still_faces;
    };
    std::vector<SweepScratch> of_sweep_;
    std::vector<std::uint8_t> still_nodes_, still_cells_; ///< batches without motion, without pressure

    bool mesh_moves() const;
    void stand_midway(double step);
    void go_with_material(double step);
    void take_wind(double step);
    void take_new_measures();
    bool weighs() const;
    const AlignedDoubles& seen() const { return mesh_moves() ? face_seen_ : face_rate_; }
    void find_face_rates(const std::array<AlignedDoubles, 3>& velocity, double step);
    std::array<Vec3, 3> velocity_gradient(std::size_t cell, const std::array<AlignedDoubles, 3>& of) const;
    Lanes viscous_work(std::size_t first, double step) const;
    Lanes stress_cells(std::size_t first);
    Lanes filled(Places cells) const;
    void find_openness();
    void calm_cells(std::size_t first);
    Lanes evaluate_cells(std::size_t first, double last_step, bool& torn);

    void find_node_fractions();
    void find_outflow_shares(const HexSweep& sweep);
    void find_densities();
    template <bool second_order>
    void find_fluxes(const HexSweep& sweep, int direction);
    template <bool second_order>
    Lanes flux_of_full(const HexSweep& sweep, std::size_t entry, int group, std::size_t lanes);
    template <bool second_order>
    Lanes flux_of_parts(const HexSweep& sweep, std::size_t entry, std::size_t lanes);
    void store_fluxes(int group, std::size_t face, const GroupFlux<Lanes>& passing, std::size_t lanes);
    void move_cells(const HexSweep& sweep, int direction);
    template <bool second_order>
    void find_edge_fluxes(const HexSweep& sweep, int direction);
    void move_momentum(const HexSweep& sweep, int direction, bool second_order);
    void update_nodes(const HexSweep& sweep, int direction);
    double motion_through_ends(const HexSweep& sweep) const;
};

} // namespace plash
