#pragma once

#include "output/d3plot_values.h"
#include "output/schedule.h"

namespace plash {

/// Which nodes and elements a d3thdt database shows: those of *DATABASE_HISTORY, as indices into the Model in
/// the order of the database.
struct ChosenHistories {
    std::vector<Index> nodes, solids, beams, shells, thick_shells;

    ChosenHistories(const Model&, const D3plotLayout&);

    /// Words of a state after its time. Each kind of node or element data begins with the time again.
    std::size_t state_words(const D3plotLayout&) const;
};

/// Control words with the blocks of what is shown, and the whole mesh.
std::vector<std::uint32_t> d3thdt_geometry(const Model&, const D3plotLayout&, const ChosenHistories&);

/// *DATABASE_BINARY_D3THDT: states of single nodes and elements as often as wanted, in the layout of the time
/// history database of LSTC, 'LS-DYNA Database', 2023, pages 63-80. Single precision, split into files like
/// d3plot.
class D3thdtRecorder final : public ScheduledRecorder {
public:
    D3thdtRecorder(const Model&, Schedule, const ResultPath& path);

private:
    D3plotLayout layout_;
    ChosenHistories chosen_;
    std::vector<std::uint32_t> node_place_;
    D3plotFamily family_;
    D3plotValues values_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(family_); }
    template <int Corners>
    void put_nodes(const NodalMotion&, double time, const Elements<Corners>&,
                   const std::vector<Index>& elements);
    void put_values(double time, const std::vector<Index>& elements, void (D3plotValues::*put)(Index));
};

} // namespace plash
