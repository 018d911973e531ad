#pragma once

#include "math/symmetric_tensor.h"

#include <vector>

namespace plash {

/// The history variables of a batch of integration points: entry k holds variable k of every lane.
///
/// What an element asks of a law (a plain struct of parameters, see materials/elastic.h for the smallest):
///   history_size                          number of variables a point; they start as initial_history() says
///   density, young_modulus, poisson_ratio for masses, wave speeds and hourglass control
///   from_record(record, model)            reads and checks the parameters; throws DeckError
///   update(stress, increment, history, time_step)               one step of solid points
///   update_plane_stress(stress, increment, history, time_step)  one step of shell points: stress.zz stays
///                                         zero and increment.zz comes back as the thickness strain
///   update_beam(stress, axial, rs, tr, history, time_step)      one step of beam points: axial and two shear
///                                         stresses, the others zero; engineering shear strains. Only laws
///                                         that beams can have
/// and, only if it has any use for them:
///   plastic_strain                        which history variable is the effective plastic strain
///   rotate_history(history, rotation)     turns tensors in the history (back stress) with the material
///   failed(history)                       mask of the points that have failed for good
///   shown_history(of_shells)              what result files show of the history, see ShownVariable
/// Both updates are inline templates over the lane type; increments are tensor strains in axes that turn with
/// the material.
template <class Lane>
struct HistoryView {
    Lane* values;

    Lane& operator[](int variable) const { return values[variable]; }
};

/// What a result file shows as one history variable of a point (NEIPH, NEIPS of *DATABASE_EXTENT_BINARY).
struct ShownVariable {
    int variable = -1; ///< of the law; -1: LS-DYNA shows something there that Plash does not keep
    double start = 0;  ///< shown is what the variable has more than this
};

/// The history variables that result files show of a law, by LS-DYNA's numbers from 1 on: what the law says,
/// or else all its variables but the plastic strain, which has a place of its own. Laws that wrap another one
/// (as `law`) keep its variables first, in their places.
template <class Law>
std::vector<ShownVariable> shown_variables(const Law& law, bool of_shells)
{
    if constexpr (requires { law.shown_history(of_shells); }) {
        return law.shown_history(of_shells);
    } else if constexpr (requires { law.law; }) {
        return shown_variables(law.law, of_shells);
    } else {
        std::vector<ShownVariable> shown;
        if constexpr (requires { Law::history_size; }) {
            for (int variable = 0; variable < static_cast<int>(Law::history_size); ++variable) {
                if constexpr (requires { Law::plastic_strain; })
                    if (variable == static_cast<int>(Law::plastic_strain)) continue;
                shown.push_back({variable, 0});
            }
        }
        return shown;
    }
}

/// Stores a tensor in six variables, in the order of its components.
template <class Lane>
inline void put_tensor(Lane* variables, const SymmetricTensor<Lane>& tensor)
{
    variables[0] = tensor.xx;
    variables[1] = tensor.yy;
    variables[2] = tensor.zz;
    variables[3] = tensor.xy;
    variables[4] = tensor.yz;
    variables[5] = tensor.zx;
}

/// The tensor that put_tensor has stored.
template <class Lane>
inline SymmetricTensor<Lane> tensor_at(const Lane* variables)
{
    return {variables[0], variables[1], variables[2], variables[3], variables[4], variables[5]};
}

} // namespace plash
