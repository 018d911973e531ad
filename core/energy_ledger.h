#pragma once

#include "core/archive.h"

#include <cstddef>
#include <vector>

namespace plash {

/// Where the energy of a run is at one time [energy]. Terms book what they hold or have taken up to now;
/// `external_work` is what loads and driven nodes have put in since the start.
/// Energy a term takes out of the motion for good (rigid wall, damping, sliding) counts as held by it.
struct EnergyLedger {
    double kinetic = 0;
    double internal = 0;
    double hourglass = 0;
    double bulk_viscosity = 0; ///< dissipated by bulk viscosity; part of `internal`, shown apart
    double springs = 0;        ///< of springs, dampers and joint stiffnesses; part of `internal`, shown apart
    double sliding = 0;
    double rigid_wall = 0;
    double damping = 0;
    double eroded_kinetic = 0;
    double eroded_internal = 0;
    double eroded_hourglass = 0;
    double advection_loss = 0;
    double external_work = 0;
    /// Put in by prescribed stresses (preloads); no work of loads, so not part of `external_work`, but known
    /// to the balance.
    double preload_work = 0;

    std::vector<double> part_internal; ///< by part of the Model
    std::vector<double> part_hourglass;

    double initial_total = 0; ///< total at the first cycle
    double largest_error = 0; ///< largest |total - initial - external and preload work| so far [energy]
    double largest_turnover =
        0; ///< largest of |initial + external work| and kinetic + internal so far [energy]

    /// The balance begins anew with the energies of the next cycle: work, damping and losses so far are left
    /// out from then on (end of dynamic relaxation).
    void start_anew();

    /// Zeroes what terms book anew each cycle; the balance over the run stays.
    void open_cycle(std::size_t part_count);
    /// Takes the sums of this cycle into the balance.
    void close_cycle();

    /// Books internal and hourglass energy under a part and in the totals.
    void add_part(int part, double internal_energy, double hourglass_energy);

    /// The balance over the run; terms book the rest anew.
    void serialise(Archive& archive)
    {
        archive(initial_total, largest_error, largest_turnover, started_, anew_, before_);
    }

    double total() const;
    /// Largest balance error of the run over its largest turnover [-].
    double balance_error() const { return largest_turnover > 0 ? largest_error / largest_turnover : 0; }

private:
    /// What loads, preloads, damping and walls had put in or taken out before the balance began anew.
    struct Before {
        double external_work = 0, preload_work = 0, damping = 0, rigid_wall = 0, sliding = 0;
    };
    bool started_ = false;
    bool anew_ = false;
    Before before_;
};

} // namespace plash
