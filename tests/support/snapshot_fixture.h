#pragma once

#include "core/recorder.h"

#include <functional>
#include <memory>

namespace plash::testing {

/// A term whose results a test makes up.
class MadeUpResults final : public Term {
public:
    std::function<void(const State&, ElementResults&)> fill;

    std::string_view name() const override { return "made up"; }
    void collect(const State& state, ElementResults& results) const override
    {
        if (fill) fill(state, results);
    }
};

/// Everything a Snapshot refers to, to be set up by a test.
struct SnapshotFixture {
    Model model;
    Clock clock;
    State state;
    EnergyLedger ledger;
    std::vector<std::unique_ptr<Term>> terms;
    StepVote owner{0, "shell", 1, 1};

    MadeUpResults& add_results()
    {
        auto term = std::make_unique<MadeUpResults>();
        MadeUpResults& results = *term;
        terms.push_back(std::move(term));
        return results;
    }

    /// A State with the Model's nodes at rest, unit masses.
    void start()
    {
        const std::size_t count = model.nodes.size();
        state.position = model.nodes.position;
        state.velocity.assign(count, {});
        state.force.assign(count, {});
        state.mass.assign(count, 1);
        ledger.open_cycle(model.parts.size());
        ledger.close_cycle();
    }

    Snapshot snapshot() const { return {model, clock, state, ledger, terms, owner}; }
};

} // namespace plash::testing
