#include "ale/tracers.h"

#include "ale/hex/hex_locator.h"
#include "materials/parameters.h"
#include "model/eulerian.h"
#include "model/tracers.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

/// The manual numbers corners around the lower face, then around the upper one; here bits say the sides.
constexpr int manual_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};

using NodeNumbers = std::array<Index, 8>;

/// Place of a point in a hexahedron; false when it lies outside.
bool place_in_solid(const NodeNumbers& nodes, const std::vector<Vec3>& position, const Vec3& point,
                    std::array<double, 3>& part)
{
    for (const auto component : vector_component) {
        double low = position[nodes[0]].*component, high = low;
        for (const Index node : nodes) {
            low = std::min(low, position[node].*component);
            high = std::max(high, position[node].*component);
        }
        const double margin = 1e-9 * (high - low);
        if (point.*component < low - margin || point.*component > high + margin) return false;
    }
    HexMesh one;
    one.corners = {{0, 1, 2, 3, 4, 5, 6, 7}};
    one.edge.resize(1);
    for (int corner = 0; corner < 8; ++corner) one.position.push_back(position[nodes[manual_corner[corner]]]);
    for (int axis = 0; axis < 3; ++axis) one.edge[0][axis] = one.position[1 << axis] - one.position[0];
    return find_in_cell(one, 0, point, part);
}

/// Trilinear value at a place in a solid.
Vec3 value_in_solid(const NodeNumbers& nodes, const std::vector<Vec3>& values,
                    const std::array<double, 3>& part)
{
    Vec3 sum{};
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= corner >> axis & 1 ? part[axis] : 1 - part[axis];
        sum += weight * values[nodes[manual_corner[corner]]];
    }
    return sum;
}

/// Velocity of the fluid at a point; false where no node around has mass.
bool flow_at(const Fluid& fluid, const MeshPoint& point, Vec3& velocity)
{
    const PlaceWeights nodes = fluid.node_weights(point);
    double sum = 0;
    Vec3 moment{};
    for (int corner = 0; corner < 8; ++corner) {
        const std::ptrdiff_t node = nodes.place[corner];
        if (!(fluid.fields.node_mass[node] > 0)) continue;
        const auto& v = fluid.fields.velocity;
        sum += nodes.weight[corner];
        moment += nodes.weight[corner] * Vec3{v[0][node], v[1][node], v[2][node]};
    }
    if (!(sum > 1e-9)) return false;
    velocity = (1 / sum) * moment;
    return true;
}

} // namespace

Tracers::Tracers(const Model& model, std::vector<EulerianFluid*> fluids)
    : model_(model), fluids_(std::move(fluids)), eulerian_(model.parts.size())
{
    for (std::size_t part = 0; part < eulerian_.size(); ++part)
        eulerian_[part] = is_eulerian(model, static_cast<Index>(part));
    for_tracer_records(model, [&](const Record& record) {
        Tracer tracer;
        tracer.start = record.real("TIME");
        const Id track = record.integer("TRACK");
        if (track < 0 || track > 2)
            reject_field(
                record, "TRACK",
                fmt::format("{} is not one of 0 with the material, 1 fixed in space, 2 with the mesh",
                            track));
        tracer.track = static_cast<Track>(track);
        const Id group = record.integer("AMMGID");
        if (group < 0 || (group > 0 && group > static_cast<Id>(multi_material_groups(model))))
            reject_field(record, "AMMGID", fmt::format("there is no material group {}", group));
        tracer.group = group == 0 ? none : static_cast<int>(group) - 1;
        const Id node = record.integer("NID");
        if (node != 0) {
            const auto& ids = model.nodes.id;
            const auto found = std::find(ids.begin(), ids.end(), node);
            if (found == ids.end()) reject_field(record, "NID", fmt::format("there is no node {}", node));
            tracer.place = model.nodes.position[found - ids.begin()];
        } else {
            tracer.place = {record.real("X"), record.real("Y"), record.real("Z")};
        }
        tracers_.push_back(tracer);
    });
}

Tracers::Host Tracers::find_solid(const Vec3& point, const State& state, bool of_fluids) const
{
    Host host;
    for (std::size_t solid = 0; solid < model_.solids.size(); ++solid) {
        if (eulerian_[model_.solids.part[solid]] != of_fluids) continue;
        if (!place_in_solid(model_.solids.nodes[solid], state.position, point, host.part)) continue;
        host.solid = static_cast<Index>(solid);
        break;
    }
    return host;
}

/// Looks in the mesh where the tracer was last, then in the others.
bool Tracers::locate(Tracer& tracer, const Vec3& point, MeshPoint& found) const
{
    for (int turn = 0; turn < static_cast<int>(fluids_.size()); ++turn) {
        const int first = std::max(tracer.fluid, 0);
        const int number = (first + turn) % static_cast<int>(fluids_.size());
        found = fluids_[number]->fluid().locate(point, turn == 0 ? tracer.cell : std::array<int, 3>{});
        if (!found.inside) continue;
        tracer.fluid = number;
        tracer.cell = found.cell;
        return true;
    }
    return false;
}

/// Takes the velocity of the fluid at a point over; false where there is none.
bool Tracers::follow_fluid(Tracer& tracer, const Vec3& point) const
{
    MeshPoint at;
    return locate(tracer, point, at) && flow_at(fluids_[tracer.fluid]->fluid(), at, tracer.velocity);
}

void Tracers::begin(Tracer& tracer, const State& state)
{
    tracer.started = true;
    MeshPoint at;
    const bool in_fluid = locate(tracer, tracer.place, at);
    if (tracer.track == Track::space || (in_fluid && tracer.track == Track::material)) return;
    const Host host = find_solid(tracer.place, state, in_fluid);
    tracer.solid = host.solid;
    tracer.part = host.part;
}

void Tracers::add_forces(const Clock& clock, State& state)
{
    for (Tracer& tracer : tracers_) {
        if (!tracer.started && clock.time >= tracer.start) begin(tracer, state);
        if (tracer.started && tracer.solid == none) follow_fluid(tracer, tracer.place);
    }
}

void Tracers::after_motion(const Clock& clock, State& state)
{
    for (Tracer& tracer : tracers_) {
        if (!tracer.started) continue;
        if (tracer.solid != none) {
            tracer.place = value_in_solid(model_.solids.nodes[tracer.solid], state.position, tracer.part);
        } else if (tracer.track == Track::material && tracer.fluid != none) {
            const Vec3 before = tracer.velocity;
            follow_fluid(tracer, tracer.place + clock.step * before);
            tracer.place += (0.5 * clock.step) * (before + tracer.velocity);
        }
    }
}

/// Means of the cells around the point that hold the group, or any.
ElementResults::Tracer Tracers::state_in_fluid(const Tracer& tracer, const MeshPoint& at) const
{
    const EulerianFluid& term = *fluids_[tracer.fluid];
    const FluidFields& fields = term.fluid().fields;
    ElementResults::Tracer result;
    flow_at(term.fluid(), at, result.velocity);
    std::vector<int> shown; // numbers among the fluids
    for (std::size_t g = 0; g < term.groups().groups.size(); ++g) {
        const int fluid = term.groups().groups[g].fluid;
        if (fluid != none && (tracer.group == none || tracer.group == static_cast<int>(g)))
            shown.push_back(fluid);
    }
    const PlaceWeights cells = term.fluid().cell_weights(at);
    double weights = 0, mass = 0, volume = 0, reference = 0;
    for (int i = 0; i < 8; ++i) {
        const std::ptrdiff_t place = cells.place[i];
        double own = 0;
        for (const int g : shown) own += fields.groups[g].mass[place];
        const double weight = own > 0 ? cells.weight[i] : 0;
        if (!(weight > 0)) continue;
        weights += weight;
        const double pressure = fields.pressure[place];
        SymmetricTensor<double> stress{-pressure, -pressure, -pressure, 0, 0, 0};
        if (!fields.viscous[0].empty()) {
            double* const components[] = {&stress.xx, &stress.yy, &stress.zz,
                                          &stress.xy, &stress.yz, &stress.zx};
            for (int c = 0; c < 6; ++c) *components[c] += fields.viscous[c][place];
        }
        result.stress.xx += weight * stress.xx;
        result.stress.yy += weight * stress.yy;
        result.stress.zz += weight * stress.zz;
        result.stress.xy += weight * stress.xy;
        result.stress.yz += weight * stress.yz;
        result.stress.zx += weight * stress.zx;
        const double size = term.fluid().volume_of(place);
        for (const int g : shown) {
            const GroupFields& group = fields.groups[g];
            const double per_volume = weight / size;
            mass += per_volume * group.mass[place];
            volume += weight * (group.fraction.empty() ? 1 : group.fraction[place]);
            reference += per_volume * group.mass[place] / term.fluid().groups[g].reference_density;
        }
    }
    if (!(weights > 0 && volume > 0)) return result;
    result.active = true;
    for (double* component : {&result.stress.xx, &result.stress.yy, &result.stress.zz, &result.stress.xy,
                              &result.stress.yz, &result.stress.zx})
        *component /= weights;
    result.density = mass / volume;
    result.relative_volume = volume / reference;
    return result;
}

ElementResults::Tracer Tracers::state_of(const Tracer& tracer, const State& state) const
{
    ElementResults::Tracer result;
    result.place = tracer.place;
    if (!tracer.started) return result;
    Tracer look = tracer;
    MeshPoint at;
    if (locate(look, tracer.place, at)) {
        result = state_in_fluid(look, at);
        result.place = tracer.place;
        if (!result.active && tracer.track == Track::material) result.velocity = tracer.velocity;
        return result;
    }
    Host host{tracer.solid, tracer.part};
    if (host.solid == none) host = find_solid(tracer.place, state, false);
    if (host.solid == none) {
        if (tracer.track == Track::material) result.velocity = tracer.velocity;
        return result;
    }
    result.active = true;
    result.solid = host.solid;
    result.velocity = value_in_solid(model_.solids.nodes[host.solid], state.velocity, host.part);
    return result;
}

void Tracers::collect(const State& state, ElementResults& results) const
{
    if (!results.tracers_wanted) return;
    for (const Tracer& tracer : tracers_) results.tracers.push_back(state_of(tracer, state));
}

void Tracers::serialise(Archive& archive)
{
    archive(tracers_);
}

std::vector<std::string> Tracers::notices(const State& state) const
{
    std::vector<std::string> lines;
    for (std::size_t number = 0; number < tracers_.size(); ++number) {
        Tracer look = tracers_[number];
        MeshPoint at;
        if (look.start > 0 || locate(look, look.place, at)) continue;
        if (find_solid(look.place, state, false).solid != none) continue;
        lines.push_back(
            fmt::format("*DATABASE_TRACER: tracer {} at ({:g}, {:g}, {:g}) lies in no solid and no "
                        "Eulerian mesh; trhist shows it as not active",
                        number + 1, look.place.x, look.place.y, look.place.z));
    }
    return lines;
}

std::unique_ptr<Tracers> make_tracers(const Model& model, std::vector<EulerianFluid*> fluids)
{
    if (tracer_count(model) == 0) return nullptr;
    return std::make_unique<Tracers>(model, std::move(fluids));
}

} // namespace plash
