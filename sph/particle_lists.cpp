// How long neighbour lists hold.

#include "core/parallel.h"
#include "sph/particle_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace plash {

namespace {

/// The least and the largest skin over the mean one that the options ask for. Fast particles are few, and
/// what the slow ones need is little: a skin by speed makes shorter lists that hold longer.
constexpr double least_share = 0.3, largest_share = 2;

/// Largest value(place) of the particles, 0 at least.
template <class Value>
double largest_of(std::size_t count, Value&& value)
{
    std::vector<double> partial((count + chunk_length - 1) / chunk_length);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        double largest = 0;
        for (std::size_t p = begin; p < end; ++p) largest = std::max<double>(largest, value(p));
        partial[begin / chunk_length] = largest;
    });
    double largest = 0;
    for (double part : partial) largest = std::max(largest, part);
    return largest;
}

/// Mean of value(place) over the particles, summed in chunks.
template <class Value>
Vec3 mean_of(std::size_t count, Value&& value)
{
    std::vector<Vec3> partial((count + chunk_length - 1) / chunk_length);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        Vec3 sum{};
        for (std::size_t p = begin; p < end; ++p) sum += value(p);
        partial[begin / chunk_length] = sum;
    });
    Vec3 sum{};
    for (const Vec3& part : partial) sum += part;
    return count > 0 ? (1 / static_cast<double>(count)) * sum : sum;
}

} // namespace

/// The skin that makes a cycle cheapest, as a share of the largest kernel radius. A cycle costs in proportion
/// to the pairs on the lists, (1 + m s)^d with the share m that particles have of it in the mean, and to how
/// often they are made: every s / u cycles where a cycle uses up the share u. The least sum is where
/// d m (1 + m s)^(d - 1) s^2 = r u, r being the cost of a search over that of a cycle.
void ParticleBody::choose_skin()
{
    if (options_.skin > 0) {
        skin_ = options_.skin;
        return;
    }
    constexpr double first = 0.04, least = 0.02, largest = 0.25, search_cost = 0.9;
    if (cycles_since_search_ > 0) {
        const double used = skin_ / static_cast<double>(cycles_since_search_);
        double best = skin_;
        for (int i = 0; i < 4; ++i) {
            const double growth = std::pow(1 + mean_share_ * best, options_.dimension - 1);
            best = std::sqrt(search_cost * used / (options_.dimension * mean_share_ * growth));
        }
        // The speed of the flow changes: half of the way, by the logarithm.
        skin_ = std::clamp(std::sqrt(skin_ * best), least, largest);
    } else if (skin_ == 0) {
        skin_ = first;
    }
    cycles_since_search_ = 0;
}

/// Gives every particle a reach with the skin that all of them use up in about the same time at their present
/// speeds. Returns the largest sum of two reaches.
double ParticleBody::set_reaches()
{
    ParticleArrays& a = arrays_;
    const Vec3 mean =
        images_.any() ? Vec3{} : mean_of(a.real_count(), [&](std::size_t p) { return a.motion[p].velocity; });
    const double fastest =
        largest_of(a.real_count(), [&](std::size_t p) { return norm(a.motion[p].velocity - mean); });
    const double largest = largest_of(a.real_count(), [&](std::size_t p) { return a.motion[p].smoothing; });
    choose_skin();
    const double skin = skin_ * support_ * largest;
    least_skin_ = least_share * skin;
    const double time = fastest > 0 ? (largest_share - least_share) * skin / fastest : 0;
    const double all_skins = sum_chunks(a.real_count(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t p = begin; p < end; ++p) {
            const double own_skin = least_skin_ + norm(a.motion[p].velocity - mean) * time;
            a.reach[p] = static_cast<float>(0.5 * (support_ * a.motion[p].smoothing + own_skin));
            sum += own_skin;
        }
        return sum;
    });
    mean_share_ = all_skins / (skin * a.real_count());
    return 2 * largest_of(a.real_count(), [&](std::size_t p) { return a.reach[p]; });
}

void ParticleArrays::remember_build()
{
    Vec3 lower{INFINITY, INFINITY, INFINITY}, upper{-INFINITY, -INFINITY, -INFINITY};
    for (const MotionRecord& particle : std::span(motion).first(real_count())) {
        const Vec3& p = particle.position;
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    build_origin = 0.5 * (lower + upper);
    build_rounding = 0.5 * norm(upper - lower) * std::numeric_limits<float>::epsilon();
    build_position.resize(node.size());
    for (std::size_t p = 0; p < node.size(); ++p) {
        build_position[p] = narrow(motion[p].position - build_origin);
    }
}

/// Whether no pair can have come into reach that is not on the lists: no particle has moved, against all of
/// them, by more than what its reach has left beyond its kernel of now.
bool ParticleBody::lists_hold(const State& state) const
{
    const ParticleArrays& a = arrays_;
    // Which copy of a particle in a periodic basin is the real one makes no difference, so the planes may run
    // ahead of those of the last search: not by much, as who has come through comes in again as still water.
    if (images_.behind(state, model_.nodes.position) > 10 * least_skin_) return false;
    if (inflows_.someone_passes(state)) return false;
    for (std::size_t i = 0; i < options_.regions.size(); ++i) {
        // Who is awake is looked up again when a region has gone a few particles further.
        const Vec3 gone = options_.regions[i].travelled(state, model_.nodes.position) - regions_at_[i];
        if (norm(gone) > 10 * least_skin_) return false;
    }
    // Images mirror the motion, so what all particles have in common counts there.
    const Vec3 common = images_.any() ? Vec3{} : mean_of(a.real_count(), [&](std::size_t p) {
        return a.motion[p].position - a.built_at(p);
    });
    const double passed = sum_chunks(a.real_count(), [&](std::size_t begin, std::size_t end) {
        double count = 0;
        for (std::size_t p = begin; p < end; ++p) {
            const double left = a.reach[p] - 0.5 * support_ * a.motion[p].smoothing - a.build_rounding;
            const Vec3 moved = a.motion[p].position - a.built_at(p) - common;
            count += !(left >= 0 && dot(moved, moved) <= left * left);
        }
        return count;
    });
    return passed == 0;
}

/// The parts between their birth and their death, and those of all.
std::uint64_t ParticleBody::alive(double time) const
{
    if (time < options_.birth || time > options_.death) return 0;
    std::uint64_t bits = ~0ULL;
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const ParticlePart& part = parts_[number];
        if (time < part.birth || time > part.death) bits &= ~(1ULL << number);
    }
    return bits;
}

/// Bonded particles are groups of their own, behind those of the parts: they do not see each other, for their
/// solids hold them together.
void ParticleBody::tell_bonded_apart(std::vector<std::uint8_t>& group, std::vector<std::uint64_t>& sees) const
{
    const std::size_t parts = parts_.size();
    group.resize(arrays_.part.size());
    for (std::size_t p = 0; p < group.size(); ++p)
        group[p] = static_cast<std::uint8_t>(arrays_.part[p] + (arrays_.bonded[p] ? parts : 0));
    std::vector<StandIns::Bond> bond(parts, StandIns::Bond::none);
    for (Index p : bonded_places_) bond[arrays_.part[p]] = hosts_.bond_of(arrays_.node[p]);
    sees.assign(2 * parts, 0);
    for (std::size_t free = 0; free < parts; ++free) {
        for (std::size_t other = 0; other < parts; ++other) {
            if (other != free && !options_.parts_interact) continue;
            sees[free] |= 1ULL << other;
            const bool holds = bond[other] == StandIns::Bond::at_start ||
                               (bond[other] == StandIns::Bond::at_loss && other == free);
            if (!holds) continue;
            sees[free] |= 1ULL << (parts + other);
            sees[parts + other] |= 1ULL << free;
        }
    }
}

void ParticleBody::list_neighbours(const ParticleCells& cells)
{
    ParticleArrays& a = arrays_;
    a.remember_build();
    images_.copy_reaches(a);
    std::vector<std::uint64_t> sees;
    if (!options_.parts_interact || alive_ != ~0ULL) {
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            sees.push_back(options_.parts_interact ? ~0ULL : 1ULL << part);
        }
    }
    std::vector<std::uint8_t> group;
    if (!bonded_places_.empty()) tell_bonded_apart(group, sees);
    for (std::size_t part = 0; part < parts_.size() && alive_ != ~0ULL; ++part) {
        if (alive_ >> part & 1) continue;
        sees[part] = 0;
        for (std::uint64_t& seen : sees) seen &= ~(1ULL << part);
    }
    build_neighbours(cells,
                     {a.motion, a.reach, real_count_, a.asleep,
                      group.empty() ? std::span(a.part) : std::span(group), sees},
                     runs_);
    ++searches_;
}

} // namespace plash
