#include "materials/parameters.h"
#include "sph/particle_bodies.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

const Record* find(const Model& model, std::string_view keyword)
{
    for (const Record& record : model.others)
        if (record.keyword == keyword) return &record;
    return nullptr;
}

/// What a FORM of *CONTROL_SPH means that particles here do not have, for the message.
const char* meaning_of_form(Id form)
{
    switch (form) {
    case 7:
    case 8:
        return " (total Lagrangian: kernels on the places of the start)";
    case 9:
    case 10:
        return " (adaptive SPH: ellipsoids for kernels, as *SECTION_SPH_ELLIPSE and _TENSOR give them, which "
               "turn "
               "and stretch with the flow; here they are spheres)";
    case 13:
        return " (implicit and incompressible)";
    default:
        return "";
    }
}

/// FORM of *CONTROL_SPH. Plash's pair forces are symmetric in all of them, so forms that differ by that alone
/// are one (docs/sph.md).
void read_form(const Record& control, ParticleOptions& options)
{
    const Id form = control.integer("FORM");
    switch (form) {
    case 0: // default
    case 2: // symmetric
    case 4: // tensor
        return;
    case 1:  // renormalised
    case 3:  // symmetric renormalised
    case 12: // moving least squares: exact for linear fields, as renormalisation is
        options.renormalised = true;
        return;
    case 5: // fluid
        options.volume_weighted = true;
        return;
    case 15: // enhanced fluid: Plash's own choice of what keeps pressures smooth
        options.volume_weighted = true;
        options.density_diffusion = 0.1;
        return;
    case 6:  // fluid, renormalised
    case 16: // enhanced fluid, renormalised
        options.volume_weighted = options.renormalised = true;
        return;
    default:
        reject_field(control, "FORM",
                     fmt::format("form {}{} is not supported; there are 0 to 6, 12, 15 and 16", form,
                                 meaning_of_form(form)));
    }
}

/// BOXID and MAXV: when particles leave the run. A negative MAXV, as in LS-DYNA, checks no speeds.
void read_limits(const Model& model, const Record& control, ParticleOptions& options)
{
    if (const Id id = control.integer("BOXID"); id != 0) {
        const auto box = std::find_if(model.boxes.begin(), model.boxes.end(),
                                      [&](const NamedBox& candidate) { return candidate.id == id; });
        if (box == model.boxes.end()) reject_field(control, "BOXID", fmt::format("there is no box {}", id));
        options.box = box->box;
    }
    const double fastest = control.real("MAXV");
    if (fastest > 0 && fastest < 1e15) options.largest_speed = fastest;
}

/// Whether a field that may be 0 or 1 is 1.
/// choices  what the two mean, for the message
bool is_one(const Record& control, const char* field, const char* choices)
{
    const Id value = control.integer(field);
    if (value < 0 || value > 1) {
        reject_field(control, field, fmt::format("{} is not supported; {}", value, choices));
    }
    return value == 1;
}

void read_control(const Record& control, ParticleOptions& options)
{
    const Id dimension = control.integer("IDIM");
    if (dimension == 2 || dimension == 3) {
        options.dimension = static_cast<int>(dimension);
    } else if (dimension != 0 && dimension != -2) {
        reject_field(control, "IDIM",
                     fmt::format("{} is not supported; there are 2 (plane strain), 3 and -2 (axisymmetric)",
                                 dimension));
    }
    read_form(control, options);
    if (dimension == -2) {
        options.dimension = 2;
        options.axisymmetric = options.volume_weighted = true;
        options.mirrors.push_back({{}, {1, 0, 0}}); // the axis
    }
    options.parts_interact = control.integer("CONT") == 0;
    const double last = control.real("DT");
    options.birth = control.real("START");
    options.death = last > 0 ? last : forever;
    options.smoothing_by_cube_root = is_one(
        control, "DERIV", "smoothing lengths follow h div(v) / d (0), or with the cube root of div(v) (1)");
    options.failed_carry_nothing =
        is_one(control, "IEROD", "failed particles stay as they are (0) or lose their stress (1)");
    if (is_one(control, "ISHIFT", "particles go with the flow (0) or are shifted apart as well (1)"))
        options.shifting = 1;
    options.bulk_viscosity =
        is_one(control, "IAVIS", "viscosity is Monaghan's (0) or as solid elements have it (1)");
}

/// Kernels beyond those of SPHKERN.
Kernel kernel_named(const Record& record, Kernel as_section)
{
    switch (record.integer("KERNEL")) {
    case 0:
        return as_section;
    case 4:
        return Kernel::wendland_c2;
    case 5:
        return Kernel::wendland_c4;
    default:
        reject_field(record, "KERNEL",
                     fmt::format("there is no kernel {}; there are 0 (that of the sections), 4 (Wendland C2) "
                                 "and 5 (Wendland C4)",
                                 record.integer("KERNEL")));
    }
}

void read_formulation(const Record& record, ParticleOptions& options)
{
    const auto share = [&](const char* field, double largest) {
        const double value = record.real(field);
        if (value < 0 || value > largest) {
            reject_field(record, field, fmt::format("{:g} is not between 0 and {:g}", value, largest));
        }
        return value;
    };
    if (record.given("DELTA")) options.density_diffusion = share("DELTA", 1);
    options.velocity_blend = share("XSPH", 1);
    if (record.given("SHIFT")) options.shifting = share("SHIFT", 10);
    options.tensile_repulsion = share("TENSILE", 10);
    const Id viscosity = record.integer("VISC");
    if (viscosity < 0 || viscosity > 1) {
        reject_field(record, "VISC",
                     fmt::format("there is no form {} of laminar viscosity; there are 0 (Monaghan & Cleary) "
                                 "and 1 (Morris et al.)",
                                 viscosity));
    }
    options.laminar_by_velocity = viscosity == 1;
    const Id graded = record.integer("GRADED");
    if (graded < 0 || graded > 1) {
        reject_field(
            record, "GRADED",
            fmt::format("{} is neither 0 (one smoothing length for a part) nor 1 (by the mass of each "
                        "particle)",
                        graded));
    }
    options.graded = graded == 1;
    options.filter_interval = static_cast<int>(share("FILTER", 1e9));
    const double skin = share("SKIN", 1);
    if (skin > 0) options.skin = skin;
    options.own_kernel = record.integer("KERNEL") != 0;
    options.kernel = kernel_named(record, options.kernel);
}

MirrorPlane mirror_of(const Record& record)
{
    const Vec3 tail{record.real("VTX"), record.real("VTY"), record.real("VTZ")};
    const Vec3 head{record.real("VHX"), record.real("VHY"), record.real("VHZ")};
    if (norm(head - tail) == 0) {
        reject_field(record, "VHX", "head and tail of the plane's normal are the same point");
    }
    MirrorPlane plane;
    plane.point = tail;
    plane.normal = unit(head - tail);
    return plane;
}

/// The fluid sticks to it; it may slide along itself.
MirrorPlane wall_of(const Record& record)
{
    MirrorPlane wall = mirror_of(record);
    wall.no_slip = true;
    wall.velocity = {record.real("VX"), record.real("VY"), record.real("VZ")};
    if (std::abs(dot(wall.velocity, wall.normal)) > 1e-6 * norm(wall.velocity)) {
        reject_field(record, "VX", "the velocity leads out of the wall's plane");
    }
    return wall;
}

const NamedVector& vector_of(const Model& model, const Record& record, std::string_view field)
{
    const Id id = record.integer(field);
    for (const NamedVector& vector : model.vectors)
        if (vector.id == id) return vector;
    reject_field(record, field, fmt::format("there is no *DEFINE_VECTOR {}", id));
}

/// The planes stand at the tails of the two vectors, across the first one.
PeriodicPair period_of(const Model& model, const Record& record)
{
    const NamedVector& first = vector_of(model, record, "VID1");
    const NamedVector& second = vector_of(model, record, "VID2");
    const Vec3 normal = unit(first.head - first.tail);
    const double distance = dot(second.tail - first.tail, normal);
    if (distance == 0) reject_field(record, "VID2", "the two planes are the same");
    return {first.tail, distance * normal, none, 0};
}

/// The same planes, going along with a node.
PeriodicPair moving_period_of(const Model& model, const Record& record)
{
    PeriodicPair pair = period_of(model, record);
    const Id id = record.integer("NID");
    const auto found = std::find(model.nodes.id.begin(), model.nodes.id.end(), id);
    if (found == model.nodes.id.end()) reject_field(record, "NID", fmt::format("there is no node {}", id));
    pair.node = static_cast<Index>(found - model.nodes.id.begin());
    pair.calm = record.real("CALM");
    if (pair.calm < 0 || pair.calm > norm(pair.period)) {
        reject_field(record, "CALM",
                     fmt::format("{:g} is no length between 0 and the distance of the planes, {:g}",
                                 pair.calm, norm(pair.period)));
    }
    return pair;
}

} // namespace

ParticleOptions particle_options_of(const Model& model)
{
    ParticleOptions options;
    if (const Record* control = find(model, "CONTROL_SPH")) {
        read_control(*control, options);
        read_limits(model, *control, options);
    }
    if (const Record* record = find(model, "PLASH_SPH_FORMULATION")) read_formulation(*record, options);
    options.regions = active_regions_of(model);
    options.inflows = inflows_of(model);
    for (const Record& record : model.others) {
        if (record.keyword == "BOUNDARY_SPH_SYMMETRY_PLANE") options.mirrors.push_back(mirror_of(record));
        if (record.keyword == "BOUNDARY_SPH_NON_REFLECTING") {
            options.mirrors.push_back(mirror_of(record));
            options.mirrors.back().absorbing = true;
        }
        if (record.keyword == "PLASH_SPH_WALL") options.mirrors.push_back(wall_of(record));
        if (record.keyword == "BOUNDARY_SPH_PERIODIC") options.periods.push_back(period_of(model, record));
        if (record.keyword == "PLASH_SPH_MOVING_PERIODIC") {
            options.periods.push_back(moving_period_of(model, record));
        }
    }
    return options;
}

} // namespace plash
