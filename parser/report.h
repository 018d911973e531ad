#pragma once

#include "model/record.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// One fault or doubt about the deck, for people: where, which keyword and field, what was found and wanted.
struct Message {
    Location where;
    std::string keyword; ///< without `*`; empty when the message is about the file
    std::string field;   ///< empty when it is about the whole block
    std::string text;
};

/// What Plash does with a keyword.
enum class KeywordStatus {
    run,         ///< honoured
    read,        ///< in the Model, but no physics uses it yet
    ignored,     ///< harmless; the reason is listed
    unsupported, ///< known by name, not read
    unknown
};

std::string_view to_string(KeywordStatus status);

/// How often a keyword stands in the deck and what became of it.
struct KeywordUse {
    std::string name;
    KeywordStatus status = KeywordStatus::unknown;
    long blocks = 0;
    std::string reason; ///< of `ignored`
    Location first;
};

/// A value of the deck, different from its default, that changes nothing in the run.
struct IgnoredField {
    Location where;
    std::string keyword;
    std::string field;
    std::string value;
    std::string reason;
};

/// Things of one kind that the deck defines and does not use.
struct Unused {
    std::string what; ///< in the plural, e.g. "curves"
    long count = 0;
    std::int64_t first = 0; ///< number of the first one
};

/// Everything there is to say about a deck besides the Model.
class Report {
public:
    std::vector<Message> errors;
    std::vector<Message> warnings;
    std::map<std::string, KeywordUse> keywords;
    std::vector<IgnoredField> ignored;
    std::vector<Unused> unused;
    struct {
        long honoured = 0, ignored = 0, unsupported = 0;
    } fields; ///< non-default values by what becomes of them
    struct {
        long shell = 0, tshell = 0, solid = 0, beam = 0, discrete = 0, mass = 0, sph = 0;
    } elements; ///< as the deck has them, also those with faults that do not reach the Model

    void error(Location where, std::string_view keyword, std::string_view field, std::string text);
    void warning(Location where, std::string_view keyword, std::string_view field, std::string text);
    bool ok() const { return errors.empty(); }

    /// After the last message: one line for each kind of message that came too often to be listed.
    void close();

private:
    /// The first few messages of a kind (same keyword and field) are kept, the others counted.
    struct Count {
        long number = 0;
        Location last;
    };
    void add(std::vector<Message>& list, std::map<std::string, Count>& counts, Message message);
    std::map<std::string, Count> error_counts_, warning_counts_;
};

} // namespace plash
