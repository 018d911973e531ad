#include "conditions/pressure_loads.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"

#include <algorithm>

namespace plash {

PressureLoads::PressureLoads(const Model& model) : model_(model)
{
    for (std::size_t i = 0; i < model.pressure_loads.size(); ++i) {
        const PressureLoad& load = model.pressure_loads[i];
        segments_.insert(segments_.end(), load.segments.begin(), load.segments.end());
        load_.insert(load_.end(), load.segments.size(), static_cast<Index>(i));
    }
    sum_ = CornerSum(segments_);
    last_.resize(segments_.size());
    find_elements();
}

/// The shell or solid that has all corners of a segment.
void PressureLoads::find_elements()
{
    shell_.assign(segments_.size(), none);
    solid_.assign(segments_.size(), none);
    std::vector<std::vector<Index>> segments_of(model_.nodes.size()); // by their first corner
    for (std::size_t i = 0; i < segments_.size(); ++i)
        segments_of[segments_[i][0]].push_back(static_cast<Index>(i));
    const auto find = [&](const auto& elements, std::vector<Index>& owner) {
        for (std::size_t e = 0; e < elements.size(); ++e) {
            const auto& nodes = elements.nodes[e];
            const auto has = [&](Index node) {
                return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
            };
            for (std::size_t c = 0; c < nodes.size(); ++c) {
                if (std::find(nodes.begin(), nodes.begin() + c, nodes[c]) != nodes.begin() + c) continue;
                for (Index segment : segments_of[nodes[c]]) {
                    const SegmentNodes& corners = segments_[segment];
                    if (std::all_of(corners.begin(), corners.end(), has))
                        owner[segment] = static_cast<Index>(e);
                }
            }
        }
    };
    find(model_.shells, shell_);
    find(model_.thick_shells, solid_);
    for (Index& solid : solid_)
        if (solid != none) solid += static_cast<Index>(model_.solids.size());
    find(model_.solids, solid_);
    if (model_.solids.ten_nodes.empty()) return;
    std::vector<Index> row(segments_.size(), none);
    find(model_.tetrahedra, row);
    std::vector<Index> solid_of(model_.tetrahedra.size());
    for (std::size_t solid = 0; solid < model_.solids.ten_nodes.size(); ++solid)
        if (model_.solids.ten_nodes[solid] != none)
            solid_of[model_.solids.ten_nodes[solid]] = static_cast<Index>(solid);
    for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] != none) solid_[i] = solid_of[row[i]];
}

bool PressureLoads::deleted(std::size_t segment, const State& state) const
{
    if (state.deletions == 0) return false;
    const Index shell = shell_[segment], solid = solid_[segment];
    if (shell != none) return !state.deleted_shells.empty() && state.deleted_shells[shell];
    if (solid != none) return !state.deleted_solids.empty() && state.deleted_solids[solid];
    return false;
}

double PressureLoads::pressure_of(const PressureLoad& load, const Clock& clock) const
{
    if (clock.time < load.arrival) return 0;
    return load.scale * load_value(model_, load.curve, clock, clock.time - load.arrival);
}

void PressureLoads::add_forces(const Clock& clock, State& state)
{
    std::vector<double> pressure;
    for (const PressureLoad& load : model_.pressure_loads) pressure.push_back(pressure_of(load, clock));
    work_ += clock.last_step * sum_chunks(segments_.size(), [&](std::size_t begin, std::size_t end) {
                 double power = 0;
                 for (std::size_t i = begin; i < end; ++i) {
                     const double p = deleted(i, state) ? 0 : pressure[load_[i]];
                     std::array<Vec3, 4> force{};
                     if (p != 0) force = unit_pressure_forces(segments_[i], state.position);
                     for (int c = 0; c < 4; ++c) {
                         force[c] *= -p;
                         power += 0.5 * dot(force[c] + last_[i][c], state.velocity[segments_[i][c]]);
                     }
                     last_[i] = sum_.force[i] = force;
                 }
                 return power;
             });
    sum_.add_to(state.force);
}

} // namespace plash
