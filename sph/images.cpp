#include "sph/images.h"

#include "core/parallel.h"
#include "sph/absorption.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

bool same(const Matrix3& a, const Matrix3& b)
{
    for (int i = 0; i < 3; ++i)
        if (norm(a.row[i] - b.row[i]) > 1e-12) return false;
    return true;
}

/// The push tensor as a mirror shows it.
void turn_tension(const Matrix3& turn, Index source, Index place, ParticleArrays& arrays)
{
    const double* t = arrays.tension[source].component;
    const Matrix3 push{{{t[0], t[1], t[2]}, {t[3], t[4], t[5]}, {t[6], t[7], arrays.push[source].push}}};
    const Matrix3 shown = turn * push * transpose(turn);
    arrays.tension[place] = {{shown.row[0].x, shown.row[0].y, shown.row[0].z, shown.row[1].x, shown.row[1].y,
                              shown.row[1].z, shown.row[2].x, shown.row[2].y}};
    arrays.push[place].push = shown.row[2].z;
}

/// How the velocity of a particle changes along a direction, as its image sees it [1/time]. Where no
/// gradients are kept, only the component along it, as if all of the change of density came from there.
Vec3 slope_along(const Vec3& outward, const Matrix3& turn, Index source, const ParticleArrays& arrays)
{
    if (arrays.gradient.empty()) {
        const double closing =
            arrays.own_mass.empty() ? arrays.rate[source] / arrays.density(source) : arrays.rate[source];
        return -closing * outward;
    }
    const Tensor3<double>& g = arrays.gradient[source];
    const Vec3 n = transpose(turn) * outward;
    return turn * Vec3{g.xx * n.x + g.xy * n.y + g.xz * n.z, g.yx * n.x + g.yy * n.y + g.yz * n.z,
                       g.zx * n.x + g.zy * n.y + g.zz * n.z};
}

} // namespace

Images::Images(std::span<const MirrorPlane> mirrors, std::span<const PeriodicPair> periods)
    : mirrors_(mirrors.begin(), mirrors.end()), periods_(periods.begin(), periods.end()), transforms_(1)
{
    const Matrix3 identity = Matrix3::identity();
    for (const PeriodicPair& pair : periods_) {
        first_lower_.push_back(pair.lower);
        const Vec3 along = unit(pair.period);
        steps_.push_back(
            {{pair.lower, along, identity, pair.period, identity, identity, {}},
             {pair.lower + pair.period, -along, identity, -pair.period, identity, identity, {}}});
    }
    for (const MirrorPlane& plane : mirrors_) {
        const Matrix3 turn = identity + dyad(-2.0 * plane.normal, plane.normal);
        const Vec3 shift = 2 * dot(plane.point, plane.normal) * plane.normal;
        const Matrix3 back{{-identity.row[0], -identity.row[1], -identity.row[2]}};
        if (plane.absorbing) {
            steps_.push_back({{plane.point, plane.normal, turn, shift, identity, identity, {}, true}});
        } else if (plane.no_slip) {
            steps_.push_back(
                {{plane.point, plane.normal, turn, shift, turn, back, 2.0 * plane.velocity, false, true}});
        } else {
            steps_.push_back({{plane.point, plane.normal, turn, shift, turn, turn, {}}});
        }
    }
}

bool Images::any_sticking() const
{
    return std::any_of(mirrors_.begin(), mirrors_.end(),
                       [](const MirrorPlane& plane) { return plane.no_slip && !plane.absorbing; });
}

bool Images::any_absorbing() const
{
    return std::any_of(mirrors_.begin(), mirrors_.end(),
                       [](const MirrorPlane& plane) { return plane.absorbing; });
}

Index Images::transform_after(Index first, const Step& step)
{
    const Transform& before = transforms_[first];
    Transform both{step.turn * before.turn,
                   step.turn * before.shift + step.shift,
                   step.flow * before.flow,
                   step.drag * before.drag,
                   step.drag * before.carry + step.carry,
                   before.planes,
                   {},
                   {},
                   before.walls + (step.sticks ? 1 : 0),
                   step.sticks ? -step.normal : step.turn * before.wall_outward,
                   step.sticks ? step.point : step.turn * before.wall_point + step.shift};
    for (int i = 0; i < before.planes; ++i) {
        both.outward[i] = step.absorbing ? before.outward[i] : step.turn * before.outward[i];
        both.point[i] = step.absorbing ? before.point[i] : step.turn * before.point[i] + step.shift;
    }
    if (step.absorbing && both.planes < 3) {
        both.outward[both.planes] = -step.normal;
        both.point[both.planes++] = step.point;
    }
    for (std::size_t i = 0; i < transforms_.size(); ++i) {
        const Transform& known = transforms_[i];
        if (same(known.turn, both.turn) && norm(known.shift - both.shift) <= 1e-12 * norm(both.shift)) {
            return static_cast<Index>(i);
        }
    }
    transforms_.push_back(both);
    return static_cast<Index>(transforms_.size()) - 1;
}

Vec3 Images::lower_now(std::size_t pair, const State& state, const std::vector<Vec3>& start) const
{
    const PeriodicPair& period = periods_[pair];
    if (period.node == none) return first_lower_[pair];
    const Vec3 along = unit(period.period);
    const double moved = dot(state.position[period.node] - start[period.node], along);
    return first_lower_[pair] + moved * along;
}

double Images::behind(const State& state, const std::vector<Vec3>& start) const
{
    double farthest = 0;
    for (std::size_t i = 0; i < periods_.size(); ++i) {
        farthest = std::max(farthest, norm(lower_now(i, state, start) - periods_[i].lower));
    }
    return farthest;
}

double Images::follow(const State& state, const std::vector<Vec3>& start)
{
    const double moved = behind(state, start);
    for (std::size_t i = 0; i < periods_.size(); ++i) {
        PeriodicPair& pair = periods_[i];
        pair.lower = lower_now(i, state, start);
        steps_[i][0].point = pair.lower; // periodic pairs come first
        steps_[i][1].point = pair.lower + pair.period;
    }
    return moved;
}

bool Images::wrap(Vec3& position) const
{
    bool moved = false;
    for (const PeriodicPair& pair : periods_) {
        const double cell =
            std::floor(dot(position - pair.lower, pair.period) / dot(pair.period, pair.period));
        if (cell == 0 || !std::isfinite(cell)) continue;
        position -= cell * pair.period;
        moved = true;
    }
    return moved;
}

/// Which of some positions are closer than `range` to the plane of a step, or beyond it.
std::vector<Index> Images::places_near(const Step& step, double range, std::span<const Vec3> position)
{
    std::vector<std::vector<Index>> found((position.size() + chunk_length - 1) / chunk_length);
    for_chunks(position.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (dot(position[i] - step.point, step.normal) >= range) continue;
            found[begin / chunk_length].push_back(static_cast<Index>(i));
        }
    });
    std::vector<Index> all;
    for (const std::vector<Index>& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
}

void Images::find(double range, std::vector<Vec3>& position)
{
    images_.clear();
    const std::size_t real_count = position.size();
    for (const auto& boundary : steps_) {
        const std::size_t known = position.size(); // images of earlier boundaries are copied too: corners
        for (const Step& step : boundary) {
            std::vector<Index> both(transforms_.size(), none); // by transform: that followed by the step
            for (Index i : places_near(step, range, {position.data(), known})) {
                const bool real = static_cast<std::size_t>(i) < real_count;
                const Image from = real ? Image{i, 0} : images_[i - real_count];
                Index& transform = both[from.transform];
                if (transform == none) transform = transform_after(from.transform, step);
                images_.push_back({from.source, transform});
                position.push_back(step.turn * position[i] + step.shift);
            }
        }
    }
}

void Images::settle(std::span<const Index> order, ParticleArrays& arrays)
{
    arrays.image.resize(images_.size());
    if (images_.empty()) return;
    const std::size_t real_count = order.size() - images_.size();
    std::vector<Index> place(real_count);
    for (std::size_t p = 0; p < real_count; ++p) place[order[p]] = static_cast<Index>(p);
    std::vector<ImageKind> kind;
    for (const Transform& transform : transforms_)
        kind.push_back(same(transform.turn, Matrix3::identity()) ? periodic_image : mirror_image);
    std::vector<Image> sorted;
    sorted.reserve(images_.size());
    for (std::size_t p = real_count; p < order.size(); ++p) {
        const Image& image = images_[order[p] - real_count];
        sorted.push_back({place[image.source], image.transform});
        arrays.part[p] = arrays.part[sorted.back().source];
        if (!arrays.bonded.empty()) arrays.bonded[p] = arrays.bonded[sorted.back().source];
        arrays.image[p - real_count] = kind[image.transform];
    }
    images_ = std::move(sorted);
}

void Images::copy_reaches(ParticleArrays& arrays) const
{
    const std::size_t first = arrays.real_count();
    for (std::size_t k = 0; k < images_.size(); ++k)
        arrays.reach[first + k] = arrays.reach[images_[k].source];
}

void Images::refresh_motion(ParticleArrays& arrays) const
{
    const std::size_t first = arrays.real_count();
    for_chunks(images_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const MotionRecord& source = arrays.motion[images_[k].source];
            const Transform& transform = transforms_[images_[k].transform];
            arrays.motion[first + k] = {transform.turn * source.position + transform.shift, source.smoothing,
                                        transform.flow * source.velocity, source.weight};
            if (transform.planes > 0) {
                carry_on(transform, images_[k].source, static_cast<Index>(first + k), arrays);
            }
        }
    });
}

void Images::refresh_all(ParticleArrays& arrays) const
{
    const std::size_t first = arrays.real_count();
    for_chunks(images_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Index from = images_[k].source;
            const MotionRecord& source = arrays.motion[from];
            const Transform& transform = transforms_[images_[k].transform];
            arrays.motion[first + k] = {transform.turn * source.position + transform.shift, source.smoothing,
                                        transform.drag * source.velocity + transform.carry, source.weight};
            arrays.push[first + k] = arrays.push[from];
            if (!arrays.laminar.empty()) arrays.laminar[first + k] = arrays.laminar[from];
            if (!arrays.tension.empty()) {
                turn_tension(transform.flow, from, static_cast<Index>(first + k), arrays);
            }
            if (transform.planes > 0) absorb(transform, from, static_cast<Index>(first + k), arrays);
        }
    });
}

/// With the velocity U of the wall, v of a particle at the distance y from it and its slope v' away from the
/// wall, the parabola has 4 U - 3 v + 2 y v' at -y, where the mirror image has 2 U - v. The difference is
/// held within 2 |v - U|, so that a wall that stands never drives the fluid.
void Images::bend_at_walls(ParticleArrays& arrays) const
{
    const std::size_t first = arrays.real_count();
    arrays.bend.assign(images_.size(), {});
    for_chunks(images_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Transform& transform = transforms_[images_[k].transform];
            if (transform.walls != 1) continue;
            const Index from = images_[k].source;
            MotionRecord& image = arrays.motion[first + k];
            const double distance = dot(image.position - transform.wall_point, transform.wall_outward);
            const Vec3 inward = transpose(transform.turn) * transform.wall_outward;
            // As the image sees it: it shows the opposite of all motion against the wall.
            const Vec3 slip = image.velocity - 0.5 * transform.carry;
            const Vec3 slope = -1.0 * (transform.drag * (arrays.wall_gradient[from] * inward));
            Vec3 bend = 2.0 * (slip + distance * slope);
            const double size = norm(bend), largest = 2 * norm(slip);
            if (size > largest) bend = (largest / size) * bend;
            arrays.bend[k] = bend;
            image.velocity += bend;
        }
    });
}

/// Velocities of images that let waves out: those of their originals, linearly on.
void Images::carry_on(const Transform& transform, Index source, Index place, ParticleArrays& arrays) const
{
    MotionRecord& image = arrays.motion[place];
    for (int i = 0; i < transform.planes; ++i) {
        const double further = 2 * dot(image.position - transform.point[i], transform.outward[i]);
        image.velocity += further * slope_along(transform.outward[i], transform.flow, source, arrays);
    }
}

/// Pushes of images that let waves out: see sph/absorption.h.
void Images::absorb(const Transform& transform, Index source, Index place, ParticleArrays& arrays) const
{
    PushRecord& push = arrays.push[place];
    const MotionRecord& original = arrays.motion[source];
    const Vec3 velocity = transform.flow * (original.velocity - arrays.rest_velocity[source]);
    carry_on(transform, source, place, arrays);
    const bool by_volume = !arrays.own_mass.empty();
    const double density = by_volume ? push.scale : 1 / push.scale;
    const Index part = arrays.part[source];
    const Impedance impedance{density * push.sound,
                              shear_sound_.empty() ? 0 : density * push.sound * shear_sound_[part],
                              arrays.rest_pressure[source], by_volume ? 1 : push.scale * push.scale};
    for (int i = 0; i < transform.planes; ++i) {
        const Vec3& outward = transform.outward[i];
        const double further = 2 * dot(arrays.motion[place].position - transform.point[i], outward);
        const Vec3 ahead = velocity + 0.5 * further * slope_along(outward, transform.flow, source, arrays);
        if (arrays.tension.empty()) {
            push.push = absorbing_push(push.push, impedance, outward, ahead);
        } else {
            absorb_tension(arrays.tension[place], push.push, impedance, outward, ahead);
        }
    }
}

void Images::reflect_passed(ParticleArrays& arrays, State& state) const
{
    const auto passes = [&](const MirrorPlane& mirror, Index node) {
        return !mirror.absorbing && dot(state.position[node] - mirror.point, mirror.normal) < 0;
    };
    if (mirrors_.empty()) return;
    std::vector<std::vector<Index>> found((images_.size() + chunk_length - 1) / chunk_length);
    for_chunks(images_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Index node = arrays.node[images_[k].source];
            const auto passed = [&](const MirrorPlane& mirror) { return passes(mirror, node); };
            if (std::none_of(mirrors_.begin(), mirrors_.end(), passed)) continue;
            found[begin / chunk_length].push_back(images_[k].source);
        }
    });
    for (const std::vector<Index>& places : found) {
        for (Index place : places) { // one that has several images stands back in after the first
            const Index node = arrays.node[place];
            for (const MirrorPlane& mirror : mirrors_) {
                if (!passes(mirror, node)) continue;
                const double gap = dot(state.position[node] - mirror.point, mirror.normal);
                state.position[node] -= 2 * gap * mirror.normal;
                state.velocity[node] = mirror.reflected(state.velocity[node]);
                // The heat of the second half of the step looks at the change of the velocity.
                arrays.motion[place].velocity = mirror.reflected(arrays.motion[place].velocity);
                arrays.viscous_force[place] = narrow(mirror.reflected(wide(arrays.viscous_force[place])));
            }
        }
    }
}

} // namespace plash
