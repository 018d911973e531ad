#pragma once

#include "ale/box_fields.h"
#include "ale/fluid.h"

namespace plash {

/// Cells of a box whose pressure, change of volume and fluxes somebody else knows: called within a step.
class CutCellStep {
public:
    virtual ~CutCellStep() = default;
    /// Before the pressures of the cells act on whole faces.
    virtual void before_forces() = 0;
    /// Once mean velocities are known: volumes, fluxes, fractions and energies for the remap. Returns the
    /// work of their fluid [energy].
    virtual double deform(double step) = 0;
    /// Once the shares of what leaves the cells across an axis are known.
    virtual void share_outflow(int axis) = 0;
    /// Before and after pressures are found.
    virtual void keep() = 0;
    virtual void restore() = 0;
};

/// A fluid on a box of cells between planes (BoxGrid).
class BoxFluid : public Fluid {
public:
    BoxGrid grid;
    BoxContents contents;
    CutCellStep* cut = nullptr; ///< not owned; none: there are no such cells

    BoxFluid(BoxGrid grid, std::vector<FluidGroup> groups, LagrangeSettings settings);

    void fill_cell(int i, int j, int k, int group, double fraction, double density, double energy_per_mass)
    {
        fill_place(grid.at(i, j, k), grid.volume(i, j, k), group, fraction, density, energy_per_mass);
    }
    double total_mass(int group) const override;
    std::array<double, 3> momentum() const override;

    std::size_t cell_count() const override { return grid.cell_count(); }
    std::size_t node_count() const override;
    FluidCell cell(std::size_t number) const override;
    double volume_of(std::ptrdiff_t place) const override;
    std::ptrdiff_t node_place(std::size_t number) const override;
    std::vector<OuterNode> outer_nodes() const override;
    void shift(const std::array<double, 3>& distance) override;
    void move_nodes(std::vector<Vec3> next, double step) override;

    MeshPoint locate(const Vec3& point, const std::array<int, 3>& guess) const override;
    std::ptrdiff_t place_of(const MeshPoint& point) const override;
    std::ptrdiff_t cell_beyond(const MeshPoint& point, int axis, int side) const override;
    PlaceWeights node_weights(const MeshPoint& point) const override;
    PlaceWeights cell_weights(const MeshPoint& point) const override;
    std::array<Vec3, 3> edges(const MeshPoint& point) const override;
    bool dry_around(const Vec3& low, const Vec3& high, const std::array<int, 3>& guess,
                    unsigned fluids) const override;
    double point_spacing(const Vec3& a, const Vec3& b) const override;

    void serialise(Archive& archive) override;

protected:
    double accelerate(double step) override;
    void deform(double step) override;
    double work_on_sides(double step) const override;
    double sweep() override;
    double return_lost_motion() override;
    void find_node_masses() override;
    CrossingRate evaluate(double last_step) override;
    std::ptrdiff_t number_of(std::ptrdiff_t place) const override;
    void update_contents() override { contents.update(grid, fields); }
    double kinetic_energy() const override;
    double internal_energy(int group) const override;

private:
    RemapScratch scratch_;
    double pressed_ = 0; ///< outside pressure that stands in the ghosts [pressure]

    void press();
};

} // namespace plash
