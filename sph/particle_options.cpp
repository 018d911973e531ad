#include "materials/parameters.h"
#include "sph/particle_bodies.h"

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
    case 6: // fluid, renormalised
        options.volume_weighted = options.renormalised = true;
        return;
    default:
        reject_field(control, "FORM", fmt::format("form {} is not supported; there are 0 to 6 and 12", form));
    }
}

void read_control(const Record& control, ParticleOptions& options)
{
    const Id dimension = control.integer("IDIM");
    if (dimension == 2 || dimension == 3) {
        options.dimension = static_cast<int>(dimension);
    } else if (dimension != 0) {
        reject_field(control, "IDIM",
                     fmt::format("{} is not supported; there are 2 (plane strain) and 3", dimension));
    }
    read_form(control, options);
    options.parts_interact = control.integer("CONT") == 0;
    const double last = control.real("DT");
    options.birth = control.real("START");
    options.death = last > 0 ? last : forever;
    if (control.integer("DERIV") != 0) {
        reject_field(control, "DERIV", "smoothing lengths follow h div(v) / d (0) alone");
    }
    if (control.integer("IAVIS") != 0) {
        reject_field(control, "IAVIS", "there is Monaghan's artificial viscosity (0) alone");
    }
}

MirrorPlane mirror_of(const Record& record)
{
    const Vec3 tail{record.real("VTX"), record.real("VTY"), record.real("VTZ")};
    const Vec3 head{record.real("VHX"), record.real("VHY"), record.real("VHZ")};
    if (norm(head - tail) == 0) {
        reject_field(record, "VHX", "head and tail of the plane's normal are the same point");
    }
    return {tail, unit(head - tail), false, {}};
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
    return {first.tail, distance * normal};
}

} // namespace

ParticleOptions particle_options_of(const Model& model)
{
    ParticleOptions options;
    if (const Record* control = find(model, "CONTROL_SPH")) read_control(*control, options);
    for (const Record& record : model.others) {
        if (record.keyword == "BOUNDARY_SPH_SYMMETRY_PLANE") options.mirrors.push_back(mirror_of(record));
        if (record.keyword == "BOUNDARY_SPH_PERIODIC") options.periods.push_back(period_of(model, record));
    }
    return options;
}

} // namespace plash
