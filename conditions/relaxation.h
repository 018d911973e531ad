#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Damping of dynamic relaxation (*CONTROL_DYNAMIC_RELAXATION): in each cycle velocities are multiplied by
/// DRFCTR before forces change them, v(n+1/2) = f v(n-1/2) + h a(n) (Hallquist 2006, chapter 'Dynamic
/// relaxation'; Otter, Cassell & Hobbs 1966). Written as the force -(1 - f) m v(n-1/2) / h, so that its
/// work is in the books as damping and constraints see it. Outside this phase the term does nothing.
class Relaxation : public Term {
public:
    /// As Damping: before rigid bodies take the masses of their nodes.
    Relaxation(const Model& model, const State& state);

    std::string_view name() const override { return "dynamic relaxation"; }
    std::size_t items() const override { return nodes_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.damping -= work_; }
    void serialise(Archive& archive) override { archive(work_); }

    /// Kinetic energy of the parts that decide, at n - 1/2, without that of their motion as a whole.
    double distortional_energy() const { return distortional_; }

private:
    struct Node {
        Index node;
        double mass, inertia;
        bool decides; ///< of the parts of DRPSET
    };
    double factor_;
    std::vector<Node> nodes_;
    std::vector<Vec3> force_, moment_; ///< like nodes_: at n - 1
    double distortional_ = 0;
    double work_ = 0; ///< of the damping forces [energy]
};

} // namespace plash
