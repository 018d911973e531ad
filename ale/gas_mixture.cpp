#include "ale/gas_mixture.h"

#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Heat capacities of one gas of a mixture [energy/mass/temperature].
struct Heat {
    double volume = 0, pressure = 0; ///< at constant volume, at constant pressure
};

/// By mass (RUNIV = 0), or by mole.
Heat heat_of(const Record& material, int gas)
{
    const auto field = [&](const char* name) { return fmt::format("{}{}", name, gas); };
    const double universal = material.real("RUNIV");
    Heat heat;
    if (universal == 0) {
        heat = {material.real(field("CVMASS")), material.real(field("CPMASS"))};
        if (!(heat.volume > 0)) reject_field(material, field("CVMASS"), "the gas has no heat capacity");
        if (!(heat.pressure > heat.volume))
            reject_field(material, field("CPMASS"), "it is not above that at constant volume");
        return heat;
    }
    const double weight = material.real(field("MOLWT")), per_mole = material.real(field("CPMOLE"));
    if (!(weight > 0)) reject_field(material, field("MOLWT"), "the gas has no molecular weight");
    if (!(per_mole > universal)) reject_field(material, field("CPMOLE"), "it is not above RUNIV");
    for (const char* name : {"B", "C"})
        if (material.real(field(name)) != 0)
            reject_field(material, field(name),
                         "heat capacities that depend on the temperature are not supported");
    return {(per_mole - universal) / weight, per_mole / weight};
}

} // namespace

void set_gas_mixture(DeckGroup& group, const Record& material, const Model& model, Id number)
{
    const Record* start = nullptr;
    for (const Record& record : model.others) {
        if (record.keyword != "INITIAL_GAS_MIXTURE" || record.integer("MMGID") != number) continue;
        if (start)
            throw DeckError(record.where, fmt::format("*INITIAL_GAS_MIXTURE, field MMGID: group {} has a "
                                                      "mixture already",
                                                      number));
        start = &record;
    }
    if (!start)
        throw DeckError(material.where, fmt::format("*{} {} of group {} wants its *INITIAL_GAS_MIXTURE",
                                                    material.keyword, material.id, number));
    const double temperature = positive(*start, "TEMP", "temperature");
    double volume = 0, pressure = 0; // heat capacities times density
    for (int gas = 1; gas <= 8; ++gas) {
        const double density = start->real(fmt::format("RO{}", gas));
        if (density < 0) reject_field(*start, fmt::format("RO{}", gas), "the density is negative");
        if (density == 0) continue;
        const Heat heat = heat_of(material, gas);
        group.density += density;
        volume += density * heat.volume;
        pressure += density * heat.pressure;
    }
    if (!(group.density > 0)) reject_field(*start, "RO1", "the mixture has no gas");
    LinearPolynomial law;
    law.c4 = law.c5 = pressure / volume - 1;
    law.energy = volume * temperature;
    group.fluid = 0; // numbered later
    group.law.law = law;
    group.law.reference_density = group.density;
    group.energy_per_mass = law.energy / group.density;
}

} // namespace plash
