#include "ale/coupling/cut_coupling.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace plash {

CutCoupling::CutCoupling(const CouplingOptions& options, const Surface& surface, EulerianFluid& fluid,
                         const std::vector<Vec3>& position)
    : fluid_(fluid),
      cells_(fluid.box()),
      cuts_{BoxCuts(fluid.box().grid), BoxCuts(fluid.box().grid)},
      outside_entry_(fluid.fluid().fields.node_mass.size(), none)
{
    for (const Segment& segment : surface.segments) {
        auto [a, b, c, d] = segment.nodes;
        if (options.turned) std::swap(b, d == c ? c : d);
        const bool triangle = segment.nodes[2] == segment.nodes[3];
        if (triangle && options.turned) d = c;
        corners_.push_back({a, b, c});
        if (!triangle) corners_.push_back({a, c, d});
    }
    triangles_.resize(corners_.size());
    force_.resize(3 * corners_.size());
    for (const int axis : {2, 1, 0}) {
        for (BoxCuts& cuts : cuts_) cuts = BoxCuts(fluid.box().grid, axis);
        find_cuts(position);
        if (!gap()) break;
    }
    if (const BoxCuts::Cell* cell = gap()) {
        const Vec3& at = cuts_[now_].pieces(*cell)[0].middle;
        throw DeckError(
            options.where,
            fmt::format("coupling {}: its surface is not closed in the fluid, or there is no lower side "
                        "of the mesh that lies on one side of it, as CUTCELLS of "
                        "*PLASH_ALE_FORMULATION wants it, near ({:g}, {:g}, {:g})",
                        options.id, at.x, at.y, at.z));
    }
    fluid.box().cut = &cells_;
    fluid.follow_structures = [this](const State& state) {
        now_ = 1 - now_;
        find_cuts(state.position);
        cells_.end(cuts_[now_]);
    };
}

/// A cell that the surface does not close, with fluid in it or beside it.
const BoxCuts::Cell* CutCoupling::gap() const
{
    const BoxGrid& grid = fluid_.box().grid;
    const AlignedDoubles& mass = fluid_.box().fields.total_mass();
    for (const BoxCuts::Cell& cell : cuts_[now_].cells()) {
        const std::ptrdiff_t place = grid.at(cell.index[0], cell.index[1], cell.index[2]);
        bool wet = mass[place] > 0;
        for (int axis = 0; axis < 3; ++axis)
            wet = wet || mass[place - grid.stride(axis)] > 0 || mass[place + grid.stride(axis)] > 0;
        if (wet && norm(cuts_[now_].gap(cell)) > 1e-6) return &cell;
    }
    return nullptr;
}

void CutCoupling::find_cuts(const std::vector<Vec3>& position)
{
    for (std::size_t n = 0; n < corners_.size(); ++n)
        for (int corner = 0; corner < 3; ++corner)
            triangles_[n].corner[corner] = position[corners_[n][corner]];
    cuts_[now_].find(fluid_.box().grid, triangles_);
}

/// Rigid bodies may put their nodes straight after the fluid has looked at them.
bool CutCoupling::has_moved(const State& state) const
{
    for (std::size_t n = 0; n < corners_.size(); ++n) {
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 &known = triangles_[n].corner[corner], &now = state.position[corners_[n][corner]];
            if (known.x != now.x || known.y != now.y || known.z != now.z) return true;
        }
    }
    return false;
}

/// Of the corners of the piece's triangle, for what acts at its middle.
std::array<double, 3> CutCoupling::weights(const BoxCuts::Piece& piece) const
{
    const auto& [a, b, c] = triangles_[piece.triangle].corner;
    const Vec3 whole = cross(b - a, c - a);
    const double square = dot(whole, whole);
    const double at_b = dot(cross(piece.middle - a, c - a), whole) / square,
                 at_c = dot(cross(b - a, piece.middle - a), whole) / square;
    return {1 - at_b - at_c, at_b, at_c};
}

Vec3 CutCoupling::velocity_of(const BoxCuts::Piece& piece, const State& state) const
{
    const std::array<double, 3> weight = weights(piece);
    Vec3 velocity{};
    for (int n = 0; n < 3; ++n) velocity += weight[n] * state.velocity[corners_[piece.triangle][n]];
    return velocity;
}

void CutCoupling::press(std::size_t triangle, const std::array<double, 3>& weight, const Vec3& force)
{
    for (int n = 0; n < 3; ++n) force_[3 * triangle + n] += weight[n] * force;
}

void CutCoupling::push_fluid(std::ptrdiff_t node, const Vec3& force)
{
    auto& outside = fluid_.fluid().outside_forces;
    Index& entry = outside_entry_[node];
    if (entry == none) {
        entry = static_cast<Index>(outside.size());
        outside.push_back({node, {}});
    }
    outside[entry].force[0] += force.x;
    outside[entry].force[1] += force.y;
    outside[entry].force[2] += force.z;
}

/// use(group, piece) for all pieces of the surface in fluid.
template <class Use>
void CutCoupling::for_wet_pieces(Use&& use) const
{
    const BoxCuts& cuts = cuts_[now_];
    const BoxGrid& grid = fluid_.box().grid;
    for (const BoxCuts::Cell& cell : cuts.cells()) {
        const Index group = cells_.group_of(grid.at(cell.index[0], cell.index[1], cell.index[2]));
        if (group == none) continue;
        for (const BoxCuts::Piece& piece : cuts.pieces(cell)) use(group, piece);
    }
}

void CutCoupling::find_swept(const State& state)
{
    for_wet_pieces([&](Index group, const BoxCuts::Piece& piece) {
        cells_.groups()[group].swept += dot(piece.area, velocity_of(piece, state));
    });
}

void CutCoupling::press_structure(const Vec3& gravity)
{
    for_wet_pieces([&](Index group, const BoxCuts::Piece& piece) {
        press(piece.triangle, weights(piece), -cells_.pressure_at(group, piece.middle, gravity) * piece.area);
    });
}

/// The mass of a node behind the surface goes along with the nearest piece of it, across it.
void CutCoupling::hold_covered_nodes(const Clock& clock, const State& state)
{
    if (!(clock.last_step > 0)) return;
    const BoxFluid& box = fluid_.box();
    const BoxGrid& grid = box.grid;
    const BoxCuts& cuts = cuts_[now_];
    struct Nearest {
        double distance = 1e300;
        const BoxCuts::Piece* piece = nullptr;
    };
    std::unordered_map<std::ptrdiff_t, Nearest> nearest;
    std::vector<std::ptrdiff_t> order;
    for (const BoxCuts::Cell& cell : cuts.cells()) {
        for (int corner = 0; corner < 8; ++corner) {
            const int i = cell.index[0] + (corner & 1), j = cell.index[1] + (corner >> 1 & 1),
                      k = cell.index[2] + (corner >> 2 & 1);
            const std::ptrdiff_t node = grid.at(i, j, k);
            if (!(box.fields.node_mass[node] > 0) || cuts.node_open(i, j, k)) continue;
            const Vec3 place{grid.planes(0)[i], grid.planes(1)[j], grid.planes(2)[k]};
            auto [entry, is_new] = nearest.try_emplace(node);
            if (is_new) order.push_back(node);
            for (const BoxCuts::Piece& piece : cuts.pieces(cell)) {
                const double distance = std::abs(dot(place - piece.middle, unit(piece.area)));
                if (distance < entry->second.distance - 1e-9 * grid.smallest_width(0))
                    entry->second = {distance, &piece};
            }
        }
    }
    for (const std::ptrdiff_t node : order) {
        const BoxCuts::Piece& piece = *nearest[node].piece;
        const Vec3 normal = unit(piece.area);
        const auto& v = box.fields.velocity;
        const Vec3 change = velocity_of(piece, state) - Vec3{v[0][node], v[1][node], v[2][node]};
        const double wanted = dot(change, normal) / clock.last_step;
        const Vec3 force = (box.fields.node_mass[node] * wanted) * normal;
        push_fluid(node, force);
        press(piece.triangle, weights(piece), -force);
    }
}

double CutCoupling::power(const State& state) const
{
    double sum = 0;
    for (std::size_t n = 0; n < corners_.size(); ++n)
        for (int corner = 0; corner < 3; ++corner)
            sum += dot(force_[3 * n + corner], state.velocity[corners_[n][corner]]);
    return sum;
}

void CutCoupling::add_forces(const Clock& clock, State& state)
{
    const double before = power(state);
    if (has_moved(state)) find_cuts(state.position);
    std::fill(force_.begin(), force_.end(), Vec3{});
    cells_.begin(cuts_[now_]);
    find_swept(state);
    cells_.find_pressures(clock.last_step);
    const std::array<double, 3> g = fluid_.gravity(clock.time);
    const Vec3 gravity{g[0], g[1], g[2]};
    cells_.press_nodes(gravity, [&](std::ptrdiff_t node, int axis, double force) {
        if (force == 0) return;
        Vec3 along{};
        along.*vector_component[axis] = force;
        push_fluid(node, along);
    });
    press_structure(gravity);
    hold_covered_nodes(clock, state);
    for (const NodeForceFromOutside& outside : fluid_.fluid().outside_forces)
        outside_entry_[outside.place] = none;
    for (std::size_t n = 0; n < corners_.size(); ++n)
        for (int corner = 0; corner < 3; ++corner) state.force[corners_[n][corner]] += force_[3 * n + corner];
    work_on_structure_ += 0.5 * clock.last_step * (before + power(state));
}

StepVote CutCoupling::stable_step() const
{
    StepVote vote;
    vote.step = cells_.stable_step();
    vote.kind = "cut cell";
    return vote;
}

void CutCoupling::collect(const State&, ElementResults& results) const
{
    if (results.coupling_force.empty()) return;
    for (std::size_t n = 0; n < corners_.size(); ++n)
        for (int corner = 0; corner < 3; ++corner)
            results.coupling_force[corners_[n][corner]] += force_[3 * n + corner];
}

Vec3 CutCoupling::force() const
{
    Vec3 sum{};
    for (const Vec3& force : force_) sum += force;
    return sum;
}

std::vector<std::string> CutCoupling::notices(const State&) const
{
    return {
        "CUTCELLS of *PLASH_ALE_FORMULATION: the fluid meets the surface in the cells that it cuts, without "
        "springs; PFAC, DAMP, NQUAD, FRCMIN, DIREC, ILEAK and PLEAK of the coupling have no effect"};
}

std::unique_ptr<CutCoupling> make_cut_coupling(const CouplingOptions& options, const Surface& surface,
                                               EulerianFluid& fluid, const std::vector<Vec3>& position)
{
    const auto refuse = [&](std::string_view why) {
        throw DeckError(options.where, fmt::format("coupling {}: with CUTCELLS of *PLASH_ALE_FORMULATION {}",
                                                   options.id, why));
    };
    if (!fluid.block().is_box()) refuse("the mesh must be a block between planes along the global axes");
    if (fluid.moves()) refuse("the mesh must stand still");
    if (!fluid.fluid().lagrange.void_allowed) refuse("the mesh must have void (*MAT_VACUUM, ELFORM 12)");
    if (fluid.box().cut) refuse("a mesh can have one coupling only");
    const unsigned all = (1u << fluid.fluid().groups.size()) - 1;
    if ((options.fluids & all) != all) refuse("MCOUP must name all groups");
    if (std::any_of(surface.segments.begin(), surface.segments.end(),
                    [](const Segment& s) { return !s.rigid; }))
        refuse("the structure must be rigid");
    if (options.direction == CouplingOptions::Direction::all || options.friction != 0)
        refuse("nothing can be held along the surface (CTYPE 1, 2; DIREC 3; FRIC)");
    if (options.pressure_curve != none) refuse("PFAC cannot be a curve");
    constexpr double default_end = 1e10;
    if (options.start > 0 || options.end < default_end) refuse("START and END cannot be given");
    if (options.both_sides || options.contact != 0) refuse("a coupling cannot stand for a contact");
    return std::make_unique<CutCoupling>(options, surface, fluid, position);
}

} // namespace plash
