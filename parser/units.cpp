#include "parser/units.h"

#include <cmath>

namespace plash {
namespace {

constexpr Dimension number{};
constexpr Dimension mass{1};
constexpr Dimension length{0, 1};
constexpr Dimension area{0, 2};
constexpr Dimension volume{0, 3};
constexpr Dimension second_area{0, 4}; // second moment of area
constexpr Dimension duration{0, 0, 1};
constexpr Dimension rate{0, 0, -1};
constexpr Dimension velocity{0, 1, -1};
constexpr Dimension acceleration{0, 1, -2};
constexpr Dimension angular_acceleration{0, 0, -2};
constexpr Dimension density{1, -3};
constexpr Dimension area_density{1, -2};
constexpr Dimension line_density{1, -1};
constexpr Dimension inertia{1, 2};
constexpr Dimension force{1, 1, -2};
constexpr Dimension moment{1, 2, -2};
constexpr Dimension stress{1, -1, -2};
constexpr Dimension softness{-1, 1, 2}; // one over a stress
constexpr Dimension viscosity{1, -1, -1};
constexpr Dimension stiffness{1, 0, -2};
constexpr Dimension damping{1, 0, -1};
constexpr Dimension rotary_damping{1, 2, -1};
constexpr Dimension slowness{0, -1, 1}; // one over a velocity
constexpr Dimension temperature{0, 0, 0, 1};
constexpr Dimension heat_capacity{0, 2, -2, -1};
constexpr Dimension mass_rate{1, 0, -1};

/// Fields of keywords with one dimension. A `*` at the end of a keyword stands for any ending, a `#` at the
/// end of a field for a number. The first row that fits counts, so that exceptions stand above their family.
struct Row {
    std::string_view keyword, fields;
    Dimension dimension;
};

constexpr Row rows[] = {
    {"NODE", "X Y Z", length},

    {"ELEMENT_SHELL*", "THIC# THICK# OFFSET", length},
    {"ELEMENT_SHELL*", "BETA PSI B#", number},
    {"ELEMENT_TSHELL*", "THICK#", length},
    {"ELEMENT_TSHELL*", "BETA B#", number},
    {"ELEMENT_SOLID*", "A# D#", number},
    {"ELEMENT_SPH", "MASS", mass},
    {"ELEMENT_SPH_VOLUME", "VOLUME", volume},
    {"ELEMENT_MASS*", "MASS ADDMASS FINMASS", mass},
    {"ELEMENT_INERTIA*", "IXX IXY IXZ IYY IYZ IZZ", inertia},
    {"ELEMENT_INERTIA*", "MASS", mass},
    {"ELEMENT_INERTIA*", "X-OFF Y_OFF Z_OFF", length},
    {"ELEMENT_DISCRETE", "S", number},
    {"ELEMENT_DISCRETE", "OFFSET", length},
    {"ELEMENT_BEAM*", "VX VY VZ DOFN#", number},
    {"ELEMENT_BEAM*", "WX# WY# WZ#", length},
    {"ELEMENT_BEAM_SCALAR*", "VOL", volume},
    {"ELEMENT_BEAM_SCALAR*", "INER", inertia},
    {"ELEMENT_SEATBELT", "SLEN", length},
    {"ELEMENT_SEATBELT_ACCELEROMETER", "MASS", mass},

    {"SECTION_SHELL*", "T#", length},
    {"SECTION_SHELL*", "NLOC SHRF PROPT QR/IRID IDOF ANGLE XI ETA WGT PI BI B#", number},
    {"SECTION_SHELL*", "MAREA", area_density},
    {"SECTION_TSHELL", "SHRF PROPT BI", number},
    {"INTEGRATION_SHELL", "S WF", number},
    {"INTEGRATION_BEAM", "S T WF RA SREF TREF", number},
    {"INTEGRATION_BEAM", "D#", length},
    {"INITIAL_STRESS_BEAM", "SIG11 SIG22 SIG33 SIG12 SIG23 SIG31", stress},
    {"INITIAL_STRESS_BEAM", "EPS", number},
    {"INITIAL_STRESS_BEAM", "F11", force},
    {"INITIAL_STRESS_BEAM", "T11 M12 M13 M22 M23", moment},
    {"SECTION_SOLID*", "XI ETA ZETA WGT P PI AFAC BFAC CFAC DFAC AAFAC COHOFF", number},
    {"SECTION_SOLID*", "START END", duration},
    {"SECTION_BEAM", "SHRF SCOOR NSLOC NTLOC PRINT", number},
    {"SECTION_BEAM", "NSM", line_density},
    {"SECTION_BEAM", "TS# TT#", length},
    {"SECTION_BEAM", "A SA SAT CA/DOFN1", area},
    {"SECTION_BEAM", "OFFSET/DOFN2", length},
    {"SECTION_BEAM", "RRCON/NULL SRCON/NULL TRCON/NULL", number},
    {"SECTION_BEAM", "ISS ITT J IST ITORM", second_area},
    {"SECTION_BEAM", "VOL", volume},
    {"SECTION_BEAM", "INER", inertia},
    {"SECTION_DISCRETE", "KD", number},
    {"SECTION_DISCRETE", "V0", velocity},
    {"SECTION_DISCRETE", "CL FD", length},
    {"SECTION_SPH*", "CSLH HMIN HMAX", number},
    {"PLASH_ALE_FORMULATION", "SMOOTH", number},
    {"PLASH_FLUID", "SIZE HEIGHT", length},
    {"SECTION_SPH*", "SPHINI", length},
    {"SECTION_SPH*", "DEATH START", duration},
    {"SECTION_SEATBELT", "AREA", area},
    {"SECTION_SEATBELT", "THICK", length},
    {"HOURGLASS", "QM Q1 Q2 QB/VDC QW", number},

    {"PART*", "FS FD SFT SSF SHRF B# SHRFAC", number},
    {"PART*", "DC", slowness},
    {"PART*", "VC", stress},
    {"PART*", "OPTT THICK# XC YC ZC XL YL ZL XLIP YLIP ZLIP XMOV YMOV ZMOV", length},
    {"PART*", "TM", mass},
    {"PART*", "IXX IXY IXZ IYY IYZ IZZ", inertia},
    {"PART*", "VTX VTY VTZ", velocity},
    {"PART*", "VRX VRY VRZ", rate},
    {"PART_COMPOSITE*", "NLOC", number},
    {"PART_COMPOSITE*", "MAREA", area_density},

    {"MAT_ELASTIC", "DA DB", number},
    {"MAT_ELASTIC_FLUID", "DA DB VC", number},
    {"MAT_ELASTIC_FLUID", "K CP", stress},
    {"MAT_HIGH_EXPLOSIVE_BURN", "D", velocity},
    {"MAT_HIGH_EXPLOSIVE_BURN", "PCJ K", stress},
    {"MAT_HIGH_EXPLOSIVE_BURN", "BETA", number},
    {"MAT_GEOLOGIC_CAP_MODEL", "ALPHA GAMMA X0 TOFF C", stress},
    {"MAT_GEOLOGIC_CAP_MODEL", "BETA D", softness},
    {"MAT_GEOLOGIC_CAP_MODEL", "THETA R W N PLOT FTYPE VEC", number},
    {"MAT_PLASTIC_KINEMATIC", "BETA SRP FS VP", number},
    {"MAT_PLASTIC_KINEMATIC", "SRC", rate},
    {"MAT_VISCOELASTIC", "G0 GI", stress},
    {"MAT_VISCOELASTIC", "BETA", rate},
    {"MAT_KELVIN-MAXWELL_VISCOELASTIC", "G0 GI", stress},
    {"MAT_KELVIN-MAXWELL_VISCOELASTIC", "DC", rate},
    {"MAT_KELVIN-MAXWELL_VISCOELASTIC", "FO SO", number},
    {"MAT_SOIL_AND_FOAM*", "A0", {2, -2, -4}},
    {"MAT_SOIL_AND_FOAM*", "A1 PC P#", stress},
    {"MAT_SOIL_AND_FOAM*", "A2 VCR REF EPS#", number},
    {"MAT_BLATZ-KO_RUBBER", "REF", number},
    {"MAT_NULL", "PC YM", stress},
    {"MAT_NULL", "MU", viscosity},
    {"MAT_NULL", "TEROD CEROD", number},
    {"MAT_ELASTIC_PLASTIC_HYDRO", "EH PC ES#", stress},
    {"MAT_ELASTIC_PLASTIC_HYDRO", "FS EPS#", number},
    {"MAT_ELASTIC_PLASTIC_HYDRO", "CHARL", length},
    {"MAT_ELASTIC_PLASTIC_HYDRO_SPALL", "SIG0 EH PC ES#", stress},
    {"MAT_ELASTIC_PLASTIC_HYDRO_SPALL", "A1 FS SPALL EPS#", number},
    {"MAT_ELASTIC_PLASTIC_HYDRO_SPALL", "A2", softness},
    {"MAT_ELASTIC_PLASTIC_HYDRO_SPALL", "CHARL", length},
    {"MAT_JOHNSON_COOK", "A B PC", stress},
    {"MAT_JOHNSON_COOK", "VP RATEOP N C M SPALL IT D1/BETA D2/WC D3/DC D4/GAMMA D5 EROD EFMIN NUMINT",
     number},
    {"MAT_JOHNSON_COOK", "DTF", duration},
    {"MAT_JOHNSON_COOK", "TM TR", temperature},
    {"MAT_JOHNSON_COOK", "EPSO", rate},
    {"MAT_JOHNSON_COOK", "CP", {0, 2, -2, -1}},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", "A B SIGMAX SIGSAT", stress},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", "VP N C PSFAIL", number},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", "EPSO", rate},
    {"MAT_POWER_LAW_PLASTICITY", "K", stress},
    {"MAT_POWER_LAW_PLASTICITY", "N SRP EPSF VP", number},
    {"MAT_POWER_LAW_PLASTICITY", "SRC", rate},
    {"MAT_RIGID", "CMO CON1 CON2 LCO_OR_A1", number},
    {"MAT_RIGID", "XSPC YSPC ZSPC", length},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "FAIL P VP EPS#", number},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "TDEL", duration},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "C", rate},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "ES#", stress},
    {"MAT_PLASTICITY_WITH_DAMAGE", "EPPF P EPPFR VP NUMINT EPS#", number},
    {"MAT_PLASTICITY_WITH_DAMAGE", "TDEL", duration},
    {"MAT_PLASTICITY_WITH_DAMAGE", "C", rate},
    {"MAT_PLASTICITY_WITH_DAMAGE", "ES#", stress},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", "P FAIL SRFLAG RPCT PCUTF", number},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", "TDEL", duration},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", "C BETAI", rate},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", "EC PC PT PCUTC PCUTT K GI", stress},
    {"MAT_MOONEY-RIVLIN_RUBBER", "A B", stress},
    {"MAT_MOONEY-RIVLIN_RUBBER", "REF", number},
    {"MAT_MOONEY-RIVLIN_RUBBER", "SGL SW ST", length},
    {"MAT_LOW_DENSITY_FOAM", "TC ED KCON", stress},
    {"MAT_LOW_DENSITY_FOAM", "HU DAMP SHAPE FAIL BVFLAG REF", number},
    {"MAT_LOW_DENSITY_FOAM", "BETA BETA1", rate},
    {"MAT_LOW_DENSITY_VISCOUS_FOAM", "TC KCON GI", stress},
    {"MAT_LOW_DENSITY_VISCOUS_FOAM", "HU DAMP SHAPE FAIL BVFLAG REF", number},
    {"MAT_LOW_DENSITY_VISCOUS_FOAM", "BETA BETAI", rate},
    {"MAT_COHESIVE_MIXED_MODE", "INTFAIL XMU GAMMA CTS", number},
    {"MAT_COHESIVE_MIXED_MODE", "EN ET", {1, -2, -2}},
    {"MAT_COHESIVE_MIXED_MODE", "GIC GIIC", {1, 0, -2}},
    {"MAT_COHESIVE_MIXED_MODE", "T S", stress},
    {"MAT_COHESIVE_MIXED_MODE", "UND UTD", length},
    {"MAT_FU_CHANG_FOAM", "KCON TC", stress},
    {"MAT_FU_CHANG_FOAM", "FAIL DAMP BVFLAG SFLAG RFLAG TFLAG SRAF REF HU SHAPE EXPON RIULD PDOPT", number},
    {"MAT_FU_CHANG_FOAM", "MINR MAXR", rate},
    {"MAT_CRUSHABLE_FOAM", "TSC", stress},
    {"MAT_CRUSHABLE_FOAM", "DAMP", number},
    {"MAT_HYPERELASTIC_RUBBER", "C10 C01 C11 C20 C02 C30 GI GJ SIGF SIGFJ", stress},
    {"MAT_HYPERELASTIC_RUBBER", "THERML REF DATA VFLAG", number},
    {"MAT_HYPERELASTIC_RUBBER", "D#", softness},
    {"MAT_HYPERELASTIC_RUBBER", "SGL SW ST", length},
    {"MAT_HYPERELASTIC_RUBBER", "BETAI", rate},
    {"MAT_OGDEN_RUBBER", "MU# GI SIGF", stress},
    {"MAT_OGDEN_RUBBER", "ALPHA# REF DATA", number},
    {"MAT_OGDEN_RUBBER", "D#", softness},
    {"MAT_OGDEN_RUBBER", "SGL SW ST", length},
    {"MAT_OGDEN_RUBBER", "BETAI", rate},
    {"MAT_HONEYCOMB", "EAAU EBBU ECCU GABU GBCU GCAU", stress},
    {"MAT_HONEYCOMB", "VF MU TSEF SSEF", number},
    {"MAT_SPOTWELD", "EH", stress},
    {"MAT_SPOTWELD", "DT TFAIL", duration},
    {"MAT_SPOTWELD", "EFAIL NF", number},
    {"MAT_SPOTWELD", "NRR NRS NRT", force},
    {"MAT_SPOTWELD", "MRR MSS MTT", moment},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", "XC XT YC YT SC", stress},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE",
     "ALPH SOFT FBRT YCFAC DFAILM DFAILS DFAILT DFAILC EFS CRIT BETA PEL EPSF EPSR TSMD SOFT2 SLIMT1 SLIMC1 "
     "SLIMT2 "
     "SLIMC2 SLIMS NCYRED SOFTG MANGLE 2WAY TI",
     number},
    {"MAT_LAMINATED_COMPOSITE_FABRIC", "XC XT YC YT SC TAU1", stress},
    {"MAT_LAMINATED_COMPOSITE_FABRIC",
     "GAMMA1 SLIMT1 SLIMC1 SLIMT2 SLIMC2 SLIMS ERODS SOFT FS EPSF EPSR TSMD BETA E11C E11T E22C E22T GMS",
     number},
    {"MAT_LAMINATED_COMPOSITE_FABRIC", "TSIZE", duration},
    {"MAT_SPRING_ELASTIC", "K", stiffness},
    {"MAT_DAMPER_VISCOUS", "DC", damping},
    {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "TKR TKS TKT", stiffness},
    {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "RKR RKS RKT MOR MOS MOT", moment},
    {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "TDR TDS TDT", damping},
    {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "RDR RDS RDT", rotary_damping},
    {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "FOR FOS FOT", force},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "TKR TKS TKT", stiffness},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "RKR RKS RKT", moment},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "TDR TDS TDT", damping},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "RDR RDS RDT", rotary_damping},
    {"MAT_NONLINEAR_*", "MFAILR MFAILS MFAILT MOR MOS MOT", moment},
    {"MAT_NONLINEAR_*", "FFAILR FFAILS FFAILT FOR FOS FOT", force},
    {"MAT_NONLINEAR_*", "UFAILR UFAILS UFAILT", length},
    {"MAT_NONLINEAR_*", "TFAILR TFAILS TFAILT", number},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "ST D R H S0 ORFLOC ORFRAD", length},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "K C C2 SF", number},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "STF", stiffness},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "RHOF", density},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "C1 DC", damping},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", "CO CLEAR", length},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", "P0 PA", stress},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", "AP", area},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", "KH", {1, 3, 0}},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", "N FR SCLF", number},
    {"MAT_CABLE_DISCRETE_BEAM", "F0 MXFRC", force},
    {"MAT_CABLE_DISCRETE_BEAM", "TMAXF0 TRAMP TSTART", duration},
    {"MAT_CABLE_DISCRETE_BEAM", "FRACL0 MXEPS", number},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", "C2", number},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", "C1", slowness},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", "DLE", velocity},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", "CDF TDF", length},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", "F0", force},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", "D", damping},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "C2", number},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "C1", slowness},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "DLE", velocity},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "CDF TDF", length},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "F0", force},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "D", damping},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "K", stiffness},
    {"MAT_GENERAL_NONLINEAR_*", "KT K", stiffness},
    {"MAT_GENERAL_NONLINEAR_*", "KR", moment},
    {"MAT_GENERAL_NONLINEAR_*",
     "UTFAILR UTFAILS UTFAILT UCFAILR UCFAILS UCFAILT IUR IUS IUT UTFAIL UCFAIL IU", length},
    {"MAT_GENERAL_NONLINEAR_*", "OFFSET DAMPF WTFAILR WTFAILS WTFAILT WCFAILR WCFAILS WCFAILT IWR IWS IWT",
     number},
    {"MAT_ADD_EROSION", "MXPRES MNPRES SIGP1 SIGVM SIGTH", stress},
    {"MAT_ADD_EROSION", "EXCL MNEPS EFFEPS VOLEPS NUMFIP NCS MXEPS EPSSH EPSTHIN VOLFRAC", number},
    {"MAT_ADD_EROSION", "FAILTM DTMIN", duration},
    {"MAT_*", "RO", density},
    {"MAT_*", "E EA EB EC (EC) GAB GBC GCA G BULK SIGY ETAN SIGF", stress},
    {"MAT_*", "PR PRBA PRCA PRCB (PRCA) (PRCB) AOPT MACF A1 A2 A3 V1 V2 V3 D1 D2 D3", number},
    {"MAT_*", "XP YP ZP", length},

    {"INITIAL_STRESS_S*", "SIGXX SIGYY SIGZZ SIGXY SIGYZ SIGZX", stress},
    {"INITIAL_STRESS_S*", "T EPS", number},

    {"EOS_LINEAR_POLYNOMIAL", "C0 C1 C2 C3 E0", stress},
    {"EOS_LINEAR_POLYNOMIAL", "C4 C5 C6 V0", number},
    {"EOS_JWL", "A B E0", stress},
    {"EOS_JWL", "R1 R2 OMEG VO", number},
    {"EOS_IDEAL_GAS", "CVMAS CPMAS", {0, 2, -2, -1}},
    {"EOS_IDEAL_GAS", "B", {0, 2, -2, -2}},
    {"EOS_IDEAL_GAS", "C", {0, 2, -2, -3}},
    {"EOS_IDEAL_GAS", "T0", temperature},
    {"EOS_IDEAL_GAS", "V0 ADIAB", number},
    {"EOS_IDEAL_GAS", "VC0", {-1, 3, 0}},
    {"EOS_GRUNEISEN", "C", velocity},
    {"EOS_GRUNEISEN", "S1 S2 S3 GAMMA0 A V0", number},
    {"EOS_GRUNEISEN", "E0", stress},
    {"EOS_TENSOR_PORE_COLLAPSE", "MU1 MU2 EC0", number},
    {"EOS_TENSOR_PORE_COLLAPSE", "IE0", stress},
    {"EOS_TABULATED*", "GAMA V0 EV#", number},
    {"EOS_TABULATED*", "T#", number},
    {"EOS_TABULATED*", "C# K# E0", stress},

    {"DEFINE_CURVE*", "SFA SFO", number},
    {"DEFINE_TABLE*", "SFA", number},
    {"DEFINE_COORDINATE_SYSTEM", "XO YO ZO XL YL ZL XP YP ZP", length},
    {"DEFINE_COORDINATE_VECTOR", "XX YX ZX XV YV ZV", number},
    {"DEFINE_VECTOR", "XT YT ZT XH YH ZH", length},
    {"DEFINE_BOX", "XMN XMX YMN YMX ZMN ZMX", length},
    {"DEFINE_SD_ORIENTATION", "XT YT ZT", number},
    {"DEFINE_FRICTION", "FS_D FD_D FS_IJ FD_IJ", number},
    {"DEFINE_FRICTION", "DC_D DC_IJ", slowness},
    {"DEFINE_FRICTION", "VC_D VC_IJ", stress},
    {"SET_*", "DA# A#", number}, // what they mean is told by who uses the set

    {"INCLUDE_*", "FCTMAS FCTTIM FCTLEN FCTCHG", number},

    {"BOUNDARY_*", "SF VX VY VZ", number},
    {"BOUNDARY_*", "BIRTH DEATH", duration},
    {"BOUNDARY_PRESCRIBED_MOTION*", "OFFSET1 OFFSET2", length},
    {"BOUNDARY_SPC_SYMMETRY_PLANE*", "X Y Z TOL", length},
    {"INITIAL_VELOCITY*", "VX VY VZ VXE VYE VZE", velocity},
    {"INITIAL_VELOCITY*", "VXR VYR VZR VXRE VYRE VZRE OMEGA", rate},
    {"INITIAL_VELOCITY*", "XC YC ZC", length},
    {"INITIAL_DETONATION*", "X Y Z", length},
    {"INITIAL_DETONATION*", "LT", duration},
    {"INITIAL_VELOCITY*", "NX NY NZ", number},
    {"LOAD_BLAST_ENHANCED", "M", mass},
    {"LOAD_BLAST_ENHANCED", "XBO YBO ZBO", length},
    {"LOAD_BLAST_ENHANCED", "TBO DEATH", duration},
    {"LOAD_BLAST*", "CFM CFL CFT CFP SCALEP SFNRB", number}, // UNIT tells of the units that come out
    {"LOAD_BODY*", "SF V1 V2 V3", number},
    {"LOAD_BODY*", "XC YC ZC", length},
    {"LOAD_NODE*", "SF", number},
    {"LOAD_SEGMENT*", "SF", number},
    {"LOAD_SEGMENT*", "AT DT", duration},
    {"LOAD_SHELL*", "SF", number},
    {"AIRBAG_*", "VSCA PSCA PSF GAMMA BETA MU C23 CP23", number},
    {"AIRBAG_*", "CN PO PE BULK P_LIMIT POVER PPOP", stress},
    {"AIRBAG_*", "RO", density},
    {"AIRBAG_*", "AREA A23 AP23", area},
    {"AIRBAG_*", "CV CP", heat_capacity},
    {"AIRBAG_*", "T", temperature},
    {"LOAD_SHELL*", "AT", duration},
    {"CONTACT_*",
     "FS FD VDC SFSA SFSB SFSAT SFSBT FSF VSF SOFSCL MAXPAR PENMAX DPRFAC EDGEK FLANGL DTPCHK FRICSF",
     number},
    {"CONTACT_*", "DC", slowness},
    {"CONTACT_*", "VC NFLS SFLS SLDSTF", stress},
    {"CONTACT_*", "BT DT", duration},
    {"CONTACT_*", "SAST SBST SLDTHK", length},
    {"RIGIDWALL_*", "OFFSET XT YT ZT XH YH ZH XHEV YHEV ZHEV LENL LENM", length},
    {"RIGIDWALL_*", "BIRTH DEATH", duration},
    {"RIGIDWALL_*", "RWKSF FRIC", number},
    {"RIGIDWALL_*", "WVEL V0", velocity},
    {"RIGIDWALL_*", "MASS", mass},
    {"CONSTRAINED_NODAL_RIGID_BODY*", "CMO", number},
    {"CONSTRAINED_NODAL_RIGID_BODY*", "XSPC YSPC ZSPC XC YC ZC XL YL ZL XLIP YLIP ZLIP", length},
    {"CONSTRAINED_NODAL_RIGID_BODY*", "TM", mass},
    {"CONSTRAINED_NODAL_RIGID_BODY*", "IXX IXY IXZ IYY IYZ IZZ", inertia},
    {"CONSTRAINED_NODAL_RIGID_BODY*", "VTX VTY VTZ", velocity},
    {"CONSTRAINED_NODAL_RIGID_BODY*", "VRX VRY VRZ", rate},
    {"CONSTRAINED_JOINT_*", "RPS DAMP COUPL", number},
    {"CONSTRAINED_JOINT_*", "TFAIL", duration},
    {"CONSTRAINED_JOINT_*", "NXX NYY NZZ", force},
    {"CONSTRAINED_JOINT_*", "MXX MYY MZZ", moment},
    {"DEFORMABLE_TO_RIGID_AUTOMATIC", "TIME1 TIME2 TIME3 DTMAX", duration},
    {"DEFORMABLE_TO_RIGID_AUTOMATIC", "OFFSET", length},
    {"CONSTRAINED_SPOTWELD", "SN SS", force},
    {"CONSTRAINED_SPOTWELD", "N M EP", number},
    {"CONSTRAINED_SPOTWELD", "TF", duration},
    {"CONSTRAINED_GENERALIZED_WELD_*", "TFAIL WINDOW", duration},
    {"CONSTRAINED_GENERALIZED_WELD_*", "SN SS", force},
    {"CONSTRAINED_GENERALIZED_WELD_*", "SIGY", stress},
    {"CONSTRAINED_GENERALIZED_WELD_*", "L W A D", length},
    {"CONSTRAINED_GENERALIZED_WELD_*", "N M EPSF BETA ALPHA", number},
    {"DAMPING_GLOBAL", "VALDMP", rate},
    {"DAMPING_*", "STX STY STZ SRX SRY SRZ SF COEF CDAMP", number},
    {"DAMPING_FREQUENCY_RANGE*", "FLOW FHIGH", rate},
    {"DATABASE_CROSS_SECTION_PLANE", "XCT YCT ZCT XCH YCH ZCH RADIUS XHEV YHEV ZHEV LENL LENM", length},
    {"DATABASE_TRACER*", "TIME", duration},
    {"DATABASE_TRACER*", "X Y Z RADIUS", length},
    {"DATABASE_*", "DT DTOUT DTXY", duration},
    {"CONTROL_CONTACT", "SLSFAC XPENE SFRIC DFRIC TH_SF PEN_SF PTSCL", number},
    {"CONTROL_CONTACT", "EDC", slowness},
    {"CONTROL_CONTACT", "VFC", stress},
    {"CONTROL_CONTACT", "TH", length},
    {"CONTROL_TERMINATION", "ENDTIM", duration},
    {"CONTROL_TERMINATION", "DTMIN ENDENG ENDMAS", number},
    {"CONTROL_DYNAMIC_RELAXATION", "DRTERM", duration},
    {"CONTROL_DYNAMIC_RELAXATION", "DRTOL DRFCTR TSSFDR EDTTL", number},
    {"CONTROL_TIMESTEP", "DTINIT DT2MS", duration},
    {"CONTROL_TIMESTEP", "TSSFAC", number},
};

/// Curves: what a field's curve gives over what, and the values of a table in the place of the curve.
struct CurveRow {
    std::string_view keyword, fields;
    CurveDimensions dimensions;
};

constexpr CurveRow curve_rows[] = {
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "LCSS", {number, stress, rate}},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "LCSR", {rate, number, number}},
    {"MAT_PLASTICITY_WITH_DAMAGE", "LCSS", {number, stress, rate}},
    {"MAT_PLASTICITY_WITH_DAMAGE", "LCSR", {rate, number, number}},
    {"MAT_PLASTICITY_WITH_DAMAGE", "LCDM", {number, number, number}},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", "LCIDC LCIDT", {number, stress, number}},
    {"MAT_LOW_DENSITY_FOAM", "LCID", {number, stress, rate}},
    {"MAT_LOW_DENSITY_VISCOUS_FOAM", "LCID", {number, stress, rate}},
    {"MAT_FU_CHANG_FOAM", "TBID", {number, stress, rate}},
    {"MAT_CRUSHABLE_FOAM", "LCID", {number, stress, rate}},
    {"MAT_SOIL_AND_FOAM", "LCID", {number, stress, number}},
    {"MAT_HYPERELASTIC_RUBBER", "LCID1", {length, force, number}},
    {"MAT_HONEYCOMB", "LCA LCB LCC LCS LCAB LCBC LCCA", {number, stress, number}},
    {"MAT_HONEYCOMB", "LCSR", {rate, number, number}},
    {"EOS_TABULATED*", "LCC LCK", {number, stress, number}},
    {"EOS_TABULATED*", "LCT", {number, number, number}},
    {"EOS_TENSOR_PORE_COLLAPSE", "NLD NCR", {number, stress, number}},
    {"MAT_MOONEY-RIVLIN_RUBBER", "LCID", {length, force, number}},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTR LCIDTS LCIDTT", {length, force, number}},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRR LCIDRS LCIDRT", {number, moment, number}},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTDR LCIDTDS LCIDTDT", {velocity, force, number}},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRDR LCIDRDS LCIDRDT", {rate, moment, number}},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPDR LCPDS LCPDT", {length, force, number}},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPMR LCPMS LCPMT", {number, moment, number}},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "LCIDF", {length, force, number}},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", "LCIDD", {length, damping, number}},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", "LCID", {length, area, number}},
    {"MAT_CABLE_DISCRETE_BEAM", "LCID", {number, stress, number}},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", "FLCID", {length, force, number}},
    {"MAT_GENERAL_NONLINEAR_*",
     "LCIDTR LCIDTS LCIDTT LCIDTUR LCIDTUS LCIDTUT LCIDT LCIDTU",
     {length, force, number}},
    {"MAT_GENERAL_NONLINEAR_*", "LCIDRR LCIDRS LCIDRT LCIDRUR LCIDRUS LCIDRUT", {number, moment, number}},
    {"MAT_GENERAL_NONLINEAR_*", "LCIDTDR LCIDTDS LCIDTDT LCIDTD", {velocity, force, number}},
    {"MAT_GENERAL_NONLINEAR_*", "LCIDRDR LCIDRDS LCIDRDT", {rate, moment, number}},
    {"MAT_GENERAL_NONLINEAR_*", "LCIDTER LCIDTES LCIDTET LCIDTE", {length, number, number}},
    {"MAT_GENERAL_NONLINEAR_*", "LCIDRER LCIDRES LCIDRET", {number, number, number}},
    {"MAT_SPRING_NONLINEAR_ELASTIC", "LCD", {length, force, number}},
    {"MAT_DAMPER_NONLINEAR_VISCOUS", "LCDR", {velocity, force, number}},
    {"LOAD_BODY_R*", "LCID LCIDDR", {duration, rate, number}},
    {"LOAD_BODY*", "LCID LCIDDR", {duration, acceleration, number}},
    {"LOAD_NODE*", "LCID", {duration, force, number}},
    {"LOAD_SEGMENT*", "LCID", {duration, stress, number}},
    {"LOAD_SHELL*", "LCID", {duration, stress, number}},
    {"AIRBAG_SIMPLE_PRESSURE_VOLUME", "LCID", {number, stress, number}},
    {"AIRBAG_SIMPLE_PRESSURE_VOLUME", "LCIDDR CN", {duration, stress, number}},
    {"AIRBAG_SIMPLE_AIRBAG_MODEL", "LCID", {duration, mass_rate, number}},
    {"AIRBAG_SIMPLE_AIRBAG_MODEL", "MU", {stress, number, number}},
    {"AIRBAG_SIMPLE_AIRBAG_MODEL", "AREA", {stress, area, number}},
    {"AIRBAG_SIMPLE_AIRBAG_MODEL", "LOU", {stress, mass_rate, number}},
    {"AIRBAG_WANG_NEFSKE", "LCT", {duration, temperature, number}},
    {"AIRBAG_WANG_NEFSKE", "LCMT", {duration, mass_rate, number}},
    {"AIRBAG_WANG_NEFSKE", "LCC23 LCCP23", {duration, number, number}},
    {"AIRBAG_WANG_NEFSKE", "LCA23 LCAP23", {stress, area, number}},
    {"AIRBAG_WANG_NEFSKE", "LCEFR", {stress, mass_rate, number}},
    {"AIRBAG_LINEAR_FLUID", "LCINT LCOUTT", {duration, mass_rate, number}},
    {"AIRBAG_LINEAR_FLUID", "LCOUTP", {stress, mass_rate, number}},
    {"AIRBAG_LINEAR_FLUID", "LCFIT LCBULK P_LIMLC", {duration, stress, number}},
    {"AIRBAG_LINEAR_FLUID", "LCID", {number, stress, number}},
    {"DAMPING_GLOBAL", "LCID", {duration, rate, number}},
    {"DAMPING_PART_MASS*", "LCID", {duration, rate, number}},
    {"CONTROL_TIMESTEP", "LCTM", {duration, duration, number}},
    {"DATABASE_*", "LCUR LCDT", {duration, duration, number}},
};

bool fits(std::string_view pattern, std::string_view name, char joker)
{
    if (!pattern.ends_with(joker)) return pattern == name;
    pattern.remove_suffix(1);
    if (!name.starts_with(pattern)) return false;
    name.remove_prefix(pattern.size());
    return joker == '*' || (!name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos);
}

bool names_field(std::string_view fields, std::string_view name)
{
    while (!fields.empty()) {
        const auto end = fields.find(' ');
        if (fits(fields.substr(0, end), name, '#')) return true;
        if (end == std::string_view::npos) return false;
        fields.remove_prefix(end + 1);
    }
    return false;
}

} // namespace

std::optional<double> UnitFactors::of(const Dimension& dimension) const
{
    if (temperature && dimension.temperature != 0) return std::nullopt;
    return std::pow(mass, dimension.mass) * std::pow(length, dimension.length) *
           std::pow(time, dimension.time);
}

std::optional<Dimension> dimension_of(std::string_view keyword, std::string_view field)
{
    for (const Row& row : rows)
        if (fits(row.keyword, keyword, '*') && names_field(row.fields, field)) return row.dimension;
    return std::nullopt;
}

std::optional<CurveDimensions> curve_dimensions_of(std::string_view keyword, std::string_view field, int kind,
                                                   bool rotation)
{
    if (keyword.starts_with("BOUNDARY_PRESCRIBED_MOTION") && field == "LCID") {
        if (kind == 3)
            return rotation ? CurveDimensions{number, rate, number}
                            : CurveDimensions{length, velocity, number};
        if (kind == 4) return CurveDimensions{duration, length, number};
        if (kind < 0 || kind > 2) return std::nullopt;
        const Dimension along[] = {velocity, acceleration, length},
                        about[] = {rate, angular_acceleration, number};
        return CurveDimensions{duration, rotation ? about[kind] : along[kind], number};
    }
    for (const CurveRow& row : curve_rows) {
        if (!fits(row.keyword, keyword, '*') || !names_field(row.fields, field)) continue;
        CurveDimensions dimensions = row.dimensions;
        if (rotation && dimensions.ordinate == force) dimensions.ordinate = moment;
        return dimensions;
    }
    return std::nullopt;
}

} // namespace plash
