#include "conditions/air_blast.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace plash {

namespace {

/// log10 of a quantity: a polynomial of offset + slope log10(scaled distance), up to a distance.
struct Fit {
    double to = 1e300; ///< log10 of the scaled distance
    double offset = 0, slope = 0;
    std::span<const double> coefficients;
};

double value(std::span<const Fit> fits, double log_distance)
{
    const Fit& fit =
        *std::find_if(fits.begin(), fits.end(), [&](const Fit& f) { return log_distance <= f.to; });
    const double u = fit.offset + fit.slope * log_distance;
    double sum = 0;
    for (std::size_t i = fit.coefficients.size(); i-- > 0;) sum = sum * u + fit.coefficients[i];
    return std::pow(10.0, sum);
}

constexpr double everywhere = 1e300;

// Largest incident pressure [psi].
constexpr double surface_incident[] = {
    1.9422502013,     -1.6958988741,  -0.154159376846,  0.514060730593,   0.0988534365274, -0.293912623038,
    -0.0268112345019, 0.109097496421, 0.00162846756311, -0.0214631030242, 0.0001456723382, 0.00167847752266};
constexpr double air_incident[] = {1.77284970457,     -1.69012801396,    0.00804973591951,
                                   0.336743114941,    -0.00516226351334, -0.0809228619888,
                                   -0.00478507266747, 0.00793030472242,  0.0007684469735};
constexpr Fit incident_pressure[2][1] = {{{everywhere, -0.756579301809, 1.35034249993, surface_incident}},
                                         {{everywhere, -0.756579301809, 1.35034249993, air_incident}}};

// Largest reflected pressure [psi].
constexpr double surface_reflected[] = {
    2.56431321138,  -2.21030870597, -0.218536586295, 0.895319589372,   0.24989009775,     -0.569249436807,
    -0.11791682383, 0.224131161411, 0.0245620259375, -0.0455116002694, -0.00190930738887, 0.00361471193389};
constexpr double air_reflected[] = {2.39106134946,    -2.21400538997,   0.035119031446,   0.657599992109,
                                    0.0141818951887,  -0.243076636231,  -0.0158699803158, 0.0492741184234,
                                    0.00227639644004, -0.00397126276058};
constexpr Fit reflected_pressure[2][1] = {{{everywhere, -0.789312405513, 1.36637719229, surface_reflected}},
                                          {{everywhere, -0.756579301809, 1.35034249993, air_reflected}}};

// Time of arrival [ms / lb^(1/3)].
constexpr double surface_arrival[] = {-0.173607601251,   1.35706496258,   0.052492798645,  -0.196563954086,
                                      -0.0601770052288,  0.0696360270891, 0.0215297490092, -0.0161658930785,
                                      -0.00232531970294, 0.00147752067524};
constexpr double air_arrival[] = {-0.0423733936826, 1.36456871214,   -0.0570035692784, -0.182832224796,
                                  0.0118851436014,  0.0432648687627, -0.0007997367834, -0.00436073555033};
constexpr Fit arrival[2][1] = {{{everywhere, -0.755684472698, 1.37784223635, surface_arrival}},
                               {{everywhere, -0.80501734056, 1.37407043777, air_arrival}}};

// Reflected impulse [psi ms / lb^(1/3)].
constexpr double surface_reflected_impulse[] = {1.75291677799, -0.949516092853, 0.112136118689,
                                                -0.0250659183287};
constexpr double air_reflected_impulse[] = {1.60579280091, -0.903118886091, 0.101771877942, -0.0242139751146};
constexpr Fit reflected_impulse[2][1] = {
    {{everywhere, -0.781951689212, 1.33422049854, surface_reflected_impulse}},
    {{everywhere, -0.757659920369, 1.37882996018, air_reflected_impulse}}};

// Incident impulse [psi ms / lb^(1/3)].
constexpr double surface_impulse_near[] = {1.57159240621, -0.502992763686, 0.171335645235, 0.0450176963051,
                                           -0.0118964626402};
constexpr double surface_impulse_far[] = {0.719852655584,    -0.384519026965, -0.0280816706301,
                                          0.00595798753822,  0.014544526107,  -0.00663289334734,
                                          -0.00284189327204, 0.0013644816227};
constexpr double air_impulse_near[] = {1.43534136453, -0.443749377691, 0.168825414684, 0.0348138030308,
                                       -0.010435192824};
constexpr double air_impulse_far[] = {0.599008468099,   -0.40463292088,   -0.0142721946082,
                                      0.00912366316617, -0.0006750681404, -0.00800863718901,
                                      0.00314819515931, 0.00152044783382, -0.0007470265899};
constexpr Fit incident_impulse[2][2] = {{{0.382017, 0.832468843425, 3.0760329666, surface_impulse_near},
                                         {everywhere, -2.91358616806, 2.40697745406, surface_impulse_far}},
                                        {{0.30103, 1.04504877747, 3.24299066475, air_impulse_near},
                                         {everywhere, -2.67912519532, 2.30629231803, air_impulse_far}}};

// Duration of the positive phase [ms / lb^(1/3)].
constexpr double surface_duration_near[] = {-0.725};
constexpr double surface_duration_1[] = {-0.728671776005, 0.130143717675,    0.134872511954,
                                         0.0391574276906, -0.00475933664702, -0.00428144598008};
constexpr double surface_duration_2[] = {0.20096507334,    -0.0297944268976, 0.030632954288,
                                         0.0183405574086,  -0.0173964666211, -0.00106321963633,
                                         0.00562060030977, 0.0001618217499,  -0.0006860188944};
constexpr double surface_duration_3[] = {0.572462469964,    0.0933035304009,   -0.0005849420883,
                                         -0.00226884995013, -0.00295908591505, 0.00148029868929};
constexpr double air_duration_near[] = {-0.824};
constexpr double air_duration_1[] = {-0.801052722864,  0.164953518069,    0.127788499497,
                                     0.00291430135946, 0.00187957449227,  0.0173413962543,
                                     0.00269739758043, -0.00361976502798, -0.00100926577934};
constexpr double air_duration_2[] = {0.115874238335,  -0.0297944268969, 0.0306329542941,
                                     0.018340557407,  -0.0173964666286, -0.00106321963576,
                                     0.0056206003128, 0.0001618217499,  -0.0006860188944};
constexpr double air_duration_3[] = {0.50659210403,    0.0967031995552,   -0.00801302059667, 0.00482705779732,
                                     0.00187587272287, -0.00246738509321, -0.000841116668,   0.0006193291052};
constexpr Fit duration[2][4] = {{{-0.34, 0, 0, surface_duration_near},
                                 {0.4048337, -0.1790217052, 5.25099193925, surface_duration_1},
                                 {0.845098, -5.85909812338, 9.2996288611, surface_duration_2},
                                 {everywhere, -4.92699491141, 3.46349745571, surface_duration_3}},
                                {{-0.34, 0, 0, air_duration_near},
                                 {0.350248, 0.209440059933, 5.11588554305, air_duration_1},
                                 {0.7596678, -5.06778493835, 9.2996288611, air_duration_2},
                                 {everywhere, -4.39590184126, 3.1524725264, air_duration_3}}};

/// a of (a - 1 + exp(-a)) / a^2 = impulse / (pressure duration), which falls from 1/2 at 0 with a.
double decay_of(double impulse, double pressure, double time)
{
    const double wanted = impulse / (pressure * time);
    if (!(wanted < 0.5)) return 0;
    const auto share = [](double a) { return (a - 1 + std::exp(-a)) / (a * a); };
    double low = 0, high = 1; // halved intervals: called once for each segment
    while (share(high) > wanted) high *= 2;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (share(middle) > wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

constexpr double ambient_pressure = 14.696; // psi

} // namespace

double nearest_blast(Burst burst)
{
    return burst == Burst::surface ? 0.170 : 0.147;
}

double farthest_blast()
{
    return 100;
}

AirBlast air_blast(Burst burst, double scaled_distance)
{
    const double distance = std::clamp(scaled_distance, nearest_blast(burst), farthest_blast());
    const double log_distance = std::log10(distance);
    const int which = burst == Burst::surface ? 0 : 1;
    AirBlast blast;
    blast.arrival = value(arrival[which], log_distance);
    blast.duration = value(duration[which], log_distance);
    blast.incident_pressure = value(incident_pressure[which], log_distance);
    blast.reflected_pressure = value(reflected_pressure[which], log_distance);
    blast.incident_impulse = value(incident_impulse[which], log_distance);
    blast.reflected_impulse = value(reflected_impulse[which], log_distance);
    // The longest of the triangles that have these pressures and impulses is the least duration that both
    // can have.
    blast.duration = std::max({blast.duration, 2 * blast.incident_impulse / blast.incident_pressure,
                               2 * blast.reflected_impulse / blast.reflected_pressure});
    blast.incident_decay = decay_of(blast.incident_impulse, blast.incident_pressure, blast.duration);
    blast.reflected_decay = decay_of(blast.reflected_impulse, blast.reflected_pressure, blast.duration);
    return blast;
}

double AirBlast::pressure(double since_arrival, double cosine) const
{
    if (since_arrival < 0) return 0;
    const double t = since_arrival / duration;
    // A triangle has no negative phase.
    const auto wave = [&](double peak, double decay) {
        return decay > 0 || t < 1 ? peak * (1 - t) * std::exp(-decay * t) : 0;
    };
    const double facing = std::max(cosine, 0.0);
    const double all = wave(reflected_pressure, reflected_decay) * facing * facing +
                       wave(incident_pressure, incident_decay) * (1 - facing) * (1 - facing);
    return std::max(all, -ambient_pressure);
}

} // namespace plash
