#pragma once

#include "materials/history.h"
#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <array>

namespace plash::testing {

/// One solid point of a law, driven by strain increments.
template <class Law>
struct DrivenPoint {
    const Law& law;
    SymmetricTensor<double> stress{};
    std::array<double, Law::history_size + 1> history{};

    explicit DrivenPoint(const Law& l) : law(l)
    {
        const auto start = law.initial_history();
        for (std::size_t i = 0; i < start.size(); ++i) history[i] = start[i];
    }

    /// A total strain in equal steps, over `duration`.
    void strain(const SymmetricTensor<double>& total, int steps = 1, double duration = 1)
    {
        for (int i = 0; i < steps; ++i) {
            law.update(stress, (1.0 / steps) * total, HistoryView<double>{history.data()}, duration / steps);
        }
    }
};

} // namespace plash::testing
