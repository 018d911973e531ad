#include "sph/particle_checks.h"

#include "model/eulerian.h"
#include "sph/near_distances.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plash {

namespace {

constexpr std::size_t largest_sample = 2000; ///< particles that speak for their part

/// Distances to the nearest neighbour and to the `count`-th one.
struct NeighbourDistances {
    double nearest = 0, farthest = 0;
};

/// Of evenly chosen particles; empty when there are too few of them.
std::vector<NeighbourDistances> sample_distances(const std::vector<Vec3>& positions, std::size_t count)
{
    std::vector<NeighbourDistances> found;
    const std::size_t stride = (positions.size() + largest_sample - 1) / largest_sample;
    std::vector<char> asked(positions.size());
    for (std::size_t p = 0; p < positions.size(); p += stride) asked[p] = 1;
    visit_near(positions, std::move(asked), count, [&](std::vector<double>& squares) {
        const auto farthest = squares.begin() + static_cast<std::ptrdiff_t>(count) - 1;
        std::nth_element(squares.begin(), farthest, squares.end());
        found.push_back({std::sqrt(*std::min_element(squares.begin(), farthest + 1)), std::sqrt(*farthest)});
    });
    return found;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Particles of each part of the Model that are there from the start, by place in Model::particles.
std::vector<std::vector<std::size_t>> particles_by_part(const Model& model, std::size_t end)
{
    std::vector<std::vector<std::size_t>> particles(model.parts.size());
    for (std::size_t i = 0; i < end; ++i) particles[model.particles.part[i]].push_back(i);
    return particles;
}

/// An axis-parallel box around nodes that move, and their mean velocity.
struct MovingBox {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    Vec3 velocity{}; ///< sum, until `finish`
    std::size_t count = 0;

    void take(Index node, const State& state)
    {
        const Vec3& p = state.position[node];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        velocity += state.velocity[node];
        ++count;
    }
    void finish()
    {
        if (count > 0) velocity = (1.0 / static_cast<double>(count)) * velocity;
    }
    double longest_edge() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

/// Whether two boxes come closer than a margin before a time.
bool boxes_meet(const MovingBox& a, const MovingBox& b, double margin, double end)
{
    double enter = 0, leave = end;
    const auto narrow_axis = [&](double a_low, double a_high, double b_low, double b_high, double speed) {
        const double ahead = b_low - a_high - margin, behind = b_high - a_low + margin; // of a, seen from b
        if (speed == 0) {
            if (ahead > 0 || behind < 0) leave = -1;
            return;
        }
        const double first = ahead / speed, second = behind / speed;
        enter = std::max(enter, std::min(first, second));
        leave = std::min(leave, std::max(first, second));
    };
    const Vec3 speed = a.velocity - b.velocity;
    narrow_axis(a.low.x, a.high.x, b.low.x, b.high.x, speed.x);
    narrow_axis(a.low.y, a.high.y, b.low.y, b.high.y, speed.y);
    narrow_axis(a.low.z, a.high.z, b.low.z, b.high.z, speed.z);
    return enter <= leave;
}

/// Parts of the Model with a particle on a side of a contact that sees particles. Single surfaces do not.
std::vector<char> parts_in_contact(const Model& model)
{
    std::vector<char> parts(model.parts.size());
    std::vector<Index> part_of_node(model.nodes.size(), none);
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
        part_of_node[model.particles.node[i]] = model.particles.part[i];
    }
    const auto look = [&](const ContactSide& side) {
        const auto inside = [&](Index node) {
            return !side.box || side.box->holds(model.nodes.position[node]);
        };
        if (side.kind == ContactSide::Kind::nodes) {
            for (Index node : side.nodes)
                if (part_of_node[node] != none && inside(node)) parts[part_of_node[node]] = 1;
        }
        if (side.kind != ContactSide::Kind::parts) return;
        if (!side.box) {
            for (Index part : side.parts) parts[part] = 1;
            return;
        }
        std::vector<char> named(model.parts.size());
        for (Index part : side.parts) named[part] = 1;
        for (std::size_t i = 0; i < model.particles.size(); ++i) {
            const Index part = model.particles.part[i];
            if (named[part] && inside(model.particles.node[i])) parts[part] = 1;
        }
    };
    for (const Contact& contact : model.contacts) {
        using Kind = Contact::Kind;
        if (contact.kind != Kind::two_way && contact.kind != Kind::one_way && contact.kind != Kind::tied)
            continue;
        look(contact.slave);
        look(contact.master);
    }
    return parts;
}

/// Boxes around the shells and solids of each part that is a body; others stay empty.
std::vector<MovingBox> boxes_of_bodies(const Model& model, const State& state)
{
    std::vector<char> passable(model.parts.size());
    for (std::size_t part = 0; part < model.parts.size(); ++part) {
        passable[part] = is_eulerian(model, static_cast<Index>(part));
    }
    for (const StandIns& some : model.stand_ins) passable[model.solids.part[some.solid]] = 1;
    std::vector<MovingBox> boxes(model.parts.size());
    const auto take = [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const Index part = elements.part[i];
            if (passable[part]) continue;
            for (Index node : elements.nodes[i]) boxes[part].take(node, state);
        }
    };
    take(model.shells);
    take(model.solids);
    take(model.thick_shells);
    for (MovingBox& box : boxes) box.finish();
    return boxes;
}

} // namespace

std::vector<std::string> mass_notices(const Model& model, const std::vector<ParticlePart>& parts,
                                      int dimension)
{
    constexpr double noticed = 2; // masses over those expected, or the other way round
    const std::size_t end = model.stand_ins.empty() ? model.particles.size() : model.stand_ins.front().first;
    const auto particles = particles_by_part(model, end);
    std::vector<std::string> lines;
    for (const ParticlePart& part : parts) {
        if (part.model_part >= static_cast<Index>(particles.size())) continue;
        std::vector<Vec3> positions;
        std::vector<double> masses;
        const double density = part.constants.density * part.law->initial_compression();
        for (std::size_t i : particles[part.model_part]) {
            const double mass = model.particles.mass[i];
            positions.push_back(model.nodes.position[model.particles.node[i]]);
            masses.push_back(mass < 0 ? -mass * part.constants.density : mass);
        }
        const auto distances = sample_distances(positions, dimension == 2 ? 4 : 6);
        if (distances.empty()) continue;
        std::vector<double> nearest, farthest;
        for (const NeighbourDistances& d : distances) {
            nearest.push_back(d.nearest);
            farthest.push_back(d.farthest);
        }
        const double mass = median(masses), spacing = median(nearest), spread = median(farthest);
        const double most = density * std::pow(spread, dimension);
        const double least = density * std::pow(spacing, dimension);
        const bool heavy = mass > noticed * most, light = noticed * mass < least;
        if (!heavy && !light) continue;
        lines.push_back(fmt::format(
            "the particles of part {} have a mass of {:.4g} (median), {:.3g} times the {:.4g} that "
            "their spacing of {:.4g} gives at the density {:.4g}: is the unit of one of them wrong?",
            part.id, mass, heavy ? mass / most : mass / least, heavy ? most : least, heavy ? spread : spacing,
            density));
    }
    return lines;
}

std::vector<std::string> contact_notices(const Model& model, const State& state,
                                         const std::vector<ParticlePart>& parts)
{
    std::vector<std::string> lines;
    if (brick_count(model) == 0 && model.shells.size() == 0) return lines;
    const std::vector<char> in_contact = parts_in_contact(model);
    const std::vector<MovingBox> bodies = boxes_of_bodies(model, state);
    for (const ParticlePart& part : parts) {
        if (part.model_part >= static_cast<Index>(in_contact.size()) || in_contact[part.model_part]) continue;
        MovingBox box;
        for (Index node : part.nodes) box.take(node, state);
        box.finish();
        std::vector<Id> near;
        for (std::size_t body = 0; body < bodies.size(); ++body) {
            if (bodies[body].count == 0) continue;
            if (boxes_meet(box, bodies[body], box.longest_edge(), model.controls.time.end_time))
                near.push_back(model.parts[body].id);
        }
        if (near.empty()) continue;
        constexpr std::size_t most = 5; // that are named
        const std::size_t named = std::min(near.size(), most);
        std::string names = fmt::format("{}", fmt::join(near.begin(), near.begin() + named, ", "));
        if (near.size() > most) names += fmt::format(" and {} more", near.size() - most);
        lines.push_back(fmt::format("the particles of part {} are in no contact that sees particles (single "
                                    "surfaces do not): nothing keeps them from passing through part{} {}",
                                    part.id, near.size() == 1 ? "" : "s", names));
    }
    return lines;
}

} // namespace plash
