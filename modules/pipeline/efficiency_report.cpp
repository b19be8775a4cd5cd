#include "pipeline/efficiency_report.h"

#include <array>
#include <cstdio>

namespace pneuma {
namespace {

Json numberOrNull(const std::optional<double>& value) {
  return value.has_value() ? Json(*value) : Json();
}

Json functionsJson(const Efficiency& efficiency, const EfficiencyFunctions& functions) {
  const Vec3& node = functions.cubes.node;
  return {{"N", efficiency.branches},
          {"Q_f", efficiency.qf},
          {"C_n", numberOrNull(functions.cn)},
          {"C_a", numberOrNull(efficiency.ca)},
          {"V_r", functions.vr},
          {"EL", functions.el},
          {"PI", numberOrNull(functions.pi)},
          {"cubes", functions.cubeCount},
          {"cube_edge_mm", functions.cubes.edgeMm},
          {"cube_node_mm", {node.x(), node.y(), node.z()}},
          {"cube_least_inside", functions.cubes.leastInside},
          {"lung_volume_ml", functions.lungVolumeMl}};
}

std::string functionsText(const Efficiency& efficiency, const EfficiencyFunctions& functions,
                          const char* definitions) {
  const auto text = [](const std::optional<double>& value, int decimals) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value.value_or(0.0));
    return std::string(value.has_value() ? buffer.data() : "-");
  };
  return "  Q_f " + text(efficiency.qf, 4) + ", C_n " + text(functions.cn, 3) + ", C_a " +
         text(efficiency.ca, 3) + ", V_r " + text(functions.vr, 4) + ", EL " +
         text(functions.el, 4) + ", PI " + text(functions.pi, 3) + " (" + definitions + "; " +
         std::to_string(functions.cubeCount) + " cubes of " + text(functions.cubes.edgeMm, 1) +
         " mm, lungs of " + text(functions.lungVolumeMl, 0) + " ml)\n";
}

}  // namespace

Json toJson(const Efficiency& efficiency) {
  return {{"branches", efficiency.branches},
          {"terminals", efficiency.terminals},
          {"failed", efficiency.failed},
          {"airway_volume_ml", efficiency.airwayVolumeMl},
          {"paper", functionsJson(efficiency, efficiency.paper)},
          {"today", functionsJson(efficiency, efficiency.today)}};
}

std::string efficiencyText(const Efficiency& efficiency) {
  return "efficiency: " + std::to_string(efficiency.failed) + " of " +
         std::to_string(efficiency.terminals) + " terminals failed\n" +
         functionsText(efficiency, efficiency.paper, "Kitaoka 1999") +
         functionsText(efficiency, efficiency.today, "today");
}

}  // namespace pneuma
