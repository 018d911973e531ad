#include "materials/composite_damage.h"

#include <fmt/format.h>

namespace plash {

CompositeDamage CompositeDamage::from_record(const Record& record, const Model&)
{
    CompositeDamage law;
    law.plane = OrthotropicPlane::from_record(record);
    law.alpha = record.real("ALPH");
    law.xt = record.real("XT");
    law.yt = record.real("YT");
    law.yc = record.real("YC");
    law.sc = record.real("SC");
    if (record.keyword == "MAT_COMPOSITE_DAMAGE") {
        law.rule = Rule::composite_damage;
    } else {
        const Id criterion = record.integer("CRIT", 54);
        if (criterion != 0 && criterion != 54 && criterion != 55) {
            reject_field(record, "CRIT",
                         fmt::format("criterion {} is not supported (54: Chang-Chang, 55: "
                                     "Tsai-Wu for the matrix)",
                                     criterion));
        }
        law.rule = criterion == 55 ? Rule::tsai_wu : Rule::chang;
        law.xc = std::abs(record.real("XC"));
        law.beta = record.real("BETA");
        law.fiber_reduction = record.real("FBRT");
        law.compression_factor = value_or(record.real("YCFAC"), 2);
        law.tension_strain = record.real("DFAILT");
        law.compression_strain = -std::abs(record.real("DFAILC"));
        law.matrix_strain = record.real("DFAILM");
        law.shear_strain = record.real("DFAILS");
        law.effective_strain = record.real("EFS");
    }
    for (const char* field : {"XT", "YT", "YC", "SC"}) {
        if (record.real(field) < 0) {
            reject_field(record, field, fmt::format("{} is no strength", record.real(field)));
        }
    }
    if (law.rule == Rule::tsai_wu && !(law.yt > 0 && law.yc > 0)) {
        reject_field(record, "YT", "CRIT = 55 needs both YT and YC");
    }
    return law;
}

} // namespace plash
