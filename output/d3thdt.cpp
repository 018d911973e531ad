#include "output/d3thdt.h"

#include "output/chosen_rows.h"
#include "output/nodal_motion.h"

#include <algorithm>

namespace plash {

namespace {

/// Those of `order` that are among `wanted`.
std::vector<Index> in_order(const std::vector<Index>& order, const std::vector<Index>& wanted)
{
    std::vector<bool> is_wanted(order.size());
    for (Index index : wanted) is_wanted[index] = true;
    std::vector<Index> chosen;
    for (Index index : order)
        if (is_wanted[index]) chosen.push_back(index);
    return chosen;
}

/// First and last place (from 1) of each run of neighbours in `order` that are chosen.
std::vector<std::uint32_t> blocks(const std::vector<Index>& order, const std::vector<Index>& chosen)
{
    std::vector<std::uint32_t> ends;
    auto next = chosen.begin();
    for (std::size_t place = 0; place < order.size() && next != chosen.end(); ++place) {
        if (order[place] != *next) continue;
        ++next;
        const auto number = static_cast<std::uint32_t>(place + 1);
        if (ends.empty() || ends.back() + 1 != number)
            ends.insert(ends.end(), {number, number});
        else
            ends.back() = number;
    }
    return ends;
}

} // namespace

ChosenHistories::ChosenHistories(const Model& model, const D3plotLayout& layout)
    : nodes(in_order(layout.nodes, model.controls.output.history_nodes)),
      solids(in_order(layout.solids, model.controls.output.history_solids)),
      beams(in_order(layout.beams, model.controls.output.history_beams)),
      shells(in_order(layout.shells, model.controls.output.history_shells)),
      thick_shells(in_order(layout.thick_shells, model.controls.output.history_thick_shells))
{}

std::size_t ChosenHistories::state_words(const D3plotLayout& layout) const
{
    const auto block = [](std::size_t count, std::size_t words) { return count > 0 ? 1 + count * words : 0; };
    return layout.global_words() + block(nodes.size(), 9) + block(solids.size(), 7 * 8) +
           block(thick_shells.size(), 7 * 8) + block(shells.size(), 7 * 4) +
           block(solids.size(), layout.solid_words()) +
           block(thick_shells.size(), layout.thick_shell_words()) + block(beams.size(), layout.beam_words()) +
           block(shells.size(), layout.shell_words());
}

std::vector<std::uint32_t> d3thdt_geometry(const Model& model, const D3plotLayout& layout,
                                           const ChosenHistories& chosen)
{
    const std::vector<std::uint32_t> node_blocks = blocks(layout.nodes, chosen.nodes);
    const std::vector<std::uint32_t> element_blocks[] = {
        blocks(layout.solids, chosen.solids),
        blocks(layout.beams, chosen.beams),
        blocks(layout.shells, chosen.shells),
        blocks(layout.thick_shells, chosen.thick_shells),
    };
    const auto count = [](const std::vector<std::uint32_t>& ends) {
        return static_cast<std::uint32_t>(ends.size() / 2);
    };
    std::vector<std::uint32_t> words = d3plot_control(model, layout);
    words[11] = 3; // file type
    words[25] = count(node_blocks);
    words[26] = 0;
    for (const auto& ends : element_blocks) words[26] += count(ends);
    words[36] = static_cast<std::uint32_t>(layout.layers); // MAXINT
    words[37] = words[38] = 0;                             // particles
    std::fill(words.begin() + 47, words.begin() + 59, 0);
    words[59] = 1000 + count(node_blocks);
    for (int kind = 0; kind < 4; ++kind) words[60 + kind] = count(element_blocks[kind]);
    words.insert(words.end(), node_blocks.begin(), node_blocks.end());
    for (const auto& ends : element_blocks) words.insert(words.end(), ends.begin(), ends.end());
    put_mesh(words, model, layout);
    return words;
}

D3thdtRecorder::D3thdtRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)),
      layout_(model),
      chosen_(model, layout_),
      node_place_(layout_.node_places()),
      family_(path, D3plotFamily::usual_words_per_file, false),
      values_(layout_, family_)
{
    family_.write_geometry(d3thdt_geometry(model, layout_, chosen_));
    ElementResults& results = values_.results();
    results.solid_rows = rows_of(chosen_.solids, model.solids.size());
    results.thick_shell_rows = rows_of(chosen_.thick_shells, model.thick_shells.size());
    results.beam_rows = rows_of(chosen_.beams, model.beams.size());
    results.shell_rows = rows_of(chosen_.shells, model.shells.size());
}

/// Numbers of the nodes of each element, their coordinates and their velocities.
template <int Corners>
void D3thdtRecorder::put_nodes(const NodalMotion& motion, double time, const Elements<Corners>& elements,
                               const std::vector<Index>& chosen)
{
    if (chosen.empty()) return;
    family_.put(time);
    for (Index element : chosen) {
        const auto& nodes = elements.nodes[element];
        for (Index node : nodes) family_.put_integer(node_place_[node]);
        for (Index node : nodes) values_.put(motion.position(node));
        for (Index node : nodes) values_.put(motion.velocity(node));
    }
}

void D3thdtRecorder::put_values(double time, const std::vector<Index>& chosen,
                                void (D3plotValues::*put)(Index))
{
    if (chosen.empty()) return;
    family_.put(time);
    for (std::size_t row = 0; row < chosen.size(); ++row) (values_.*put)(static_cast<Index>(row));
}

/// The manual prints the time before the data of nodes, before the nodal data of solids, thick shells and
/// shells, and before beams; before the stresses of the others it leaves it open. Here all have it.
void D3thdtRecorder::write_state(const Snapshot& snapshot)
{
    const Model& model = snapshot.model;
    const double time = snapshot.clock.time;
    const NodalMotion motion(snapshot, false);
    values_.collect(snapshot, {chosen_.solids.size(), chosen_.thick_shells.size(), chosen_.beams.size(),
                               chosen_.shells.size(), 0});
    family_.begin_state(time, chosen_.state_words(layout_));
    values_.put_globals(snapshot, motion);
    if (!chosen_.nodes.empty()) family_.put(time);
    for (Index node : chosen_.nodes) {
        values_.put(motion.position(node));
        values_.put(motion.velocity(node));
        values_.put(motion.acceleration(node));
    }
    put_nodes(motion, time, model.solids, chosen_.solids);
    put_nodes(motion, time, model.thick_shells, chosen_.thick_shells);
    put_nodes(motion, time, model.shells, chosen_.shells);
    put_values(time, chosen_.solids, &D3plotValues::put_solid);
    put_values(time, chosen_.thick_shells, &D3plotValues::put_thick_shell);
    put_values(time, chosen_.beams, &D3plotValues::put_beam);
    put_values(time, chosen_.shells, &D3plotValues::put_shell);
    family_.end_state();
}

} // namespace plash
