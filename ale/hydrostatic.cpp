#include "ale/hydrostatic.h"

#include "ale/cell_pieces.h"
#include "core/run_error.h"
#include "materials/parameters.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace plash {

namespace {

struct Column {
    const std::function<double(double, double)>& density;
    double gravity;
};

int slope(realtype depth, N_Vector pressure, N_Vector result, void* data)
{
    const Column& column = *static_cast<const Column*>(data);
    NV_Ith_S(result, 0) = column.density(NV_Ith_S(pressure, 0), depth) * column.gravity;
    return 0;
}

/// CVODE's objects, freed with this one.
class Integrator {
public:
    Integrator(Column& column, double top, double scale)
    {
        SUNContext_Create(nullptr, &context_);
        value_ = N_VNew_Serial(1, context_);
        NV_Ith_S(value_, 0) = top;
        memory_ = CVodeCreate(CV_ADAMS, context_);
        solver_ = SUNNonlinSol_FixedPoint(value_, 0, context_);
        const bool fine = CVodeInit(memory_, slope, 0, value_) == CV_SUCCESS &&
                          CVodeSetUserData(memory_, &column) == CV_SUCCESS &&
                          CVodeSStolerances(memory_, 1e-10, 1e-12 * scale) == CV_SUCCESS &&
                          CVodeSetNonlinearSolver(memory_, solver_) == CV_SUCCESS &&
                          CVodeSetMaxNumSteps(memory_, 100000) == CV_SUCCESS;
        if (!fine) throw RunError("CVODE could not be set up for the hydrostatic column");
    }
    ~Integrator()
    {
        CVodeFree(&memory_);
        SUNNonlinSolFree(solver_);
        N_VDestroy(value_);
        SUNContext_Free(&context_);
    }
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;

    double advance(double depth)
    {
        realtype reached = 0;
        if (CVode(memory_, depth, value_, &reached, CV_NORMAL) < 0)
            throw RunError(fmt::format("the hydrostatic column has no solution at depth {:g}", depth));
        return NV_Ith_S(value_, 0);
    }

private:
    SUNContext context_ = nullptr;
    N_Vector value_ = nullptr;
    SUNNonlinearSolver solver_ = nullptr;
    void* memory_ = nullptr;
};

/// A layer of one group below a level.
struct Layer {
    double top = 0; ///< depth at which it begins [length]
    int group = 0;  ///< by the deck's order
};

/// What one *INITIAL_HYDROSTATIC_ALE says.
struct Still : StillLevel {
    double gravity = 0; ///< [acceleration]
    double top = 0;     ///< pressure at the free surface [pressure]
    std::vector<Layer> layers;
};

Vec3 direction_of(const Model& model, const Record& record)
{
    const Id id = record.integer("VECID");
    const auto found = std::find_if(model.vectors.begin(), model.vectors.end(),
                                    [&](const NamedVector& vector) { return vector.id == id; });
    if (found == model.vectors.end()) reject_field(record, "VECID", fmt::format("there is no vector {}", id));
    return unit(found->head - found->tail);
}

Still still_of(const Model& model, const Record& record, const DeckGroups& groups)
{
    Still still;
    still.down = direction_of(model, record);
    still.gravity = record.real("GRAV");
    still.top = record.real("PBASE");
    const Table* table = record.table("NID");
    if (!table || table->rows() == 0) reject_field(record, "NID", "there is no layer");
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const Id id = std::llround(table->at(row, 0)), group = std::llround(table->at(row, 1));
        const auto node = std::find(model.nodes.id.begin(), model.nodes.id.end(), id);
        if (node == model.nodes.id.end())
            throw DeckError({record.where.file, table->lines[row]},
                            fmt::format("*{}, field NID: there is no node {}", record.keyword, id));
        if (group < 1 || group > static_cast<Id>(groups.groups.size()))
            throw DeckError({record.where.file, table->lines[row]},
                            fmt::format("*{}, field MMGBLO: there is no group {}; the deck has 1 to {}",
                                        record.keyword, group, groups.groups.size()));
        if (groups.groups[group - 1].fluid == none) continue; // empty space weighs nothing
        const Vec3 level = model.nodes.position[node - model.nodes.id.begin()];
        if (still.layers.empty()) still.surface = level;
        still.layers.push_back({still.depth(level), static_cast<int>(group) - 1});
    }
    if (still.layers.empty()) reject_field(record, "MMGBLO", "no layer has a fluid");
    std::sort(still.layers.begin(), still.layers.end(),
              [](const Layer& a, const Layer& b) { return a.top < b.top; });
    return still;
}

bool applies(const Model& model, const Record& record, const MeshBlock& block)
{
    const std::vector<Index> parts = parts_of_fields(model, record, "ALESID", "STYPE");
    return std::any_of(block.solids.begin(), block.solids.end(), [&](Index solid) {
        return std::find(parts.begin(), parts.end(), model.solids.part[solid]) != parts.end();
    });
}

/// How deep the middle of a cell lies, and half of its height, both along gravity [length].
struct CellDepth {
    double middle = 0, half_height = 0;
};

CellDepth depth_of(const FluidCell& cell, const StillLevel& still)
{
    double sum = 0, least = 1e300, most = -1e300;
    for (const Vec3& point : cell.points) {
        const double depth = still.depth(point);
        sum += depth;
        least = std::min(least, depth);
        most = std::max(most, depth);
    }
    return {0.125 * sum, 0.5 * (most - least)};
}

/// Pressures at the depths that the cells of a mesh ask for. Depths that differ by round-off alone count
/// once: the cells of a layer shall all have the same pressure.
class Profile {
public:
    Profile(const Fluid& fluid, const Still& still, const DeckGroups& groups) : top_(still.top)
    {
        for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
            const CellDepth depth = depth_of(fluid.cell(number), still);
            depths_.push_back(depth.half_height);
            if (depth.middle > 0) depths_.push_back(depth.middle);
        }
        std::sort(depths_.begin(), depths_.end());
        same_ = 1e-10 * depths_.back();
        depths_.erase(
            std::unique(depths_.begin(), depths_.end(), [&](double a, double b) { return b - a < same_; }),
            depths_.end());
        const auto density = [&](double pressure, double depth) {
            const Layer* layer = &still.layers.front();
            for (const Layer& next : still.layers)
                if (next.top <= depth) layer = &next;
            const DeckGroup& group = groups.groups[layer->group];
            return density_at_pressure(group.law, pressure, group.energy_per_mass);
        };
        pressures_ = pressures_below(still.top, density, still.gravity, depths_);
    }

    double at(double depth) const
    {
        if (depth <= 0) return top_;
        const auto found = std::lower_bound(depths_.begin(), depths_.end(), depth - same_);
        return pressures_[found - depths_.begin()];
    }

private:
    double top_, same_ = 0;
    std::vector<double> depths_, pressures_;
};

/// By how much more a cell that the free surface passes has to be filled than by the volume below the
/// surface, so that it rests. One pressure P and one density d of a cell press on a node z above its middle
/// with P - d g z: nothing on its dry upper nodes and the weight of the column on those below, if d is that
/// of the fluid times the share of the cell's height that is wet. Where a cell is no parallelepiped this is
/// not the share of its volume. Between upright walls the cells of a layer change their fluid only among
/// one another. One for cells whose ends are not level: no fraction balances all of their nodes.
double surface_correction(const FluidCell& cell, const Still& still)
{
    const CellDepth depth = depth_of(cell, still);
    const double round_off = 1e-9 * depth.half_height;
    for (const Vec3& point : cell.points)
        if (std::abs(std::abs(still.depth(point) - depth.middle) - depth.half_height) > round_off) return 1;
    Container below;
    below.origin = still.surface;
    below.normal = still.down;
    const double wet_volume = share_of_cell(below, cell);
    return wet_volume > 0 ? still.wet_share(cell) / wet_volume : 1;
}

} // namespace

double StillLevel::wet_share(const FluidCell& cell) const
{
    const CellDepth depth = depth_of(cell, *this);
    return std::clamp(0.5 * (1 + depth.middle / depth.half_height), 0.0, 1.0);
}

std::vector<double> pressures_below(double top, const std::function<double(double, double)>& density,
                                    double gravity, const std::vector<double>& depths)
{
    Column column{density, gravity};
    const double deepest = depths.empty() ? 0 : depths.back();
    const double scale = std::max(std::abs(top), density(top, 0) * gravity * deepest);
    Integrator integrator(column, top, scale);
    std::vector<double> pressures;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const bool again = i > 0 && depths[i] == depths[i - 1];
        pressures.push_back(depths[i] <= 0 ? top : again ? pressures.back() : integrator.advance(depths[i]));
    }
    return pressures;
}

double density_at_pressure(const FluidGroup& fluid, double pressure, double energy_per_mass)
{
    double density = fluid.reference_density;
    for (int round = 0; round < 50; ++round) {
        const FluidState<double> state = fluid_state(fluid, density, energy_per_mass);
        // dp/d(density) at constant entropy is close enough to that at constant energy.
        const double change = (pressure - state.pressure) * density / state.stiffness;
        density = std::clamp(density + change, 0.5 * density, 2 * density);
        if (std::abs(change) < 1e-15 * density) break;
    }
    return density;
}

std::optional<StillLevel> set_hydrostatic_state(Fluid& fluid, const MeshBlock& block,
                                                const DeckGroups& groups, const Model& model)
{
    std::optional<StillLevel> level;
    for (const Record& record : model.others) {
        if (record.keyword != "INITIAL_HYDROSTATIC_ALE" || !applies(model, record, block)) continue;
        const Still still = still_of(model, record, groups);
        level = still;
        const Profile profile(fluid, still, groups);
        const bool mixed = !fluid.fields.groups[0].fraction.empty();
        for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
            const FluidCell cell = fluid.cell(number);
            double filled = mixed ? 0 : 1;
            for (const GroupFields& group : fluid.fields.groups)
                if (mixed) filled += group.fraction[cell.place];
            const CellDepth depth = depth_of(cell, still);
            // Cells below the surface that are not full end at structures, which press as the water would.
            const bool at_surface = filled < 1 && depth.middle < depth.half_height;
            const double pressure = profile.at(at_surface ? depth.half_height : depth.middle);
            const double more = at_surface && filled > 0 && !block.is_box()
                                    ? std::min(surface_correction(cell, still), 1 / filled)
                                    : 1;
            for (const DeckGroup& group : groups.groups) {
                if (group.fluid == none) continue;
                const double share = mixed ? fluid.fields.groups[group.fluid].fraction[cell.place] : 1;
                if (share == 0) continue;
                const double density = density_at_pressure(group.law, pressure, group.energy_per_mass);
                fluid.fill_place(cell.place, cell.volume, group.fluid, more * share, density,
                                 group.energy_per_mass);
            }
        }
    }
    return level;
}

} // namespace plash
