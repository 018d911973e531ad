#pragma once

#include "parser/reading.h"

#include <vector>

namespace plash {

/// The numbers in definitions that must be numbers of other things: collected while the deck is read, checked
/// when all of it is known.
class References {
public:
    /// Members of sets are left out: they are checked when the sets are resolved.
    void collect(const Record& record, const KeywordLayout& layout, Reading& reading);

    /// Reports every number that nothing has.
    void check(Reading& reading) const;

private:
    struct Reference {
        Kind kind;
        Id id;
        Location where;
        const KeywordLayout* layout;
        const FieldLayout* field;
    };
    void collect(const Record& record, const KeywordLayout& layout, const CardLayout& card, Reading& reading);

    std::vector<Reference> references_;
};

/// Counts what the deck defines and nothing in it uses (curves, sets, materials, parts without elements ...).
void count_unused(Reading& reading);

} // namespace plash
