#pragma once

#include "ale/box_fields.h"
#include "ale/cell_state.h"
#include "ale/fluid.h"
#include "ale/hex/hex_locator.h"
#include "ale/hex/hex_mesh.h"
#include "ale/hex/hex_sweep.h"
#include "ale/outflow_shares.h"

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
    std::ptrdiff_t node_place(std::size_t number) const override { return number; }
    std::vector<OuterNode> outer_nodes() const override;
    void shift(const std::array<double, 3>& distance) override;

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
    void deform(double step) override;
    double work_on_sides() const override;
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
    HexLocator locator_;
    Vec3 offset_{};                 ///< that the mesh has moved [length]
    double common_size_ = 0;        ///< median of the smallest widths of cells [length]
    std::vector<Vec3> corner_area_; ///< derivative of a cell's volume by its corner, like mesh.node_corner
    std::vector<Vec3> outer_area_;  ///< of outer faces, outward, by node [length^2]
    std::vector<Mask> contents_;    ///< of each cell

    /// Faces in lanes: nodes, and components of the areas of their corners.
    std::array<std::vector<Index>, 4> face_nodes_;
    std::array<std::array<AlignedDoubles, 3>, 4> face_area_;
    std::array<std::vector<Index>, 6> cell_faces_; ///< cells in lanes: their faces
    std::array<AlignedDoubles, 3> width_;          ///< and widths [length]
    AlignedDoubles face_rate_;                     ///< volume that passes a face by time [volume/time]
    AlignedDoubles face_seen_;                     ///< the same, seen from the moving mesh
    AlignedDoubles volume_flux_, mass_flux_;       ///< through each face in the step
    /// Of the present sweep: by group and cell, then by group and face of the direction.
    struct GroupScratch {
        AlignedDoubles density, energy; ///< [density], [energy/mass]
        AlignedDoubles volume_flux, mass_flux, energy_flux;
    };
    std::vector<GroupScratch> scratch_;
    AlignedDoubles member_flux_, edge_flux_;
    std::array<AlignedDoubles, 3> edge_velocity_;

    void lay_out_lanes();
    void find_openness();
    template <class Lane>
    Lane respond(std::size_t cell, const CellState<Lane>& state, const CellStrain<Lane>& strain,
                 Lane crossing);
    bool evaluate_full(std::size_t cell, CrossingRate& limit);
    CrossingRate evaluate_cell(std::size_t cell, double last_step, bool& torn);
    double filled(std::size_t cell) const;
    void find_face_rates(const std::array<AlignedDoubles, 3>& velocity);
    std::array<Vec3, 3> velocity_gradient(std::size_t cell, const std::array<AlignedDoubles, 3>& of) const;

    void find_outflow_shares(const HexSweep& sweep);
    Vector3<double> gradient(const FirstGroups& first, std::size_t cell) const;
    template <bool second_order>
    void find_fluxes(const HexSweep& sweep);
    template <bool second_order>
    Lanes flux_of_full(const HexSweep& sweep, std::size_t entry);
    template <bool second_order>
    Lanes flux_of_parts(const HexSweep& sweep, std::size_t entry);
    void move_cells(const HexSweep& sweep);
    template <bool second_order>
    void move_momentum(const HexSweep& sweep);
    void update_nodes(const HexSweep& sweep);
    double motion_through_ends(const HexSweep& sweep) const;
};

} // namespace plash
