#include "eos/gruneisen.h"
#include "eos/linear_polynomial.h"
#include "eos/murnaghan.h"
#include "eos/tabulated.h"
#include "materials/compression_tension.h"
#include "materials/crushable_foam.h"
#include "materials/damaged_plasticity.h"
#include "materials/elastic.h"
#include "materials/elastic_fluid.h"
#include "materials/geologic_cap.h"
#include "materials/johnson_cook.h"
#include "materials/piecewise_linear_plasticity.h"
#include "materials/plastic_kinematic.h"
#include "materials/soil_foam.h"
#include "materials/viscoelastic.h"
#include "math/lanes_math.h"
#include "sph/fluid_law.h"
#include "sph/particle_bodies.h"
#include "sph/solid_law.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

template <class Eos>
ParticleLawOfPart fluid_with(const NullFluid& fluid, const Eos& eos)
{
    return {std::make_shared<FluidLaw<Eos>>(fluid, eos), fluid.density, fluid.viscosity};
}

template <class Eos>
ParticleLawOfPart fluid_of(const NullFluid& fluid, const Record& equation_of_state)
{
    return fluid_with(fluid, Eos::from_record(equation_of_state, fluid.density));
}

ParticleLawOfPart make_fluid(const Record& material, const Record* equation_of_state, const Model& model,
                             const Part& part)
{
    if (!equation_of_state) {
        throw DeckError(part.where,
                        fmt::format("*PART {}, field EOSID: the particles of *MAT_NULL {} need an "
                                    "equation of state",
                                    part.id, material.id));
    }
    const NullFluid fluid = NullFluid::from_record(material);
    if (equation_of_state->keyword == "EOS_GRUNEISEN") return fluid_of<Gruneisen>(fluid, *equation_of_state);
    if (equation_of_state->keyword == "EOS_LINEAR_POLYNOMIAL") {
        return fluid_of<LinearPolynomial>(fluid, *equation_of_state);
    }
    if (equation_of_state->keyword == "EOS_MURNAGHAN") return fluid_of<Murnaghan>(fluid, *equation_of_state);
    if (equation_of_state->keyword == "EOS_TABULATED") {
        return fluid_with(fluid, Tabulated::from_record(*equation_of_state, model));
    }
    throw DeckError(equation_of_state->where,
                    fmt::format("*{} {} is not supported for the particles of part {}; there are "
                                "EOS_LINEAR_POLYNOMIAL, EOS_GRUNEISEN, EOS_MURNAGHAN and EOS_TABULATED",
                                equation_of_state->keyword, equation_of_state->id, part.id));
}

/// p = -K ln V, of *MAT_ELASTIC_FLUID.
struct LogarithmicPressure {
    double bulk_modulus = 0; ///< [stress]
    double energy = 0, relative_volume = 1;

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        return {bulk_modulus * log(compression), Lane{}, bulk_modulus / compression, Lane{}};
    }
};

/// The length in the tensor viscosity, s = VC L a rho e', is the edge of the cube that a particle fills: a
/// fluid of the viscosity VC L a rho / 2.
ParticleLawOfPart make_elastic_fluid(const Record& material, const Record*, const Model&, const Part&)
{
    const ElasticFluid given = ElasticFluid::from_record(material);
    NullFluid fluid;
    fluid.density = given.density;
    fluid.lowest_pressure = given.lowest_pressure;
    ParticleLawOfPart law = fluid_with(fluid, LogarithmicPressure{given.bulk_modulus});
    law.viscosity_by_size = 0.5 * given.viscosity * std::sqrt(given.bulk_modulus * given.density);
    return law;
}

template <class Material>
ParticleLawOfPart solid_of(const Material& material)
{
    return {std::make_shared<SolidParticleLaw<Material>>(material), material.density, 0};
}

template <class Material>
ParticleLawOfPart make_solid(const Record& material, const Record* equation_of_state, const Model& model,
                             const Part& part)
{
    if (equation_of_state) {
        throw DeckError(part.where,
                        fmt::format("*PART {}, field EOSID: the particles of *{} {} have their pressure from "
                                    "the material alone; give 0",
                                    part.id, material.keyword, material.id));
    }
    return solid_of(Material::from_record(material, model));
}

ParticleLawOfPart make_plastic_kinematic(const Record& material, const Record*, const Model& model,
                                         const Part&)
{
    const auto isotropic = PlasticKinematic<false>::from_record(material, model);
    if (!isotropic.has_back_stress()) return solid_of(isotropic);
    return solid_of(PlasticKinematic<true>::from_record(material, model));
}

/// Material laws that particles can have.
constexpr struct {
    std::string_view keyword;
    ParticleLawOfPart (*make)(const Record& material, const Record* equation_of_state, const Model&,
                              const Part&);
} laws[] = {
    {"MAT_NULL", make_fluid},
    {"MAT_ELASTIC", make_solid<Elastic>},
    {"MAT_ELASTIC_FLUID", make_elastic_fluid},
    {"MAT_PLASTIC_KINEMATIC", make_plastic_kinematic},
    {"MAT_SOIL_AND_FOAM", make_solid<SoilFoam>},
    {"MAT_SOIL_AND_FOAM_FAILURE", make_solid<SoilFoam>},
    {"MAT_VISCOELASTIC", make_solid<Viscoelastic>},
    {"MAT_KELVIN-MAXWELL_VISCOELASTIC", make_solid<Viscoelastic>},
    {"MAT_JOHNSON_COOK", make_solid<JohnsonCook>},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", make_solid<PiecewiseLinearPlasticity>},
    {"MAT_GEOLOGIC_CAP_MODEL", make_solid<GeologicCap>},
    {"MAT_CRUSHABLE_FOAM", make_solid<CrushableFoam>},
    {"MAT_PLASTICITY_WITH_DAMAGE", make_solid<DamagedPlasticity>},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", make_solid<CompressionTension>},
};

} // namespace

ParticleLawOfPart particle_law_of(const Model& model, const Part& part)
{
    if (part.material == none) {
        throw DeckError(part.where, fmt::format("*PART {} has particles but no material", part.id));
    }
    const Record& material = model.materials[part.material];
    const auto* law = std::find_if(std::begin(laws), std::end(laws),
                                   [&](const auto& entry) { return entry.keyword == material.keyword; });
    if (law == std::end(laws)) {
        throw DeckError(material.where,
                        fmt::format("*{} {} is not supported for the particles of part {}; particles have {}",
                                    material.keyword, material.id, part.id,
                                    fmt::join(particle_material_keywords(), ", ")));
    }
    const Record* equation_of_state =
        part.equation_of_state == none ? nullptr : &model.equations_of_state[part.equation_of_state];
    return law->make(material, equation_of_state, model, part);
}

std::vector<std::string_view> particle_material_keywords()
{
    std::vector<std::string_view> keywords;
    for (const auto& law : laws) keywords.push_back(law.keyword);
    return keywords;
}

} // namespace plash
