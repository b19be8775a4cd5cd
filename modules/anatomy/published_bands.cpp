#include "anatomy/published_bands.h"

#include <array>

namespace pneuma {
namespace {

constexpr std::string_view ChasteTree = "Chaste's test tree Subject002";

constexpr std::array Bands = std::to_array<PublishedBand>({
    {"branches", 54000, 54000, "Kitaoka 1999, abstract"},
    {"terminals", 26000, 32000,
     "Kitaoka 1999: 27,306; Haefeli-Bleuer & Weibel 1988 (recalled); both lungs"},
    {"terminal_generation.mean", 16, 17.6,
     "Weibel 1963 A (recalled): 16; Chaste's test tree Subject002: 17; Kitaoka 1999: 17.6"},
    {"terminal_generation.sd", 3.4, 3.4, "Kitaoka 1999"},
    {"terminal_generation.min", 8, 10, "Kitaoka 1999: 8; Chaste's test tree Subject002: 10"},
    {"terminal_generation.max", 29, 32, "Kitaoka 1999: 32; Chaste's test tree Subject002: 29"},
    {"path_length_mm.mean", 266, 270,
     "Weibel 1963 A to generation 16: 266 (recalled table); Kitaoka 1999 (recalled); trachea "
     "included"},
    {"branching_angle_deg.mean", 37, 43, "Horsfield, Tawhai (recalled)"},
    {"branching_angle_major_deg.mean", 39.36, 39.36, ChasteTree},
    {"branching_angle_minor_deg.mean", 44.88, 44.88, ChasteTree},
    {"branching_angle_by_parent_diameter_deg.>4 mm.mean", 29.5, 29.5, ChasteTree},
    {"branching_angle_by_parent_diameter_deg.4-3 mm.mean", 25.3, 25.3, ChasteTree},
    {"branching_angle_by_parent_diameter_deg.3-2 mm.mean", 30.5, 30.5, ChasteTree},
    {"branching_angle_by_parent_diameter_deg.2-1 mm.mean", 36.0, 36.0, ChasteTree},
    {"rotation_angle_deg.mean", 75, 90,
     "CT: 75-80 (Sauret 2002, recalled); Kitaoka 1999: 90 by construction"},
    {"length_to_diameter.mean", 2.8, 3.3,
     "casts (recalled); Kitaoka 1999: 3.06; Weibel 1963 A: 3.24 (recalled table)"},
    {"length_to_parent.mean", 0.86, 0.93,
     "Chaste's test tree Subject002: 0.877; trees grown by lungsim and Chaste: 0.86-0.93"},
    {"length_to_parent_below_one", 0.66, 0.72,
     "Chaste's test tree Subject002: 0.699; trees grown by lungsim and Chaste: 0.66-0.72"},
    {"diameter_to_parent.mean", 0.79, 0.82,
     "2^(-1/3) = 0.794; Weibel 1963 A: 0.808 (recalled table); Chaste's test tree Subject002: "
     "0.815"},
    {"diameter_minor_to_major.mean", 0.96, 0.96, ChasteTree},
    {"strahler.Rb", 2.51, 2.81, "Horsfield, Relea & Cumming 1976 (recalled)"},
    {"strahler.Rl", 1.33, 1.49, "Horsfield, Relea & Cumming 1976 (recalled)"},
    {"strahler.Rd", 1.35, 1.45, "Horsfield, Relea & Cumming 1976 (recalled)"},
    {"horsfield.Rb", 1.38, 1.50, "Horsfield 1971, Tawhai 2004 (recalled)"},
    {"horsfield.Rl", 1.10, 1.14, "Horsfield 1971, Tawhai 2004 (recalled)"},
    {"horsfield.Rd", 1.11, 1.15, "Horsfield 1971, Tawhai 2004 (recalled); Chaste tutorial: 1.15"},
    {"dead_space_ml", 130, 180,
     "adult 150 (teaching texts); Weibel 1963 A to generation 16: 175 (recalled table)"},
    {"gap_mean", 0.48, 0.55,
     "goal of this project; cubic lattice 0.48; trees grown by lungsim and Chaste: 0.58-0.62"},
    {"gap_max", 0.87, 1.30,
     "goal of this project; cubic lattice 0.87; trees grown by lungsim and Chaste: 1.45-1.72"},
});

}  // namespace

std::span<const PublishedBand> publishedBands() { return Bands; }

}  // namespace pneuma
