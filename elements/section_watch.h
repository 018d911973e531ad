#pragma once

#include "core/results.h"
#include "core/state.h"
#include "elements/patches.h"
#include "model/model.h"

namespace plash {

/// Cross sections of the Model in the elements of one topology: tells the corners that they want, and sums up
/// what the elements exert there.
class SectionWatch {
public:
    /// elements  the section's list of this topology, e.g. &CrossSection::shells
    SectionWatch(const Model& model, const std::vector<Index> CrossSection::*elements,
                 std::size_t element_count, Patches& patches);

    /// Adds forces and moments about the sections' centroids to results.sections, if they are wanted.
    void collect(const Patches& patches, const State& state, ElementResults& results) const;

private:
    bool any_ = false;
};

inline SectionWatch::SectionWatch(const Model& model, const std::vector<Index> CrossSection::*elements,
                                  std::size_t element_count, Patches& patches)
{
    if (model.cross_sections.empty()) return;
    std::vector<std::uint64_t> of_element(element_count), of_node(model.nodes.size());
    for (std::size_t i = 0; i < model.cross_sections.size(); ++i) {
        const std::uint64_t bit = std::uint64_t{1} << i;
        for (Index element : model.cross_sections[i].*elements) of_element[element] |= bit;
        for (Index node : model.cross_sections[i].nodes) of_node[node] |= bit;
    }
    patches.watch(model.nodes.size(),
                  [&](Index element, Index node) { return of_element[element] & of_node[node]; });
    any_ = true;
}

inline void SectionWatch::collect(const Patches& patches, const State& state, ElementResults& results) const
{
    if (!any_ || results.sections.empty()) return;
    patches.for_each_watched([&](std::uint64_t bits, Index node, const Vec3& force, const Vec3& moment) {
        for (std::size_t i = 0; i < results.sections.size(); ++i) {
            if (!(bits >> i & 1)) continue;
            ElementResults::SectionForce& section = results.sections[i];
            section.force += force;
            section.moment += moment + cross(state.position[node] - section.centroid, force);
        }
    });
}

} // namespace plash
