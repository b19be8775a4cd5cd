#include "pipeline/person_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/units.h"
#include "io/atomic_file.h"

namespace pneuma {
namespace {

constexpr const char* PersonSchema = "pneuma/estimate/1";

[[noreturn]] void throwDamaged(const std::string& name, const std::string& what) {
  throw InvalidInput(name + " is damaged: " + what + "; write it anew with 'pneuma estimate'");
}

FormKind kindOf(const std::string& word, const std::string& name) {
  const auto names = choices(FormKind{});
  const auto at = std::ranges::find(names, word);
  if (at == names.end()) throwDamaged(name, "there is no form '" + word + "'");
  return static_cast<FormKind>(at - names.begin());
}

/// @throws InvalidInput for constants that no fit gives
void requireInRange(const PersonMotion& person, const std::vector<double>& constants) {
  constexpr double MostOfPolynomial = 1000.0;
  constexpr double MostPower = 10.0;
  if (constants.size() != constantCount(person.kind)) {
    throwDamaged(person.name, "it has " + std::to_string(constants.size()) +
                                  " constants where its form has " +
                                  std::to_string(constantCount(person.kind)));
  }
  for (const double value : constants) {
    if (!(std::abs(value) <= MostOfPolynomial))
      throwDamaged(person.name, "a constant is too large");
  }
  const auto* published = std::get_if<PublishedForm>(&person.form);
  if (published == nullptr) return;
  if (published->weights.minCoeff() < 0.0 || published->powers.minCoeff() <= 0.0 ||
      published->powers.maxCoeff() > MostPower) {
    throwDamaged(person.name, "a weight is below 0, or a power is not above 0 and up to 10");
  }
}

Side sideNamed(const std::string& word) {
  return word == "right" ? Side::Right : word == "left" ? Side::Left : Side::None;
}

/// @throws nlohmann's exceptions where something is missing or of another kind
void fill(PersonMotion& person, const Json& json) {
  person.kind = kindOf(json.at("form").get<std::string>(), person.name);
  std::vector<double> constants;
  for (const Json& constant : json.at("constants")) {
    constants.push_back(constant.at("value").get<double>());
  }
  if (constants.size() == constantCount(person.kind)) person.form = formOf(person.kind, constants);
  requireInRange(person, constants);
  const Json& landmarks = json.at("landmarks");
  person.landmarks = landmarks.at("fitted").get<std::size_t>();
  person.heldOut = landmarks.at("held_out").get<std::size_t>();
  for (const Json& row : json.at("errors")) {
    const Json& told = row.contains("held_out") ? row.at("held_out") : row.at("fitted");
    const double mm = told.at("raw").at("mean_mm").get<double>();
    if (row.at("motion") == "no motion") person.stillMm = mm;
    if (row.at("motion") == "these constants") person.errorMm = mm;
  }
  for (const Json& lung : json.at("lungs")) {
    const Side side = sideNamed(lung.at("lung").get<std::string>());
    person.strain[side] = lung.at("strain").get<double>();
    if (lung.contains("rest_ml")) person.restMl[side] = lung.at("rest_ml").get<double>();
  }
}

std::string oneDigit(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

}  // namespace

PersonMotion readPersonMotion(const std::filesystem::path& path) {
  constexpr std::size_t MostBytes = std::size_t{16} << 20;
  PersonMotion person;
  person.name = "'" + path.string() + "'";
  const Json json = Json::parse(readFile(path, MostBytes), nullptr, false);
  if (!json.is_object() || json.value("schema", Json()) != PersonSchema) {
    throw InvalidInput(person.name +
                       " holds no constants of a person; 'pneuma estimate' writes such files");
  }
  try {
    fill(person, json);
  } catch (const Json::exception&) {
    throwDamaged(person.name, "something is missing or is no number");
  }
  return person;
}

std::vector<std::string> doubts(const PersonMotion& person, const std::map<Side, double>& restMm3,
                                const std::map<Side, double>& mostMm3) {
  constexpr double MostOff = 0.15;   // of a lung's volume
  constexpr double MostTimes = 2.0;  // of a strain
  std::vector<std::string> sentences;
  for (const auto& [side, mm3] : restMm3) {
    const std::string lung = "the " + std::string(name(side)) + " lung";
    const auto strain = person.strain.find(side);
    if (strain == person.strain.end()) {
      sentences.push_back("The constants in " + person.name + " were fitted without landmarks in " +
                          lung + ", which moves by them too.");
      continue;
    }
    const auto rest = person.restMl.find(side);
    if (rest != person.restMl.end() && std::abs(millilitres(mm3) / rest->second - 1.0) > MostOff) {
      sentences.push_back(
          "At rest " + lung + " holds " + std::to_string(std::lround(millilitres(mm3))) +
          " ml, the one that the constants in " + person.name + " were fitted to held " +
          std::to_string(std::lround(rest->second)) + " ml; are they of the same person?");
    }
    const double here = std::cbrt(mostMm3.at(side) / mm3) - 1.0;
    if (here > MostTimes * strain->second || MostTimes * here < strain->second) {
      sentences.push_back("In this breath " + lung + " widens by " + oneDigit(100.0 * here) +
                          " % in each direction, the constants in " + person.name +
                          " come from one of " + oneDigit(100.0 * strain->second) +
                          " %; quiet and deep breathing move lungs in different ways.");
    }
  }
  return sentences;
}

std::string basisOf(const PersonMotion& person) {
  const std::string off =
      oneDigit(person.errorMm) + " mm, no motion by " + oneDigit(person.stillMm) + " mm";
  const std::string of = "constants fitted to " + std::to_string(person.landmarks) +
                         " landmarks of this person (form '" + textOf(person.kind) + "')";
  return person.heldOut > 0
             ? of + ", off on " + std::to_string(person.heldOut) + " others by a mean of " + off
             : of + ", off on these same ones by a mean of " + off;
}

Json toJson(const PersonMotion& person) {
  return {{"file", person.name.substr(1, person.name.size() - 2)},
          {"form", textOf(person.kind)},
          {"values", constantsOf(person.form, person.kind)},
          {"fitted_landmarks", person.landmarks},
          {"held_out_landmarks", person.heldOut},
          {"error_mm", person.errorMm},
          {"no_motion_mm", person.stillMm}};
}

}  // namespace pneuma
