#include "io/detail/person_words.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

struct Shown {
  Identifiers identifiers;
  std::string description;
  std::string expected;
};

TEST(PersonWords, AreLeftOutOfDescriptions) {
  const std::vector<Shown> all = {
      {{{"PatientName", "DOE^JANE"}}, "CT Doe lung 1.0", "CT ... lung 1.0"},
      {{{"PatientName", "DOE^JANE"}}, "CT DoeJane chest", "CT ... chest"},
      {{{"PatientName", "DOE^JANE"}}, "JDoe,DOEJ janeDoe3", "... ..."},
      {{{"PatientName", "VAN DER BERG^J"}}, "vanderBerg thin", "... thin"},
      {{{"PatientName", "PETERSEN^OLE"}}, "Petersens lung", "... lung"},
      {{{"PatientName", "LI^AN"}}, "LiAn brilliant", "... brilliant"},
      {{{"PatientID", "12345678"}}, "chest 1234-5678", "chest ..."},
      {{{"PatientID", "12345678"}}, "chest 1234 5678 B60f", "chest ... ... B60f"},
      {{{"PatientID", "0012345678"}}, "Chest12345678", "..."},
      {{{"PatientID", "4711-0815"}}, "47110815 axial", "... axial"},
      {{{"PatientID", "4711/08"}}, "VB471108", "..."},
      {{{"OtherPatientIDs", "AB-77\\CD-99"}}, "cd99 ab77", "... ..."},
      {{{"PatientBirthDate", "19310213"}}, "13.02.1931 1931-02-13 02/13/31 x", "... ... ... x"},
      {{{"PatientBirthDate", "19310203"}}, "3.2.1931 2/3/31 3.02.1931 x", "... ... ... x"},
      {{{"PatientName", "DOE^JANE"}}, "Doe2 D-O-E D.o.e 3JANE", "... ... ... ..."},
      {{{"PatientName", "ИВАНОВ^X"}}, "Иванов lung", "... lung"},
      {{{"PatientName", "ŁUKASZ^ŻAK"}}, "łukasz żak Ak", "... ... Ak"},
      {{{"PatientName", "Doe^Östen"}}, "ÖDoe DoeÖ", "... ..."},
      {{{"PatientName", "山田^太郎"}}, "胸部山田太郎 CT", "... CT"},
      {{{"OperatorsName", "SMITH^BOB"}}, "BobSmith BSmith bob", "... ... ..."},
  };
  for (const Shown& shown : all) {
    EXPECT_EQ(withoutPerson(shown.description, shown.identifiers), shown.expected);
  }
}

/// Damaged headers, over and over in one description, which thousands of names are compared with.
TEST(PersonWords, TextsOfAnyLengthAreCut) {
  const auto repeated = [](const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  const Identifiers identifiers = {{"PatientName", repeated("ab ", 20000)},
                                   {"OtherPatientIDs", repeated(repeated("1", 640) + "\\", 100)}};
  EXPECT_EQ(withoutPerson(repeated("1 ", 30000), identifiers), "..." + repeated(" ...", 511));
  EXPECT_EQ(withoutPerson(repeated("c", 60000), identifiers), repeated("c", 1024));
}

TEST(PersonWords, WhatNamesNobodyStays) {
  const Identifiers identifiers = {{"PatientName", "DOE^JANE"},
                                   {"PatientID", "0001"},
                                   {"AccessionNumber", "5001"},
                                   {"PatientBirthDate", "19310213"}};
  const std::string description = "Thorax 5.0 01 B60f LUNG dose 1.25 mm DoG";
  EXPECT_EQ(withoutPerson(description, identifiers), description);
  EXPECT_EQ(withoutPerson(description, {}), description);
  EXPECT_EQ(withoutPerson("", identifiers), "");
}

}  // namespace
}  // namespace pneuma
