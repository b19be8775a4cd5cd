// make_dicom FOLDER [gap|tilt|mr|uneven|two|head|far|odd]: a small CT series, spoilt in one way; or
// odd ones.
#include <cstdio>
#include <string>

#include "support/dicom_maker.h"

using pneuma::Vec3;
using pneuma::testing::DicomMaker;
using pneuma::testing::SeriesSpec;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: make_dicom FOLDER [gap|tilt|mr|uneven|two|head|far|odd]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  const std::string way = argc > 2 ? argv[2] : "";
  if (way == "odd") {
    pneuma::testing::writeOddSeries(folder);
    return 0;
  }
  SeriesSpec spec;
  spec.slices = 20;
  if (way == "far") spec.step = Vec3(0.0, 0.0, 1e200);
  if (way == "tilt") spec.step = Vec3(0.0, 0.6, 3.0);
  spec.change = [&](DicomMaker& maker, int k) {
    if (way == "mr") maker.setText(0x00080060, "CS", "MR");
    if (way == "head") maker.setText(0x00180015, "CS", "HEAD");
    if (way == "uneven" && k % 2 == 1) maker.position(spec.point(0, 0, k) + Vec3(0.0, 0.0, 0.5));
    return way != "gap" || (k != 7 && k != 8);
  };
  writeSeries(folder, spec);
  if (way == "two") {
    spec.uid = "1.2.826.0.1.3680043.9.2";
    spec.slices = 5;
    writeSeries(folder + "/second", spec);
  }
  return 0;
}
