#pragma once

#include "output/binout.h"
#include "output/result_file.h"
#include "output/schedule.h"

#include <span>

namespace plash {

/// *DATABASE_ALE_MAT: sums by material group over Eulerian meshes, or over those cells whose middles lie in
/// the boxes BOXLOW to BOXUP (*DEFINE_BOX), one after the other.
class FluidGroupSums {
public:
    FluidGroupSums(const Model& model, const Record& record);

    struct Row {
        Id box = 0; ///< 0: the whole meshes
        Id group = 0;
        ElementResults::FluidSum sum;
    };
    std::vector<Row> rows(const Snapshot& snapshot) const;
    /// Boxes and groups of the rows.
    const std::vector<Row>& frame() const { return frame_; }

private:
    std::vector<Row> frame_;
    std::vector<NamedBox> boxes_;
    std::size_t groups_;
};

/// *DATABASE_ALE: chosen variables of the cells of a set, or their means (IAVER = 1) as well.
class FluidCellHistories {
public:
    /// DeckError for variables that are not there.
    FluidCellHistories(const Model& model, const Record& record);

    const std::vector<Index>& solids() const { return solids_; }
    std::span<const int> variables() const { return variables_; }
    bool means() const { return means_; }
    /// Values by cell and variable.
    std::vector<std::vector<double>> values(const Snapshot& snapshot) const;
    /// Of each variable over all cells.
    static std::vector<double> means_of(const std::vector<std::vector<double>>& values);
    static std::string_view name_of(int variable);

private:
    std::vector<Index> solids_;
    std::vector<int> variables_; ///< by the manual's numbers
    bool means_ = false;
};

/// File alemat. LS-DYNA collects the same sums in a file of its own and makes curves of them; the columns are
/// Plash's.
class AlematRecorder final : public ScheduledRecorder {
public:
    AlematRecorder(const Model&, const Record&, const ResultPath& path);

private:
    FluidGroupSums sums_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// File dbale, likewise.
class DbaleRecorder final : public ScheduledRecorder {
public:
    DbaleRecorder(const Model&, const Record&, const ResultPath& path);

private:
    FluidCellHistories cells_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// A file of arrays to which histories go besides; null: there is none.
using ArrayRecorders = std::span<BinoutRecorder* const>;

/// The recorders of all *DATABASE_ALE and *DATABASE_ALE_MAT of a deck; the second of a kind has the number 2
/// at the end of its name, and so on.
std::vector<std::unique_ptr<Recorder>> make_ale_recorders(const Model& model, const std::string& directory,
                                                          bool resume, ArrayRecorders arrays);

} // namespace plash
