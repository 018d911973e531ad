#pragma once

#include "conditions/bag_content.h"
#include "conditions/bag_surface.h"
#include "conditions/loaded_elements.h"
#include "core/term.h"

namespace plash {

/// Control volumes (*AIRBAG family): gas or fluid of one pressure inside a surface of segments, on which it
/// acts (docs/conditions.md). The forces of unit pressure are the exact derivatives of the volume, so that
/// gas and structure exchange the same energy. Work on the structure counts as external work. A segment whose
/// element has been deleted still bounds the volume but is pushed no more.
class Airbags : public Term {
public:
    /// RunError: a surface has no volume inside.
    Airbags(const Model& model, const State& state);

    std::string_view name() const override { return "airbags"; }
    std::size_t items() const override { return items_; }
    void add_forces(const Clock& clock, State& state) override;
    /// A content resists the one change of volume like a spring of -dp/dV: 2 / omega with omega^2 = -dp/dV
    /// times the sum over nodes of (force of unit pressure)^2 / mass.
    StepVote stable_step() const override { return vote_; }
    std::vector<std::string> notices(const State& state) const override;
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_; }
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override;

private:
    struct Bag {
        BagSurface surface;
        LoadedElements elements;
        CornerSum sum; ///< forces of unit pressure on corners [area], until they act
        BagState content;
        double area = 0; ///< of the surface [area]
    };
    const Model& model_;
    std::vector<Bag> bags_;
    StepVote vote_;
    std::size_t items_ = 0;
    double work_ = 0; ///< [energy]

    void measure(Bag& bag, const State& state) const;
    double leak_area(const Airbag& airbag, const Bag& bag, const State& state) const;
    double push(const Airbag& airbag, Bag& bag, const Clock& clock, State& state) const;
};

} // namespace plash
