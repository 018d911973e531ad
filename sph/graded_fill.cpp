#include "sph/graded_fill.h"

#include "materials/principal_axes.h"
#include "sph/cells.h"
#include "sph/images.h"
#include "sph/kernels.h"
#include "sph/neighbours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plash {

namespace {

constexpr double smoothing_ratio = 1.3; ///< of the smoothing length to the spacing
constexpr double support = 2;           ///< of the kernel, in smoothing lengths

double volume_of(const Box& box)
{
    const Vec3 edges = box.high - box.low;
    return edges.x * edges.y * edges.z;
}

/// The faces of a box, as particles in it see them.
std::vector<MirrorPlane> faces_of(const Box& box)
{
    return {{box.low, {1, 0, 0}, false, {}}, {box.high, {-1, 0, 0}, false, {}},
            {box.low, {0, 1, 0}, false, {}}, {box.high, {0, -1, 0}, false, {}},
            {box.low, {0, 0, 1}, false, {}}, {box.high, {0, 0, -1}, false, {}}};
}

/// Particles in sorted order, and behind them their mirror images at the faces of the box.
class PackedParticles {
public:
    PackedParticles(const GradedFill& fill, const std::vector<Vec3>& position)
        : fill_(fill), images_(faces_of(fill.box), {})
    {
        for (const Vec3& p : position) arrays_.motion.push_back({p, 0, {}, 0});
        arrays_.node.resize(position.size());
        set_volumes();
    }

    std::size_t count() const { return arrays_.node.size(); }
    const std::vector<MotionRecord>& records() const { return arrays_.motion; } ///< weight: volume
    double spacing(std::size_t i) const { return records()[i].smoothing / smoothing_ratio; }

    /// Sorts the particles, finds their images and lists neighbours up to `margin` beyond their kernels.
    void search(double margin)
    {
        std::vector<MotionRecord>& motion = arrays_.motion;
        motion.resize(count());
        std::vector<Vec3> position;
        double reach = 0;
        for (const MotionRecord& p : motion) {
            position.push_back(p.position);
            reach = std::max(reach, (support + margin) * p.smoothing);
        }
        images_.find(reach, position);
        ParticleCells cells;
        cells.sort(position, reach, count());
        std::vector<MotionRecord> sorted(position.size());
        for (std::size_t p = 0; p < count(); ++p) sorted[p] = motion[cells.order()[p]];
        motion = std::move(sorted);
        arrays_.part.assign(motion.size(), 0);
        images_.settle(cells.order(), arrays_);
        images_.refresh_motion(arrays_);
        std::vector<float> reaches;
        for (const MotionRecord& record : motion) {
            reaches.push_back(static_cast<float>(0.5 * (support + margin) * record.smoothing));
        }
        build_neighbours(cells, {motion, reaches, count(), {}, {}, {}}, runs_);
    }

    /// pair(a, b) for every particle a and every neighbour b of it.
    template <class Pair>
    void for_pairs(Pair&& pair) const
    {
        for (const NeighbourRun& run : runs_) {
            for_listed(run, [&](Index a, Index b, bool inside) {
                if (a == b) return;
                pair(a, b);
                if (inside) pair(b, a);
            });
        }
    }

    /// Moves every particle, inside the box, and fits volumes and images to where they stand.
    void move(const std::vector<Vec3>& by)
    {
        const Vec3 edges = fill_.box.high - fill_.box.low;
        for (std::size_t i = 0; i < count(); ++i) {
            Vec3& p = arrays_.motion[i].position;
            p += by[i];
            for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
                const double inset = 1e-6 * edges.*axis;
                p.*axis = std::clamp(p.*axis, fill_.box.low.*axis + inset, fill_.box.high.*axis - inset);
            }
        }
        set_volumes();
        images_.refresh_motion(arrays_);
    }

private:
    const GradedFill& fill_;
    Images images_;
    ParticleArrays arrays_; ///< motion alone, and what images ask for
    std::vector<NeighbourRun> runs_;

    void set_volumes()
    {
        double sum = 0;
        for (std::size_t i = 0; i < count(); ++i) {
            MotionRecord& record = arrays_.motion[i];
            const double spacing = fill_.spacing_at(record.position);
            record.weight = spacing * spacing * spacing;
            sum += record.weight;
        }
        const double scale = volume_of(fill_.box) / sum;
        for (std::size_t i = 0; i < count(); ++i) {
            MotionRecord& record = arrays_.motion[i];
            record.weight *= scale;
            record.smoothing = smoothing_ratio * std::cbrt(record.weight);
        }
    }
};

/// Points of the additive recurrence of the fourth generalised golden ratio (Roberts 2018), kept with the
/// probability that makes their density that of the wanted spacing.
std::vector<Vec3> scattered(const GradedFill& fill)
{
    constexpr double golden = 1.1673039782614187; // x^5 = x + 1
    constexpr double step[] = {1 / golden, 1 / (golden * golden), 1 / (golden * golden * golden),
                               1 / (golden * golden * golden * golden)};
    const Vec3 edges = fill.box.high - fill.box.low;
    const auto point = [&](double x, double y, double z) {
        return fill.box.low + Vec3{x * edges.x, y * edges.y, z * edges.z};
    };
    const auto density = [&](const Vec3& p) { return std::pow(fill.spacing_at(p), -3); };
    constexpr int samples = 64;
    double integral = 0, largest = 0;
    for (int i = 0; i < samples; ++i)
        for (int j = 0; j < samples; ++j)
            for (int k = 0; k < samples; ++k) {
                const double here =
                    density(point((i + 0.5) / samples, (j + 0.5) / samples, (k + 0.5) / samples));
                integral += here;
                largest = std::max(largest, here);
            }
    integral *= volume_of(fill.box) / (static_cast<double>(samples) * samples * samples);
    const auto count = static_cast<std::size_t>(std::lround(integral));
    std::vector<Vec3> points;
    for (double n = 1; points.size() < count; ++n) {
        const auto part = [&](int axis) { return std::fmod(0.5 + n * step[axis], 1.0); };
        const Vec3 here = point(part(0), part(1), part(2));
        if (part(3) * largest < density(here)) points.push_back(here);
    }
    return points;
}

} // namespace

double GradedFill::spacing_at(const Vec3& point) const
{
    const auto beyond = [](double x, double low, double high) { return std::max({low - x, x - high, 0.0}); };
    const Vec3 distance{beyond(point.x, fine_box.low.x, fine_box.high.x),
                        beyond(point.y, fine_box.low.y, fine_box.high.y),
                        beyond(point.z, fine_box.low.z, fine_box.high.z)};
    return std::min(coarse, fine + growth * norm(distance));
}

GradedParticles fill_graded(const GradedFill& fill)
{
    constexpr double first_strength = 0.012, last_strength = 0.002; // of the push
    constexpr double farthest = 0.1;                                // move in one iteration, in spacings
    constexpr double margin = 0.4; // of the lists, in smoothing lengths: for that many iterations
    constexpr int between_searches = 4;
    PackedParticles particles(fill, scattered(fill));
    std::vector<Vec3> push(particles.count());
    const auto& records = particles.records();
    const auto tessellate = [&](Index a, Index b) {
        const Vec3 apart = records[a].position - records[b].position;
        const double distance = norm(apart);
        const double reach = 0.5 * support * (records[a].smoothing + records[b].smoothing);
        if (distance >= reach || distance == 0) return;
        const double over = reach / (distance + 0.01 * reach);
        constexpr double at_reach = 1 / (1.01 * 1.01);
        const double size = records[b].smoothing / records[a].smoothing;
        push[a] += size * (over * over - at_reach) / distance * apart;
    };
    for (int iteration = 0; iteration < fill.iterations; ++iteration) {
        if (iteration % between_searches == 0) particles.search(margin);
        std::fill(push.begin(), push.end(), Vec3{});
        const double done = static_cast<double>(iteration) / fill.iterations;
        const double strength = first_strength * std::pow(last_strength / first_strength, done);
        particles.for_pairs(tessellate);
        for (std::size_t i = 0; i < push.size(); ++i) {
            push[i] = strength * records[i].smoothing * push[i];
            const double longest = farthest * particles.spacing(i), length = norm(push[i]);
            if (length > longest) push[i] = longest / length * push[i];
        }
        particles.move(push);
    }
    GradedParticles result;
    for (std::size_t i = 0; i < particles.count(); ++i) {
        result.position.push_back(particles.records()[i].position);
        result.volume.push_back(particles.records()[i].weight);
    }
    return result;
}

std::vector<double> eigenvalue_ratios(const GradedFill& fill, const GradedParticles& given)
{
    PackedParticles particles(fill, given.position);
    particles.search(0);
    std::vector<SymmetricTensor<double>> inertia(particles.count());
    const auto& records = particles.records();
    particles.for_pairs([&](Index a, Index b) {
        const Vec3 r = records[a].position - records[b].position;
        const double q = 2 * norm(r) / (records[a].smoothing + records[b].smoothing);
        const double weight = records[b].weight * WendlandC2::value(q);
        inertia[a] = inertia[a] + weight * SymmetricTensor<double>{r.x * r.x, r.y * r.y, r.z * r.z,
                                                                   r.x * r.y, r.y * r.z, r.z * r.x};
    });
    std::vector<double> ratios;
    for (const SymmetricTensor<double>& tensor : inertia) {
        const auto value = principal_axes(tensor).value;
        const auto [least, largest] = std::minmax_element(value.begin(), value.end());
        ratios.push_back(*largest / *least);
    }
    return ratios;
}

} // namespace plash
