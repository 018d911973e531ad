#pragma once

#include "elements/result_layers.h"
#include "elements/solid_group.h"
#include "elements/thick_shell_step.h"

#include <algorithm>
#include <variant>

namespace plash {

/// Group of thick shells of one part (*ELEMENT_TSHELL).
template <ThickShellStress kind, class Law>
class ThickShellGroup final : public SolidGroup {
public:
    /// start_law(element, history of the points of a lane)  what the law has of its own in each element, or
    /// nothing
    template <class StartLaw>
    ThickShellGroup(Law law, ThickShellSettings settings, SolidSetup setup, State& state,
                    StartLaw&& start_law)
        : SolidGroup(std::move(setup), state, thick_history_size<Law>(settings), point_constants, 0),
          law_(std::move(law)),
          settings_(std::move(settings))
    {
        start(state, start_law);
    }

    void add_forces(const Clock& clock, State& state) override
    {
        each_batch(clock, state, [&](const Patches::Patch&, Index batch, NodeCopies& nodes, PatchSum& sum) {
            add_batch_forces(batch, clock.last_step, nodes, sum);
        });
    }

private:
    Law law_;
    ThickShellSettings settings_;

    int history_size() const { return thick_history_size<Law>(settings_); }

    void add_batch_forces(Index batch, double time_step, NodeCopies& nodes, PatchSum& sum)
    {
        const SolidModes<Lanes> position = modes_at(batch, nodes.position);
        const SolidModes<Lanes> velocity = modes_at(batch, nodes.velocity);
        SolidResult<Lanes> result =
            thick_shell_step<kind>(law_, settings_, setup_.parameters, position, velocity, time_step,
                                   history_of(batch), constants_of(batch));
        take(batch, position, nodes, result, sum);
        add_modes(batch, result.force, nodes);
    }

    template <class StartLaw>
    void start(State& state, StartLaw& start_law)
    {
        std::vector<Lanes, CacheAligned<Lanes>> trial(history_size());
        const int points = settings_.columns * settings_.rule.size();
        std::vector<double> first_step = first_steps([&](const Patches::Patch& patch, Index batch) {
            const SolidModes<Lanes> position = start_position(patch, batch, state);
            start_batch(batch, gradient_of<SolidGradientRule::mean>(position).volume, position, state);
            Lanes* history = history_of(batch);
            const auto initial = law_.initial_history();
            for (int point = 0; point < points; ++point) {
                Lanes* values = history + first_thick_point + point * thick_point_size<Law>;
                for (std::size_t i = 0; i < initial.size(); ++i) values[6 + i] = broadcast<Lanes>(initial[i]);
            }
            for (int lane = 0; lane < lane_count; ++lane) {
                const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
                const auto element = static_cast<Index>(element_of(place));
                const auto values = [&](int point) {
                    return history + first_thick_point + point * thick_point_size<Law>;
                };
                start_law(element, lane, points, values);
                put_initial_stress(element, lane, position, values);
                put_initial_strain(element, lane, position, history + history_size() - 12);
            }
            std::copy_n(history, trial.size(), trial.begin());
            const auto result =
                thick_shell_step<kind>(law_, settings_, setup_.parameters, position, SolidModes<Lanes>{}, 0.0,
                                       trial.data(), constants_of(batch));
            return result.vote.stable_step;
        });
        finish_start(std::move(first_step), state);
    }

    static Tensor3<double> axes_of(const SolidModes<double>& position)
    {
        return thick_shell_frame(position).axes;
    }

    /// The axes of an element at the start.
    static Tensor3<double> axes_of(const SolidModes<Lanes>& position, int lane)
    {
        const auto of_lane = [&](const Vector3<Lanes>& v) { return Vec3{v.x[lane], v.y[lane], v.z[lane]}; };
        SolidModes<double> one;
        for (int i = 0; i < 3; ++i) one.linear[i] = of_lane(position.linear[i]);
        for (int i = 0; i < 4; ++i) one.hourglass[i] = of_lane(position.hourglass[i]);
        return axes_of(one);
    }

    /// *INITIAL_STRAIN_TSHELL, for result files.
    /// strains  of the innermost and the outermost points, where the group keeps them
    void put_initial_strain(Index element, int lane, const SolidModes<Lanes>& position, Lanes* strains)
    {
        if (!settings_.strains || !setup_.initial_strains) return;
        const auto found = setup_.initial_strains->find(element);
        if (found == setup_.initial_strains->end()) return;
        for (const int side : {0, 1}) {
            const double place = side == 0 ? settings_.rule.place.front() : settings_.rule.place.back();
            put_stress(rotated(through_thickness(found->second, place, 0).stress, axes_of(position, lane)),
                       strains + 6 * side, lane);
        }
    }

    /// *INITIAL_STRESS_TSHELL.
    template <class Values>
    void put_initial_stress(Index element, int lane, const SolidModes<Lanes>& position, Values&& values)
    {
        if (!setup_.initial_stresses) return;
        const auto found = setup_.initial_stresses->find(element);
        if (found == setup_.initial_stresses->end()) return;
        const Tensor3<double> axes = axes_of(position, lane);
        for (int point = 0; point < settings_.columns * settings_.rule.size(); ++point) {
            const int column = point / settings_.rule.size(), layer = point % settings_.rule.size();
            const InitialStressPoint start =
                through_thickness(found->second, settings_.rule.place[layer], column);
            put_stress(rotated(start.stress, axes), values(point), lane);
            if constexpr (requires { Law::plastic_strain; })
                values(point)[6 + Law::plastic_strain][lane] = start.plastic_strain;
        }
    }

    void collect_points(const Patches::Patch& patch, std::size_t place, const State& state,
                        ElementResults& results) const override
    {
        const Index row = results.row_of_thick_shell(static_cast<Index>(element_of(place)));
        if (row == none) return;
        if (!results.thick_shell_deleted.empty()) results.thick_shell_deleted[row] = !is_alive(place);
        if (!results.thick_shell_history.empty()) collect_history(place, row, results);
        if (results.thick_shell_stress.empty() && results.thick_shell_plastic_strain.empty() &&
            results.thick_shell_strain.empty())
            return;
        Vec3 corners[8];
        for (int i = 0; i < 8; ++i) corners[i] = state.position[corner(patch, place, i)];
        const Tensor3<double> r = axes_of(modes_of(corners));
        const Tensor3<double> back{r.xx, r.yx, r.zx, r.xy, r.yy, r.zy, r.xz, r.yz, r.zz};
        const Lanes* history = history_of(static_cast<Index>(place / lane_count));
        const int lane = static_cast<int>(place % lane_count), layers = settings_.rule.size();
        if (!results.thick_shell_strain.empty() && settings_.strains) {
            for (const int side : {0, 1}) {
                const Lanes* s = history + history_size() - 12 + 6 * side;
                const SymmetricTensor<double> strain{s[0][lane], s[1][lane], s[2][lane],
                                                     s[3][lane], s[4][lane], s[5][lane]};
                results.thick_shell_strain[row][side] = rotated(strain, back);
            }
        }
        for (int layer = 0; layer < results.thick_shell_layers; ++layer) {
            const auto [first, last] = points_of_layer(layer, results.thick_shell_layers, layers);
            const double share = 1.0 / (settings_.columns * (last - first + 1));
            SymmetricTensor<double> stress;
            double plastic_strain = 0;
            for (int column = 0; column < settings_.columns; ++column) {
                for (int point = first; point <= last; ++point) {
                    const Lanes* v =
                        history + first_thick_point + (column * layers + point) * thick_point_size<Law>;
                    stress = stress + share * SymmetricTensor<double>{v[0][lane], v[1][lane], v[2][lane],
                                                                      v[3][lane], v[4][lane], v[5][lane]};
                    if constexpr (requires { Law::plastic_strain; })
                        plastic_strain += share * v[6 + Law::plastic_strain][lane];
                }
            }
            const std::size_t entry = static_cast<std::size_t>(row) * results.thick_shell_layers + layer;
            if (!results.thick_shell_stress.empty())
                results.thick_shell_stress[entry] = rotated(stress, back);
            if (!results.thick_shell_plastic_strain.empty())
                results.thick_shell_plastic_strain[entry] = plastic_strain;
        }
    }

    /// Variables of the law that result files show of a point; plies have laws of their own.
    std::vector<ShownVariable> shown_of(int point) const
    {
        if constexpr (requires { Law::ply_place; }) {
            std::vector<ShownVariable> shown = std::visit(
                [](const auto& law) { return shown_variables(law, kind == ThickShellStress::plane); },
                law_.plies[point]);
            for (ShownVariable& one : shown)
                if (one.variable >= 0) one.variable += Law::own;
            return shown;
        } else {
            return shown_variables(law_, kind == ThickShellStress::plane);
        }
    }

    void collect_history(std::size_t place, Index row, ElementResults& results) const
    {
        const Lanes* history = history_of(static_cast<Index>(place / lane_count));
        const int lane = static_cast<int>(place % lane_count), layers = settings_.rule.size();
        const int wanted = results.shell_history_size;
        for (int layer = 0; layer < results.thick_shell_layers; ++layer) {
            const auto [first, last] = points_of_layer(layer, results.thick_shell_layers, layers);
            double* values =
                &results.thick_shell_history[(static_cast<std::size_t>(row) * results.thick_shell_layers +
                                              layer) *
                                             wanted];
            for (int point = first; point <= last; ++point) {
                const std::vector<ShownVariable> shown = shown_of(point);
                const double share = 1.0 / (settings_.columns * (last - first + 1));
                for (int i = 0; i < std::min<int>(wanted, static_cast<int>(shown.size())); ++i) {
                    if (shown[i].variable < 0) continue;
                    for (int column = 0; column < settings_.columns; ++column) {
                        const Lanes* own = history + first_thick_point +
                                           (column * layers + point) * thick_point_size<Law> + 6;
                        values[i] += share * (own[shown[i].variable][lane] - shown[i].start);
                    }
                }
            }
        }
    }
};

} // namespace plash
