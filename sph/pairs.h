#pragma once

#include "math/lane_pair.h"
#include "math/vector3.h"
#include "sph/kernels.h"
#include "sph/motion_record.h"
#include "sph/neighbours.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace plash {

/// Which copy of a particle stands at a place. A corner of a mirror and a periodic plane counts as mirrored.
enum ImageKind : std::uint8_t { mirror_image, periodic_image };

/// What the force loop needs besides: half a cache line. "Scaled" is by 1 / density^2 where weights are
/// masses, and by 1 where they are volumes.
struct alignas(32) PushRecord {
    double push = 0;      ///< scaled pressure
    double scale = 0;     ///< 1 / density where weights are masses, density where they are volumes
    double sound = 0;     ///< speed of sound [velocity]
    double viscosity = 0; ///< scaled laminar viscosity: (dimension + 2) * dynamic viscosity * scaling
};
static_assert(sizeof(PushRecord) == 32);

/// Push as a tensor, where stresses have shear or gradients are corrected: one cache line. The scaled
/// negative of stress times correction.
struct alignas(64) TensionRecord {
    double component[8] = {}; ///< xx xy xz yx yy yz zx zy; zz is the push of the PushRecord
};

/// One particle, or a batch of neighbours, in lanes.
template <class Lane>
struct Moving {
    Vector3<Lane> position, velocity;
    Lane smoothing, weight;

    template <class Place>
    static Moving load(const MotionRecord* records, const Place* place)
    {
        Lane value[8];
        load_lines(&records->position.x, place, value);
        return {{value[0], value[1], value[2]}, {value[4], value[5], value[6]}, value[3], value[7]};
    }
    static Moving same(const MotionRecord& a)
    {
        const auto lanes = [](double value) { return broadcast<Lane>(value); };
        return {{lanes(a.position.x), lanes(a.position.y), lanes(a.position.z)},
                {lanes(a.velocity.x), lanes(a.velocity.y), lanes(a.velocity.z)},
                lanes(a.smoothing),
                lanes(a.weight)};
    }
    /// One particle, for neighbours that come in two batches.
    template <class Wide>
    Moving<Wide> in() const
    {
        const auto wide = [](Lane value) { return widened<Wide>(value); };
        return {{wide(position.x), wide(position.y), wide(position.z)},
                {wide(velocity.x), wide(velocity.y), wide(velocity.z)},
                wide(smoothing),
                wide(weight)};
    }
};

/// Kernel of a run, with what its gradient needs: for a pair at distance r with mean smoothing length h,
/// grad W = -steepness(r, h) * (x_i - x_j).
template <class Kernel>
struct Steepness {
    double plane, space; ///< the norm of the kernel in the plane (W ~ h^-2) or in space (W ~ h^-3); else 0

    explicit Steepness(int dimension)
        : plane(dimension == 2 ? -Kernel::norm(2) : 0), space(dimension == 2 ? 0 : -Kernel::norm(dimension))
    {}

    /// square  r^2 [length^2], not zero; inverse_distance 1 / r; inverse_smoothing 1 / h
    template <class Lane>
    Lane operator()(Lane square, Lane inverse_distance, Lane inverse_smoothing) const
    {
        const Lane q = square * (inverse_distance * inverse_smoothing);
        const Lane area = inverse_smoothing * inverse_smoothing;
        const Lane norm = plane + space * inverse_smoothing;
        if constexpr (requires { Kernel::slope_by_q(q); }) {
            return Kernel::slope_by_q(q) * ((area * area) * norm);
        } else {
            return (Kernel::slope(q) * inverse_distance) * ((area * inverse_smoothing) * norm);
        }
    }
};

/// Added to squared distances [length^2], so that a particle's own image in a padded batch gives 0 and not
/// 0/0.
inline constexpr double tiny_square = 1e-200;

/// How many particles ahead of the opened one pair loops ask for what they read: neighbours jump about too
/// much for the processor to foresee, and what comes from beyond the second cache costs a third of a loop.
inline constexpr Index look_ahead = 1024;

/// Asks for the records of a run and of its surroundings, `look_ahead` particles before they are opened;
/// surroundings are numbered in the order in which lists name them.
template <class Pass>
class LookAhead {
public:
    LookAhead(const NeighbourRun& run, const Pass& pass)
        : run_(run),
          pass_(pass),
          own_(run.begin),
          halo_per_particle_(static_cast<double>(run.halo.size()) / run.length())
    {}

    void open(Index particle)
    {
        if constexpr (requires { pass_.expect(own_); }) {
            const Index end = std::min(run_.end, run_.begin + particle + look_ahead);
            for (; own_ < end; ++own_) pass_.expect(own_);
            const auto ahead = static_cast<std::size_t>(halo_per_particle_ * (particle + look_ahead));
            for (const auto end_here = std::min(ahead, run_.halo.size()); halo_ < end_here; ++halo_) {
                pass_.expect(run_.halo[halo_]);
            }
        }
    }

private:
    const NeighbourRun& run_;
    const Pass& pass_;
    Index own_;
    std::size_t halo_ = 0;
    double halo_per_particle_;
};

/// Walks all pairs of a run in batches of one lane value. `Pass` has
///   void open(Index particle)                      particle is counted from the run's begin
///   void inside(const std::uint16_t* places)       neighbours, counted from the run's begin: both sides add
///   void outside(const Index* places)              neighbours by sorted place: only the opened particle adds
///   void close(Index particle)
/// and may have
///   void expect(Index place) const                 asks for the records of a sorted place
/// A pass that says `takes_two` has `inside` as a template over Lane and LanePair, and is given two batches
/// of Lanes at once.
template <class Lane, class Pass>
void walk_pairs(const NeighbourRun& run, Pass& pass)
{
    constexpr int width = lanes_in<Lane>;
    constexpr bool two = std::is_same_v<Lane, Lanes> && requires
    {
        requires Pass::takes_two;
    };
    const std::uint16_t* inside = run.inside.data();
    const std::uint16_t* outside = run.outside.data();
    const Index* halo = run.halo.data();
    LookAhead<Pass> ahead(run, pass);
    for (Index particle = 0; particle < run.length(); ++particle) {
        const NeighbourRun::Counts counts = run.counts[particle];
        ahead.open(particle);
        pass.open(particle);
        const auto* end = inside + counts.inside;
        if constexpr (two) {
            for (; inside < end; inside += pair_count) pass.template inside<LanePair>(inside);
        } else {
            for (; inside < end; inside += width) pass.inside(inside);
        }
        for (int left = counts.outside; left > 0; left -= width) {
            Index places[width];
            for (int l = 0; l < width; ++l) places[l] = halo[outside[l]];
            for (int l = 0; l < width; ++l) places[l] = l < left ? places[l] : run.begin + particle;
            pass.outside(places);
            outside += std::min(left, width);
        }
        pass.close(particle);
    }
}

} // namespace plash
