#pragma once

#include "core/term.h"
#include "core/work_sum.h"
#include "model/model.h"
#include "rigid/tied_node_groups.h"

#include <array>
#include <memory>

namespace plash {

/// *CONSTRAINED_LINEAR_GLOBAL (sum of c_k u_k = 0 over freedoms of nodes), *CONSTRAINED_NODE_SET (nodes that
/// share translations) and *CONSTRAINED_TIED_NODES_FAILURE (nodes that share all freedoms). The forces are
/// changed so that every sum of velocities vanishes: lambda from (C M^-1 C^T) lambda = C (M v / dt + f), a
/// matrix that depends on masses alone and is factored once for each group of conditions that share a
/// freedom. Freedoms that the deck drives or holds keep the motion that they were given; what the conditions
/// ask of them is booked as external work.
class LinearConstraints : public Term {
public:
    /// To be made when the state has its final masses. DeckError for nodes of rigid bodies, for freedoms that
    /// do not exist, and for conditions without terms.
    /// elements  the terms that know plastic strains, for tied nodes that fail
    LinearConstraints(const Model& model, const State& state, std::vector<const Term*> elements = {});

    void serialise(Archive& archive) override { archive(conditions_, groups_, started_, work_, tied_); }
    std::string_view name() const override { return "linear constraints"; }
    std::size_t items() const override { return conditions_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_.done; }
    void collect(const State& state, ElementResults& results) const override;

    bool empty() const { return conditions_.empty(); }

private:
    struct Part {
        Index node;
        int freedom; ///< 0..2 translation, 3..5 rotation
        double coefficient;
        bool driven; ///< keeps its velocity
    };
    struct Condition {
        std::vector<Part> parts;
        double end; ///< [time] up to which it holds
        Location where;
        double multiplier = 0; ///< of the last step [force]

        void serialise(Archive& archive) { archive(parts, end, multiplier); }
    };
    /// Conditions that share free freedoms, with the Cholesky factor of their matrix by rows.
    struct Group {
        std::vector<std::size_t> conditions;
        std::vector<double> factor;
        std::vector<bool> dropped; ///< follows from those before it
        double end = 0;            ///< [time] at which the first of them ends

        void serialise(Archive& archive) { archive(conditions, factor, dropped, end); }
    };
    std::vector<Condition> conditions_;
    std::vector<Group> groups_;
    bool started_ = false;
    WorkSum work_;
    std::vector<double> values_; ///< room for each cycle
    TiedNodeGroups tied_;
    /// Conditions of each tied group by freedom.
    std::vector<std::array<std::vector<std::size_t>, 6>> tied_conditions_;

    void read(const Model& model);
    void read_tied(const State& state);
    void let_go_of_tied_nodes(const State& state);
    void mark_driven(const Model& model);
    void make_groups();
    void find_end(Group& group) const;
    void factor(Group& group, const State& state) const;
    void solve(const Group& group, std::vector<double>& values) const;
    void start(State& state);
};

std::unique_ptr<LinearConstraints> make_linear_constraints(const Model& model, const State& state,
                                                           std::vector<const Term*> elements);

} // namespace plash
