#include "sph/graded_fill.h"

#include "materials/principal_axes.h"
#include "sph/cells.h"
#include "sph/kernels.h"
#include "sph/neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plash {

namespace {

constexpr double smoothing_ratio = 1.3; ///< of the smoothing length to the spacing
constexpr double support = 2;           ///< of the kernel, in smoothing lengths

using Axes = double Vec3::*;
constexpr Axes axes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

double volume_of(const Box& box)
{
    const Vec3 edges = box.high - box.low;
    return edges.x * edges.y * edges.z;
}

/// Particles in sorted order, and behind them their mirror images at the faces of the box.
class PackedParticles {
public:
    PackedParticles(const GradedFill& fill, std::vector<Vec3> position) : fill_(fill)
    {
        for (const Vec3& p : position) records_.push_back({p, 0, {}, 0});
        count_ = position.size();
        set_volumes();
    }

    std::size_t count() const { return count_; }
    const std::vector<MotionRecord>& records() const { return records_; } ///< weight: volume
    double spacing(std::size_t i) const { return records_[i].smoothing / smoothing_ratio; }

    /// Sorts the particles, finds their images and lists neighbours up to `margin` beyond their kernels.
    void search(double margin)
    {
        records_.resize(count_);
        double reach = 0;
        for (const MotionRecord& p : records_) reach = std::max(reach, (support + margin) * p.smoothing);
        find_images(reach);
        std::vector<Vec3> position;
        for (const MotionRecord& p : records_) position.push_back(p.position);
        for (const Image& image : images_) position.push_back(shown(image, position[image.source]));
        ParticleCells cells;
        cells.sort(position, reach, count_);

        std::vector<Index> place(count_);
        std::vector<MotionRecord> sorted;
        for (std::size_t p = 0; p < count_; ++p) {
            place[cells.order()[p]] = static_cast<Index>(p);
            sorted.push_back(records_[cells.order()[p]]);
        }
        std::vector<Image> images;
        for (std::size_t p = count_; p < position.size(); ++p) {
            images.push_back(images_[cells.order()[p] - count_]);
            images.back().source = place[images.back().source];
        }
        records_ = std::move(sorted);
        images_ = std::move(images);
        show_images();
        const std::vector<std::uint8_t> asleep(count_, 0);
        const std::vector<float> skin(records_.size(), 0);
        build_neighbours(cells, {records_, skin, support + margin, asleep, {}, {}}, runs_);
    }

    /// pair(a, b) for every particle a and every neighbour b of it.
    template <class Pair>
    void for_pairs(Pair&& pair) const
    {
        for (const NeighbourRun& run : runs_) {
            const std::uint16_t *inside = run.inside.data(), *outside = run.outside.data();
            for (Index i = 0; i < run.length(); ++i) {
                const Index a = run.begin + i;
                for (int k = 0; k < run.batches[i].inside * lane_count; ++k) {
                    const Index b = run.begin + *inside++;
                    if (a == b) continue;
                    pair(a, b);
                    pair(b, a);
                }
                for (int k = 0; k < run.batches[i].outside * lane_count; ++k) {
                    const Index b = run.halo[*outside++];
                    if (a != b) pair(a, b);
                }
            }
        }
    }

    /// Moves every particle, inside the box, and fits volumes and images to where they stand.
    void move(const std::vector<Vec3>& by)
    {
        const Vec3 edges = fill_.box.high - fill_.box.low;
        for (std::size_t i = 0; i < count_; ++i) {
            Vec3& p = records_[i].position;
            p += by[i];
            for (Axes axis : axes) {
                const double inset = 1e-6 * edges.*axis;
                p.*axis = std::clamp(p.*axis, fill_.box.low.*axis + inset, fill_.box.high.*axis - inset);
            }
        }
        set_volumes();
        show_images();
    }

private:
    /// A copy of a particle, mirrored at the lower (-1) or upper (1) face along each axis, or not (0).
    struct Image {
        Index source;
        std::array<int, 3> face;
    };

    const GradedFill& fill_;
    std::size_t count_ = 0;
    std::vector<MotionRecord> records_;
    std::vector<Image> images_;
    std::vector<NeighbourRun> runs_;

    void set_volumes()
    {
        double sum = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double spacing = fill_.spacing_at(records_[i].position);
            records_[i].weight = spacing * spacing * spacing;
            sum += records_[i].weight;
        }
        const double scale = volume_of(fill_.box) / sum;
        for (std::size_t i = 0; i < count_; ++i) {
            records_[i].weight *= scale;
            records_[i].smoothing = smoothing_ratio * std::cbrt(records_[i].weight);
        }
    }

    void find_images(double reach)
    {
        images_.clear();
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t known = images_.size(); // edges and corners: images of images
            const auto add = [&](Index source, std::array<int, 3> face) {
                const double x = records_[source].position.*axes[axis];
                for (int side : {-1, 1}) {
                    const double at = side < 0 ? fill_.box.low.*axes[axis] : fill_.box.high.*axes[axis];
                    if (std::abs(x - at) >= reach) continue;
                    face[axis] = side;
                    images_.push_back({source, face});
                }
            };
            for (std::size_t i = 0; i < count_; ++i) add(static_cast<Index>(i), {});
            for (std::size_t k = 0; k < known; ++k) add(images_[k].source, images_[k].face);
        }
    }

    Vec3 shown(const Image& image, Vec3 position) const
    {
        for (int axis = 0; axis < 3; ++axis) {
            if (image.face[axis] == 0) continue;
            const double at = image.face[axis] < 0 ? fill_.box.low.*axes[axis] : fill_.box.high.*axes[axis];
            position.*axes[axis] = 2 * at - position.*axes[axis];
        }
        return position;
    }

    void show_images()
    {
        records_.resize(count_);
        records_.reserve(count_ + images_.size());
        for (const Image& image : images_) {
            MotionRecord record = records_[image.source];
            record.position = shown(image, record.position);
            records_.push_back(record);
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
