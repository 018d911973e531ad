#pragma once

#include "conditions/segment_forces.h"
#include "core/state.h"
#include "model/model.h"

#include <span>

namespace plash {

/// The shell or solid under each segment of a loaded surface: once it has been deleted nothing acts there.
class LoadedElements {
public:
    LoadedElements() = default;
    LoadedElements(const Model& model, std::span<const SegmentNodes> segments);

    bool deleted(std::size_t segment, const State& state) const
    {
        if (state.deletions == 0) return false;
        const Index shell = shell_[segment], solid = solid_[segment];
        if (shell != none) return !state.deleted_shells.empty() && state.deleted_shells[shell];
        if (solid != none) return !state.deleted_solids.empty() && state.deleted_solids[solid];
        return false;
    }

private:
    std::vector<Index> shell_, solid_; ///< by segment; none: another element, or none at all
};

} // namespace plash
