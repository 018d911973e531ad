#pragma once

#include "elements/solid_group.h"
#include "eos/gruneisen.h"
#include "eos/ideal_gas.h"
#include "eos/jwl.h"
#include "eos/linear_polynomial.h"
#include "eos/murnaghan.h"
#include "eos/pore_collapse.h"
#include "eos/tabulated.h"
#include "eos/tabulated_compaction.h"

#include <fmt/format.h>
#include <memory>

namespace plash {

/// The equation of state of a part whose material has none of its own; DeckError when the part names none.
inline const Record& need_equation_of_state(const Record& material, const Record* equation_of_state,
                                            const SolidSetup& setup)
{
    if (equation_of_state) return *equation_of_state;
    const Part& part = setup.model.parts[setup.part];
    throw DeckError(part.where, fmt::format("*PART {}, field EOSID: the solids of *{} {} need an equation of "
                                            "state",
                                            part.id, material.keyword, material.id));
}

/// Reads a card of an equation of state and hands it to `make`, which returns the group. Sets the relative
/// volume at the start. DeckError for equations that solids do not have.
/// density  of the material [mass/volume]
template <class Make>
std::unique_ptr<SolidGroup> with_equation_of_state(const Record& card, double density, SolidSetup& setup,
                                                   Make&& make)
{
    const auto with = [&](const auto& eos) {
        setup.initial_relative_volume = eos.relative_volume;
        return make(eos);
    };
    if (card.keyword == "EOS_LINEAR_POLYNOMIAL") return with(LinearPolynomial::from_record(card, density));
    if (card.keyword == "EOS_GRUNEISEN") return with(Gruneisen::from_record(card, density));
    if (card.keyword == "EOS_JWL") return with(Jwl::from_record(card, density));
    if (card.keyword == "EOS_IDEAL_GAS") return with(IdealGas::from_record(card, density));
    if (card.keyword == "EOS_MURNAGHAN") return with(Murnaghan::from_record(card, density));
    if (card.keyword == "EOS_TABULATED") return with(Tabulated::from_record(card, setup.model));
    if (card.keyword == "EOS_TABULATED_COMPACTION")
        return with(TabulatedCompaction::from_record(card, setup.model));
    if (card.keyword == "EOS_TENSOR_PORE_COLLAPSE") return with(PoreCollapse::from_record(card, setup.model));
    throw DeckError(card.where,
                    fmt::format("*{} {} is not supported for the solids of part {}; there are "
                                "EOS_LINEAR_POLYNOMIAL, EOS_JWL, EOS_GRUNEISEN, EOS_TABULATED_COMPACTION, "
                                "EOS_TABULATED, EOS_TENSOR_PORE_COLLAPSE, EOS_MURNAGHAN and EOS_IDEAL_GAS",
                                card.keyword, card.id, setup.model.parts[setup.part].id));
}

} // namespace plash
