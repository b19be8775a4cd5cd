#pragma once

#include <memory>
#include <string>

class vtkAlgorithm;
class vtkObject;
class vtkXMLReader;

namespace pneuma {

/// Collects what VTK says of an object, instead of it going to the terminal.
class VtkErrors {
 public:
  explicit VtkErrors(vtkObject& object);

  /// Also listens to the algorithm's executive.
  explicit VtkErrors(vtkAlgorithm& algorithm);

  /// Also listens to the reader's XML parser.
  explicit VtkErrors(vtkXMLReader& reader);
  ~VtkErrors();
  VtkErrors(const VtkErrors&) = delete;
  VtkErrors& operator=(const VtkErrors&) = delete;

  /// The first error without VTK's file names and addresses; "" if there was none.
  const std::string& first() const;

 private:
  class Listener;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pneuma
