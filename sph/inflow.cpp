#include "sph/inflow.h"

#include "core/prescribed_rate.h"
#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

/// Position of the entry with a number; `none` where there is none.
template <class Entries>
Index place_of(const Entries& entries, Id id)
{
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.id == id; });
    return found == entries.end() ? none : static_cast<Index>(found - entries.begin());
}

std::vector<Index> particles_of_parts(const Model& model, const std::vector<Index>& parts)
{
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
        const bool inside = std::find(parts.begin(), parts.end(), model.particles.part[i]) != parts.end();
        if (inside) nodes.push_back(model.particles.node[i]);
    }
    return nodes;
}

std::vector<Index> waiting_nodes(const Model& model, const Record& record)
{
    const Id id = record.integer("ID");
    const Id kind = record.integer("STYP");
    Index place = none;
    switch (kind) {
    case 1:
        place = place_of(model.part_sets, id);
        if (place == none) reject_field(record, "ID", fmt::format("there is no part set {}", id));
        return particles_of_parts(model, model.part_sets[place].parts);
    case 2:
        place = place_of(model.parts, id);
        if (place == none) reject_field(record, "ID", fmt::format("there is no part {}", id));
        return particles_of_parts(model, {place});
    case 3:
        place = place_of(model.node_sets, id);
        if (place == none) reject_field(record, "ID", fmt::format("there is no node set {}", id));
        return model.node_sets[place].nodes;
    default:
        reject_field(
            record, "STYP",
            fmt::format("there is no type {}; there are 1 (part set), 2 (part) and 3 (node set)", kind));
    }
}

PrescribedMotion::Kind kind_of(const Record& record)
{
    switch (record.integer("VAD")) {
    case 0:
        return PrescribedMotion::Kind::velocity;
    case 1:
        return PrescribedMotion::Kind::acceleration;
    case 2:
        return PrescribedMotion::Kind::displacement;
    default:
        reject_field(
            record, "VAD",
            fmt::format("there is no {}; there are 0 (velocity), 1 (acceleration) and 2 (displacement)",
                        record.integer("VAD")));
    }
}

Inflow inflow_of(const Model& model, const Record& record)
{
    Inflow inflow;
    const Index vector = place_of(model.vectors, record.integer("VID"));
    if (vector == none) {
        reject_field(record, "VID", fmt::format("there is no *DEFINE_VECTOR {}", record.integer("VID")));
    }
    inflow.normal = unit(model.vectors[vector].head - model.vectors[vector].tail);
    const Id node_id = record.integer("NID");
    const auto node = std::find(model.nodes.id.begin(), model.nodes.id.end(), node_id);
    if (node == model.nodes.id.end())
        reject_field(record, "NID", fmt::format("there is no node {}", node_id));
    inflow.point = model.nodes.position[node - model.nodes.id.begin()];

    PrescribedMotion& motion = inflow.motion;
    motion.nodes = waiting_nodes(model, record);
    const Id freedom = record.integer("DOF");
    switch (freedom) {
    case 1:
    case 2:
    case 3:
        motion.direction = {double(freedom == 1), double(freedom == 2), double(freedom == 3)};
        break;
    case 4:
        motion.direction = inflow.normal;
        break;
    default:
        reject_field(
            record, "DOF",
            fmt::format("there is no freedom {}; there are 1, 2, 3 (x, y, z) and 4 (along VID)", freedom));
    }
    motion.kind = kind_of(record);
    const Id curve = record.integer("LCID");
    motion.curve = curve == 0 ? none : place_of(model.curves, curve);
    if (curve != 0 && motion.curve == none) {
        reject_field(record, "LCID", fmt::format("there is no curve {}", curve));
    }
    motion.scale = record.real("SF");
    motion.birth = record.real("BIRTH");
    motion.death = value_or(record.real("DEATH"), forever);
    return inflow;
}

} // namespace

std::vector<Inflow> inflows_of(const Model& model)
{
    std::vector<Inflow> inflows;
    for (const Record& record : model.others) {
        if (record.keyword == "BOUNDARY_SPH_FLOW") inflows.push_back(inflow_of(model, record));
    }
    return inflows;
}

Inflows::Inflows(std::vector<Inflow> inflows, const Model& model, State& state)
    : model_(&model), inflows_(std::move(inflows))
{
    if (inflows_.empty()) return;
    waits_.resize(state.size());
    force_.resize(state.size());
    travelled_.resize(inflows_.size());
    for (std::size_t number = 0; number < inflows_.size(); ++number) {
        const PrescribedMotion& motion = inflows_[number].motion;
        for (Index node : motion.nodes) waits_[node] = static_cast<std::uint8_t>(number + 1);
    }
    look(state);
    for (const Inflow& inflow : inflows_) {
        const PrescribedMotion& motion = inflow.motion;
        if (motion.kind != PrescribedMotion::Kind::velocity || motion.birth > 0) continue;
        const double target = motion.scale * curve_value(model, motion.curve, 0);
        for (Index node : motion.nodes) {
            if (!waits(node)) continue;
            Vec3& velocity = state.velocity[node];
            velocity += (target - dot(velocity, motion.direction)) * motion.direction;
        }
    }
}

bool Inflows::someone_passes(const State& state) const
{
    for (const Inflow& inflow : inflows_) {
        for (Index node : inflow.motion.nodes) {
            if (waits(node) && dot(state.position[node] - inflow.point, inflow.normal) >= 0) return true;
        }
    }
    return false;
}

void Inflows::look(const State& state)
{
    for (const Inflow& inflow : inflows_) {
        for (Index node : inflow.motion.nodes) {
            if (dot(state.position[node] - inflow.point, inflow.normal) >= 0) waits_[node] = 0;
        }
    }
}

void Inflows::constrain(const Clock& clock, State& state)
{
    for (std::size_t number = 0; number < inflows_.size(); ++number) {
        const PrescribedMotion& motion = inflows_[number].motion;
        const bool driven = clock.time >= motion.birth && clock.time <= motion.death &&
                            acts_now(*model_, motion.curve, clock);
        double next = 0;
        bool known = false; // all who wait have the same velocity
        for (Index node : motion.nodes) {
            Vec3& last = force_[node];
            Vec3 added{};
            const Vec3& velocity = state.velocity[node];
            if (waits(node) && state.mass[node] > 0) {
                const double speed = dot(velocity, motion.direction);
                if (!known) {
                    next =
                        driven ? prescribed_rate(*model_, motion, clock, speed, travelled_[number]) : speed;
                    known = true;
                }
                const double per_velocity = state.mass[node] / clock.velocity_step();
                added = per_velocity * (next - speed) * motion.direction - state.force[node];
            }
            work_ += 0.5 * clock.last_step * dot(last + added, velocity);
            last = added;
            state.force[node] += added;
        }
    }
}

} // namespace plash
