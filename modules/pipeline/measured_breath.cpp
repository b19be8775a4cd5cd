#include "pipeline/measured_breath.h"

#include "io/number_table.h"

namespace pneuma {

MeasuredBreath readMeasuredBreath(const std::filesystem::path& path) {
  constexpr double MlPerLitre = 1000.0;
  const std::vector<std::vector<std::string_view>> wanted = {
      {"seconds", "time_s"}, {"pressure_cmh2o"}, {"volume_ml", "volume_l"}};
  NumberTable table = readNumberTable(path, wanted);
  MeasuredBreath measured{std::move(table.name), std::move(table.lines), std::move(table.values[0]),
                          std::move(table.values[1]), std::move(table.values[2])};
  if (table.columns[2] == "volume_ml") {
    for (double& volume : measured.volume) volume /= MlPerLitre;
  }
  return measured;
}

}  // namespace pneuma
