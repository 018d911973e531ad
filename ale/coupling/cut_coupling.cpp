#include "ale/coupling/cut_coupling.h"

#include "core/run_error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace plash {

CutCoupling::CutCoupling(std::vector<CoupledSurface> surfaces, EulerianFluid& fluid,
                         const std::vector<Vec3>& position)
    : fluid_(fluid),
      surfaces_(std::move(surfaces)),
      cells_(fluid.box()),
      cuts_{BoxCuts(fluid.box().grid), BoxCuts(fluid.box().grid)},
      outside_entry_(fluid.fluid().fields.node_mass.size(), none)
{
    for (const auto& [options, surface] : surfaces_) {
        first_triangle_.push_back(carriers_.size());
        for (const Segment& segment : surface.segments) {
            auto [a, b, c, d] = segment.nodes;
            if (options.turned) std::swap(b, d == c ? c : d);
            const bool triangle = segment.nodes[2] == segment.nodes[3];
            if (triangle && options.turned) d = c;
            if (triangle || segment.rigid) {
                carriers_.push_back({{a, b, c, c}, false});
                if (!triangle) carriers_.push_back({{a, c, d, d}, false});
            } else {
                for (const auto& nodes : {std::array{a, b, c, d}, std::array{b, c, d, a},
                                          std::array{c, d, a, b}, std::array{d, a, b, c}})
                    carriers_.push_back({nodes, true});
            }
            deformable_ = deformable_ || !segment.rigid;
        }
    }
    triangles_.resize(carriers_.size());
    force_.resize(4 * carriers_.size());
    for (const int axis : {2, 1, 0}) {
        for (BoxCuts& cuts : cuts_) cuts = BoxCuts(fluid.box().grid, axis);
        find_cuts(position);
        if (!gap()) break;
    }
    if (const BoxCuts::Cell* cell = gap()) {
        const BoxCuts::Piece& piece = cuts_[now_].pieces(*cell)[0];
        const CouplingOptions& options = options_of(piece.triangle);
        throw DeckError(
            options.where,
            fmt::format("coupling {}: its surface is not closed in the fluid, or there is no lower side "
                        "of the mesh that lies on one side of it, as CUTCELLS of "
                        "*PLASH_ALE_FORMULATION wants it, near ({:g}, {:g}, {:g})",
                        options.id, piece.middle.x, piece.middle.y, piece.middle.z));
    }
    fluid.box().cut = &cells_;
    if (const auto& level = fluid.still_level()) refilled_ = cells_.fill_wet_parts(cuts_[now_], *level);
    fluid.follow_structures = [this](const State& state) {
        now_ = 1 - now_;
        find_cuts(state.position);
        cells_.end(cuts_[now_]);
    };
}

const CouplingOptions& CutCoupling::options_of(Index triangle) const
{
    const auto after =
        std::upper_bound(first_triangle_.begin(), first_triangle_.end(), std::size_t(triangle));
    return surfaces_[after - first_triangle_.begin() - 1].options;
}

/// A surface that has lost a segment is open.
void CutCoupling::check_exposed(const Clock& clock, const State& state) const
{
    for (const auto& [options, surface] : surfaces_) {
        for (const Segment& segment : surface.segments) {
            if (is_exposed(segment, state)) continue;
            const Vec3& at = state.position[segment.nodes[0]];
            throw RunError(
                fmt::format("coupling {}: with CUTCELLS of *PLASH_ALE_FORMULATION its surface must stay "
                            "closed, but an element near ({:g}, {:g}, {:g}) has eroded by time {:g}",
                            options.id, at.x, at.y, at.z, clock.time));
        }
    }
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

SurfaceTriangle CutCoupling::triangle_at(std::size_t number, const std::vector<Vec3>& position) const
{
    const auto& [node, middle] = carriers_[number];
    SurfaceTriangle triangle{{position[node[0]], position[node[1]], position[node[2]]}};
    if (middle)
        triangle.corner[2] =
            0.25 * ((position[node[0]] + position[node[2]]) + (position[node[1]] + position[node[3]]));
    return triangle;
}

void CutCoupling::find_cuts(const std::vector<Vec3>& position)
{
    for (std::size_t n = 0; n < triangles_.size(); ++n) triangles_[n] = triangle_at(n, position);
    cuts_[now_].find(fluid_.box().grid, triangles_);
}

/// Rigid bodies may put their nodes straight after the fluid has looked at them.
bool CutCoupling::has_moved(const State& state) const
{
    for (std::size_t n = 0; n < triangles_.size(); ++n) {
        const SurfaceTriangle now = triangle_at(n, state.position);
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 &was = triangles_[n].corner[corner], &is = now.corner[corner];
            if (was.x != is.x || was.y != is.y || was.z != is.z) return true;
        }
    }
    return false;
}

/// Of the nodes that carry the piece's triangle, for what acts at the piece's middle.
CutCoupling::Weights CutCoupling::weights(const BoxCuts::Piece& piece) const
{
    const auto& [a, b, c] = triangles_[piece.triangle].corner;
    const Vec3 whole = cross(b - a, c - a);
    const double square = dot(whole, whole);
    const double at_b = dot(cross(piece.middle - a, c - a), whole) / square,
                 at_c = dot(cross(b - a, piece.middle - a), whole) / square;
    return of_carriers(piece.triangle, 1 - at_b - at_c, at_b, at_c);
}

/// What the corners of a triangle have, on the nodes that carry it.
CutCoupling::Weights CutCoupling::of_carriers(std::size_t triangle, double at_a, double at_b,
                                              double at_c) const
{
    if (!carriers_[triangle].middle) return {at_a, at_b, at_c, 0};
    return {at_a + 0.25 * at_c, at_b + 0.25 * at_c, 0.25 * at_c, 0.25 * at_c};
}

/// Mean over a piece of its nodes' shape functions times a pressure that is zero in the middle and has a
/// slope [pressure]. Without it what a node bears would depend on how planes of the mesh divide its
/// triangles.
CutCoupling::Weights CutCoupling::lean(const BoxCuts::Piece& piece, const Vec3& slope) const
{
    const auto& [a, b, c] = triangles_[piece.triangle].corner;
    const Vec3 whole = cross(b - a, c - a), moved = (1 / dot(whole, whole)) * (piece.spread * slope);
    const double at_b = dot(cross(moved, c - a), whole), at_c = dot(cross(b - a, moved), whole);
    return of_carriers(piece.triangle, -at_b - at_c, at_b, at_c);
}

Vec3 CutCoupling::velocity_of(const BoxCuts::Piece& piece, const State& state) const
{
    const Weights weight = weights(piece);
    Vec3 velocity{};
    for (int n = 0; n < 4; ++n) velocity += weight[n] * state.velocity[carriers_[piece.triangle].node[n]];
    return velocity;
}

void CutCoupling::press(std::size_t triangle, const Weights& weight, const Vec3& force)
{
    for (int n = 0; n < 4; ++n) force_[4 * triangle + n] += weight[n] * force;
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

/// What the masses of the surface's own nodes add to the stiffness of each group: squares of the area by
/// which its pressure acts on a node, over the node's mass.
void CutCoupling::find_compliance(const State& state)
{
    struct Part {
        Index group, node;
        Vec3 area;
    };
    std::vector<Part> parts;
    for_wet_pieces([&](Index group, const BoxCuts::Piece& piece) {
        const Weights weight = weights(piece);
        for (int n = 0; n < 4; ++n) {
            const Index node = carriers_[piece.triangle].node[n];
            if (weight[n] != 0 && state.mass[node] > 0)
                parts.push_back({group, node, weight[n] * piece.area});
        }
    });
    const auto key = [](const Part& part) { return std::pair(part.group, part.node); };
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const Part& a, const Part& b) { return key(a) < key(b); });
    for (std::size_t n = 0; n < parts.size();) {
        const Part& first = parts[n];
        Vec3 area{};
        for (; n < parts.size() && key(parts[n]) == key(first); ++n) area += parts[n].area;
        cells_.groups()[first.group].structure_compliance += dot(area, area) / state.mass[first.node];
    }
}

/// Pressures linear in space, that of the weight, times shape functions.
void CutCoupling::press_structure(const Vec3& gravity)
{
    for_wet_pieces([&](Index group, const BoxCuts::Piece& piece) {
        const Weights at = weights(piece), leaning = lean(piece, cells_.groups()[group].density * gravity);
        const double pressure = cells_.pressure_at(group, piece.middle, gravity);
        Weights pressures;
        for (int n = 0; n < 4; ++n) pressures[n] = pressure * at[n] + leaning[n];
        press(piece.triangle, pressures, -piece.area);
    });
}

/// Nodes of the fluid with mass behind the surface, each with the nearest piece of it.
std::vector<CutCoupling::Covered> CutCoupling::covered_nodes() const
{
    const BoxFluid& box = fluid_.box();
    const BoxGrid& grid = box.grid;
    const BoxCuts& cuts = cuts_[now_];
    std::unordered_map<std::ptrdiff_t, std::size_t> entry;
    std::vector<Covered> covered;
    std::vector<double> nearest;
    for (const BoxCuts::Cell& cell : cuts.cells()) {
        for (int corner = 0; corner < 8; ++corner) {
            const int i = cell.index[0] + (corner & 1), j = cell.index[1] + (corner >> 1 & 1),
                      k = cell.index[2] + (corner >> 2 & 1);
            const std::ptrdiff_t node = grid.at(i, j, k);
            if (!(box.fields.node_mass[node] > 0) || cuts.node_open(i, j, k)) continue;
            const Vec3 place{grid.planes(0)[i], grid.planes(1)[j], grid.planes(2)[k]};
            const auto [found, is_new] = entry.try_emplace(node, covered.size());
            if (is_new) {
                covered.push_back({node, nullptr});
                nearest.push_back(1e300);
            }
            for (const BoxCuts::Piece& piece : cuts.pieces(cell)) {
                const double distance = std::abs(dot(place - piece.middle, unit(piece.area)));
                if (!(distance < nearest[found->second] - 1e-9 * grid.smallest_width(0))) continue;
                nearest[found->second] = distance;
                covered[found->second].piece = &piece;
            }
        }
    }
    return covered;
}

/// By how much of the difference of velocities a covered node comes nearer to the surface's within a step.
/// The surface comes nearer too, by the same impulse, and must not pass it: nodes of the surface with mass M
/// that bear covered mass m take M / (M + m) of it, as when both move on together, so that no energy comes of
/// it. Rigid bodies stay as they are.
std::vector<double> CutCoupling::shares_of_motion(const std::vector<Covered>& covered,
                                                  const State& state) const
{
    std::vector<double> share(covered.size(), 1);
    if (!deformable_) return share;
    std::unordered_map<Index, double> borne;
    const auto for_corners = [&](const Covered& one, auto&& visit) {
        const Weights weight = weights(*one.piece);
        for (int n = 0; n < 4; ++n) {
            const Index node = carriers_[one.piece->triangle].node[n];
            if (weight[n] != 0 && state.mass[node] > 0) visit(node, weight[n]);
        }
    };
    for (const Covered& one : covered)
        for_corners(one, [&](Index node, double weight) {
            borne[node] += weight * fluid_.box().fields.node_mass[one.node];
        });
    for (std::size_t n = 0; n < covered.size(); ++n)
        for_corners(covered[n], [&](Index node, double) {
            share[n] = std::min(share[n], state.mass[node] / (state.mass[node] + borne.at(node)));
        });
    return share;
}

/// The mass of a node behind the surface goes along with the nearest piece of it, across it.
void CutCoupling::hold_covered_nodes(const Clock& clock, const State& state)
{
    if (!(clock.last_step > 0)) return;
    const BoxFluid& box = fluid_.box();
    const std::vector<Covered> covered = covered_nodes();
    const std::vector<double> share = shares_of_motion(covered, state);
    for (std::size_t n = 0; n < covered.size(); ++n) {
        const std::ptrdiff_t node = covered[n].node;
        const BoxCuts::Piece& piece = *covered[n].piece;
        const Vec3 normal = unit(piece.area);
        const auto& v = box.fields.velocity;
        const Vec3 change = velocity_of(piece, state) - Vec3{v[0][node], v[1][node], v[2][node]};
        const double wanted = share[n] * dot(change, normal) / clock.last_step;
        const Vec3 force = (box.fields.node_mass[node] * wanted) * normal;
        push_fluid(node, force);
        press(piece.triangle, weights(piece), -force);
    }
}

double CutCoupling::power(const State& state) const
{
    double sum = 0;
    for (std::size_t n = 0; n < carriers_.size(); ++n)
        for (int corner = 0; corner < 4; ++corner)
            sum += dot(force_[4 * n + corner], state.velocity[carriers_[n].node[corner]]);
    return sum;
}

void CutCoupling::add_forces(const Clock& clock, State& state)
{
    const double before = power(state);
    if (!state.deleted_shells.empty() || !state.deleted_solids.empty()) check_exposed(clock, state);
    if (has_moved(state)) find_cuts(state.position);
    std::fill(force_.begin(), force_.end(), Vec3{});
    // Velocities of a structure that looks for its place are displacements.
    if (clock.relaxing) cells_.fill_at_rest(cuts_[now_]);
    cells_.begin(cuts_[now_]);
    if (!clock.relaxing) find_swept(state);
    if (deformable_) find_compliance(state);
    cells_.find_pressures(clock.relaxing ? 0 : clock.last_step);
    const std::array<double, 3> g = fluid_.gravity(clock.time);
    const Vec3 gravity{g[0], g[1], g[2]};
    cells_.press_nodes(gravity, [&](std::ptrdiff_t node, int axis, double force) {
        if (force == 0) return;
        Vec3 along{};
        along.*vector_component[axis] = force;
        push_fluid(node, along);
    });
    press_structure(gravity);
    if (!clock.relaxing) hold_covered_nodes(clock, state);
    for (const NodeForceFromOutside& outside : fluid_.fluid().outside_forces)
        outside_entry_[outside.place] = none;
    for (std::size_t n = 0; n < carriers_.size(); ++n)
        for (int corner = 0; corner < 4; ++corner)
            state.force[carriers_[n].node[corner]] += force_[4 * n + corner];
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
    for (std::size_t n = 0; n < carriers_.size(); ++n)
        for (int corner = 0; corner < 4; ++corner)
            results.coupling_force[carriers_[n].node[corner]] += force_[4 * n + corner];
}

Vec3 CutCoupling::force() const
{
    Vec3 sum{};
    for (const Vec3& force : force_) sum += force;
    return sum;
}

std::vector<std::string> CutCoupling::notices(const State&) const
{
    std::vector<std::string> notices{
        "CUTCELLS of *PLASH_ALE_FORMULATION: the fluid meets the surface in the cells that it cuts, without "
        "springs; PFAC, DAMP, NQUAD, FRCMIN, DIREC, ILEAK, PLEAK and THKF of the coupling have no effect"};
    constexpr double notable = 0.05; // more than fillings of edges and of curved surfaces miss
    if (refilled_ > notable)
        notices.push_back(fmt::format(
            "*INITIAL_HYDROSTATIC_ALE: fluid at rest reaches to the surface that cuts its cells, and below "
            "the free surface alone; the deck's filling differs from that by up to {:.2f} of a cell",
            refilled_));
    return notices;
}

void check_cut_coupling(const CoupledSurface& surface, const EulerianFluid& fluid)
{
    const CouplingOptions& options = surface.options;
    const auto refuse = [&](std::string_view why) {
        throw DeckError(options.where, fmt::format("coupling {}: with CUTCELLS of *PLASH_ALE_FORMULATION {}",
                                                   options.id, why));
    };
    if (!fluid.block().is_box()) refuse("the mesh must be a block between planes along the global axes");
    if (fluid.moves()) refuse("the mesh must stand still");
    if (!fluid.fluid().lagrange.void_allowed) refuse("the mesh must have void (*MAT_VACUUM, ELFORM 12)");
    const unsigned all = (1u << fluid.fluid().groups.size()) - 1;
    if ((options.fluids & all) != all) refuse("MCOUP must name all groups");
    if (options.direction == CouplingOptions::Direction::all || options.friction != 0)
        refuse("nothing can be held along the surface (CTYPE 1, 2; DIREC 3; FRIC)");
    if (options.pressure_curve != none) refuse("PFAC cannot be a curve");
    constexpr double default_end = 1e10;
    if (options.start > 0 || options.end < default_end) refuse("START and END cannot be given");
    if (options.both_sides || options.contact != 0) refuse("a coupling cannot stand for a contact");
}

} // namespace plash
