#pragma once

#include "output/d3plot_family.h"
#include "output/d3plot_layout.h"
#include "output/schedule.h"

namespace plash {

/// *DATABASE_BINARY_D3PLOT: the binary state database that LS-PrePost, ParaView (vtkLSDynaReader) and others
/// read. Single precision. The state at the end of the run is always written.
class D3plotRecorder final : public ScheduledRecorder {
public:
    /// Largest file before the next one begins: 256 MiB in words.
    static constexpr std::size_t default_words_per_file = std::size_t{64} << 20;

    D3plotRecorder(const Model&, Schedule, const ResultPath& path,
                   std::size_t words_per_file = default_words_per_file);

    void write_on_request(const Snapshot& snapshot) override { write(snapshot); }
    void finish(const Snapshot& snapshot) override { write(snapshot); }

private:
    D3plotLayout layout_;
    D3plotFamily family_;
    ElementResults results_; ///< kept between states for its memory

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(family_); }
    void put_globals(const Snapshot&, const Vec3& velocity);
    void put_solids();
    void put_point(std::size_t place, const std::vector<SymmetricTensor<double>>& stress,
                   const std::vector<double>& strain, const std::vector<double>& history);
    void put_thick_shells();
    void put_beams();
    void put_shells();
    void put_particles(const Model&);
};

} // namespace plash
