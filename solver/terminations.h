#pragma once

#include "solver/scene.h"

#include <optional>
#include <string>

namespace plash {

/// What may end a run before its time: *TERMINATION_..., and *CONTROL_TERMINATION ENDENG (change of the
/// energy ratio) and ENDMAS (mass added by mass scaling).
class Terminations {
public:
    /// DeckError where a termination names a contact that is not there.
    explicit Terminations(const Scene& scene);

    /// Between two cycles: why the run ends now; nothing while it goes on.
    std::optional<std::string> reason(const Clock& clock);

    void serialise(Archive& archive) { archive(quiet_since_); }

private:
    const Scene& scene_;
    std::vector<double>
        quiet_since_; ///< by termination: since when its contact has had no force; -1: it has one

    /// Nodes and weights whose weighted place is the centre of mass of each rigid body, by termination.
    struct Center {
        std::vector<Index> nodes;
        std::vector<double> weight;
    };
    std::vector<Center> centers_;

    bool node_ends(const Termination& end) const;
    bool body_ends(const Termination& end, const Center& center) const;
    bool deletion_ends(const Termination& end) const;
    bool contact_ends(const Termination& end, double& quiet_since, const Clock& clock) const;
    std::string describe(const Termination& end) const;
};

} // namespace plash
