#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// Stress of one integration point in global axes, as elout shows it.
struct PointStress {
    SymmetricTensor<double> stress;
    double plastic_strain = 0;
};

/// One element of elout with its integration points (shells: from bottom to top).
struct ElementHistory {
    Id id = 0;
    Id part = 0;
    Id formulation = 0; ///< ELFORM; printed for shells only
    std::vector<PointStress> points;
    /// With STRFLG: of a solid one tensor, of shells those of the innermost and the outermost point.
    std::vector<SymmetricTensor<double>> strains{};
};

/// The stress tables of one state as LS-DYNA prints them; `cycle` counts from 1. A point is called plastic
/// when it has plastic strain. The yield function column of solids holds the plastic strain.
std::string format_elout_solids(long cycle, double time, std::span<const ElementHistory>);
std::string format_elout_shells(long cycle, double time, std::span<const ElementHistory>);
std::string format_elout_thick_shells(long cycle, double time, std::span<const ElementHistory>);

/// The elements of *DATABASE_HISTORY_SHELL, _SOLID and _TSHELL, each once and by the Model's order.
class ElementHistories {
public:
    explicit ElementHistories(const Model&);

    /// Those that are not eroded.
    struct Lists {
        std::vector<ElementHistory> solids, shells, thick_shells;
    };
    Lists collect(const Snapshot&) const;

private:
    std::vector<Index> shells_, solids_;         ///< wanted elements, by the Model's order
    std::vector<Index> shell_rows_, solid_rows_; ///< row of each element of the Model among those
    std::vector<int> shell_points_;              ///< integration points of each of `shells_`
    int shell_layers_ = 0;
    std::vector<Index> thick_shells_, thick_shell_rows_; ///< likewise
    std::vector<int> thick_shell_points_;
    int thick_shell_layers_ = 0;
    bool strains_; ///< STRFLG
};

/// *DATABASE_ELOUT: the elements of *DATABASE_HISTORY_SHELL, _SOLID, _TSHELL and _BEAM. Eroded elements are
/// left out, as LS-DYNA does.
class EloutRecorder final : public ScheduledRecorder {
public:
    EloutRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ElementHistories histories_;
    std::vector<Index> beams_; ///< wanted, each once
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash
