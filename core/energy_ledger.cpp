#include "core/energy_ledger.h"

#include <algorithm>
#include <cmath>

namespace plash {

void EnergyLedger::open_cycle(std::size_t part_count)
{
    kinetic = internal = hourglass = bulk_viscosity = springs = sliding = rigid_wall = damping = 0;
    eroded_kinetic = eroded_internal = eroded_hourglass = advection_loss = external_work = preload_work = 0;
    part_internal.assign(part_count, 0);
    part_hourglass.assign(part_count, 0);
}

void EnergyLedger::start_anew()
{
    started_ = false;
    anew_ = true;
    largest_error = largest_turnover = 0;
}

void EnergyLedger::close_cycle()
{
    if (anew_ && !started_) before_ = {external_work, preload_work, damping, rigid_wall, sliding};
    external_work -= before_.external_work;
    preload_work -= before_.preload_work;
    damping -= before_.damping;
    rigid_wall -= before_.rigid_wall;
    sliding -= before_.sliding;
    if (!started_) {
        initial_total = total() - external_work - preload_work;
        started_ = true;
    }
    const double expected = initial_total + external_work + preload_work;
    largest_error = std::max(largest_error, std::abs(total() - expected));
    largest_turnover = std::max({largest_turnover, std::abs(expected), std::abs(kinetic + internal)});
}

void EnergyLedger::add_part(int part, double internal_energy, double hourglass_energy)
{
    internal += internal_energy;
    hourglass += hourglass_energy;
    part_internal[part] += internal_energy;
    part_hourglass[part] += hourglass_energy;
}

double EnergyLedger::total() const
{
    return kinetic + internal + hourglass + sliding + rigid_wall + damping + eroded_kinetic +
           eroded_internal + eroded_hourglass + advection_loss;
}

} // namespace plash
