#include "conditions/blast_loads.h"

#include "core/parallel.h"

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

} // namespace

BlastLoads::BlastLoads(const Model& model, const State& state) : model_(model)
{
    for (std::size_t i = 0; i < model.blast_loads.size(); ++i) {
        for (const BlastLoad::Surface& surface : model.blast_loads[i].surfaces) {
            segments_.insert(segments_.end(), surface.segments.begin(), surface.segments.end());
            load_.insert(load_.end(), surface.segments.size(), static_cast<Index>(i));
            scale_.insert(scale_.end(), surface.segments.size(), surface.scale);
        }
    }
    sum_ = CornerSum(segments_);
    last_.resize(segments_.size());
    shock_.resize(segments_.size());
    elements_ = LoadedElements(model, segments_);
    for (std::size_t segment = 0; segment < segments_.size(); ++segment) look(segment, state);
}

Vec3 BlastLoads::charge(const BlastLoad& load, const State& state) const
{
    return load.node == none ? load.centre : state.position[load.node];
}

double BlastLoads::scaled_distance(std::size_t segment, const State& state) const
{
    const BlastLoad& load = model_.blast_loads[load_[segment]];
    const double distance = norm(charge(load, state) - middle_of(segments_[segment], state));
    return distance * load.units.feet / std::cbrt(load.mass * load.units.pounds);
}

void BlastLoads::look(std::size_t segment, const State& state)
{
    const BlastLoad& load = model_.blast_loads[load_[segment]];
    Shock& shock = shock_[segment];
    shock.blast = air_blast(burst_of(load), scaled_distance(segment, state));
    shock.arrival = shock.blast.arrival * std::cbrt(load.mass * load.units.pounds) / load.units.milliseconds;
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

double BlastLoads::pressure_at(std::size_t segment, double time, const Vec3& normal, const State& state)
{
    const BlastLoad& load = model_.blast_loads[load_[segment]];
    Shock& shock = shock_[segment];
    const double since = time - load.start;
    if (time > load.death || since < shock.arrival) return 0;
    if (!shock.arrived) { // the segment may have moved since the last look
        look(segment, state);
        if (since < shock.arrival) return 0;
        shock.arrived = true;
    }
    const double scaled =
        (since - shock.arrival) * load.units.milliseconds / std::cbrt(load.mass * load.units.pounds);
    if (!load.negative_phase && scaled > shock.blast.duration) return 0;
    const Vec3 to_charge = charge(load, state) - middle_of(segments_[segment], state);
    const double cosine = dot(normal, to_charge) / std::max(norm(to_charge), 1e-300);
    return scale_[segment] * shock.blast.pressure(scaled, cosine) / load.units.psi;
}

void BlastLoads::add_forces(const Clock& clock, State& state)
{
    work_ += clock.last_step * sum_chunks(segments_.size(), [&](std::size_t begin, std::size_t end) {
                 double power = 0;
                 for (std::size_t i = begin; i < end; ++i) {
                     const BlastLoad& load = model_.blast_loads[load_[i]];
                     std::array<Vec3, 4> force{};
                     if (clock.time - load.start >= shock_[i].arrival && !elements_.deleted(i, state)) {
                         force = unit_pressure_forces(segments_[i], state.position);
                         const Vec3 area = force[0] + force[1] + force[2] + force[3];
                         const double size = norm(area);
                         const double p = size > 0 ? pressure_at(i, clock.time, (1 / size) * area, state) : 0;
                         for (Vec3& corner : force) corner *= -p;
                     }
                     for (int c = 0; c < 4; ++c)
                         power += 0.5 * dot(force[c] + last_[i][c], state.velocity[segments_[i][c]]);
                     last_[i] = sum_.force[i] = force;
                 }
                 return power;
             });
    sum_.add_to(state.force);
}

} // namespace plash
