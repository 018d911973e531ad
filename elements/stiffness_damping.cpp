#include "elements/stiffness_damping.h"

#include "elements/shell_belytschko_tsay.h"
#include "elements/shell_mass.h"
#include "elements/shell_store.h"
#include "elements/solid_kinematics.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace plash {

namespace {

constexpr int damping_patch_length = 256; // elements

/// Young's modulus and Poisson's ratio of a material, from E and PR or from G and BULK.
std::pair<double, double> elastic_moduli(const Record& material, const StiffnessDamping& given, Id part)
{
    if (material.peek("E") && material.peek("PR") && material.real("E") > 0)
        return {material.real("E"), material.real("PR")};
    if (material.peek("G") && material.peek("BULK") && material.real("G") > 0) {
        const double g = material.real("G"), k = material.real("BULK");
        return {9 * k * g / (3 * k + g), (3 * k - 2 * g) / (2 * (3 * k + g))};
    }
    if (material.keyword == "MAT_FABRIC")
        return {std::max(material.real("EA"), material.real("EB")), material.real("PRBA")};
    throw DeckError(given.where,
                    fmt::format("*DAMPING_PART_STIFFNESS: part {} has a material *{} without the "
                                "elastic moduli E and PR, or G and BULK",
                                part, material.keyword));
}

/// What the deck damps: by parts, and fabrics by their material.
std::vector<StiffnessDamping> all_dampings(const Model& model)
{
    std::vector<StiffnessDamping> all = model.stiffness_dampings;
    for (std::size_t part = 0; part < model.parts.size(); ++part) {
        const Index number = model.parts[part].material;
        if (number == none || model.materials[number].keyword != "MAT_FABRIC") continue;
        const Record& material = model.materials[number];
        const double damping = material.real("DAMP");
        if (damping == 0) continue;
        if (!(damping > 0 && damping < 1))
            reject_field(material, "DAMP", "a share of critical damping lies between 0 and 1");
        const bool own = std::any_of(all.begin(), all.end(), [&](const StiffnessDamping& other) {
            return other.part == static_cast<Index>(part);
        });
        if (!own) all.push_back({static_cast<Index>(part), damping, material.where});
    }
    return all;
}

template <int Corners>
Patches cut(const Elements<Corners>& elements, const std::vector<Index>& wanted, const State& state)
{
    std::vector<Index> connectivity;
    for (Index element : wanted)
        connectivity.insert(connectivity.end(), elements.nodes[element].begin(),
                            elements.nodes[element].end());
    return Patches(Corners, wanted, connectivity, state.position, damping_patch_length);
}

} // namespace

StiffnessDampingGroup::StiffnessDampingGroup(const Model& model, const StiffnessDamping& given, Shape shape,
                                             std::vector<Index> elements, State& state)
    : model_(model),
      given_(given),
      shape_(shape),
      patches_(shape == Shape::solid ? cut(model.solids, elements, state)
                                     : cut(model.shells, elements, state)),
      taken_(patches_.patches.size()),
      votes_(patches_.patches.size())
{
    const Part& part = model.parts[given.part];
    if (part.material == none) {
        throw DeckError(given.where,
                        fmt::format("*DAMPING_PART_STIFFNESS: part {} has no material of its own", part.id));
    }
    const Record& material = model.materials[part.material];
    const auto [e, nu] = elastic_moduli(material, given, part.id);
    shear_ = e / (2 * (1 + nu));
    lame_ = e * nu / ((1 + nu) * (1 - 2 * nu));
    plane_ = e / (1 - nu * nu);
    poisson_ = nu;
    const double density = positive(material, "RO", "mass density");
    wave_speed_ = std::sqrt((shape == Shape::solid ? lame_ + 2 * shear_ : plane_) / density);
    records_.resize(patches_.batch_count() * record_size);
    if (shape != Shape::shell) return;
    state.need_rotation();
    for (Index place = 0; place < patches_.batch_count() * lane_count; ++place) {
        Lanes* record = &records_[place / lane_count * record_size];
        const int lane = static_cast<int>(place % lane_count);
        const Index element = patches_.elements[place];
        record[6][lane] = shell_thickness(model, element);
        record[7][lane] = record[6][lane] * shell_area(model, state, element);
    }
}

bool StiffnessDampingGroup::gone(Index element, const State& state) const
{
    const auto& deleted = shape_ == Shape::solid ? state.deleted_solids : state.deleted_shells;
    return !deleted.empty() && deleted[element] != 0;
}

void StiffnessDampingGroup::add_forces(const Clock& clock, State& state)
{
    const double step = clock.last_step;
    const double beta = given_.coefficient < 0 ? -given_.coefficient : given_.coefficient * step;
    // With the damping ratio xi a vibration is stable up to 2 / omega (sqrt(1 + xi^2) - xi); what TSSFAC
    // leaves of it already need not be asked for again.
    const double spare = 0.98 / model_.controls.time.step_scale;
    patches_.for_each(
        state, shape_ == Shape::shell,
        [&](std::ptrdiff_t number, const Patches::Patch& patch, NodeCopies& copies) {
            PatchVote& vote = votes_[number];
            vote = {std::numeric_limits<double>::infinity(), 0};
            for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
                Lanes alive = broadcast<Lanes>(1);
                Lengths length;
                if (state.deletions > 0) {
                    for (int lane = 0; lane < lane_count; ++lane)
                        alive[lane] = gone(patches_.elements[batch * lane_count + lane], state) ? 0 : 1;
                }
                const Lanes work = shape_ == Shape::solid
                                       ? damp_solids(batch, beta, step, copies, length, alive)
                                       : damp_shells(batch, beta, step, copies, length, alive);
                for (int lane = 0; lane < patches_.active_lanes(batch); ++lane) {
                    if (alive[lane] == 0) continue;
                    taken_[number] += work[lane];
                    const double own = length.crossing[lane] / wave_speed_;
                    const double bound = length.bound[lane] / wave_speed_;
                    const double ratio = given_.coefficient > 0 ? given_.coefficient : beta / bound;
                    const double stable =
                        std::min(own, bound * spare * (std::sqrt(1 + ratio * ratio) - ratio));
                    if (stable < vote.step) vote = {stable, batch * lane_count + lane};
                }
            }
        });
}

Lanes StiffnessDampingGroup::damp_solids(Index batch, double beta, double step, NodeCopies& copies,
                                         Lengths& length, const Lanes& alive)
{
    Vector3<Lanes> position[8], velocity[8];
    for (int corner = 0; corner < 8; ++corner) {
        const std::uint16_t* offsets = patches_.corner_offsets(batch, corner);
        position[corner] = load_corner<Lanes>(copies.position.data(), offsets);
        velocity[corner] = load_corner<Lanes>(copies.velocity.data(), offsets);
    }
    const SolidModes<Lanes> x = modes_of(position), v = modes_of(velocity);
    const auto gradient = gradient_of<SolidGradientRule::mean>(x);
    const Tensor3<Lanes> rate = (1.0 / gradient.volume) * volume_gradient(gradient, v);
    const Lanes trace = rate.xx + rate.yy + rate.zz;
    const Lanes volumetric = (beta * lame_) * trace;
    const Lanes twice = alive * (2 * beta * shear_), once = alive * (beta * shear_);
    const Lanes stress[6] = {alive * volumetric + twice * rate.xx, alive * volumetric + twice * rate.yy,
                             alive * volumetric + twice * rate.zz, once * (rate.xy + rate.yx),
                             once * (rate.yz + rate.zy),           once * (rate.zx + rate.xz)};
    const Lanes rates[6] = {rate.xx,           rate.yy,           rate.zz,
                            rate.xy + rate.yx, rate.yz + rate.zy, rate.zx + rate.xz};
    Lanes* last = records_.data() + static_cast<std::size_t>(batch) * record_size;
    Lanes power{};
    for (int i = 0; i < 6; ++i) {
        power += 0.5 * (stress[i] + last[i]) * rates[i];
        last[i] = stress[i];
    }
    const Tensor3<Lanes> minus{-stress[0], -stress[3], -stress[5], -stress[3], -stress[1],
                               -stress[4], -stress[5], -stress[4], -stress[2]};
    const int active = patches_.active_lanes(batch);
    for_corners(stress_divergence(gradient, minus), [&](int corner, const Vector3<Lanes>& force) {
        add_corner(copies.force.data(), patches_.corner_offsets(batch, corner), force, active);
    });
    length.crossing = length.bound = gradient.volume / sqrt(largest_face_squared(x));
    return step * gradient.volume * power;
}

Lanes StiffnessDampingGroup::damp_shells(Index batch, double beta, double step, NodeCopies& copies,
                                         Lengths& length, const Lanes& alive)
{
    Vector3<Lanes> x[4], v[4], w[4];
    for (int corner = 0; corner < 4; ++corner) {
        const std::uint16_t* offsets = patches_.corner_offsets(batch, corner);
        x[corner] = load_corner<Lanes>(copies.position.data(), offsets);
        v[corner] = load_corner<Lanes>(copies.velocity.data(), offsets);
        w[corner] = load_corner<Lanes>(copies.angular_velocity.data(), offsets);
    }
    const CornerPattern<Lanes> position = pattern_of(x[0], x[1], x[2], x[3]);
    const ShellFrame<Lanes> frame = shell_frame(position);
    const ShellIncrement<Lanes> rate = shell_increment(frame, pattern_of(v[0], v[1], v[2], v[3]),
                                                       pattern_of(w[0], w[1], w[2], w[3]), 1.0, false);
    Lanes* last = records_.data() + static_cast<std::size_t>(batch) * record_size;
    const Lanes thickness = last[6];
    const Lanes membrane = alive * (beta * plane_) * thickness;
    const Lanes bending = (1.0 / 12) * membrane * thickness * thickness;
    const double shear = 0.5 * (1 - poisson_);
    ShellResultants<Lanes> r{};
    r.nxx = membrane * (rate.exx + poisson_ * rate.eyy);
    r.nyy = membrane * (rate.eyy + poisson_ * rate.exx);
    r.nxy = (shear * membrane) * rate.twice_exy;
    r.mxx = bending * (rate.kxx + poisson_ * rate.kyy);
    r.myy = bending * (rate.kyy + poisson_ * rate.kxx);
    r.mxy = (shear * bending) * rate.twice_kxy;
    const Lanes now[6] = {r.nxx, r.nyy, r.nxy, r.mxx, r.myy, r.mxy};
    const Lanes rates[6] = {rate.exx, rate.eyy, rate.twice_exy, rate.kxx, rate.kyy, rate.twice_kxy};
    Lanes power{};
    for (int i = 0; i < 6; ++i) {
        power += 0.5 * (now[i] + last[i]) * rates[i];
        last[i] = now[i];
    }
    CornerPattern<Lanes> force, moment;
    shell_forces(frame, r, ShellHourglassForce<Lanes>{}, false, force, moment);
    const int active = patches_.active_lanes(batch);
    each_corner(force, [&](int corner, const Vector3<Lanes>& value) {
        add_corner(copies.force.data(), patches_.corner_offsets(batch, corner), value, active);
    });
    each_corner(moment, [&](int corner, const Vector3<Lanes>& value) {
        add_corner(copies.moment.data(), patches_.corner_offsets(batch, corner), value, active);
    });
    length.crossing = sqrt(squared_length(position, frame.area, 0));
    // Drawn out, a shell keeps its mass (stretched_share(), elements/shell_kernel.h).
    length.bound =
        length.crossing *
        sqrt(min(broadcast<Lanes>(1), last[7] / max(frame.area * thickness, broadcast<Lanes>(1e-300))));
    return step * frame.area * power;
}

StepVote StiffnessDampingGroup::stable_step() const
{
    const PatchVote* shortest = nullptr;
    for (const PatchVote& vote : votes_) {
        if (!shortest || vote.step < shortest->step) shortest = &vote;
    }
    if (!shortest || !std::isfinite(shortest->step)) return StepVote::nothing();
    const Index element = patches_.elements[shortest->place];
    const bool solid = shape_ == Shape::solid;
    return {shortest->step, solid ? "solid" : "shell",
            solid ? model_.solids.id[element] : model_.shells.id[element], model_.parts[given_.part].id};
}

void StiffnessDampingGroup::report(EnergyLedger& ledger) const
{
    for (double energy : taken_) ledger.damping += energy;
}

std::vector<std::unique_ptr<Term>> make_stiffness_damping(const Model& model, State& state)
{
    std::vector<std::unique_ptr<Term>> groups;
    for (const StiffnessDamping& damping : all_dampings(model)) {
        if (model.is_rigid(damping.part)) continue;
        const auto elements_of = [&](const std::vector<Index>& part_of_element) {
            std::vector<Index> elements;
            for (std::size_t i = 0; i < part_of_element.size(); ++i) {
                if (part_of_element[i] == damping.part) elements.push_back(static_cast<Index>(i));
            }
            return elements;
        };
        using Shape = StiffnessDampingGroup::Shape;
        for (const Shape shape : {Shape::solid, Shape::shell}) {
            auto elements = elements_of(shape == Shape::solid ? model.solids.part : model.shells.part);
            if (elements.empty()) continue;
            if (shape == Shape::solid && ten_nodes(model, elements.front())) {
                throw DeckError(
                    damping.where,
                    fmt::format(
                        "*DAMPING_PART_STIFFNESS is not supported for the ten-node tetrahedra of part {}",
                        model.parts[damping.part].id));
            }
            groups.push_back(
                std::make_unique<StiffnessDampingGroup>(model, damping, shape, std::move(elements), state));
        }
        if (!elements_of(model.beams.part).empty()) {
            throw DeckError(damping.where,
                            fmt::format("*DAMPING_PART_STIFFNESS is not supported for the beams of part {}",
                                        model.parts[damping.part].id));
        }
    }
    return groups;
}

} // namespace plash
