// *TERMINATION family.

#include "parser/reading.h"

#include <fmt/format.h>

namespace plash {
namespace {

/// A limit that stands in the deck; a zero is none.
double limit_of(const Record& record, std::string_view field, double without)
{
    const double value = record.real(field);
    return value == 0 ? without : value;
}

void read_limits(const Record& record, Termination& end)
{
    end.largest = limit_of(record, "MAXC", forever);
    end.smallest = limit_of(record, "MINC", -forever);
}

/// STOP 1 to 3: a coordinate passes a limit (which may be zero, if written); 4: the node touches a contact
/// surface.
void read_node(const Record& record, const Block&, Reading& reading)
{
    Termination end;
    end.where = record.where;
    end.kind = Termination::Kind::node;
    end.index = reading.find(record, "NID", Kind::node);
    const Id stop = record.integer("STOP");
    if (stop < 1 || stop > 4) {
        reading.error(record, "STOP", fmt::format("{} is not one of 1 x, 2 y, 3 z, 4 contact", stop));
        return;
    }
    end.axis = static_cast<int>(stop - 1);
    read_limits(record, end);
    if (end.index != none) reading.model.terminations.push_back(end);
}

/// STOP 1 to 3: displacement of the rigid body along an axis, 4: its magnitude.
void read_body(const Record& record, const Block&, Reading& reading)
{
    Termination end;
    end.where = record.where;
    end.kind = Termination::Kind::body;
    end.index = reading.find(record, "PID", Kind::part);
    const Id stop = record.integer("STOP");
    if (stop < 1 || stop > 4) {
        reading.error(record, "STOP", fmt::format("{} is not one of 1 x, 2 y, 3 z, 4 magnitude", stop));
        return;
    }
    end.axis = static_cast<int>(stop - 1);
    read_limits(record, end);
    if (end.index != none) reading.model.terminations.push_back(end);
}

void read_deleted(const Record& record, const Block&, Reading& reading)
{
    Termination end;
    end.where = record.where;
    const bool shells = record.keyword.find("_SHELLS") != std::string::npos;
    end.kind = shells ? Termination::Kind::deleted_shells : Termination::Kind::deleted_solids;
    end.count = std::max<Id>(1, record.integer("NDS"));
    if (record.peek("PSID")) {
        const Index set = reading.find(record, "PSID", Kind::part_set);
        if (set != none) end.parts = reading.model.part_sets[set].parts;
    } else if (const Index part = reading.find(record, "PID", Kind::part); part != none) {
        end.parts = {part};
    }
    if (!end.parts.empty()) reading.model.terminations.push_back(std::move(end));
}

void read_curve_termination(const Record& record, const Block&, Reading& reading)
{
    Termination end;
    end.where = record.where;
    end.kind = Termination::Kind::curve;
    end.index = reading.find(record, "LCID", Kind::curve);
    end.time = record.real("ATIME");
    if (end.index != none) reading.model.terminations.push_back(end);
}

/// The contact is looked up when the run starts: contacts are complete only then.
void read_contact_termination(const Record& record, const Block&, Reading& reading)
{
    Termination end;
    end.where = record.where;
    end.kind = Termination::Kind::contact;
    end.index = static_cast<Index>(record.integer("CID"));
    end.time = record.real("ACTIM");
    end.duration = record.real("DURID");
    end.threshold = record.real("THRES");
    const Id freedom = record.integer("DOF");
    if (freedom < 0 || freedom > 3)
        reading.error(record, "DOF", fmt::format("{} is not one of 0 resultant, 1 x, 2 y, 3 z", freedom));
    end.axis = freedom == 0 ? 3 : static_cast<int>(freedom - 1);
    reading.model.terminations.push_back(end);
}

constexpr Translator termination_table[] = {
    {"TERMINATION_NODE", Phase::conditions, read_node},
    {"TERMINATION_BODY", Phase::conditions, read_body},
    {"TERMINATION_DELETED_SHELLS*", Phase::conditions, read_deleted},
    {"TERMINATION_DELETED_SOLIDS*", Phase::conditions, read_deleted},
    {"TERMINATION_CURVE", Phase::conditions, read_curve_termination},
    {"TERMINATION_CONTACT", Phase::conditions, read_contact_termination},
};

} // namespace

std::span<const Translator> termination_keywords()
{
    return termination_table;
}

} // namespace plash
