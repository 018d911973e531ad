#include "sph/particle_bodies.h"

#include "materials/parameters.h"
#include "sph/near_distances.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace plash {

namespace {

const Record& section_of(const Model& model, const Part& part)
{
    if (part.section == none) {
        throw DeckError(part.where, fmt::format("*PART {} has particles but no section", part.id));
    }
    const Record& section = model.sections[part.section];
    if (section.keyword == "SECTION_SPH") return section;
    throw DeckError(part.where, fmt::format("*PART {} has particles, but its section {} is *{} instead of "
                                            "*SECTION_SPH",
                                            part.id, section.id, section.keyword));
}

Kernel kernel_of(const Record& section)
{
    const Id number = section.integer("SPHKERN");
    constexpr Kernel kernels[] = {Kernel::cubic_spline, Kernel::quintic_spline, Kernel::quadratic,
                                  Kernel::quartic_spline};
    if (number < 0 || number > 3) {
        reject_field(section, "SPHKERN", fmt::format("there is no kernel {}; there are 0 to 3", number));
    }
    return kernels[number];
}

ArtificialViscosity viscosity_of(const Model& model, const Part& part)
{
    const ElementControls& control = model.controls.elements;
    if (part.hourglass != none) {
        const Record& record = model.hourglass[part.hourglass];
        return {value_or(record.real("Q1"), 1.5), value_or(record.real("Q2"), 0.06)};
    }
    return {value_or(control.quadratic_viscosity, 1.5), value_or(control.linear_viscosity, 0.06)};
}

void set_smoothing(const Record& section, const std::vector<Vec3>& positions, PartConstants& constants)
{
    const double given = section.real("SPHINI");
    constants.smoothing =
        given > 0 ? given : value_or(section.real("CSLH"), 1.2) * particle_spacing(positions);
    constants.smallest_smoothing = value_or(section.real("HMIN"), 0.2) * constants.smoothing;
    constants.largest_smoothing = value_or(section.real("HMAX"), 2) * constants.smoothing;
    if (!(constants.smoothing > 0)) {
        reject_field(section, "SPHINI",
                     "two particles at the same place leave no smoothing length; give one");
    }
    if (constants.smallest_smoothing > constants.largest_smoothing) {
        reject_field(section, "HMIN", "the smallest smoothing length is above the largest one, HMAX");
    }
}

/// Edge of the cube, in the plane of the square, that a particle of mean mass fills [length].
double mean_edge(const std::vector<double>& mass, double density, int dimension)
{
    const double volume =
        std::accumulate(mass.begin(), mass.end(), 0.0) / (density * static_cast<double>(mass.size()));
    return dimension == 2 ? std::sqrt(volume) : std::cbrt(volume);
}

/// The smoothing length of a particle of mean mass, which those of the others follow: CSLH times the edge of
/// the cube, in the plane of the square, that a particle fills.
void set_graded_smoothing(const Record& section, const std::vector<double>& mass, int dimension,
                          PartConstants& constants)
{
    const double mean = std::accumulate(mass.begin(), mass.end(), 0.0) / static_cast<double>(mass.size());
    const double given = section.real("SPHINI"), edge = mean_edge(mass, constants.density, dimension);
    const double smoothing = given > 0 ? given : value_or(section.real("CSLH"), 1.2) * edge;
    const double ratio = smoothing / constants.smoothing;
    constants.smoothing_mass = mean;
    constants.smoothing = smoothing;
    constants.smallest_smoothing *= ratio;
    constants.largest_smoothing *= ratio;
}

void set_weight(const DepthStress& weight, ParticlePart& part)
{
    if (part.law->has_strength() || weight.lateral != 1) {
        throw DeckError(weight.where, fmt::format("*INITIAL_STRESS_DEPTH: the particles of part {} must be a "
                                                  "fluid, and KFACT must be 1, as pressure acts alike",
                                                  part.id));
    }
    part.weight = weight;
}

ParticlePart make_part(const Model& model, Index index, const std::vector<Index>& elements, int dimension)
{
    const Part& source = model.parts[index];
    const Record& section = section_of(model, source);
    const ParticleLawOfPart law = particle_law_of(model, source);
    ParticlePart part;
    part.model_part = index;
    part.id = source.id;
    part.law = law.law;
    part.constants.density = law.density;
    part.constants.laminar_viscosity = law.laminar_viscosity;
    std::vector<Vec3> positions;
    for (Index element : elements) {
        const Index node = model.particles.node[element];
        const double mass = model.particles.mass[element];
        part.nodes.push_back(node);
        part.elements.push_back(element);
        part.mass.push_back(mass < 0 ? -mass * law.density : mass);
        positions.push_back(model.nodes.position[node]);
        if (!(part.mass.back() > 0)) {
            throw DeckError(source.where, fmt::format("*ELEMENT_SPH {} of part {} has the mass {:g}",
                                                      model.nodes.id[node], source.id, mass));
        }
    }
    set_smoothing(section, positions, part.constants);
    part.constants.laminar_viscosity += law.viscosity_by_size * mean_edge(part.mass, law.density, dimension);
    part.birth = section.real("START");
    if (const double death = section.real("DEATH"); death > 0) part.death = death;
    if (part.death < part.birth) {
        reject_field(section, "DEATH", fmt::format("{:g} is before START, {:g}", part.death, part.birth));
    }
    part.constants.viscosity = viscosity_of(model, source);
    for (const DepthStress& weight : depth_stresses(model)) {
        if (weight.part == index) set_weight(weight, part);
    }
    return part;
}

/// Viscosity of solid elements goes by the edge of the cube that a particle fills.
void set_bulk_length(ParticlePart& part, int dimension)
{
    PartConstants& constants = part.constants;
    constants.bulk_length = mean_edge(part.mass, constants.density, dimension) / constants.smoothing;
}

/// What all particles of a body must share, for pairs of particles of two parts have one of each.
void share(const Model& model, const ParticlePart& part, bool first, ParticleOptions& options)
{
    const Part& source = model.parts[part.model_part];
    const Kernel kernel = kernel_of(section_of(model, source));
    const ArtificialViscosity& viscosity = part.constants.viscosity;
    if (first) {
        if (!options.own_kernel) options.kernel = kernel;
        options.viscosity = viscosity;
    }
    if (!options.own_kernel && kernel != options.kernel) {
        throw DeckError(source.where,
                        fmt::format("*PART {}: all particles must have the same SPHKERN", source.id));
    }
    if (viscosity.quadratic != options.viscosity.quadratic || viscosity.linear != options.viscosity.linear) {
        throw DeckError(
            source.where,
            fmt::format("*PART {}: all particles must have the same artificial viscosity; here Q1 = {:g}, "
                        "Q2 = {:g}, elsewhere {:g}, {:g}",
                        source.id, viscosity.quadratic, viscosity.linear, options.viscosity.quadratic,
                        options.viscosity.linear));
    }
}

/// Mirrors look at their particles, however the deck has turned them.
void turn_mirrors(const std::vector<ParticlePart>& parts, const Model& model, ParticleOptions& options)
{
    for (MirrorPlane& mirror : options.mirrors) {
        double side = 0;
        for (const ParticlePart& part : parts)
            for (Index node : part.nodes)
                side += dot(model.nodes.position[node] - mirror.point, mirror.normal);
        if (side < 0) mirror.normal = -mirror.normal;
    }
}

void check_plane(const std::vector<ParticlePart>& parts, const Model& model, const ParticleOptions& options)
{
    if (options.dimension != 2 || parts.empty()) return;
    const double level = model.nodes.position[parts.front().nodes.front()].z;
    for (const ParticlePart& part : parts)
        for (Index node : part.nodes) {
            if (model.nodes.position[node].z == level) continue;
            throw DeckError(
                model.parts[part.model_part].where,
                fmt::format("*CONTROL_SPH, field IDIM: {} asks for particles in one plane z = const, "
                            "but particle {} has z = {:g} and others {:g}",
                            options.axisymmetric ? -2 : 2, model.nodes.id[node], model.nodes.position[node].z,
                            level));
        }
}

/// Who sees whom is kept in 64 bits, half of them for those that wait in solids.
void check_count(const std::vector<ParticlePart>& parts, const Model& model, const ParticleOptions& options)
{
    const auto comes_or_goes = [](const ParticlePart& part) {
        return part.birth > 0 || part.death < forever;
    };
    const bool apart = !options.parts_interact || options.birth > 0 || options.death < forever ||
                       std::any_of(parts.begin(), parts.end(), comes_or_goes);
    const std::size_t most = model.stand_ins.empty() ? 64 : 32;
    if (parts.size() <= most || (!apart && model.stand_ins.empty())) return;
    throw DeckError(
        model.parts[parts[most].model_part].where,
        fmt::format(
            "there are {} parts of particles; with CONT = 1, START or DT of *CONTROL_SPH, START or "
            "DEATH of *SECTION_SPH or *DEFINE_ADAPTIVE_SOLID_TO_SPH no more than {} can be told apart",
            parts.size(), most));
}

/// Rings stand on one side of the axis, and options that move particles besides their velocity know no hoops.
void check_rings(const std::vector<ParticlePart>& parts, const Model& model, const ParticleOptions& options)
{
    if (!options.axisymmetric || parts.empty()) return;
    for (const ParticlePart& part : parts)
        for (Index node : part.nodes) {
            if (model.nodes.position[node].x > 0) continue;
            throw DeckError(model.parts[part.model_part].where,
                            fmt::format("*CONTROL_SPH, field IDIM: -2 asks for particles at x > 0, for they "
                                        "are rings around the y axis, but particle {} has x = {:g}",
                                        model.nodes.id[node], model.nodes.position[node].x));
        }
    const auto refuse = [&](bool given, const char* what) {
        if (!given) return;
        throw DeckError(
            model.parts[parts.front().model_part].where,
            fmt::format("{} do not work with axisymmetric particles (*CONTROL_SPH IDIM = -2)", what));
    };
    refuse(options.velocity_blend > 0 || options.shifting > 0 || options.tensile_repulsion > 0 ||
               options.graded || options.laminar_by_velocity,
           "XSPH, SHIFT, TENSILE, GRADED and VISC of *PLASH_SPH_FORMULATION");
    refuse(!options.inflows.empty(), "*BOUNDARY_SPH_FLOW");
    refuse(!model.stand_ins.empty(), "*DEFINE_ADAPTIVE_SOLID_TO_SPH");
    refuse(std::any_of(options.mirrors.begin(), options.mirrors.end(),
                       [](const MirrorPlane& plane) { return plane.absorbing; }),
           "*BOUNDARY_SPH_NON_REFLECTING");
}

/// Corrections that know fluids alone.
void check_formulation(const std::vector<ParticlePart>& parts, const Model& model,
                       const ParticleOptions& options)
{
    if (options.density_diffusion == 0 && options.tensile_repulsion == 0) return;
    if (options.renormalised) {
        throw DeckError(model.parts[parts.front().model_part].where,
                        "*PLASH_SPH_FORMULATION: DELTA and TENSILE do not work together with the corrected "
                        "gradients of *CONTROL_SPH FORM 1, 3, 6 and 12");
    }
    for (const ParticlePart& part : parts) {
        if (!part.law->has_strength()) continue;
        throw DeckError(model.parts[part.model_part].where,
                        fmt::format("*PART {} has strength: DELTA and TENSILE of *PLASH_SPH_FORMULATION are "
                                    "for scenes whose particles are all fluids",
                                    part.id));
    }
}

} // namespace

double initial_smoothing(const Model& model, Index part, const std::vector<Vec3>& positions)
{
    PartConstants constants;
    set_smoothing(section_of(model, model.parts[part]), positions, constants);
    return constants.smoothing;
}

double particle_spacing(const std::vector<Vec3>& positions)
{
    double largest = 0;
    visit_near(positions, std::vector<char>(positions.size(), 1), 1, [&](std::vector<double>& squares) {
        largest = std::max(largest, std::sqrt(*std::min_element(squares.begin(), squares.end())));
    });
    return largest;
}

std::vector<std::unique_ptr<ParticleBody>> make_particle_bodies(const Model& model, State& state)
{
    std::vector<std::unique_ptr<ParticleBody>> bodies;
    if (model.particles.size() == 0) return bodies;
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
        elements[model.particles.part[i]].push_back(static_cast<Index>(i));
    }
    ParticleOptions options = particle_options_of(model);
    std::vector<ParticlePart> parts;
    for (std::size_t part = 0; part < elements.size(); ++part) {
        if (elements[part].empty()) continue;
        parts.push_back(make_part(model, static_cast<Index>(part), elements[part], options.dimension));
        share(model, parts.back(), parts.size() == 1, options);
        if (options.bulk_viscosity) set_bulk_length(parts.back(), options.dimension);
        if (!options.graded) continue;
        set_graded_smoothing(section_of(model, model.parts[part]), parts.back().mass, options.dimension,
                             parts.back().constants);
    }
    turn_mirrors(parts, model, options);
    check_count(parts, model, options);
    check_plane(parts, model, options);
    check_rings(parts, model, options);
    check_formulation(parts, model, options);
    bodies.push_back(std::make_unique<ParticleBody>(std::move(parts), std::move(options), model, state));
    return bodies;
}

} // namespace plash
