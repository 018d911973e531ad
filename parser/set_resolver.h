#pragma once

#include "parser/reading.h"

#include <map>

namespace plash {

/// Fills the sets of one reading: lists, ranges, sums, intersections and the options of _GENERAL. Sets of
/// sets are resolved when they are first asked for.
class SetResolver {
public:
    using Members = std::vector<Index>;
    using Segments = std::vector<std::array<Index, 4>>;

    explicit SetResolver(Reading& reading) : reading_(reading), model_(reading.model) {}

    void run();

private:
    using Key = std::pair<Kind, Index>;
    enum class State { untouched, open, done };

    /// One row of a set's table, for messages.
    struct Row {
        const Record& record;
        int line;
        std::string_view column;
    };

    static Kind member_kind(Kind set);
    /// Fills the set, unless that is done; false (and reported) when it is being filled right now.
    bool resolve(Kind kind, Index index);
    void report_missing(const Row& row, Kind kind, Id id);

    Members& members_of(Kind set, Index index);
    std::size_t count_of(Kind kind) const;
    Id id_of(Kind kind, std::size_t position) const;
    const std::vector<Index>& parts_of(Kind element) const;
    /// Calls visit(node) for the nodes of one element.
    template <class Visit>
    void for_nodes(Kind element, Index position, Visit&& visit) const;

    void add_members(const Record& record, Kind set, Members& members);
    void add_one(const Row& row, Kind kind, Id id, Members& members);
    void add_range(Kind kind, Id first, Id last, Id step, Members& members);
    const Members* other_set(const Row& row, Kind set, Id id);
    static void intersect(const Members* other, bool first, Members& members);

    void add_advanced(const Record& record, const Table& table, Members& members);
    void add_general(const Record& record, const Table& table, Kind set, Members& members);
    bool general(const Row& row, std::string_view option, Kind member, Id id, Members& found);
    bool general_nodes(const Row& row, std::string_view option, Id id, Members& found);
    void add_parts(Kind member, const Members& parts, Members& found);
    void add_box(const Row& row, Kind member, Id id, Members& found);

    void add_segments(const Record& record, SegmentSet& set);
    void add_segment(const Record& record, const Table& table, std::size_t row, std::size_t first_column,
                     SegmentSet& set);
    bool general_segments(const Record& record, const Table& table, std::size_t row, Segments& segments);

    Reading& reading_;
    Model& model_;
    const Block* block_ =
        nullptr; ///< of the record in work: numbers in _GENERAL need the offsets of its include
    std::map<Key, std::vector<std::size_t>> by_set_; ///< positions in Reading::pending_sets
    std::map<Key, State> states_;
    int depth_ = 0; ///< sets that are being filled, each inside the one before
};

} // namespace plash
