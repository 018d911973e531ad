#include "conditions/blast_loads.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

Vec3 middle_of(const SegmentNodes& segment, const State& state)
{
    const int corners = segment[2] == segment[3] ? 3 : 4;
    Vec3 sum{};
    for (int c = 0; c < corners; ++c) sum += state.position[segment[c]];
    return (1.0 / corners) * sum;
}

Burst burst_of(const BlastLoad& load)
{
    return load.on_the_ground ? Burst::surface : Burst::air;
}

/// Of the charge [lb^(1/3)].
double mass_root(const BlastLoad& load)
{
    return std::cbrt(load.mass * load.units.pounds);
}

} // namespace

BlastLoads::BlastLoads(const Model& model, const State& state) : model_(model)
{
    for (std::size_t i = 0; i < model.blast_loads.size(); ++i) {
        scaled_time_.push_back(model.blast_loads[i].units.milliseconds / mass_root(model.blast_loads[i]));
        for (const BlastLoad::Surface& surface : model.blast_loads[i].surfaces) {
            segments_.insert(segments_.end(), surface.segments.begin(), surface.segments.end());
            load_.insert(load_.end(), surface.segments.size(), static_cast<Index>(i));
            scale_.insert(scale_.end(), surface.segments.size(), surface.scale);
        }
    }
    sum_ = CornerSum(segments_);
    shock_.resize(segments_.size());
    elements_ = LoadedElements(model, segments_);
    for (std::size_t segment = 0; segment < segments_.size(); ++segment) look(segment, state);
}

/// From a segment's middle [length].
Vec3 BlastLoads::to_charge(std::size_t segment, const State& state) const
{
    const BlastLoad& load = model_.blast_loads[load_[segment]];
    const Vec3 charge = load.node == none ? load.centre : state.position[load.node];
    return charge - middle_of(segments_[segment], state);
}

double BlastLoads::scaled_distance(std::size_t segment, const State& state) const
{
    const BlastLoad& load = model_.blast_loads[load_[segment]];
    return norm(to_charge(segment, state)) * load.units.feet / mass_root(load);
}

void BlastLoads::look(std::size_t segment, const State& state)
{
    Shock& shock = shock_[segment];
    shock.blast = air_blast(burst_of(model_.blast_loads[load_[segment]]), scaled_distance(segment, state));
    shock.arrival = shock.blast.arrival / scaled_time_[load_[segment]];
}

std::vector<std::string> BlastLoads::notices(const State& state) const
{
    double nearest = 1e300, farthest = 0;
    bool out = false;
    for (std::size_t segment = 0; segment < segments_.size(); ++segment) {
        const double distance = scaled_distance(segment, state);
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
        const Burst burst = burst_of(model_.blast_loads[load_[segment]]);
        out = out || distance < nearest_blast(burst) || distance > farthest_blast();
    }
    if (!out) return {};
    return {fmt::format(
        "blast loads: segments lie at scaled distances of {:.3g} to {:.3g} ft/lb^(1/3); there are "
        "data for {} (surface bursts), {} (air bursts) to {}, and the nearest of these are used",
        nearest, farthest, nearest_blast(Burst::surface), nearest_blast(Burst::air), farthest_blast())};
}

/// Whether the shock is there; until it is, the segment may have moved since the last look.
bool BlastLoads::has_arrived(std::size_t segment, double since_explosion, const State& state)
{
    Shock& shock = shock_[segment];
    if (since_explosion < shock.arrival) return false;
    if (!shock.arrived) {
        look(segment, state);
        shock.arrived = since_explosion >= shock.arrival;
    }
    return shock.arrived;
}

double BlastLoads::pressure_at(std::size_t segment, double since_explosion, const Vec3& normal,
                               const State& state) const
{
    const BlastLoad& load = model_.blast_loads[load_[segment]];
    const Shock& shock = shock_[segment];
    const double scaled = (since_explosion - shock.arrival) * scaled_time_[load_[segment]];
    if (!load.negative_phase && scaled > shock.blast.duration) return 0;
    const Vec3 way = to_charge(segment, state);
    const double cosine = dot(normal, way) / std::max(norm(way), 1e-300);
    return scale_[segment] * shock.blast.pressure(scaled, cosine) / load.units.psi;
}

void BlastLoads::add_forces(const Clock& clock, State& state)
{
    work_ += sum_.act(segments_, clock, state, [&](std::size_t i) {
        const BlastLoad& load = model_.blast_loads[load_[i]];
        const double since = clock.time - load.start;
        std::array<Vec3, 4> force{};
        if (clock.time > load.death || elements_.deleted(i, state) || !has_arrived(i, since, state))
            return force;
        force = unit_pressure_forces(segments_[i], state.position);
        const Vec3 area = force[0] + force[1] + force[2] + force[3];
        const double size = norm(area);
        const double p = size > 0 ? pressure_at(i, since, (1 / size) * area, state) : 0;
        for (Vec3& corner : force) corner *= -p;
        return force;
    });
}

} // namespace plash
