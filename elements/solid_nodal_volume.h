#pragma once

#include "elements/solid_group.h"

#include <algorithm>

namespace plash {

/// Group of tetrahedra with volumes averaged over nodes (ELFORM 13) of one part, for nearly incompressible
/// flow.
///
/// The volume of a node is the sum of those of its elements; the ratio of volumes that the law of an element
/// sees is the mean of those of its four nodes (Bonet & Burton 1998, Commun. Numer. Methods Engng 14,
/// 437-449, eqs. 11-14: there the nodes have pressures; for a constant bulk modulus the mean of their
/// pressures is the pressure of the mean volume, and the element's force is the same). Shape strains are the
/// element's own. Averages go over the elements of the part alone. The energy that an element shows is the
/// work on its own volume.
template <class Point>
class SolidNodalVolume final : public SolidGroup {
public:
    SolidNodalVolume(Point point, SolidSetup setup, State& state)
        : SolidGroup(std::move(setup), state, history_size, point_constants + Point::constant_size,
                     Point::plastic_strain),
          point_(std::move(point))
    {
        number_nodes();
        start(state);
    }

    void add_forces(const Clock& clock, State& state) override
    {
        average_volumes(state);
        each_batch(clock, state,
                   [&](const Patches::Patch& patch, Index batch, NodeCopies& nodes, PatchSum& sum) {
                       add_batch_forces(patch, batch, clock.last_step, nodes, sum);
                   });
    }

private:
    static constexpr auto rule = SolidGradientRule::mean;
    static constexpr int history_size = point_history + Point::history_size;
    /// Averaged relative volume of the last step; tetrahedra have no hourglass modes.
    static constexpr int ratio_history = hourglass_history;
    /// The four nodes of a tetrahedron among the corners a b c c d d d d.
    static constexpr int own_corners[] = {0, 1, 2, 4};

    Point point_;
    std::vector<Index> own_node_;     ///< by entry of the patches: number among the group's nodes
    std::vector<std::size_t> begin_;  ///< by node: its places in places_
    std::vector<std::size_t> places_; ///< elements around the nodes
    std::vector<double> volume_;      ///< by place, now [volume]
    std::vector<double> ratio_;       ///< by node: volume over reference volume

    std::size_t entry_of(const Patches::Patch& patch, std::size_t place, int corner) const
    {
        const std::uint16_t* offset = patches_.corner_offsets(static_cast<Index>(place / lane_count), corner);
        return patch.first_node + offset[place % lane_count] / 4;
    }

    void number_nodes()
    {
        std::vector<Index> own = patches_.nodes;
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        for (Index node : patches_.nodes)
            own_node_.push_back(
                static_cast<Index>(std::lower_bound(own.begin(), own.end(), node) - own.begin()));
        std::vector<std::vector<std::size_t>> around(own.size());
        for_each_element([&](const Patches::Patch& patch, std::size_t place) {
            for (int corner : own_corners) around[own_node_[entry_of(patch, place, corner)]].push_back(place);
        });
        begin_.push_back(0);
        for (const auto& places : around) {
            places_.insert(places_.end(), places.begin(), places.end());
            begin_.push_back(places_.size());
        }
        volume_.resize(patches_.elements.size());
        ratio_.assign(own.size(), 1.0);
    }

    /// Six times the volume is the triple product of three edges.
    void average_volumes(const State& state)
    {
        const auto patches = static_cast<std::ptrdiff_t>(patches_.patches.size());
        const auto nodes = static_cast<std::ptrdiff_t>(ratio_.size());
#pragma omp parallel if (patches > 1)
        {
#pragma omp for schedule(static)
            for (std::ptrdiff_t number = 0; number < patches; ++number) {
                const Patches::Patch& patch = patches_.patches[number];
                const auto last = std::min<std::size_t>(
                    static_cast<std::size_t>(patch.first_batch + patch.batch_count) * lane_count,
                    patches_.element_count);
                for (std::size_t place = static_cast<std::size_t>(patch.first_batch) * lane_count;
                     place < last; ++place) {
                    Vec3 x[4];
                    for (int i = 0; i < 4; ++i)
                        x[i] = state.position[patches_.nodes[entry_of(patch, place, own_corners[i])]];
                    volume_[place] = dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])) / 6;
                }
            }
#pragma omp for schedule(static)
            for (std::ptrdiff_t node = 0; node < nodes; ++node) {
                double now = 0, reference = 0;
                for (std::size_t i = begin_[node]; i < begin_[node + 1]; ++i) {
                    if (!is_alive(places_[i])) continue;
                    now += volume_[places_[i]];
                    reference += 1 / constant_of(places_[i], inverse_volume_constant);
                }
                if (reference > 0) ratio_[node] = now / reference;
            }
        }
    }

    void add_batch_forces(const Patches::Patch& patch, Index batch, double time_step, NodeCopies& nodes,
                          PatchSum& sum)
    {
        const SolidModes<Lanes> position = modes_at(batch, nodes.position);
        const SolidModes<Lanes> velocity = modes_at(batch, nodes.velocity);
        Lanes* history = history_of(batch);
        AveragedVolume<Lanes> averaged{{}, history[ratio_history]};
        for (int lane = 0; lane < lane_count; ++lane) {
            const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
            double ratio = 0;
            for (int corner : own_corners) ratio += 0.25 * ratio_[own_node_[entry_of(patch, place, corner)]];
            averaged.now[lane] = ratio;
        }
        SolidResult<Lanes> result = solid_step<rule>(point_, setup_.parameters, position, velocity, time_step,
                                                     history, constants_of(batch), averaged);
        history[ratio_history] = averaged.now;
        take(batch, position, nodes, result, sum);
        add_modes(batch, result.force, nodes);
    }

    /// As for one-point solids; all volumes are those of the start.
    void start(State& state)
    {
        std::vector<double> first_step = first_steps([&](const Patches::Patch& patch, Index batch) {
            const SolidModes<Lanes> position = start_position(patch, batch, state);
            start_batch(batch, gradient_of<rule>(position).volume, position, state);
            Lanes* history = history_of(batch);
            point_.start(position, history, constants_of(batch));
            history[ratio_history] = broadcast<Lanes>(setup_.initial_relative_volume);
            std::array<Lanes, history_size> trial;
            std::copy_n(history, trial.size(), trial.begin());
            const auto result = solid_step<rule>(point_, setup_.parameters, position, SolidModes<Lanes>{},
                                                 0.0, trial.data(), constants_of(batch));
            return result.vote.stable_step;
        });
        take_initial_stresses(
            {stress_is_free<Point>, 1, 0, 0, Point::plastic_strain, shown_variables(point_, false)});
        finish_start(std::move(first_step), state);
    }
};

} // namespace plash
