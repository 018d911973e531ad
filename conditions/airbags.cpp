#include "conditions/airbags.h"

#include "core/parallel.h"
#include "core/run_error.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

Airbags::Airbags(const Model& model, const State& state) : model_(model)
{
    for (const Airbag& airbag : model.airbags) {
        Bag bag;
        bag.surface = BagSurface(airbag.segments, state.position);
        bag.elements = LoadedElements(model, bag.surface.segments());
        bag.sum = CornerSum(bag.surface.segments());
        measure(bag, state);
        const double volume = airbag.volume_scale * bag.surface.volume(state.position, bag.sum.force);
        if (!(volume > 0))
            throw RunError(fmt::format("{}: the surface of airbag {} encloses no volume ({:.4g}): a content "
                                       "would have no pressure",
                                       model.place(airbag.where), airbag.id, volume));
        bag.content = start_content(airbag, model, volume);
        items_ += airbag.segments.size();
        bags_.push_back(std::move(bag));
    }
}

/// Forces of unit pressure and the area of a surface as it stands.
void Airbags::measure(Bag& bag, const State& state) const
{
    const auto& segments = bag.surface.segments();
    bag.area = sum_chunks(segments.size(), [&](std::size_t begin, std::size_t end) {
        double area = 0;
        for (std::size_t i = begin; i < end; ++i) {
            bag.sum.force[i] = unit_pressure_forces(segments[i], state.position);
            area += segment_area(segments[i], state.position);
        }
        return area;
    });
}

double Airbags::leak_area(const Airbag& airbag, const Bag& bag, const State& state) const
{
    const auto* gas = std::get_if<VentedGas>(&airbag.content);
    if (!gas || gas->leak_share.empty()) return 0;
    const auto& segments = bag.surface.segments();
    return sum_chunks(segments.size(), [&](std::size_t begin, std::size_t end) {
        double area = 0;
        for (std::size_t i = begin; i < end; ++i)
            area += gas->leak_share[i] * segment_area(segments[i], state.position);
        return area;
    });
}

/// Turns unit forces into those of the content's pressure. Returns their work over the last step.
double Airbags::push(const Airbag& airbag, Bag& bag, const Clock& clock, State& state) const
{
    const double pressure = airbag.pressure_scale * bag.content.pressure;
    return bag.sum.act(bag.surface.segments(), clock, state, [&](std::size_t i) {
        std::array<Vec3, 4> force = bag.sum.force[i];
        for (Vec3& corner : force) corner *= bag.elements.deleted(i, state) ? 0 : pressure;
        return force;
    });
}

void Airbags::add_forces(const Clock& clock, State& state)
{
    vote_ = StepVote::nothing();
    for (std::size_t b = 0; b < bags_.size(); ++b) {
        const Airbag& airbag = model_.airbags[b];
        Bag& bag = bags_[b];
        measure(bag, state);
        const double volume = airbag.volume_scale * bag.surface.volume(state.position, bag.sum.force);
        if (!(volume > 0))
            throw RunError(fmt::format("the surface of airbag {} encloses no volume any more ({:.4g})",
                                       airbag.id, volume));
        advance_content(airbag, model_, clock, volume, leak_area(airbag, bag, state), bag.content);
        const double spring = airbag.pressure_scale * airbag.volume_scale * bag.content.stiffness / volume;
        const double frequency = std::sqrt(std::max(spring, 0.0) * bag.sum.square_over_mass(state.mass));
        if (frequency > 0 && 2 / frequency < vote_.step) vote_ = {2 / frequency, "airbag", airbag.id, 0};
        work_ += push(airbag, bag, clock, state);
    }
}

std::vector<std::string> Airbags::notices(const State&) const
{
    std::vector<std::string> lines;
    for (std::size_t b = 0; b < bags_.size(); ++b) {
        const Bag& bag = bags_[b];
        std::string line =
            fmt::format("airbag {}: {} segments, volume {:.6g}, area {:.6g}", model_.airbags[b].id,
                        bag.surface.segments().size(), bag.content.first_volume, bag.area);
        if (bag.surface.turned() > 0)
            line += fmt::format("; {} segments turned to face outwards", bag.surface.turned());
        if (bag.surface.hole_count() > 0)
            line += fmt::format("; {} holes, which count as closed by a fan that nothing pushes",
                                bag.surface.hole_count());
        if (bag.surface.crossings() > 0)
            line += fmt::format("; {} edges have more than two segments, whose sides are those of the deck",
                                bag.surface.crossings());
        lines.push_back(std::move(line));
    }
    return lines;
}

void Airbags::collect(const State&, ElementResults& results) const
{
    for (std::size_t b = 0; b < bags_.size(); ++b) {
        const BagState& content = bags_[b].content;
        results.airbags.push_back({model_.airbags[b].id, content.volume, content.pressure,
                                   content.internal_energy, content.inflow, content.outflow, content.mass,
                                   content.temperature, bags_[b].area});
    }
}

void Airbags::serialise(Archive& archive)
{
    for (Bag& bag : bags_) archive(bag.content, bag.sum);
    archive(work_);
}

} // namespace plash
